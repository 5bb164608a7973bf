// Flying by hand: two pads and the keyboard, each with a dead man. As long as a finger, a button of
// the mouse or the space bar holds, the page says where the sticks are; what lets go sends hover,
// and the program lets go by itself when it hears nothing for 0.3 s.
const Sticks = (() => {
  const kEvery_ms = 80, kWaiting = 3, kKeyShare = 0.5;
  // Of the stick axes: forward, right, down, yaw.
  const kSteer = { w: [1, 0, 0, 0], s: [-1, 0, 0, 0], a: [0, -1, 0, 0], d: [0, 1, 0, 0],
    q: [0, 0, 0, -1], e: [0, 0, 0, 1], r: [0, 0, -1, 0], f: [0, 0, 1, 0],
    ArrowUp: [0, 0, -1, 0], ArrowDown: [0, 0, 1, 0], ArrowLeft: [0, 0, 0, -1], ArrowRight: [0, 0, 0, 1] };
  const holders = new Set(), pressed = new Set();
  const pads = { move: [0, 0], turn: [0, 0] };  // to the right and up, -1 to 1
  let timer = null, waiting = 0, full = false, fly = null;

  const keyOf = event => event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const clip = x => Math.max(-1, Math.min(1, x));

  function share() {
    const s = [pads.move[1], pads.move[0], -pads.turn[1], pads.turn[0]];
    for (const key of pressed) kSteer[key].forEach((x, i) => { s[i] += x * (full ? 1 : kKeyShare); });
    return s.map(clip);
  }
  function velocity() { return share().map((x, i) => x * fly.desk().speed[i]); }

  function why() {  // nothing goes out
    if (!at("dead_man").disabled) return "nothing, let go";
    return fly.commanding() ? "nothing: reset after the abort first" : "nothing: take the command first";
  }
  function show() {
    const s = share(), held = timer !== null;
    const knob = (id, x, y) => { at(id).setAttribute("cx", 50 + 36 * x); at(id).setAttribute("cy", 50 - 36 * y); };
    knob("knob_move", s[1], s[0]);
    knob("knob_turn", s[3], -s[2]);
    at("sticks").classList.toggle("held", held);
    at("dead_man").setAttribute("aria-pressed", String(holders.size > 0));
    if (!fly || !fly.desk()) return;
    const v = velocity();
    const words = held ? `${fixed(v[0], 2)}  ${fixed(v[1], 2)}  ${fixed(v[2], 2)} m/s,  ${fixed(v[3] * 180 / Math.PI, 0)} deg/s` : why();
    if (at("sticks_asked").textContent !== words) at("sticks_asked").textContent = words;
  }

  async function push() {
    if (waiting >= kWaiting) return;  // a slow line: what is older than this would be stale
    ++waiting;
    try {
      const reply = await Commands.give("sticks", { velocity: velocity() });
      if (timer !== null && reply.status === 409) lost(reply.words);
    } catch (error) {
      if (timer !== null) lost(error.message);
    } finally {
      --waiting;
    }
  }
  function stopSending() {
    clearInterval(timer);
    timer = null;
  }
  // The program has let go, or cannot be reached: a hand must take the sticks anew.
  function lost(why) {
    stopSending();
    forget();
    fly.say(`The sticks are let go: ${why}. Hover until Start.`, "bad");
  }
  function forget() {
    holders.clear();
    pressed.clear();
    pads.move = [0, 0];
    pads.turn = [0, 0];
    show();
  }

  async function hold(who) {
    const first = holders.size === 0;
    holders.add(who);
    show();
    if (!first || timer !== null) return;
    if (!fly.commanding()) {
      forget();
      return fly.say("Take the command first; then the sticks can be taken.", "bad");
    }
    const reply = await fly.give("grip");
    if (!reply.done) return forget();
    if (holders.size === 0) return fly.give("hover");  // let go meanwhile
    if (timer !== null) return;  // and held again: the other answer came first
    timer = setInterval(push, kEvery_ms);
    push();
    show();
  }
  function letGo(who) {
    if (!holders.delete(who) || holders.size > 0) return show();
    letAllGo();
  }
  function letAllGo() {
    const held = timer !== null;
    stopSending();
    forget();
    if (held) fly.give("hover");
  }

  function wirePad(name, id) {
    const pad = at(id), who = "pad " + name;
    let finger = null, box = null;  // that holds it, and where the pad was then: a page that moves steers nothing
    const place = event => {
      const half = 0.36 * box.width;
      pads[name] = [clip((event.clientX - box.left - box.width / 2) / half),
        clip((box.top + box.height / 2 - event.clientY) / half)];
      show();
    };
    const end = event => {
      if (event.pointerId !== finger) return;
      finger = null;
      pads[name] = [0, 0];
      letGo(who);
    };
    pad.addEventListener("pointerdown", event => {
      event.preventDefault();
      if (finger !== null && holders.has(who)) return;  // a second finger on the same stick
      finger = event.pointerId;
      box = pad.getBoundingClientRect();
      pad.setPointerCapture(event.pointerId);
      place(event);
      hold(who);
    });
    pad.addEventListener("pointermove", event => { if (event.pointerId === finger && holders.has(who)) place(event); });
    for (const word of ["pointerup", "pointercancel", "lostpointercapture"]) pad.addEventListener(word, end);
    pad.addEventListener("contextmenu", event => event.preventDefault());
  }
  function wireDeadMan() {
    const button = at("dead_man");
    button.addEventListener("keydown", event => {
      if (event.key !== " " && event.key !== "Enter") return;
      event.preventDefault();
      if (!event.repeat) hold("key");
    });
    button.addEventListener("keyup", event => {
      if (event.key !== " " && event.key !== "Enter") return;
      event.preventDefault();
      letGo("key");
    });
    button.addEventListener("pointerdown", event => {
      button.focus();
      button.setPointerCapture(event.pointerId);
      hold("button");
    });
    for (const word of ["pointerup", "pointercancel", "lostpointercapture"]) button.addEventListener(word, () => letGo("button"));
    button.addEventListener("contextmenu", event => event.preventDefault());
    button.addEventListener("blur", () => { letGo("key"); letGo("button"); });
  }

  return {
    // parts of the page: { give, say, commanding, desk }.
    wire(parts) {
      fly = parts;
      wirePad("move", "pad_move");
      wirePad("turn", "pad_turn");
      wireDeadMan();
      window.addEventListener("blur", letAllGo);
      window.addEventListener("pagehide", letAllGo);
      document.addEventListener("visibilitychange", () => { if (document.hidden) letAllGo(); });
      document.addEventListener("keyup", event => {
        full = event.shiftKey;
        pressed.delete(keyOf(event));
        show();
      });
    },
    // True when the key steers: then it is no command of the page.
    takes(event) {
      full = event.shiftKey;
      if (holders.size === 0 || !(keyOf(event) in kSteer)) return false;
      pressed.add(keyOf(event));
      show();
      return true;
    },
    areHeld: () => holders.size > 0,
    letAllGo,
    // The program's word on it: its mode, and what may be asked for.
    follow(desk) {
      const mine = fly.commanding();
      at("dead_man").disabled = !mine || desk.mode === "aborted";
      at("sticks").classList.toggle("off", at("dead_man").disabled);
      if (timer !== null && !mine) lost("another page has the command");
      show();
    },
  };
})();
