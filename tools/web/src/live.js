// Scenes that run: the kernels are WebAssembly, this draws what they say and hands sliders to them.

const { scenes, kernels } = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
// How long curves and traces reach back: pictures.
const KEPT = 900;
const HEAD = ["t", "kinetic", "potential", "error", "steps"];

let stage = null;
try { stage = new Stage(byId("stage"), [0, 0, 1]); } catch (error) { fail(error.message); }
function fail(message) {
  byId("failure").textContent = message;
  byId("failure").hidden = message === "";
}

// What the module says, read from its memory.
let wasm = null;
const numbers = () => Array.from(new Float64Array(wasm.memory.buffer, wasm.numbers(), wasm.count()));
const complaint = () => {
  const bytes = new Uint8Array(wasm.memory.buffer, wasm.message(), wasm.message_length());
  return new TextDecoder().decode(bytes);
};

let scene = null, now = null, playing = true, last = null, share = 0;
let clock = [], panels = [], trails = [], errors = [];

// Numbers of the scene: the head by name, then poses, arrows, curves.
const read = () => {
  const all = numbers(), { bodies, arrows, curves } = scene;
  const head = Object.fromEntries(HEAD.map((name, k) => [name, all[k]]));
  let from = HEAD.length;
  const take = (length) => all.slice(from, from += length);
  const poses = bodies.map(() => {
    const pose = take(7);
    return { at: pose.slice(0, 3), axes: axesOf(pose.slice(3)) };
  });
  return { ...head, poses, arrows: arrows.map(() => take(6)), curves: take(curves[1].length), all };
};

const slider = (box, { name, unit, range, value }, digits, moved) => {
  const label = box.appendChild(document.createElement("label")), id = `slider-${name}`;
  label.className = "slider";
  label.appendChild(document.createElement("span")).textContent = name;
  const shown = label.appendChild(document.createElement("output"));
  const input = label.appendChild(document.createElement("input"));
  Object.assign(input, { id, type: "range", min: range[0], max: range[1], step: (range[1] - range[0]) / 500, value });
  const tell = (v) => { shown.textContent = digits(v) + (unit && ` ${unit}`); };
  input.addEventListener("input", () => { tell(Number(input.value)); moved(Number(input.value)); });
  tell(value);
};
const plain = (v) => Number(v.toPrecision(3)).toString().replace("-", "−");

// Pictures so far are forgotten: another motion begins.
const forget = () => {
  [clock, errors].forEach((list) => { list.length = 0; });
  panels.forEach((panel) => panel.panel.curves.forEach((curve) => { curve.values.length = 0; }));
  trails.forEach((trail) => { trail.length = 0; });
  keep();
};
const keep = () => {
  now = read();
  const push = (list, value) => { list.push(value); if (list.length > KEPT) list.shift(); };
  push(clock, now.t);
  now.curves.forEach((value, k) => push(panels[0].panel.curves[k].values, value));
  push(errors, now.error);
  scene.traces.forEach(({ body, point }, k) => {
    const { at, axes } = now.poses[body];
    push(trails[k], add(at, turned3(axes, point)));
  });
};

const open = (index) => {
  scene = scenes[index];
  wasm.open(index);
  fail(complaint());
  [...byId("scenes").children].forEach((button, k) => button.setAttribute("aria-pressed", k === index));
  byId("words").textContent = scene.words;
  byId("code").textContent = scene.code;
  byId("equations").textContent = scene.equations;
  ["starts", "parameters", "panels", "legend"].forEach((id) => byId(id).replaceChildren());
  scene.sliders.forEach((each, k) => slider(byId(each.parameter ? "parameters" : "starts"), each, plain, (value) => {
    wasm.set(k, value);
    fail(complaint());
    if (!each.parameter) forget();
    draw();
  }));
  [clock, errors, trails] = [[], [], scene.traces.map(() => [])];
  const curves = scene.curves[1].map((name) => ({ name, values: [0] }));
  panels = [
    new Curves({ title: scene.curves[0], curves }, clock, () => {}, { over: "t / s" }),
    new Curves({ title: "error of the energy", curves: [{ name: "(T + U − work) / largest T, from the start", values: errors }] },
      clock, () => {}, { over: "t / s", least: 1e-16 }),
  ];
  scene.bodies.forEach((body, k) => key(byId("legend"), body.name, body.shapes[0].colour || bodyColour(k)));
  scene.arrows.forEach((name, k) => key(byId("legend"), name, bodyColour(scene.bodies.length + k)));
  if (stage) AXES.forEach(({ name, colour }) => key(byId("legend"), name, colour));
  forget();
  look();
  draw();
};

const look = () => {
  if (!stage) return;
  const { up, target, radius, angles } = scene.view;
  stage.world = axesAlong(up);
  // A ball of this radius fills the shorter side.
  const wide = stage.canvas.clientWidth / stage.canvas.clientHeight || 1, distance = distanceTo(radius) / Math.min(1, wide);
  Object.assign(stage, { target, distance, azimuth: angles[0], elevation: angles[1] });
  stage.free = false;
};

// Points joined by lines, drawn once.
const once = (points, ink) => {
  const buffer = stage.buffer(points);
  stage.lines(buffer, points.length / 3, ink);
  stage.gl.deleteBuffer(buffer);
};
const drawStage = (style) => {
  const { view, bodies, traces } = scene, { poses } = now;
  if (view.follow !== null && !stage.free) stage.target = add(poses[view.follow].at, view.target);
  stage.begin(colourOf(style.ground));
  const ink = colourOf(style.ink), [e1, e2, e3] = stage.world;
  const wall = view.backdrop.wall !== undefined, axes = wall ? [e1, e3, e2] : stage.world;
  const floor = floorOf(stage, stage.target, 2 * view.radius, wall ? view.backdrop.wall : view.backdrop.floor, axes);
  stage.lines(floor.buffer, floor.count, [...ink, 0.13]);
  stage.gl.deleteBuffer(floor.buffer);
  drawAxes(stage, 0.18 * view.radius);
  poses.forEach((pose, k) => drawBody(stage, bodies[k].shapes, pose, bodyColour(k)));
  if (byId("traces").checked) trails.forEach((trail, k) => {
    once(trail.slice(1).flatMap((point, n) => [...trail[n], ...point]), [...colourOf(bodyColour(traces[k].body)), 0.8]);
  });
  if (byId("arrows").checked) now.arrows.forEach((row, k) => {
    stage.arrow(row.slice(0, 3), row.slice(3), 0.003 * stage.distance, colourOf(bodyColour(bodies.length + k)));
  });
};

const readouts = () => [
  ["energies T, U", `${plain(now.kinetic)} J, ${plain(now.potential)} J`],
  ["error of the energy", now.error.toExponential(1).replaceAll("-", "−")],
  ["steps of the integrator", now.steps],
  ["operations of ż", scene.operations],
  ["time that computing takes", `${(100 * share).toPrecision(2)} %`],
];
const draw = () => {
  const style = styleNow();
  if (stage) drawStage(style);
  panels.forEach((panel) => { panel.fit(); panel.draw(now.t, style); });
  byId("clock").textContent = `t = ${now.t.toFixed(2)} s`;
  byId("play").textContent = playing ? "❚❚" : "▶";
  byId("readouts").replaceChildren(...readouts().flatMap(([name, value]) => {
    const [term, data] = ["dt", "dd"].map((tag) => document.createElement(tag));
    [term.textContent, data.textContent] = [name, value];
    return [term, data];
  }));
};

let tolerance = 1e-9;
const advance = (seconds) => {
  wasm.advance(seconds, tolerance);
  const message = complaint();
  if (message) { playing = false; fail(message); }
  keep();
};
const tick = (stamp) => {
  if (playing) {
    // A page that was hidden goes on where it was.
    const passed = last === null ? 1 / 60 : Math.min(0.05, (stamp - last) / 1000);
    const begin = performance.now();
    advance(passed * byId("speed").value);
    share += 0.05 * ((performance.now() - begin) / 1000 / passed - share);
    draw();
  }
  last = stamp;
  requestAnimationFrame(tick);
};
const toggle = () => { playing = !playing; fail(""); draw(); };

const begin = async () => {
  const bytes = Uint8Array.from(atob(kernels), (c) => c.charCodeAt(0));
  wasm = (await WebAssembly.instantiate(bytes, {})).instance.exports;
  scenes.forEach(({ title }, k) => {
    const button = byId("scenes").appendChild(document.createElement("button"));
    button.textContent = title;
    button.addEventListener("click", () => { playing = true; open(k); });
  });
  [0.1, 0.25, 0.5, 1, 2, 4].forEach((s) => byId("speed").add(new Option(`${s}×`, s, s === 1, s === 1)));
  const power = (v) => (10 ** v).toExponential(0).replace("-", "−");
  slider(byId("method"), { name: "tolerance of a step", unit: "", range: [-12, -2], value: -9 }, power, (v) => {
    tolerance = 10 ** v;
  });
  byId("play").addEventListener("click", toggle);
  byId("restart").addEventListener("click", () => { wasm.restart(); fail(""); forget(); playing = true; draw(); });
  ["traces", "arrows"].forEach((id) => byId(id).addEventListener("change", draw));
  window.addEventListener("resize", draw);
  window.addEventListener("keydown", (event) => {
    if (["SELECT", "INPUT", "BUTTON"].includes(event.target.tagName)) return;
    if (event.key === " ") { event.preventDefault(); toggle(); }
  });
  if (stage) steer(stage, byId("stage"), { changed: draw, released: () => { stage.free = true; }, all: look });
  // `#scene=2&t=1.5` opens a scene at that time and stops there.
  const wanted = new URLSearchParams(location.hash.slice(1));
  open(Math.min(scenes.length - 1, Number(wanted.get("scene") ?? 0)));
  if (wanted.has("t")) {
    const pictures = Math.round(60 * Number(wanted.get("t")));
    for (let n = 0; n < pictures; n++) advance(1 / 60);
    playing = false;
    draw();
  }
  document.body.dataset.numbers = JSON.stringify(now.all);
  document.body.dataset.ready = stage ? "yes" : "without WebGL";
  requestAnimationFrame(tick);
};
begin().catch((error) => fail(error.message));
