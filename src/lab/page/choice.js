// The controls; all work by mouse, touch and keyboard.
"use strict";
function fill(select, names, words) {
  select.innerHTML = names.map((n, i) => `<option value="${i}">${esc(words ? words(n) : n)}</option>`).join("");
}

// Only what was run with the scenario can be chosen.
function fillModifiers() {
  const there = [...new Set(data.runs.filter(r => r.s === state.s).map(r => r.m))];
  if (!there.includes(state.m)) state.m = there[0] ?? 0;
  at("modifier").innerHTML = there.map(m => `<option value="${m}"${m === state.m ? " selected" : ""}>${
    esc(data.modifiers[m] || "none")}</option>`).join("");
}

function fillLaws() {
  const there = chosenRuns();
  at("laws").innerHTML = there.map(r => `<label data-law="${r.l}" title="${esc(r.end)}"><input type="checkbox" value="${r.l}"${
    state.off.has(r.l) ? "" : " checked"}><svg width="26" height="8" aria-hidden="true"><path ${look(r.l)} d="M1 4H25"/></svg>${
    esc(nameOf(r))}<small>${r.ok ? "" : " " + esc(r.end)}</small></label>`).join("");
  if (!there.some(r => r.l === state.law)) state.law = there.length ? there[0].l : 0;
  at("law").innerHTML = there.map(r => `<option value="${r.l}"${r.l === state.law ? " selected" : ""}>${esc(nameOf(r))}</option>`).join("");
}

function redraw() { drawOverlay(); drawDetail(); }
function rechoose() { fillModifiers(); fillLaws(); redraw(); }

// One law stands out: the others fade.
function stress(law) {
  at("stress").textContent = law === undefined ? "" :
    `#explore svg [data-law]{opacity:.13}#explore svg [data-law="${CSS.escape(law)}"]{opacity:1}#explore path[data-law="${CSS.escape(law)}"]{stroke-width:3}`;
}

// "#S3_rz90/kz2" names scenario and modifier.
function readAddress() {
  const [s, m] = decodeURIComponent(location.hash.slice(1)).split("/");
  if (!data.scenarios.includes(s)) return false;
  state.s = data.scenarios.indexOf(s);
  state.m = Math.max(0, data.modifiers.indexOf(m || ""));
  at("scenario").value = state.s;
  return true;
}

function chooseLaws(wanted) {
  for (const r of chosenRuns()) wanted(r) ? state.off.delete(r.l) : state.off.add(r.l);
  fillLaws(); redraw();
}

function listen() {
  at("scenario").onchange = e => { state.s = +e.target.value; rechoose(); };
  at("modifier").onchange = e => { state.m = +e.target.value; fillLaws(); redraw(); };
  at("law").onchange = e => { state.law = +e.target.value; drawDetail(); };
  at("full").onchange = e => { state.full = e.target.checked; redraw(); };
  at("laws").onchange = e => { e.target.checked ? state.off.delete(+e.target.value) : state.off.add(+e.target.value); drawOverlay(); };
  at("all").onclick = () => chooseLaws(() => true);
  at("none").onclick = () => chooseLaws(() => false);
  at("converged").onclick = () => chooseLaws(r => r.ok);
  for (const id of ["az", "el"]) at(id).oninput = e => {
    state.turn[id] = e.target.value / DEG;
    if (at("space")) at("space").innerHTML = spacePlot(sceneNow(), paths(shownRuns()), state.turn);
  };
  const over = e => { const hit = e.target.closest && e.target.closest("[data-law]"); stress(hit ? hit.dataset.law : undefined); };
  const area = at("explore");
  area.addEventListener("pointerover", over);
  area.addEventListener("focusin", over);
  area.addEventListener("pointerleave", () => stress());
  area.addEventListener("focusout", () => stress());
  area.addEventListener("click", e => {  // a line: that law in detail
    const hit = e.target.closest("svg [data-law]");
    if (!hit || !/^\d+$/.test(hit.dataset.law) || hit.closest("label")) return;
    state.law = +hit.dataset.law; at("law").value = state.law; drawDetail();
  });
  let width = roomy();
  addEventListener("resize", () => { if (roomy() !== width) { width = roomy(); redraw(); } });
  addEventListener("hashchange", () => { if (readAddress()) rechoose(); });
}

fill(at("scenario"), data.scenarios);
const withTrace = data.runs.find(r => r.t);
if (withTrace) { state.s = withTrace.s; state.m = withTrace.m; at("scenario").value = state.s; readAddress(); rechoose(); listen(); }
at("explore").hidden = !withTrace;
// The still figures are for paper and for readers without scripts: shut here, opened to print.
const shut = () => document.querySelectorAll("details.still").forEach(d => { d.open = false; });
shut();
addEventListener("beforeprint", () => document.querySelectorAll("details.still").forEach(d => { d.open = true; }));
addEventListener("afterprint", shut);
