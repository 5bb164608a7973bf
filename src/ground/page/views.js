// Maps from above and from the side, the horizon, and how the line to the vehicle is.
const Views = (() => {
  const kTrail = 600;  // places of the vehicle that are drawn
  const style = getComputedStyle(document.documentElement);
  const colour = name => style.getPropertyValue(name).trim();
  // Across and down on the screen, of forward, right, down of the level frame at the target.
  const kFrom = { above: p => [p[1], -p[0]], side: p => [p[0], p[2]] };
  const kEdges = { above: [[0, 3], [1, 2]], side: [[0, 1], [3, 2]] };  // corners of the picture at its two edges
  let trail = [], scene = null, last = null, attitude = null, counts = [], stamp_s = -1;

  function fitted(canvas) {
    const dots = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    if (!w || !h) return null;
    canvas.width = w * dots;
    canvas.height = h * dots;
    const to = canvas.getContext("2d");
    to.setTransform(dots, 0, 0, dots, 0, 0);
    to.clearRect(0, 0, w, h);
    to.font = Math.max(12, Math.round(h / 18)) + "px system-ui, sans-serif";
    return { to, w, h };
  }
  // From metres to the screen, the same scale in both directions.
  function scaled(points, w, h) {
    const across = points.map(p => p[0]), down = points.map(p => p[1]);
    const box = list => [Math.min(...list), Math.max(...list)];
    const [left, right] = box(across), [top, bottom] = box(down);
    const k = Math.min((w - 60) / Math.max(right - left, 1), (h - 70) / Math.max(bottom - top, 1));
    return { k, at: p => [w / 2 + (p[0] - (left + right) / 2) * k, h / 2 - 8 + (p[1] - (top + bottom) / 2) * k] };
  }
  function line(to, points, close) {
    to.beginPath();
    points.forEach((p, i) => i ? to.lineTo(p[0], p[1]) : to.moveTo(p[0], p[1]));
    if (close) to.closePath();
  }
  function arrow(to, p, towards, ink, filled) {
    const angle = Math.atan2(towards[1], towards[0]), size = 11;
    const tip = a => [p[0] + size * Math.cos(angle + a), p[1] + size * Math.sin(angle + a)];
    line(to, [tip(0), tip(2.5), tip(-2.5)], true);
    to.lineWidth = 2; to.strokeStyle = ink; to.stroke();
    if (filled) { to.fillStyle = ink; to.fill(); }
  }
  const heading = place => [Math.cos(place[3]), Math.sin(place[3]), 0];

  function bar(to, k, w, h) {  // a length of 1, 2 or 5 times a power of ten, a sixth of the width or more
    const length = Plot.step(w / 6 / k), x = w - 12 - length * k;
    to.strokeStyle = to.fillStyle = colour("--soft");
    to.lineWidth = 2;
    line(to, [[x, h - 8], [w - 12, h - 8]]);
    to.stroke();
    to.textAlign = "right";
    to.fillText(length + " m", w - 12, h - 14);
  }
  function sight(to, from, place, flat, k) {
    const reach = Math.hypot(place[0], place[1], place[2]) * 1.15;
    const ends = kEdges[from].map(([i, j]) => {
      const d = flat(scene.sight[i].map((x, n) => (x + scene.sight[j][n]) / 2));
      return [d[0] * reach * k, d[1] * reach * k];
    });
    const p = last.screen[from];
    line(to, [p, [p[0] + ends[0][0], p[1] + ends[0][1]], [p[0] + ends[1][0], p[1] + ends[1][1]]], true);
    to.fillStyle = "rgba(111,192,240,.16)";
    to.fill();
  }
  function map(from, id) {
    const sheet = fitted(at(id));
    if (!sheet || !scene) return;
    const { to, w, h } = sheet, flat = kFrom[from], target = scene.target.map(flat);
    const places = [...target, flat(scene.goal), ...(last ? [flat(last.place)] : []), ...trail.map(flat)];
    const { k, at: on } = scaled(places, w, h);
    if (last) last.screen[from] = on(flat(last.place));
    if (scene.vehicle) sight(to, from, scene.vehicle, flat, k);
    line(to, trail.map(p => on(flat(p))));
    to.lineWidth = 1.5; to.strokeStyle = colour("--c4"); to.stroke();
    line(to, target.map(on), true);
    to.lineWidth = 5; to.strokeStyle = colour("--ink"); to.stroke();
    arrow(to, on(flat(scene.goal)), flat(heading(scene.goal)), "#ff5d52", false);
    if (last) arrow(to, last.screen[from], flat(heading(last.place)), scene.vehicle ? "#3ee07f" : "#aab4bf", true);
    bar(to, k, w, h);
    to.textAlign = "left"; to.fillStyle = colour("--soft");
    to.fillText(from === "above" ? "forward is up" : "forward is to the right", 8, h - 10);
  }
  function drawHorizon() {
    const sheet = fitted(at("horizon"));
    if (!sheet || !attitude) return;
    const { to, w, h } = sheet, r = Math.min(w, h) / 2 - 6, [roll, pitch] = attitude, k = r / 0.7;
    to.save();
    to.translate(w / 2, h / 2);
    to.beginPath(); to.arc(0, 0, r, 0, 7); to.clip();
    to.rotate(-roll);
    to.fillStyle = "#1f5f93"; to.fillRect(-2 * r, -3 * r + pitch * k, 4 * r, 3 * r);
    to.fillStyle = "#5e4526"; to.fillRect(-2 * r, pitch * k, 4 * r, 3 * r);
    to.strokeStyle = "#fff"; to.lineWidth = 2;
    line(to, [[-2 * r, pitch * k], [2 * r, pitch * k]]); to.stroke();
    to.lineWidth = 1; to.fillStyle = "#fff"; to.textAlign = "left";
    for (const degrees of [-20, -10, 10, 20]) {
      const y = pitch * k - degrees / 180 * Math.PI * k;
      line(to, [[-r / 5, y], [r / 5, y]]); to.stroke();
      to.fillText(String(degrees), r / 5 + 4, y + 4);
    }
    to.restore();
    to.strokeStyle = colour("--c4"); to.lineWidth = 3;
    line(to, [[w / 2 - r * .6, h / 2], [w / 2 - r * .15, h / 2], [w / 2, h / 2 + r * .1], [w / 2 + r * .15, h / 2], [w / 2 + r * .6, h / 2]]);
    to.stroke();
  }
  function words() {
    const m = (x, plus, minus) => `${Math.abs(x).toFixed(2)} m ${x >= 0 ? plus : minus}`;
    const of = p => `${m(p[0], "beyond it", "before it")}, ${m(p[1], "right", "left")}, ${m(-p[2], "above", "below")}`;
    at("map_words").textContent = !scene.vehicle ? "The target is not seen; grey: where the vehicle was last."
      : "Vehicle: " + of(scene.vehicle) + ".";
    at("horizon_words").textContent = attitude
      ? "Roll, pitch, heading: " + attitude.map(x => fixed(x * 180 / Math.PI, 0)).join(", ") + " deg" : "The source tells no attitude.";
  }
  function rate(now_ms, count) {
    counts.push([now_ms, count]);
    while (counts.length > 2 && counts[0][0] < now_ms - 3000) counts.shift();
    const [then_ms, before] = counts[0];
    if (count < before) counts = [];
    return now_ms > then_ms && count >= before ? (count - before) / (now_ms - then_ms) * 1000 : 0;
  }
  function showLink(desk) {
    const [commands, zeros, failures] = desk.sent, per_s = rate(performance.now(), commands);
    const rows = [["Commands sent", `${commands}, ${per_s.toFixed(0)} a second`], ["Of these zero", String(zeros)],
      ["Could not be sent", String(failures)],
      ["Page to program", Commands.took_ms() === null ? "–" : Commands.took_ms().toFixed(0) + " ms"], ...desk.facts];
    const list = at("link");
    while (list.children.length > 2 * rows.length) list.lastChild.remove();
    rows.forEach(([name, value, tone], i) => {
      if (!list.children[2 * i]) list.append(document.createElement("dt"), document.createElement("dd"));
      if (list.children[2 * i].textContent !== name) list.children[2 * i].textContent = name;
      if (list.children[2 * i + 1].textContent !== value) list.children[2 * i + 1].textContent = value;
      list.children[2 * i + 1].className = tone || "";
    });
  }

  return {
    show(view) {
      if (view.stamp_s < stamp_s) { trail = []; last = null; }
      stamp_s = view.stamp_s;
      scene = view.scene;
      attitude = view.attitude;
      if (scene.vehicle) {
        last = { place: scene.vehicle, screen: {} };
        trail.push(scene.vehicle);
        if (trail.length > kTrail) trail.shift();
      }
    },
    showLink,
    forget() { trail = []; last = null; },
    draw() {
      if (!scene) return;
      map("above", "map_above");
      map("side", "map_side");
      drawHorizon();
      words();
    },
  };
})();
