// Draws the leg and hands pushes to it. All that moves is computed by the module.

const byId = (id) => document.getElementById(id);
const canvas = byId("stage"), context = canvas.getContext("2d");
// Of the program: seconds of a step, and the hull's half length and radius, m.
const STEP = 1e-3, HALF = 0.17, RADIUS = 0.08;
// Of a push: N for each metre that it is drawn out, the most, and that of a key.
const DRAWN = 150, MOST = 120, KEY = 40;
// What a contact does, and its colours: those of pages that play.
const MODES = ["open", "closed", "sticks", "slides"];
const COLOURS = ["#9aa0a6", "#56b4e9", "#009e73", "#d55e00"];
// Metres for each newton of an arrow.
const ARROW = 0.002;
const STOPS = ["leg at its shortest", "leg at its longest", "hip at its rear stop", "hip at its front stop"];

let wasm = null, now = null, playing = true, last = null, remainder = 0, share = 0, eye = 0;
let held = null, pointer = [0, 0];
const keys = new Set();

const numbers = () => Array.from(new Float64Array(wasm.memory.buffer, wasm.numbers(), wasm.count()));
const complaint = () =>
  new TextDecoder().decode(new Uint8Array(wasm.memory.buffer, wasm.message(), wasm.message_length()));
const say = (text) => { byId("fallback").textContent = text; byId("fallback").hidden = text === ""; };

// The numbers of the program by name.
const read = () => {
  const all = numbers();
  const [t, x, z, pitch, hip, length, speed, falls, closed, corrections, residual, deepest, below, crept] = all;
  const contacts = [0, 1, 2].map((k) => {
    const [mode, px, pz, fx, fz] = all.slice(14 + 5 * k, 19 + 5 * k);
    return { mode, at: [px, pz], force: [fx, fz] };
  });
  const stops = all.slice(29);
  return { t, x, z, pitch, hip, length, speed, falls, closed, corrections, residual, deepest, below, crept, contacts,
    stops, all };
};

// A point of a body that is turned by an angle about the second axis, by the observer.
const placed = ([x, z], angle, [a, b]) =>
  [x + Math.cos(angle) * a + Math.sin(angle) * b, z - Math.sin(angle) * a + Math.cos(angle) * b];
const onHull = (at) => placed([now.x, now.z], now.pitch, at);

const scale = () => Math.min(canvas.clientWidth / 1.7, canvas.clientHeight / 1.05);
const onScreen = ([x, z]) =>
  [0.5 * canvas.clientWidth + (x - eye) * scale(), canvas.clientHeight - 0.12 * scale() - z * scale()];
const fromScreen = ([u, v]) =>
  [eye + (u - 0.5 * canvas.clientWidth) / scale(), (canvas.clientHeight - 0.12 * scale() - v) / scale()];

// What pushes, and where on the hull: what is held, or keys.
const push = () => {
  if (held) {
    const at = onHull(held), to = fromScreen(pointer);
    const drawn = [DRAWN * (to[0] - at[0]), DRAWN * (to[1] - at[1])];
    const size = Math.hypot(...drawn), less = size > MOST ? MOST / size : 1;
    return { force: drawn.map((part) => part * less), at: held };
  }
  const of = (plus, minus) => KEY * (keys.has(plus) - keys.has(minus));
  return { force: [of("ArrowRight", "ArrowLeft"), of("ArrowUp", "ArrowDown")], at: [0, 0] };
};

const line = (points, width, colour) => {
  context.beginPath();
  points.map(onScreen).forEach(([u, v], k) => (k ? context.lineTo(u, v) : context.moveTo(u, v)));
  Object.assign(context, { lineWidth: width, strokeStyle: colour, lineCap: "round", lineJoin: "round" });
  context.stroke();
};
const dot = (at, radius, colour) => {
  context.beginPath();
  context.arc(...onScreen(at), radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
};
const arrow = (at, force, colour) => {
  const length = ARROW * Math.hypot(...force);
  if (length < 0.01) return;
  const tip = [at[0] + ARROW * force[0], at[1] + ARROW * force[1]];
  const along = force.map((part) => (ARROW * part) / length), head = Math.min(0.04, 0.5 * length);
  const barb = (side) => [tip[0] - head * (along[0] + side * along[1]), tip[1] - head * (along[1] - side * along[0])];
  line([at, tip], 3, colour);
  line([barb(0.5), tip, barb(-0.5)], 3, colour);
};

// Ground with a mark each quarter of a metre, so that one sees the leg go on.
const drawGround = (style) => {
  const [left] = fromScreen([0, 0]), [right] = fromScreen([canvas.clientWidth, 0]);
  line([[left, 0], [right, 0]], 2, style.ink);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = style.pale;
  context.textAlign = "center";
  for (let k = Math.ceil(left / 0.25); k <= right / 0.25; k++) {
    line([[0.25 * k, 0], [0.25 * k - 0.03, -0.03]], 1, style.pale);
    const [u, v] = onScreen([0.25 * k, -0.075]);
    if (k % 2 === 0) context.fillText(`${(0.25 * k).toString().replace("-", "−")} m`, u, v + 4);
  }
};
const drawLeg = (style) => {
  const hip = [now.x, now.z], angle = now.pitch + now.hip, down = (length, side = 0) => placed(hip, angle, [side, -length]);
  const coils = 7, from = 0.16, to = now.length - 0.1;
  const zigzag = Array.from({ length: coils }, (_, k) =>
    down(from + ((to - from) * (k + 0.5)) / coils, k % 2 ? 0.035 : -0.035));
  line([down(0), down(from)], 7, style.mark);
  line([down(from), ...zigzag, down(to)], 2.5, style.ink);
  line([down(to), down(now.length)], 5, style.mark);
  const ends = [onHull([-HALF, 0]), onHull([HALF, 0])];
  line(ends, 2 * RADIUS * scale(), style.mark);
  line(ends, 2 * RADIUS * scale() - 6, style.paper);
  dot(hip, 6, style.mark);
};
const drawContacts = () => now.contacts.forEach(({ mode, at, force }) => {
  dot(at, mode ? 6 : 4, COLOURS[mode]);
  arrow(at, force, COLOURS[mode]);
});

const plain = (v, digits) => v.toFixed(digits).replace("-", "−");
const power = (v) => (v === 0 ? "0" : v.toExponential(0).replaceAll("-", "−"));
const readouts = () => [
  ["time, speed", `${plain(now.t, 1)} s, ${plain(now.speed, 2)} m/s`],
  ["toe", MODES[now.contacts[0].mode]],
  ["force on the toe", `${plain(Math.hypot(...now.contacts[0].force), 0)} N`],
  ["at a stop", now.stops.map((mode, k) => (mode ? STOPS[k] : "")).filter(Boolean).join(", ") || "nothing"],
  ["worst residual of the laws", `${power(now.residual)} m/s`],
  ["lowest gap at the end of a step", `${power(-now.below)} m`],
  ["the same before it was closed", `${power(-now.deepest)} m`],
  ["contacts closed, corrections", `${now.closed}, ${now.corrections}`],
  ["falls", now.falls],
  ["time that computing takes", `${(100 * share).toPrecision(2)} %`],
];

const draw = () => {
  const css = getComputedStyle(document.documentElement);
  const style = Object.fromEntries(["ink", "pale", "paper", "mark"].map((name) => [name, css.getPropertyValue(`--${name}`)]));
  const ratio = window.devicePixelRatio || 1;
  [canvas.width, canvas.height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.round(size * ratio));
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  drawGround(style);
  drawLeg(style);
  drawContacts();
  const { force, at } = push();
  if (held) line([onHull(held), fromScreen(pointer)], 1, style.pale);
  arrow(onHull(at), force, style.ink);
  byId("play").textContent = playing ? "pause" : "go on";
  byId("readouts").replaceChildren(...readouts().flatMap(([name, value]) => {
    const [term, data] = ["dt", "dd"].map((tag) => document.createElement(tag));
    [term.textContent, data.textContent] = [name, value];
    return [term, data];
  }));
};

// So many steps under a push.
const advance = (steps, { force, at }) => {
  wasm.advance(steps, ...force, ...at);
  now = read();
  const message = complaint();
  if (message) { playing = false; say(message); }
};
const tick = (stamp) => {
  // A page that was hidden goes on where it was.
  const passed = last === null ? 0 : Math.min(0.05, (stamp - last) / 1000);
  last = stamp;
  if (playing) {
    const steps = Math.floor((passed + remainder) / STEP), begin = performance.now();
    remainder += passed - steps * STEP;
    advance(steps, push());
    if (passed > 0) share += 0.05 * ((performance.now() - begin) / 1000 / passed - share);
    eye += (now.x - eye) * Math.min(1, 6 * passed);
    draw();
  }
  requestAnimationFrame(tick);
};

const want = () => {
  const [speed, height, friction] = ["speed", "height", "friction"].map((id) => Number(byId(id).value));
  wasm.want(speed, height, friction);
  byId("speed-now").textContent = `${plain(speed, 2)} m/s`;
  byId("height-now").textContent = `${plain(height, 2)} m`;
  byId("friction-now").textContent = plain(friction, 2);
};
const restart = () => {
  wasm.restart();
  now = read();
  [playing, eye, remainder] = [true, now.x, 0];
  say(complaint());
};
// What of the hull is held: the point that was met, or its middle.
const take = (event) => {
  move(event);
  const [a, b] = fromScreen(pointer).map((v, k) => v - [now.x, now.z][k]);
  const at = placed([0, 0], -now.pitch, [a, b]);
  held = Math.hypot(Math.max(0, Math.abs(at[0]) - HALF), at[1]) < 1.5 * RADIUS ? at : [0, 0];
  canvas.setPointerCapture(event.pointerId);
};
const move = (event) => { pointer = [event.offsetX, event.offsetY]; };

const listen = () => {
  ["speed", "height", "friction"].forEach((id) => byId(id).addEventListener("input", want));
  byId("play").addEventListener("click", () => { playing = !playing; draw(); });
  byId("restart").addEventListener("click", restart);
  canvas.addEventListener("pointerdown", take);
  canvas.addEventListener("pointermove", move);
  ["pointerup", "pointercancel"].forEach((name) => canvas.addEventListener(name, () => { held = null; }));
  const isPush = (event) => event.key.startsWith("Arrow") && event.target.tagName !== "INPUT";
  window.addEventListener("keydown", (event) => { if (isPush(event)) { keys.add(event.key); event.preventDefault(); } });
  window.addEventListener("keyup", (event) => keys.delete(event.key));
  window.addEventListener("blur", () => keys.clear());
  window.addEventListener("resize", draw);
};

const begin = async () => {
  const digits = byId("module").textContent.trim();
  if (digits === "") throw new Error("This page was written without its module: see the words of the example.");
  const bytes = Uint8Array.from({ length: digits.length / 2 }, (_, k) => parseInt(digits.slice(2 * k, 2 * k + 2), 16));
  wasm = (await WebAssembly.instantiate(bytes, {})).instance.exports;
  MODES.forEach((name, k) => {
    const item = byId("legend").appendChild(document.createElement("li"));
    item.textContent = `contact ${name}`;
    item.style.setProperty("--colour", COLOURS[k]);
  });
  want();
  restart();
  listen();
  // `#t=2&push=40` goes on to that time, with a force forward from 1 s to 1.15 s, and stops there.
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (wanted.has("t")) {
    const force = Number(wanted.get("push") ?? 0), blocks = Math.round(Number(wanted.get("t")) / 0.01);
    for (let n = 0; n < blocks; n++) advance(10, { force: [n >= 100 && n < 115 ? force : 0, 0], at: [0, 0.04] });
    [playing, eye] = [false, now.x];
  }
  draw();
  document.body.dataset.numbers = JSON.stringify(now.all);
  document.body.dataset.ready = "yes";
  requestAnimationFrame(tick);
};
begin().catch((error) => say(error.message));
