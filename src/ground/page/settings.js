// Law, limits and goal by numbers, within what the task allows; degrees here, radians to the program.
const Settings = (() => {
  const kRadian = 180 / Math.PI;
  const kLimits = ["most_forward", "most_right", "most_down", "most_yaw"];
  const kGoal = ["goal_forward", "goal_right", "goal_down", "goal_yaw"];
  let fly = null, place = null, goal = null;
  const edited = new Set();  // groups in which a human has written what is not yet asked for

  const short = x => String(Number(x.toFixed(2)) || 0);
  const inDegrees = list => list.map((x, i) => i === 3 ? x * kRadian : x);
  const inRadians = list => list.map((x, i) => i === 3 ? x / kRadian : x);
  const numbers = ids => ids.map(id => at(id).value.trim() === "" ? NaN : Number(at(id).value));

  function fill(ids, values) { ids.forEach((id, i) => { at(id).value = short(values[i]); }); }

  function showLaws(desk) {
    const list = at("law");
    if (list.children.length !== desk.laws.length) {
      list.replaceChildren(...desk.laws.map(word => new Option(word, word)));
    }
    if (document.activeElement !== list) list.value = desk.law;
  }
  async function ask(group, word, more, ids) {
    if (Object.values(more).flat().some(x => Number.isNaN(x))) {
      return fly.say("A number is missing.", "bad");
    }
    const reply = await fly.give(word, more);
    if (reply.done) edited.delete(group);
    for (const id of ids) at(id).setAttribute("aria-invalid", String(!reply.done));
  }
  function askLimits(event) {
    event.preventDefault();
    ask("limits", "limits", { velocity: inRadians(numbers(kLimits)) }, kLimits);
  }
  function askGoal(event) {
    event.preventDefault();
    const [forward, right, down, yaw] = inRadians(numbers(kGoal));
    ask("goal", "goal", { position_m: [forward, right, down], yaw_rad: yaw }, kGoal);
  }
  function here() {
    if (!place) return fly.say("The target is not seen: nobody knows where the vehicle is.", "bad");
    fill(kGoal, inDegrees(place));
    edited.add("goal");
  }

  return {
    wire(parts) {
      fly = parts;
      at("law").addEventListener("change", () => fly.give("law", { law: at("law").value }));
      at("limits").addEventListener("submit", askLimits);
      at("goal").addEventListener("submit", askGoal);
      at("goal_here").addEventListener("click", here);
      at("limits").addEventListener("input", () => edited.add("limits"));
      at("goal").addEventListener("input", () => edited.add("goal"));
      at("limits_reset").addEventListener("click", () => {
        fill(kLimits, inDegrees(fly.desk().most_speed));
        edited.add("limits");
      });
    },
    show(desk, mine) {
      showLaws(desk);
      for (const id of ["law", "set_limits", "set_goal"]) at(id).disabled = !mine;
      if (!edited.has("limits")) fill(kLimits, inDegrees(desk.speed));
      at("limits_words").textContent = "The task allows " + inDegrees(desk.most_speed).map(short).join(", ") + ".";
    },
    showScene(scene) {
      place = scene.vehicle;
      goal = scene.goal;
      if (!edited.has("goal")) fill(kGoal, inDegrees(goal));
      const words = place ? inDegrees(place).map((x, i) => fixed(x, i === 3 ? 0 : 2)).join(", ") : "not known";
      at("goal_now").textContent = "Now: " + words + ".";
    },
  };
})();
