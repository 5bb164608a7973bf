// Paths in space and lying bars.
"use strict";

// Parallel projection: azimuth about the space's upward direction, elevation above its horizon.
function projection(up, ahead, azimuth, elevation) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const side = cross(ahead, up), c = Math.cos(azimuth), s = Math.sin(azimuth);
  const level = ahead.map((v, i) => v * c + side[i] * s);  // where one looks, level
  const right = cross(level, up), down = Math.sin(elevation), flat = Math.cos(elevation);
  const upwards = up.map((v, i) => v * flat + level[i] * down);
  return p => [dot(right, p), dot(upwards, p)];
}

// Gives a word [w px wide] the first of the places [middle, baseline] where it meets no other.
function freeWords() {
  const taken = [];
  return (w, places) => {
    const free = ([x, y]) => taken.every(t => Math.abs(t[0] - x) > (t[2] + w) / 2 || Math.abs(t[1] - y) > 12);
    const [x, y] = places.find(free) || places[places.length - 1];
    taken.push([x, y, w]);
    return `x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="middle"`;
  };
}

const isHelicopter = scene => scene && scene.kind === "helicopter";

// runs: [{law, look, points: [[x, y, z]...], fits}] in the scene's space.
function spacePlot(scene, runs, turn, w = roomy(), h = 420) {
  const see = isHelicopter(scene) ? projection([0, 0, -1], [1, 0, 0], turn.az, turn.el)
                                  : projection([0, -1, 0], [0, 0, 1], turn.az, turn.el);
  const fixed = scene ? scene.points.concat([scene.start.at, scene.goal.at]) : [];
  const flat = fixed.concat(runs.filter(r => r.fits).flatMap(r => r.points))
    .filter(p => p.every(finite)).map(see);
  const [x0, x1] = rangeOf(flat.map(p => p[0]), 0.08), [y0, y1] = rangeOf(flat.map(p => p[1]), 0.08);
  const unit = Math.max((x1 - x0) / (w - 20), (y1 - y0) / (h - 76));
  const ax = v => w / 2 + (v - (x0 + x1) / 2) / unit, ay = v => 32 + (h - 76) / 2 - (v - (y0 + y1) / 2) / unit;
  const place = p => { const q = see(p); return ax(q[0]).toFixed(1) + " " + ay(q[1]).toFixed(1); };
  let inside = "";
  if (scene && scene.points.length)
    inside += `<path class="tg" d="M${scene.points.map(place).join("L")}Z"/>`;
  for (const r of runs)
    inside += `<path data-law="${r.law}" ${look(r.look)} d="${r.points.map((p, i) => (i ? "L" : "M") + place(p)).join("")}"/>`;
  const word = freeWords();
  if (scene) for (const [f, name] of [[scene.start, "start"], [scene.goal, "goal"]]) {
    if (!f.at.every(finite)) continue;
    const o = see(f.at), x = ax(o[0]), y = ay(o[1]);
    f.axes.forEach((a, i) => {
      const q = see(a), tip = [x + 34 * q[0], y - 34 * q[1]];
      inside += `<path class="mk" d="M${x.toFixed(1)} ${y.toFixed(1)}L${tip[0].toFixed(1)} ${tip[1].toFixed(1)}"/>`;
      const out = [42, 56, 70].map(r => [x + r * q[0], y - r * q[1] + 4]);
      if (Math.hypot(...q) > 0.3) inside += `<text class="tx" ${word(7, out)}>${"xyz"[i]}</text>`;
    });
    const wide = 6.9 * name.length, rows = [18, 32, 46, 60].map(d => [x + 8 + wide / 2, y + d]);
    inside += `<text class="tx en" ${word(wide, rows)}>${name}</text>`;
  }
  const wanted = w / 6 * unit, power = 10 ** Math.floor(Math.log10(wanted));
  const bar = power * (wanted / power < 2 ? 1 : wanted / power < 5 ? 2 : 5);
  const cut = runs.some(r => !r.fits) ? "; runs that left are cut at the border" : "";
  const body = `<text class="tx hd" x="6" y="20">Path of the camera in space</text>
    <svg x="0" y="32" width="${w}" height="${h - 76}" viewBox="0 32 ${w} ${h - 76}">${inside}</svg>
    <path class="mk" d="M14 ${h - 20}v8m0 -4h${(bar / unit).toFixed(1)}m0 -4v8"/>
    <text class="tx" x="${(22 + bar / unit).toFixed(1)}" y="${h - 12}">${+bar.toPrecision(1)} m${cut}</text>`;
  return svg(w, h, "Path of the camera in space", body);
}

// rows: [{name, look, law, value, words}].
function bars(title, label, rows, w = roomy()) {
  const row = 18, top = 32, bottom = top + row * Math.max(rows.length, 2), h = bottom + 40;
  const left = 20 + 6.9 * Math.max(4, ...rows.map(r => r.name.length)), right = w - 130;
  const most = Math.max(1e-9, ...rows.map(r => finite(r.value) ? r.value : 0));
  const least = Math.min(0, ...rows.map(r => finite(r.value) ? r.value : 0));
  const ax = v => left + (v - least) / (most - least) * (right - left);
  let out = `<text class="tx hd" x="6" y="20">${esc(title)}</text>`;
  for (const [v, words] of ticks(least, most, 5))
    out += `<path class="gr" d="M${ax(v).toFixed(1)} ${top}V${bottom}"/><text class="tx" text-anchor="middle" x="${
      ax(v).toFixed(1)}" y="${bottom + 15}">${words}</text>`;
  rows.forEach((r, i) => {
    const y = top + row * (i + 0.5), has = finite(r.value), end = ax(has ? r.value : 0);
    out += `<g data-law="${r.law}"><text class="tx" x="6" y="${y + 4}">${esc(r.name)}</text>`;
    if (has) out += `<rect class="f${r.look % kColours}" x="${Math.min(end, ax(0)).toFixed(1)}" y="${y - 6}" width="${
      Math.abs(end - ax(0)).toFixed(1)}" height="12"/>`;
    out += `<text class="tx en" x="${(Math.max(end, ax(0)) + 5).toFixed(1)}" y="${y + 4}">${esc(r.words)}</text></g>`;
  });
  out += `<text class="tx" text-anchor="middle" x="${(left + right) / 2}" y="${h - 6}">${esc(label)}</text>`;
  return svg(w, h, title, out);
}
