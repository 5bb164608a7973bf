// Recorded runs in the page of a flight: the page asks for the frames it shows, and draws them with
// what draws a flight.
const Replay = (() => {
  const count = Number(document.querySelector('meta[name="recorded-runs"]').content);
  const kBatch = 30, kKept = 240, kSpeeds = [0.1, 0.25, 0.5, 1, 2, 4, 8];
  if (count > 0) document.body.classList.add("view_only", "replaying");
  const caches = [new Map(), new Map()];
  let token = "", runs = null, shown = 0, now_s = 0, playing = false, speed = 1, dirty = true, fetching = null;

  async function get(path) {
    const answer = await fetch(path, { headers: { Authorization: "Bearer " + token }, cache: "no-store" });
    if (answer.status === 401) throw new Error("token");
    if (!answer.ok) throw new Error((await answer.json()).words);
    return answer;
  }
  const times = run => runs[run].times;
  const length_s = () => Math.max(...runs.map(run => run.times[run.times.length - 1]));
  // The row that is shown at a time: the last that is not after it.
  function rowAt(run, time_s) {
    let low = 0, high = times(run).length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times(run)[middle] <= time_s + 1e-6) low = middle; else high = middle - 1;
    }
    return low;
  }
  async function fetchFrames(run, from) {
    const answer = await get(`frames?run=${run}&from=${from}&count=${kBatch}`);
    const reader = answer.body.getReader(), frames = new StreamReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      frames.add(value);
      for (let frame = frames.next(); frame; frame = frames.next()) caches[run].set(frame.words.row, frame);
      while (caches[run].size > kKept) caches[run].delete(caches[run].keys().next().value);
    }
  }
  async function frameOf(run, row) {
    if (!caches[run].has(row)) {
      const isBack = caches[run].has(row + 1);  // going back: those before it come too
      await fetchFrames(run, isBack ? Math.max(0, row - kBatch + 1) : row);
    }
    return caches[run].get(row);
  }
  function fetchAhead(row) {
    const ahead = row + kBatch / 2;
    if (fetching || !playing || ahead >= times(shown).length || caches[shown].has(ahead)) return;
    fetching = fetchFrames(shown, ahead).catch(() => {}).finally(() => { fetching = null; });
  }

  function go(time_s) { now_s = Math.max(0, Math.min(length_s(), time_s)); dirty = true; }
  function step(rows) {
    playing = false;
    const row = Math.max(0, Math.min(times(shown).length - 1, rowAt(shown, now_s) + rows));
    go(times(shown)[row]);
  }
  function play() {
    if (!playing && now_s >= length_s()) go(0);
    playing = !playing;
    dirty = true;
  }
  function change(factor) { speed = kSpeeds[Math.max(0, Math.min(kSpeeds.length - 1, kSpeeds.indexOf(speed) + factor))]; dirty = true; }
  function turn() { if (runs.length > 1) { shown = 1 - shown; Picture.forget(); dirty = true; } }

  const kKeys = { ",": () => step(-1), ".": () => step(1), ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    PageUp: () => go(now_s - 1), PageDown: () => go(now_s + 1), Home: () => go(0), End: () => go(length_s()),
    " ": play, "+": () => change(1), "-": () => change(-1), x: turn };
  const kButtons = [["back", "◀ frame", ",", () => step(-1)], ["play", "Play", "Space", play],
    ["next", "frame ▶", ".", () => step(1)], ["slower", "slower", "-", () => change(-1)],
    ["faster", "faster", "+", () => change(1)], ["turn", "Other run", "x", turn]];

  function element(tag, more, ...inside) {
    const made = Object.assign(document.createElement(tag), more);
    made.append(...inside);
    return made;
  }
  function buildBar() {
    const slider = element("input", { id: "time", type: "range", min: 0, step: "any", value: 0 });
    slider.setAttribute("aria-label", "Time of the run, s");
    slider.max = length_s();
    slider.addEventListener("input", () => { playing = false; go(Number(slider.value)); });
    const buttons = kButtons.map(([id, words, key, action]) => {
      const button = element("button", { id, title: "Key: " + key }, element("span", {}, words), " ", element("kbd", {}, key));
      button.addEventListener("click", action);
      return button;
    });
    const bar = element("section", { className: "replay card", id: "replay" }, slider,
      element("p", { id: "when" }), element("div", { className: "row" }, ...buttons));
    for (const run of runs) for (const note of run.notes) bar.append(element("p", { className: "soft" }, `${run.name}: ${note}`));
    bar.setAttribute("aria-label", "Recorded run");
    at("station").prepend(bar);
    at("turn").hidden = runs.length < 2;
    document.addEventListener("keydown", event => {
      const writes = event.target.tagName === "INPUT" && event.target.type !== "range";
      const presses = event.target.tagName === "BUTTON" && event.key === " ";
      if (!kKeys[event.key] || writes || presses || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      kKeys[event.key]();
    });
  }
  // Where the target was lost and seen again, each a way there.
  function buildEvents() {
    const kMost = 200, items = [];
    runs.forEach((run, which) => run.found.forEach((found, row) => {
      if (row > 0 ? found === run.found[row - 1] : found) return;
      items.push({ time_s: run.times[row], which, words: (runs.length > 1 ? run.name + ": " : "") + (found ? "target seen again" : "target lost") });
    }));
    items.sort((a, b) => a.time_s - b.time_s);
    for (const item of items.slice(0, kMost)) {
      const button = element("button", { type: "button" }, `${item.time_s.toFixed(2)} s  ${item.words}`);
      button.addEventListener("click", () => { playing = false; if (shown !== item.which) turn(); go(item.time_s); });
      at("events").append(element("li", {}, button));
    }
    if (items.length > kMost) at("events").append(element("li", {}, `and ${items.length - kMost} more`));
    if (!items.length) at("events").append(element("li", {}, "the target was seen in every frame"));
  }
  function showBar(row) {
    if (document.activeElement !== at("time") || playing) at("time").value = now_s;
    at("when").textContent = `${runs[shown].name}: ${now_s.toFixed(2)} of ${length_s().toFixed(2)} s, `
      + `row ${row + 1} of ${times(shown).length}, ${playing ? "playing" : "paused"} at ${speed}x`
      + (runs.length > 1 ? `; dashes: ${runs[1].name}` : "");
    at("play").firstChild.textContent = playing ? "Pause" : "Play";
    at("line").textContent = playing ? "playing" : "paused";
    document.documentElement.dataset.run = shown;
    document.documentElement.dataset.row = row;
  }
  async function load() {
    runs = await (await get("runs")).json();
    for (const run of runs) run.times = run.stamp_s.map(s => s - run.stamp_s[0]);
    for (const name of Object.keys(plots)) plots[name] = new RunPlot(plots[name], runs, name, () => now_s);
    latency.rename(runs.map(run => run.name));
    runs.forEach((run, i) => run.time.forEach(time => { if (time) latency.put(i, time[0]); }));
    Commands.give = async () => ({ done: false, took_ms: 0, words: "a recorded run takes no commands" });
    buildBar();
    buildEvents();
  }
  // Shows what the slider and the keys ask for, until the program is gone.
  async function watch(nextToken, show) {
    token = nextToken;
    if (!runs) await load();
    dirty = true;
    let before_ms = performance.now(), before = 0;
    for (;;) {
      const passed_s = (performance.now() - before_ms) / 1000;
      before_ms = performance.now();
      if (playing) go(now_s + passed_s * speed);
      if (playing && now_s >= length_s()) playing = false;
      if (dirty) {
        dirty = false;
        const row = rowAt(shown, now_s), frame = await frameOf(shown, row);
        if (Math.abs(row - before) > kBatch) Picture.forget();  // the corners' way is not known in between
        before = row;
        if (frame) await show(frame);
        showBar(row);
        fetchAhead(row);
      }
      await new Promise(wake => setTimeout(wake, 15));
    }
  }
  return { watch: count > 0 ? watch : readStream, isThere: count > 0 };
})();

// Curves of whole runs, the second one dashed, and a line where the picture is.
class RunPlot {
  constructor(plot, runs, column, now_s) {
    Object.assign(this, { plot, runs, column, now_s, drawn: "" });
    const values = [];
    for (const run of runs) for (const row of run[column]) if (row) values.push(...row.filter(v => v !== null));
    const low = values.reduce((a, b) => Math.min(a, b), 0), high = values.reduce((a, b) => Math.max(a, b), 0);
    this.step = Plot.step(Math.max(high - low, 1e-9) / 3);
    this.low = Math.floor(low / this.step) * this.step;
    this.high = Math.max(Math.ceil(high / this.step) * this.step, this.low + this.step);
    plot.canvas.closest("section").hidden = values.length === 0;  // of a run that only tracks
    this.length_s = Math.max(...runs.map(run => run.times[run.times.length - 1]), 1e-3);
  }
  add() {}
  draw() {
    const { canvas, to } = this.plot, dots = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    const key = [w, h, dots, this.now_s()].join();
    if (!w || !h || key === this.drawn) return;
    this.drawn = key;
    canvas.width = w * dots; canvas.height = h * dots;
    to.setTransform(dots, 0, 0, dots, 0, 0);
    const font = Math.max(12, Math.round(h / 15)), left = font * 3.6, right = w - 4, top = font * 1.8, bottom = h - font * 1.5;
    to.font = font + "px system-ui, sans-serif";
    const x = t => left + t / this.length_s * (right - left);
    const y = v => bottom - (v - this.low) / (this.high - this.low) * (bottom - top);
    this.grid(x, y, { left, right, top, bottom, font });
    this.runs.forEach((run, i) => this.curves(run, i > 0, x, y, right - left));
    this.plot.key(2, font);
  }
  grid(x, y, { left, right, top, bottom, font }) {
    const to = this.plot.to;
    Object.assign(to, { strokeStyle: "#323c48", fillStyle: "#a4b0bd", lineWidth: 1, textAlign: "right" });
    to.setLineDash([]);
    for (let v = this.low; v <= this.high + this.step / 2; v += this.step) {
      to.beginPath(); to.moveTo(left, y(v)); to.lineTo(right, y(v)); to.stroke();
      to.fillText(Number(v.toPrecision(3)).toString(), left - 4, y(v) + font / 3);
    }
    for (const part of [0, 0.25, 0.5, 0.75, 1]) {
      to.textAlign = part === 0 ? "left" : part === 1 ? "right" : "center";
      to.fillText(Number((part * this.length_s).toPrecision(3)) + " s", x(part * this.length_s), bottom + font * 1.2);
    }
    to.strokeStyle = "#e8edf3";
    to.beginPath(); to.moveTo(x(this.now_s()), top); to.lineTo(x(this.now_s()), bottom); to.stroke();
  }
  curves(run, isSecond, x, y, width) {
    const to = this.plot.to, rows = run[this.column], stride = Math.max(1, Math.floor(rows.length / (2 * width)));
    this.plot.colours.forEach((colour, curve) => {
      if (this.plot.dashed[curve] && this.runs.length > 1) return;  // dashes are the second run's
      let pen = false;
      to.beginPath();
      for (let i = 0; i < rows.length; i += stride) {
        const v = rows[i] ? rows[i][curve] : undefined;
        if (v === undefined || v === null) { pen = false; continue; }
        if (pen) to.lineTo(x(run.times[i]), y(v)); else to.moveTo(x(run.times[i]), y(v));
        pen = true;
      }
      const dashed = isSecond || this.plot.dashed[curve];
      to.setLineDash(dashed ? [4, 4] : []);
      Object.assign(to, { lineWidth: dashed ? 1.2 : 1.8, strokeStyle: colour });
      to.stroke();
    });
    to.setLineDash([]);
  }
}
