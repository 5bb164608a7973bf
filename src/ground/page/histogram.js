// How often which latency was: bars over a logarithmic axis, so that parts of a millisecond and tens
// of them are both seen. The newest frames only; the words below say the quantiles.
class Histogram {
  static kFrames = 3000;
  static kPerDecade = 8;
  constructor(id, wordsId, names) {
    this.canvas = document.getElementById(id);
    this.words = document.getElementById(wordsId);
    this.names = names;
    this.clear();
  }
  clear() { this.values = this.names.map(() => []); this.dirty = true; }
  // One value for each name, ms; null: not known. The oldest are forgotten.
  add(values) {
    values.forEach((v, i) => {
      if (!Number.isFinite(v)) return;
      this.put(i, v);
      if (this.values[i].length > Histogram.kFrames) this.values[i].shift();
    });
  }
  put(i, value_ms) {
    if (!(value_ms > 0)) return;  // a simulated camera without latency has no place on this axis
    this.values[i].push(value_ms);
    this.dirty = true;
  }
  rename(names) { this.names = names; this.clear(); }
  static quantile(sorted, share) { return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]; }
  static short(ms) { return ms < 10 ? ms.toFixed(1) : ms.toFixed(0); }

  tell() {
    this.words.textContent = this.names.map((name, i) => {
      if (!this.values[i].length) return "";
      const sorted = [...this.values[i]].sort((a, b) => a - b), q = share => Histogram.short(Histogram.quantile(sorted, share));
      return `${name}: median ${q(0.5)}, 95 % ${q(0.95)}, most ${q(1)} ms, ${sorted.length} frames.`;
    }).filter(words => words).join(" ");
  }
  // Shares of the frames by bin, of each name; bins count from that of 1 ms.
  bins() {
    return this.values.map(values => {
      const counts = new Map();
      for (const v of values) {
        const bin = Math.floor(Math.log10(v) * Histogram.kPerDecade + 1e-9);
        counts.set(bin, (counts.get(bin) || 0) + 1);
      }
      return new Map([...counts].map(([bin, count]) => [bin, 100 * count / values.length]));
    });
  }
  draw() {
    const dots = window.devicePixelRatio || 1, w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    if (!w || !h || (!this.dirty && this.canvas.width === Math.round(w * dots))) return;
    this.dirty = false;
    this.tell();
    this.canvas.width = Math.round(w * dots); this.canvas.height = Math.round(h * dots);
    const to = this.canvas.getContext("2d"), font = Math.max(12, Math.round(h / 15));
    to.setTransform(dots, 0, 0, dots, 0, 0);
    to.font = font + "px system-ui, sans-serif";
    const all = this.bins(), used = all.flatMap(bins => [...bins.keys()]), n = Histogram.kPerDecade;
    const low = n * Math.floor(Math.min(-1, ...used) / n), high = n * Math.ceil(Math.max(n, ...used.map(bin => bin + 1)) / n);
    const most = Math.max(10, ...all.flatMap(bins => [...bins.values()]));
    const box = { left: font * 3.6, right: w - font, top: font * 1.8, bottom: h - font * 1.5 };
    const x = bin => box.left + (bin - low) / (high - low) * (box.right - box.left);
    const y = share => box.bottom - share / most * (box.bottom - box.top);
    this.axes(to, { x, y, low, high, most, font, box });
    all.forEach((bins, i) => this.bars(to, bins, i, x, y));
    this.key(to, font);
  }
  axes(to, at) {
    to.strokeStyle = "#323c48"; to.fillStyle = "#a4b0bd"; to.lineWidth = 1;
    const step = Plot.step(at.most / 3);
    to.textAlign = "right";
    for (let share = 0; share <= at.most; share += step) {
      to.beginPath(); to.moveTo(at.box.left, at.y(share)); to.lineTo(at.box.right, at.y(share)); to.stroke();
      to.fillText(String(share), at.box.left - 4, at.y(share) + at.font / 3);
    }
    to.textAlign = "center";
    for (let bin = at.low; bin <= at.high; bin += Histogram.kPerDecade) {
      to.beginPath(); to.moveTo(at.x(bin), at.box.bottom); to.lineTo(at.x(bin), at.box.bottom + 4); to.stroke();
      const last = bin + Histogram.kPerDecade > at.high;
      to.textAlign = last ? "right" : "center";
      to.fillText(Number(Math.pow(10, bin / Histogram.kPerDecade).toPrecision(1)) + (last ? " ms" : ""), at.x(bin) + (last ? at.font : 0), at.box.bottom + at.font * 1.2);
    }
  }
  bars(to, bins, i, x, y) {
    const inset = 3 * i;  // of two the second stands inside the first, as an outline
    for (const [bin, share] of bins) {
      const left = x(bin) + inset / 2, width = Math.max(2, x(bin + 1) - x(bin) - 1 - inset);
      to.fillStyle = to.strokeStyle = kColours[i];
      if (i === 0) to.fillRect(left, y(share), width, y(0) - y(share));
      to.lineWidth = 2;
      to.strokeRect(left, y(share), width, y(0) - y(share));
    }
  }
  key(to, font) {
    to.textAlign = "left";
    let at = 2;
    this.names.forEach((name, i) => {
      if (!this.values[i].length) return;
      to.fillStyle = kColours[i];
      to.fillRect(at, font * 0.55, font * 0.9, 3);
      to.fillText(name, at + font * 1.1, font);
      at += font * 1.9 + to.measureText(name).width;
    });
  }
}
