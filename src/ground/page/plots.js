// Curves over the last seconds, drawn on a canvas.
const kSpan_s = 20;
const kColours = ["--c0", "--c1", "--c2", "--c3", "--c4", "--c5", "--c6", "--c7"]
  .map(name => getComputedStyle(document.documentElement).getPropertyValue(name).trim());

// curves: names; those of one name have one colour, and those that start with "~" are dashed.
class Plot {
  constructor(id, curves) {
    this.canvas = document.getElementById(id);
    this.to = this.canvas.getContext("2d");
    this.curves = curves.map(name => name.replace("~", ""));
    this.dashed = curves.map(name => name.startsWith("~"));
    const solid = [...new Set(this.curves)];
    this.colours = this.curves.map(name => kColours[solid.indexOf(name) % kColours.length]);
    this.times = [];
    this.values = curves.map(() => []);
  }
  add(time_s, values) {
    if (this.times.length && time_s <= this.times[this.times.length - 1]) this.clear();
    this.times.push(time_s);
    this.values.forEach((curve, i) => curve.push(values && Number.isFinite(values[i]) ? values[i] : null));
    while (this.times[0] < time_s - kSpan_s) { this.times.shift(); this.values.forEach(curve => curve.shift()); }
  }
  clear() { this.times = []; this.values = this.values.map(() => []); }
  range() {
    let low = 0, high = 0;
    for (const curve of this.values) for (const v of curve) if (v !== null) { low = Math.min(low, v); high = Math.max(high, v); }
    if (high - low < 1e-9) high = low + 1;
    const step = Plot.step((high - low) / 3);
    return { low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
  }
  // 1, 2 or 5 times a power of ten, not below the value.
  static step(value) {
    const power = Math.pow(10, Math.floor(Math.log10(value)));
    return [1, 2, 5, 10].map(k => k * power).find(step => step >= value * 0.999);
  }
  draw() {
    const dots = window.devicePixelRatio || 1, w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    if (!w || !h) return;
    this.canvas.width = w * dots; this.canvas.height = h * dots;
    const to = this.to, font = Math.max(12, Math.round(h / 15));
    to.setTransform(dots, 0, 0, dots, 0, 0);
    to.font = font + "px system-ui, sans-serif";
    const left = font * 3.6, right = w - 4, top = font * 1.8, bottom = h - font * 1.5;
    const range = this.range(), end = this.times.length ? this.times[this.times.length - 1] : 0;
    const x = t => right - (end - t) / kSpan_s * (right - left);
    const y = v => bottom - (v - range.low) / (range.high - range.low) * (bottom - top);
    this.grid(x, y, range, end, { left, right, bottom, font });
    this.lines(x, y);
    this.key(2, font);
  }
  grid(x, y, range, end, at) {
    const to = this.to;
    to.strokeStyle = "#323c48"; to.fillStyle = "#a4b0bd"; to.lineWidth = 1; to.setLineDash([]);
    to.textAlign = "right";
    for (let v = range.low; v <= range.high + range.step / 2; v += range.step) {
      to.beginPath(); to.moveTo(at.left, y(v)); to.lineTo(at.right, y(v)); to.stroke();
      to.fillText(Number(v.toPrecision(3)).toString(), at.left - 4, y(v) + at.font / 3);
    }
    to.textAlign = "center";
    for (let t = 0; t <= kSpan_s; t += 5) to.fillText((t ? "-" + t : "0") + " s", Math.min(x(end - t), at.right - at.font * 1.4), at.bottom + at.font * 1.2);
  }
  lines(x, y) {
    this.values.forEach((curve, i) => {
      const to = this.to;
      to.beginPath();
      let pen = false;
      curve.forEach((v, k) => {
        if (v === null) { pen = false; return; }
        if (pen) to.lineTo(x(this.times[k]), y(v)); else to.moveTo(x(this.times[k]), y(v));
        pen = true;
      });
      to.setLineDash(this.dashed[i] ? [4, 4] : []);
      to.lineWidth = this.dashed[i] ? 1 : 1.8;
      to.strokeStyle = this.colours[i];
      to.stroke();
    });
    this.to.setLineDash([]);
  }
  key(left, font) {
    const to = this.to;
    to.textAlign = "left";
    let at = left;
    this.curves.forEach((name, i) => {
      if (this.dashed[i] || this.curves.indexOf(name) < i) return;
      to.fillStyle = this.colours[i];
      to.fillRect(at, font * 0.55, font * 0.9, 3);
      to.fillText(name, at + font * 1.1, font);
      at += font * 1.9 + to.measureText(name).width;
    });
  }
}
