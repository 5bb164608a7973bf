// The page: what is shown where, and what the buttons do.
const at = id => document.getElementById(id);
const plots = {
  errors: new Plot("plot_errors", ["norm", "x", "y", "x", "y", "x", "y", "x", "y"]),
  twist: new Plot("plot_twist", ["vx", "vy", "vz", "wx", "wy", "wz"]),
  command: new Plot("plot_command", ["forward", "right", "down", "yaw", "~forward", "~right", "~down", "~yaw"]),
  condition: new Plot("plot_condition", ["condition"]),
  time: new Plot("plot_time", ["chain", "behind"]),
};
const latency = new Histogram("latency", "latency_words", ["chain", "capture to command"]);
let token = "", desk = null, frozen = null, lastPicture_ms = 0, lastWord_ms = 0, told = 0, drag = null, alive = null;

// ---- what the program says

const kMode = { hover: ["Hover: zero velocity", "so"], servo: ["Servoing", "ok"], sticks: ["By hand", "so"],
  aborted: ["ABORTED: zero velocity", "bad"] };

function showDesk(next) {
  desk = next;
  const [words, colour] = kMode[desk.mode];
  badge("mode", desk.view_only || words, desk.view_only ? "so" : colour);
  document.body.classList.toggle("view_only", desk.view_only !== "");
  const mine = commanding();
  at("take").hidden = mine;
  at("release").hidden = !mine;
  at("release").textContent = desk.asker ? "Give command to the page that asks" : "Give up command";
  at("start").disabled = !mine || desk.mode !== "hover";
  const stopped = desk.way && desk.way.stopped;
  at("reset").hidden = desk.mode !== "aborted" && !stopped;
  at("reset").textContent = desk.mode === "aborted" ? "Reset after abort" : "Reset the switch's emergency stop";
  const way = desk.way && !desk.view_only ? desk.way.words : "";
  if (at("way").textContent !== way) at("way").textContent = way;
  at("way").className = stopped ? "answer bad" : "soft";
  at("reset").disabled = !mine;
  for (const id of ["hold_view", "gain", "freeze"]) at(id).disabled = !mine;
  at("gain_shown").textContent = `${desk.gain_per_s.toPrecision(2)} of ${desk.most_gain_per_s.toPrecision(2)} 1/s`;
  if (document.activeElement !== at("gain")) at("gain").value = 100 * desk.gain_per_s / desk.most_gain_per_s;
  if (desk.laws && !desk.view_only) {
    Sticks.follow(desk);
    Settings.show(desk, mine);
  }
  if (desk.sent) Views.showLink(desk);
  showEvents();
}

function commanding() { return desk && desk.commander !== "" && desk.commander === Commands.client(); }

function badge(id, words, colour) {
  if (at(id).textContent !== words) at(id).textContent = words;
  at(id).className = "badge " + colour;
}

function showEvents() {
  if (Replay.isThere) return;  // it has a list of its own
  const newest = desk.events.length ? desk.events[desk.events.length - 1].number : 0;
  if (newest < told) told = 0;  // the program was started anew
  for (const event of desk.events) {
    if (event.number <= told) continue;
    told = event.number;
    const item = document.createElement("li"), time = document.createElement("time");
    time.textContent = event.stamp_s.toFixed(1) + " s";
    item.append(time, event.words);
    at("events").prepend(item);
  }
  while (at("events").children.length > 100) at("events").lastChild.remove();
}

const kMiss = { no_image: "no picture", few_keypoints: "too little texture in sight", few_matches: "too few matches",
  no_consensus: "matches do not agree", bad_outline: "no possible view", undetermined: "too uncertain",
  not_alike: "does not look like the template", ambiguous: "two places look alike" };

// Without the sign of a nought.
function fixed(x, digits) {
  const text = x.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

const kStage = { none: "–", aligned: "its pixels, followed", searched: "its pixels, searched for", detected: "keypoints" };

function showSight(view) {
  const sure = Math.round(100 * view.confidence) + " % sure";
  if (view.status === "found") badge("sight", "Target seen, " + sure, view.confidence > 0.5 ? "ok" : "so");
  else if (view.status === "coasting") badge("sight", "Target hidden for " + view.age_s.toFixed(1) + " s", "so");
  else badge("sight", "Target lost: " + (kMiss[view.miss] || "not seen"), "bad");
}

function showNumbers(view, words) {
  const v = list => list ? list.map(x => fixed(x, 2)).join("  ") : "–";
  const rows = {
    "Frame": view.frame + ", " + view.stamp_s.toFixed(2) + " s",
    "Distance": view.distance_m === null ? "–" : view.distance_m.toFixed(2) + " m",
    "Command rests on": view.state === "sticks" ? "a hand" : view.state || "–",
    "Sent, m/s, rad/s": v(view.sent),
    "The law wants": v(view.wanted),
    "Most allowed": v(desk.speed),
    "Error": view.error_norm === null ? "–" : view.error_norm.toFixed(4),
    "Condition": view.condition === null ? "–" : view.condition.toFixed(0),
    "Found by": kStage[view.stage],
    "Keypoints": view.keypoints ? `${view.keypoints}, ${view.matches} matched, ${view.agree} agree` : "none looked for",
    "Chain": view.chain_ms === null ? "–" : view.chain_ms.toFixed(1) + " ms",
    "Capture to command": view.latency_ms === null ? "–" : view.latency_ms.toFixed(0) + " ms",
    "Behind": words.encode_ms.toFixed(0) + " ms in the program",
    "Command": desk.commander === "" ? "nobody" : commanding() ? "this page" : "another page",
    "Viewers": desk.viewers + (desk.refused ? `, ${desk.refused} requests refused` : ""),
  };
  if (Replay.isThere) for (const name of ["Most allowed", "Behind", "Command", "Viewers"]) delete rows[name];
  const list = at("numbers");
  Object.entries(rows).forEach(([name, value], i) => {
    if (!list.children[2 * i]) list.append(document.createElement("dt"), document.createElement("dd"));
    list.children[2 * i].textContent = name;
    list.children[2 * i + 1].textContent = value;
  });
}

async function showFrame({ words, jpeg }) {
  lastWord_ms = performance.now();
  showDesk(words.desk);
  if (!words.view) {
    at("line").textContent = `no new picture for ${((performance.now() - lastPicture_ms) / 1000).toFixed(0)} s`;
    return;
  }
  const view = words.view;
  lastPicture_ms = performance.now();
  at("line").textContent = frozen === null ? "live" : "the picture is frozen; what flies goes on";
  if (frozen === null && jpeg.length) {
    Picture.show(await createImageBitmap(new Blob([jpeg], { type: "image/jpeg" })), view);
  }
  showSight(view);
  document.body.classList.toggle("no_scene", !view.scene);
  if (view.scene) {
    Views.show(view);
    Settings.showScene(view.scene);
  }
  showNumbers(view, words);
  plots.errors.add(view.stamp_s, view.errors && [view.error_norm, ...view.errors]);
  plots.twist.add(view.stamp_s, view.twist);
  plots.command.add(view.stamp_s, view.sent && [...view.sent, ...view.wanted]);
  plots.condition.add(view.stamp_s, [view.condition]);
  plots.time.add(view.stamp_s, [view.chain_ms, words.encode_ms]);
  if (!Replay.isThere) latency.add([view.chain_ms, view.latency_ms]);
  document.documentElement.dataset.frame = view.frame;  // for those who watch the page
}

// ---- what the operator wants

function say(words, colour) {
  at("answer").textContent = words;
  at("answer").className = "answer " + colour;
}

async function give(word, more) {
  try {
    const reply = await Commands.give(word, more);
    say(`${reply.words} (${reply.took_ms.toFixed(0)} ms)`, reply.done ? "ok" : "bad");
    return reply;
  } catch (error) {
    say(`${word}: no answer from the program (${error.message})`, "bad");
    return { done: false };
  }
}

async function take() {
  const reply = await give("take");
  if (/^you have the command/.test(reply.words)) say(`${reply.words}: press Start, hold a stick, or draw a new template`, "ok");
  if (reply.done && !alive) alive = setInterval(() => Commands.give("alive").catch(() => {}), 500);
}

async function release() {
  clearInterval(alive);
  alive = null;
  await give("release");
}

// A frozen picture is kept by the program too: the template is cut from exactly what is seen here.
async function freeze() {
  const frame = Picture.frame();
  if (frozen !== null || frame === null) return frozen !== null;
  frozen = frame;
  const reply = await give("freeze", { frame });
  if (!reply.done) { goLive(); return false; }
  at("live").hidden = false;
  at("rectangle").hidden = false;
  return true;
}

function goLive() {
  frozen = null;
  Picture.mark(null);
  at("live").hidden = at("rectangle").hidden = true;
  at("use").disabled = true;
  at("verdict").textContent = "";
}

function rectangle() {
  const n = id => Math.round(Number(at(id).value));
  return { x: n("box_x"), y: n("box_y"), w: n("box_w"), h: n("box_h") };
}

function setRectangle(r) {
  at("box_x").value = r.x; at("box_y").value = r.y; at("box_w").value = r.w; at("box_h").value = r.h;
  Picture.mark(r);
}

async function examine() {
  const r = rectangle();
  at("use").disabled = true;
  at("verdict").textContent = "looking at it …";
  const reply = await give("examine", { box: [r.x, r.y, r.w, r.h] });
  const v = reply.verdict;
  at("verdict").textContent = v
    ? `${v.grade.toUpperCase()}: ${v.words}. ${v.keypoints} keypoints, texture in ${Math.round(100 * v.spread)} % of it, `
      + `${Math.round(100 * v.self_likeness)} % like itself elsewhere.`
    : reply.words || "";
  if (!v) return;
  at("width_m").value = Number(reply.width_m.toPrecision(3));
  at("use").disabled = false;
  at("use").scrollIntoView({ block: "nearest" });
}

async function use() {
  const reply = await give("use", { width_m: Number(at("width_m").value) });
  if (!reply.done) return;
  Picture.forget();
  Views.forget();
  goLive();
  say(`${reply.words}: press Start to servo on it`, "ok");
}

function cornersToRectangle(a, b) {
  return { x: Math.min(a.x, b.x), y: Math.min(a.y, b.y), w: Math.abs(a.x - b.x), h: Math.abs(a.y - b.y) };
}

// One finger or the mouse draws; others on the picture meanwhile draw nothing.
function onDown(event) {
  if (Replay.isThere || drag || event.button !== 0) return;
  if (!commanding()) return say("Take the command first; then a rectangle can be drawn.", "bad");
  event.preventDefault();
  Picture.canvas.setPointerCapture(event.pointerId);
  drag = { finger: event.pointerId, from: Picture.place(event), wasLive: frozen === null, ready: freeze() };
}

function draws(event) { return drag !== null && drag.finger === event.pointerId; }

function onMove(event) {
  if (draws(event)) Picture.mark(cornersToRectangle(drag.from, Picture.place(event)));
}

// The system took the finger away: nothing was drawn.
async function onCancel(event) {
  if (!draws(event)) return;
  const { wasLive, ready } = drag;
  drag = null;
  await ready;
  if (wasLive) goLive(); else Picture.mark(rectangle());
  say("Nothing was drawn: the finger was taken away.", "bad");
}

async function onUp(event) {
  if (!draws(event)) return;
  const { from, ready, wasLive } = drag, r = cornersToRectangle(from, Picture.place(event));
  drag = null;
  if (!(await ready)) return;
  if (r.w >= 16 && r.h >= 16) {
    setRectangle(r);
    return examine();
  }
  if (wasLive) goLive(); else Picture.mark(rectangle());  // a tap is no rectangle
  say("The rectangle is too small: drag one of 16x16 px or more.", "bad");
}

// ---- wiring

const kKeys = { Escape: () => give("abort"), h: () => give("hover"), s: () => at("start").click(),
  v: () => at("hold_view").click(), c: () => at("take").click(), f: () => at("freeze").click(), g: () => at("dead_man").focus() };

function wire() {
  const on = (id, action) => at(id).addEventListener("click", action);
  on("abort", () => give("abort"));
  on("hover", () => give("hover"));
  on("start", () => give("start"));
  on("reset", () => give("reset"));
  on("hold_view", () => give("hold_view"));
  on("take", take);
  on("release", release);
  on("freeze", freeze);
  on("live", goLive);
  on("examine", examine);
  on("use", use);
  at("gain").addEventListener("change", () => give("gain", { gain_per_s: at("gain").value / 100 * desk.most_gain_per_s }));
  for (const id of ["box_x", "box_y", "box_w", "box_h"]) at(id).addEventListener("input", () => Picture.mark(rectangle()));
  Picture.canvas.addEventListener("pointerdown", onDown);
  Picture.canvas.addEventListener("pointermove", onMove);
  Picture.canvas.addEventListener("pointerup", onUp);
  Picture.canvas.addEventListener("pointercancel", onCancel);
  Picture.canvas.addEventListener("contextmenu", event => event.preventDefault());
  document.addEventListener("keydown", event => {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const writes = /^(text|password|number|select-one)$/.test(event.target.type || "") && key !== "Escape";
    if (!writes && Sticks.takes(event)) return event.preventDefault();
    if (!kKeys[key] || writes || event.repeat || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    kKeys[key]();
  });
  setInterval(() => { for (const plot of Object.values(plots)) plot.draw(); Views.draw(); }, 200);
  setInterval(() => latency.draw(), 1000);
  if (matchMedia("(max-width:640px), (max-height:500px)").matches) at("legend").open = false;
  // What stays at the top covers what is scrolled to: told to the style.
  const cover = new ResizeObserver(() => {
    const head_px = document.querySelector("header").offsetHeight, picture = document.querySelector(".picture");
    const stays = getComputedStyle(picture).position === "sticky";
    document.documentElement.style.setProperty("--head", head_px + "px");
    document.documentElement.style.setProperty("--cover", head_px + (stays ? picture.offsetHeight : 0) + 8 + "px");
  });
  for (const part of ["header", ".picture"]) cover.observe(document.querySelector(part));
  setInterval(watchLine, 500);
  const parts = { give, say, commanding, desk: () => desk };
  Sticks.wire(parts);
  Settings.wire(parts);
  at("entry").addEventListener("submit", event => {
    event.preventDefault();
    enter(at("token").value.trim());
  });
}

// A line that is cut without a word: what is shown is old, and nobody flies by hand what he does not see.
function watchLine() {
  const silent_ms = performance.now() - lastWord_ms;
  if (lastWord_ms === 0 || silent_ms < 2500 || Replay.isThere) return;  // a recorded run stands still
  Sticks.letAllGo();
  badge("mode", "no connection", "bad");
  badge("sight", "nothing known", "bad");
  at("line").textContent = `no word from the program for ${(silent_ms / 1000).toFixed(0)} s`;
}

function askToken() {
  at("entry").hidden = false;
  at("station").hidden = true;
  badge("mode", "token wanted", "bad");
  at("token").focus();
}

async function enter(next) {
  token = next;
  Commands.enter(token);
  sessionStorage.setItem("token", token);
  at("entry").hidden = true;
  at("station").hidden = false;
  for (;;) {
    try {
      await Replay.watch(token, showFrame);
    } catch (error) {
      if (error.message === "token") { sessionStorage.removeItem("token"); return askToken(); }
      Sticks.letAllGo();
      badge("mode", "no connection", "bad");
      badge("sight", "nothing known", "bad");
      at("line").textContent = `${error.message}; trying again`;
    }
    await new Promise(wake => setTimeout(wake, 1000));
  }
}

wire();
const given = /^#token=([0-9a-f]+)$/.exec(location.hash);
if (given) history.replaceState(null, "", location.pathname);  // so that it is in no bookmark
const known = given ? given[1] : sessionStorage.getItem("token");
if (known) enter(known); else askToken();
