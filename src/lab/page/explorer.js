// What the reader chooses: scenario, modifier, laws; and the plots of that choice.
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const at = id => document.getElementById(id);
const LOGS = /^(error_norm|condition|sigma_min|s\d)$/;

// The columns of a run as numbers (logarithmic ones as exponents); decoded once.
function decode(run) {
  if (!run.t || run.v) return run.v;
  const sum = (list, unit) => { let s = 0; return list.map(d => d === null ? NaN : (s += d) * unit); };
  run.v = {t: sum(run.t, 1e-3)};
  for (const [name, [unit, ...list]] of Object.entries(run.c)) run.v[name] = sum(list, unit);
  run.t = run.c = true;
  return run.v;
}

const state = {s: 0, m: 0, off: new Set(), law: 0, full: false, turn: {az: 0.6, el: 0.45}};
const chosenRuns = () => data.runs.filter(r => r.s === state.s && r.m === state.m);
const shownRuns = () => chosenRuns().filter(r => r.t && !state.off.has(r.l));
const sceneNow = () => data.scenes[data.scenarios[state.s]];
const nameOf = r => data.laws[r.l];

// The time until which there is something to see: past the last convergence or early end.
function horizon(runs) {
  const all = Math.max(0, ...runs.map(r => decode(r).t.at(-1)));
  const ended = runs.map(r => r.k.t_error_s ?? r.k.settle_s ?? (r.ok ? null : decode(r).t.at(-1)))
    .filter(t => finite(t) && t < 0.7 * all);
  return state.full || !ended.length ? all : Math.min(all, 1.25 * Math.max(...ended, 0.02 * all));
}

const series = (runs, column, scale = 1) => runs.filter(r => decode(r)[column]).map(r => ({
  x: r.v.t, y: scale === 1 ? r.v[column] : r.v[column].map(v => v * scale),
  law: r.l, look: r.l, name: nameOf(r)}));

function timePlot(runs, column, title, label, more = {}) {
  const limit = (sceneNow() || {limits: {}}).limits[column.replace(/^sent_/, "")];
  const scale = more.scale || 1;
  return plot({title, xl: "time (s)", yl: label, log: LOGS.test(column), series: series(runs, column, scale),
    limits: limit ? [-limit * scale, limit * scale] : [], xMax: horizon(runs) || 1, ...more});
}

const pointCount = run => { let n = 0; while (decode(run)[`u${n}_px`]) ++n; return n; };

// Trajectories of the points in the image; byPoint: a colour for each point, not for each law.
function imagePlot(runs, byPoint) {
  const scene = sceneNow(), lines = [], marks = [], size = scene ? scene.image : [640, 480];
  for (const r of runs) for (let i = 0; i < pointCount(r); ++i)
    lines.push({x: r.v[`u${i}_px`], y: r.v[`v${i}_px`], law: r.l, look: byPoint ? i : r.l});
  if (runs.length) for (let i = 0; i < pointCount(runs[0]); ++i)
    marks.push({x: runs[0].v[`u${i}_px`][0], y: runs[0].v[`v${i}_px`][0], cross: true});
  for (const [x, y] of scene ? scene.goal_px : []) marks.push({x, y});
  const clip = (all, side) => { const [a, b] = rangeOf(all.concat([0, side]), 0.03);
    return [Math.max(a, -0.6 * side), Math.min(b, 1.6 * side)]; };
  return plot({title: "Points in the image: × start, ○ goal", xl: "u (px)", yl: "v (px)",
    series: lines, marks, rect: size, equal: true, down: true, h: Math.min(470, 0.8 * roomy()),
    x: clip(lines.flatMap(l => l.x), size[0]), y: clip(lines.flatMap(l => l.y), size[1])});
}

function paths(runs) {
  const [a, b, c] = isHelicopter(sceneNow()) ? ["camera_north_m", "camera_east_m", "camera_down_m"] : ["tx_m", "ty_m", "tz_m"];
  return runs.filter(r => decode(r)[a]).map(r => ({law: r.l, look: r.l, fits: r.ok,
    points: r.v.t.map((_, i) => [r.v[a][i], r.v[b][i], r.v[c][i]]).filter(p => p.every(finite))}));
}

const barsOf = (key, title, label) => {
  const rows = chosenRuns().filter(r => !state.off.has(r.l));
  return rows.some(r => finite(r.k[key])) ? bars(title, label, rows.map(r => ({name: nameOf(r), look: r.l, law: r.l,
    value: r.k[key], words: (finite(r.k[key]) ? +r.k[key].toPrecision(3) : "–") + (r.ok ? "" : " (" + r.end + ")")}))) : "";
};

const DEG = 180 / Math.PI;
const VELOCITIES = ["vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"];
const COMMANDS = ["forward_m_s", "right_m_s", "down_m_s", "yaw_rate_rad_s"];
const small = {w: 460, h: 230};
const unitOf = c => c.endsWith("rad_s") ? ["°/s", DEG] : c.endsWith("rad") ? ["°", DEG] : [c.endsWith("m_s") ? "m/s" : "m", 1];
const titled = c => c.replace(/_(m|rad|m_s|rad_s)$/, "").replace(/_/g, " ");

function smallPlots(runs, columns) {
  return columns.filter(c => runs.some(r => decode(r)[c])).map(c => {
    const [unit, scale] = unitOf(c);
    return timePlot(runs, c, titled(c), unit, {...small, scale});
  }).join("");
}

function drawOverlay() {
  const runs = shownRuns(), heli = isHelicopter(sceneNow());
  at("overlay").innerHTML = imagePlot(runs) + `<div id="space">${spacePlot(sceneNow(), paths(runs), state.turn)}</div>` +
    timePlot(runs, "error_norm", "Error |s − s*|", "|e|", {ends: true, h: 380}) +
    (heli ? timePlot(runs, "position_error_m", "Position error", "m", {ends: true, h: 380}) : "") +
    timePlot(runs, "condition", "Condition number", "", {ends: true}) +
    timePlot(runs, "sigma_min", "Smallest singular value", "", {ends: true});
  at("small").innerHTML = heli ? smallPlots(runs, ["north_m", "east_m", "down_m", "roll_rad", "pitch_rad", "yaw_rad",
    "heading_error_rad", ...COMMANDS.map(c => "sent_" + c)]) : smallPlots(runs, VELOCITIES);
  at("bars").innerHTML = heli ? barsOf("settle_s", "Settling time", "s") + barsOf("path_ratio", "Path over the straight line", "ratio") +
    barsOf("final_position_m", "Final position error", "m") : barsOf("k_error", "Steps to converge", "steps") +
    barsOf("retreat_m", "Retreat", "m") + barsOf("approach_m", "Approach", "m") + barsOf("path_ratio", "Path over the straight line", "ratio");
}

// Every component of one run in one plot: columns -> lines with their names at the ends.
function together(run, columns, title, label, scale, more) {
  const v = decode(run), known = columns.filter(c => v[c]);
  if (!known.length) return "";
  return plot({title, xl: "time (s)", yl: label, xMax: horizon([run]) || 1, ends: true, h: 320, ...more, series: known.map((c, i) => ({
    x: v.t, y: v[c].map(y => y * (scale ? scale(c) : 1)), law: "d" + i, look: i, name: titled(c)}))});
}

function errors(run) {
  const scene = sceneNow(), v = decode(run);
  if (!scene || isHelicopter(scene)) return "";
  const lines = scene.goal_px.flatMap(([gu, gv], i) => [["x", "u", gu], ["y", "v", gv]].filter(([, c]) => v[`${c}${i}_px`]).map(([n, c, g], k) =>
    ({x: v.t, y: v[`${c}${i}_px`].map(p => (p - g) / scene.focal), law: "e" + i + n, look: 2 * i + k, name: n + i})));
  return plot({title: "Each component of e", xl: "time (s)", yl: "s − s*", series: lines, ends: true, h: 320, xMax: horizon([run]) || 1});
}

function drawDetail() {
  const run = chosenRuns().find(r => r.l === state.law && r.t);
  at("detail-end").textContent = run ? run.end : "no trace of this run";
  if (!run) { at("detail").innerHTML = ""; return; }
  const degrees = c => c.includes("rad_s") ? DEG : 1;
  at("detail").innerHTML = imagePlot([run], true) + errors(run) + (isHelicopter(sceneNow()) ?
    COMMANDS.map(c => together(run, ["wanted_" + c, "sent_" + c], "Command: " + titled(c), unitOf(c)[0], degrees,
      {limits: [1, -1].map(s => s * (sceneNow().limits[c] ?? NaN) * degrees(c)).filter(finite)})).join("") +
    together(run, ["roll_rad", "pitch_rad", "yaw_rad"], "Attitude", "°", () => DEG) :
    together(run, VELOCITIES, "Velocities (m/s, °/s)", "m/s, °/s", degrees)) +
    together(run, ["s1", "s2", "s3", "s4", "s5", "s6"], "Singular values", "", null, {log: true});
}
