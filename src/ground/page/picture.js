// The picture and what is drawn over it, both of the same frame. Each part of the drawing is shown
// or hidden by its key below the picture.
const Picture = (() => {
  const canvas = document.getElementById("picture"), to = canvas.getContext("2d");
  const kTrace = 90;  // frames of the corners' way that are drawn
  const hidden = new Set();
  let traces = [[], [], [], []], image = null, view = null, drawn = null, unit = 1;

  function path(points, colour, width, dashes) {
    if (!points || points.some(p => p[0] === null)) return;
    to.beginPath();
    points.forEach((p, i) => i ? to.lineTo(p[0], p[1]) : to.moveTo(p[0], p[1]));
    to.closePath();
    stroke(colour, width, dashes);
  }
  function stroke(colour, width, dashes) {
    to.setLineDash((dashes || []).map(length => length * unit));
    to.lineWidth = (width + 2) * unit; to.strokeStyle = "rgba(0,0,0,.65)"; to.stroke();
    to.lineWidth = width * unit; to.strokeStyle = colour; to.stroke();
    to.setLineDash([]);
  }
  function dots(points, colour, radius) {
    for (const p of points || []) {
      if (p[0] === null) continue;
      to.beginPath(); to.arc(p[0], p[1], radius * unit, 0, 7);
      to.fillStyle = colour; to.fill();
      to.lineWidth = unit; to.strokeStyle = "#000"; to.stroke();
    }
  }
  // Of another shape than dots: not by the colour alone.
  function crosses(points, colour) {
    to.beginPath();
    const r = 3 * unit;
    for (const p of points || []) {
      to.moveTo(p[0] - r, p[1] - r); to.lineTo(p[0] + r, p[1] + r);
      to.moveTo(p[0] - r, p[1] + r); to.lineTo(p[0] + r, p[1] - r);
    }
    stroke(colour, 1.2);
  }
  function ways() {
    for (const trace of traces) {
      if (trace.length < 2) continue;
      to.beginPath();
      trace.forEach((p, i) => i ? to.lineTo(p[0], p[1]) : to.moveTo(p[0], p[1]));
      to.lineWidth = 1.5 * unit; to.strokeStyle = "#f2cc4d"; to.stroke();
    }
  }
  function draw() {
    if (!image) return;
    if (canvas.width !== image.width || canvas.height !== image.height) {
      canvas.width = image.width; canvas.height = image.height;
      document.documentElement.style.setProperty("--shape", image.width / image.height);
    }
    unit = Math.max(1, canvas.width / (canvas.clientWidth || canvas.width));  // no thinner where it is shown small
    to.drawImage(image, 0, 0);
    if (view) overlay();
    if (drawn) path([[drawn.x, drawn.y], [drawn.x + drawn.w, drawn.y],
      [drawn.x + drawn.w, drawn.y + drawn.h], [drawn.x, drawn.y + drawn.h]], "#6fc0f0", 2, [6, 4]);
  }
  const kLayers = [
    ["window", () => {
      const w = view.window;
      if (!(w[2] > 0)) return;
      to.beginPath(); to.rect(w[0], w[1], w[2], w[3]);
      to.lineWidth = 3 * unit; to.strokeStyle = "rgba(255,255,255,.7)"; to.stroke();
      to.lineWidth = 1.5 * unit; to.strokeStyle = "#000"; to.stroke();
    }],
    ["horizon", () => {
      if (!view.horizon) return;
      to.beginPath(); to.moveTo(...view.horizon[0]); to.lineTo(...view.horizon[1]);
      stroke("#f4f6f8", 1, [14, 8]);
    }],
    ["others", () => crosses(view.others, "#ff9b54")],
    ["inliers", () => dots(view.inliers, "#58a6ff", 2)],
    ["goal", () => { path(view.goal, "#ff5d52", 2, [8, 4]); dots(view.goal, "#ff5d52", 5); }],
    ["trace", ways],
    ["predicted", () => path(view.predicted, "#aab4bf", 2, [3, 4])],
    ["corners", () => { path(view.corners, "#3ee07f", 2); dots(view.corners, "#3ee07f", 5); }],
  ];
  function overlay() { for (const [name, show] of kLayers) if (!hidden.has(name)) show(); }

  for (const key of document.querySelectorAll("[data-layer]")) {
    key.addEventListener("click", () => {
      const name = key.dataset.layer;
      if (!hidden.delete(name)) hidden.add(name);
      key.setAttribute("aria-pressed", String(!hidden.has(name)));
      draw();
    });
  }
  return {
    canvas,
    show(nextImage, nextView) {
      if (image && image.close && image !== nextImage) image.close();
      image = nextImage; view = nextView;
      traces.forEach((trace, i) => {
        if (view.corners) trace.push(view.corners[i]);
        if (trace.length > kTrace || (!view.corners && trace.length)) trace.shift();
      });
      draw();
    },
    mark(rectangle) { drawn = rectangle; draw(); },
    forget() { traces = [[], [], [], []]; },
    frame() { return view ? view.frame : null; },
    // A place of the pointer in pixels of the picture.
    place(event) {
      const box = canvas.getBoundingClientRect();
      const clip = (x, most) => Math.max(0, Math.min(most, Math.round(x)));
      return { x: clip((event.clientX - box.left) * canvas.width / box.width, canvas.width),
        y: clip((event.clientY - box.top) * canvas.height / box.height, canvas.height) };
    },
  };
})();
