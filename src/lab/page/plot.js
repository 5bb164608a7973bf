// Line plots as SVG, drawn from the numbers in the page. One plot is one string.
"use strict";
const kColours = 7, kDashes = ["", "6 4", "1.5 3", "9 3 2 3"];
const esc = s => String(s).replace(/[&<>"']/g, c => "&#" + c.charCodeAt(0) + ";");
const finite = v => v !== null && Number.isFinite(v);

// The look of law number i: colour and dashes, 28 in all.
const look = i => `class="ln c${i % kColours}" stroke-dasharray="${kDashes[(i / kColours | 0) % 4]}"`;

// Width of a plot in its own units, px: narrow windows get plots whose letters stay legible.
const roomy = () => Math.max(330, Math.min(600, innerWidth - 20));

// Round numbers within lo..hi, about `count`.
function ticks(lo, hi, count) {
  const wanted = (hi - lo) / Math.max(count, 1), power = 10 ** Math.floor(Math.log10(wanted));
  const step = power * [1, 2, 5, 10].find(m => m * power >= wanted * 0.75 || m === 10), out = [];
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step && out.length < 60; ++k)
    out.push([k * step, digits > 4 ? (k * step).toPrecision(2) : (k * step || 0).toFixed(digits)]);
  return out;
}

// Powers of ten; the values are exponents.
function logTicks(lo, hi, count) {
  const stride = Math.max(1, Math.ceil((hi - lo) / Math.max(count, 1))), out = [];
  if (hi - lo < 0.3) return ticks(10 ** lo, 10 ** hi, count).map(([v, label]) => [Math.log10(v), label]);
  for (let k = Math.floor(lo); k <= hi; ++k) for (const m of hi - lo < 2 ? [1, 2, 5] : [1]) {
    const v = k + Math.log10(m), power = String(k).replace(/[-0-9]/g, c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]);
    if (k % stride === 0 && v >= lo && v <= hi)
      out.push([v, Math.abs(k) <= 2 ? String(+(m * 10 ** k).toPrecision(1)) : (m > 1 ? m + "·" : "") + "10" + power]);
  }
  return out;
}

function rangeOf(values, margin) {
  let lo = Infinity, hi = -Infinity;
  for (const v of values) if (finite(v)) { if (v < lo) lo = v; if (v > hi) hi = v; }
  if (lo > hi) return [0, 1];
  const pad = hi > lo ? (hi - lo) * margin : Math.max(Math.abs(lo) * 0.1, 1e-3);
  return [lo - pad, hi + pad];
}

// x and y of a line -> path data; gaps at what is no number.
function pathOf(xs, ys, ax, ay) {
  let d = "", pen = "M";
  for (let i = 0; i < xs.length; ++i) {
    if (!finite(xs[i]) || !finite(ys[i])) { pen = "M"; continue; }
    d += pen + ax(xs[i]).toFixed(1) + " " + ay(ys[i]).toFixed(1);
    pen = "L";
  }
  return d;
}

// Names beside the ends of lines, moved apart; ends: [{x, y, name, law}] in px.
function endNames(ends, right, top, bottom) {
  const row = Math.min(11.5, (bottom - top) / Math.max(ends.length, 1));
  ends.sort((a, b) => a.y - b.y);
  let low = top;
  for (const e of ends) { e.at = Math.max(e.y, low); low = e.at + row; }
  let high = bottom;
  for (const e of ends.reverse()) { e.at = Math.min(e.at, high); high = e.at - row; }
  return ends.map(e => `<g data-law="${e.law}"><path ${look(e.look)} opacity=".45" d="M${e.x.toFixed(1)} ${
    e.y.toFixed(1)}L${right + 10} ${e.at.toFixed(1)}h8"/><text class="tx en" x="${right + 21}" y="${
    (e.at + 4).toFixed(1)}">${esc(e.name)}</text></g>`).join("");
}

// Where a line leaves the axes at x1, or ends before: [x, y]; null for a line without points.
function lastOf(s, x1) {
  let k = s.x.length - 1;
  while (k >= 0 && !(finite(s.y[k]) && s.x[k] <= x1 + 1e-9)) --k;
  if (k < 0) return null;
  if (s.x[k] >= x1 || !finite(s.y[k + 1])) return [s.x[k], s.y[k]];
  return [x1, s.y[k] + (s.y[k + 1] - s.y[k]) * (x1 - s.x[k]) / (s.x[k + 1] - s.x[k])];
}

// Limits of the axes: [x0, x1], [y0, y1] of what is seen.
function extents(p) {
  const seen = p.series.flatMap(s => p.xMax ? s.y.filter((_, i) => s.x[i] <= p.xMax) : s.y);
  const more = (p.marks || []).map(m => m.y).concat(p.log ? [] : p.limits || []);
  let x = p.x || (p.xMax ? [0, p.xMax] : rangeOf(p.series.flatMap(s => s.x)
    .concat((p.marks || []).map(m => m.x)), p.equal ? 0.05 : 0));
  let y = p.y || rangeOf(seen.concat(more), 0.06);
  return [x, y];
}

// p: {title, xl, yl, log, series: [{x, y, law, look, name}], marks, limits, rect, equal, down,
// ends, xMax, x, y, w, h}. equal: one unit is as long on both axes; down: y grows downwards.
function plot(p) {
  const w = Math.min(p.w || 600, roomy()), h = Math.max(p.h || 300, p.ends ? 90 + 11.5 * p.series.length : 0), top = 32, bottom = h - 40, left = 58;
  const longest = p.ends ? Math.max(0, ...p.series.map(s => (s.name || "").length)) : 0;
  const right = w - 12 - (longest ? 18 + longest * 6.3 : 0);
  let [[x0, x1], [y0, y1]] = extents(p);
  if (p.equal) {
    const unit = Math.max((x1 - x0) / (right - left), (y1 - y0) / (bottom - top));
    [x0, x1] = [(x0 + x1 - unit * (right - left)) / 2, (x0 + x1 + unit * (right - left)) / 2];
    [y0, y1] = [(y0 + y1 - unit * (bottom - top)) / 2, (y0 + y1 + unit * (bottom - top)) / 2];
  }
  const ax = v => left + (v - x0) / (x1 - x0) * (right - left);
  const ay = p.down ? v => top + (v - y0) / (y1 - y0) * (bottom - top)
                    : v => bottom - (v - y0) / (y1 - y0) * (bottom - top);
  let out = `<text class="tx hd" x="6" y="20">${esc(p.title)}</text>`;
  for (const [v, label] of ticks(x0, x1, (right - left) / 70))
    out += `<path class="gr" d="M${ax(v).toFixed(1)} ${top}V${bottom}"/><text class="tx" text-anchor="middle" x="${
      ax(v).toFixed(1)}" y="${bottom + 15}">${label}</text>`;
  for (const [v, label] of (p.log ? logTicks : ticks)(y0, y1, (bottom - top) / 36))
    out += `<path class="gr" d="M${left} ${ay(v).toFixed(1)}H${right}"/><text class="tx" text-anchor="end" x="${
      left - 5}" y="${(ay(v) + 4).toFixed(1)}">${label}</text>`;
  let inside = "";
  if (p.rect) inside += `<rect class="im" x="${ax(0)}" y="${ay(0)}" width="${
    ax(p.rect[0]) - ax(0)}" height="${ay(p.rect[1]) - ay(0)}"/>`;
  for (const l of p.limits || []) inside += `<path class="li" d="M${left} ${ay(l).toFixed(1)}H${right}"/>`;
  const ends = [];
  for (const s of p.series) {
    inside += `<path data-law="${s.law}" ${look(s.look)} d="${pathOf(s.x, s.y, ax, ay)}"/>`;
    const last = p.ends && s.name ? lastOf(s, x1) : null;
    if (last) ends.push({x: ax(last[0]), y: Math.min(bottom, Math.max(top, ay(last[1]))),
      name: s.name, law: s.law, look: s.look});
  }
  for (const m of p.marks || []) inside += markAt(m, ax(m.x), ay(m.y));
  out += `<svg x="${left}" y="${top}" width="${right - left}" height="${bottom - top}" viewBox="${left} ${top} ${
    right - left} ${bottom - top}">${inside}</svg>`;
  out += `<rect class="fr" x="${left}" y="${top}" width="${right - left}" height="${bottom - top}"/>`;
  if (!p.series.length) out += `<text class="tx" text-anchor="middle" x="${(left + right) / 2}" y="${h / 2}">nothing is chosen</text>`;
  if (p.ends) out += endNames(ends, right, top + 4, bottom - 4);
  out += `<text class="tx" text-anchor="middle" x="${(left + right) / 2}" y="${h - 6}">${esc(p.xl)}</text>
    <text class="tx" text-anchor="middle" transform="translate(13 ${(top + bottom) / 2}) rotate(-90)">${esc(p.yl)}</text>`;
  return svg(w, h, p.title, out);
}

const svg = (w, h, title, body) => `<figure class="card"><svg viewBox="0 0 ${w} ${h}" role="img" aria-label="${
  esc(title)}">${body}</svg></figure>`;

function markAt(m, x, y) {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return "";
  const at = `${x.toFixed(1)} ${y.toFixed(1)}`;
  return m.cross ? `<path class="mk" d="M${at}m-5 -5l10 10m0 -10l-10 10"/>`
                 : `<circle class="mk" cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="5"/>`;
}
