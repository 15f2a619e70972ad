// The clock, what is drawn at a time, and what mouse and keys do.

const data = JSON.parse(document.getElementById("data").textContent);
const { times: clock, bodies, rods, traces, arrows } = data;
const byId = (id) => document.getElementById(id);
const styleNow = () => {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(["ink", "pale", "line", "ground"].map((k) => [k, style.getPropertyValue(`--${k}`).trim()]));
};
const [begin, end] = [clock[0], clock.at(-1)];
const span = end - begin;

const AXES = [
  { name: "k₁", axis: [1, 0, 0], colour: "#c0392b" },
  { name: "k₂", axis: [0, 1, 0], colour: "#27ae60" },
  { name: "k₃", axis: [0, 0, 1], colour: "#2c6fbb" },
];

// Between two pictures everything goes straight; quaternions by the shorter way.
const place = (time) => {
  const forward = span >= 0 ? 1 : -1;
  let [low, high] = [0, clock.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((clock[middle] - time) * forward <= 0) low = middle; else high = middle;
  }
  const gap = clock[high] - clock[low];
  return [low, high, gap ? Math.min(1, Math.max(0, (time - clock[low]) / gap)) : 0];
};
const mixed = (rows, [a, b, s]) => rows[a].map((v, k) => v + s * (rows[b][k] - v));
const poseAt = (body, where) => {
  const [p, r] = [body.poses[where[0]], body.poses[where[1]]];
  const sign = p[3] * r[3] + p[4] * r[4] + p[5] * r[5] + p[6] * r[6] < 0 ? -1 : 1;
  const pose = p.map((v, k) => v + where[2] * ((k < 3 ? 1 : sign) * r[k] - v));
  const norm = Math.hypot(...pose.slice(3)) || 1;
  return { at: pose.slice(0, 3), axes: axesOf(pose.slice(3).map((v) => v / norm)) };
};

// How large everything is.
const reach = (body) => Math.max(0, ...body.shapes.map((shape) => Math.hypot(...shape.pose.slice(0, 3)) + Math.max(...shape.size)));
const bounds = (() => {
  const [low, high] = [[0, 0, 0], [0, 0, 0]].map((_, k) => [0, 0, 0].fill(k ? -Infinity : Infinity));
  for (const body of bodies) for (const pose of body.poses) for (let k = 0; k < 3; k++) {
    low[k] = Math.min(low[k], pose[k] - reach(body));
    high[k] = Math.max(high[k], pose[k] + reach(body));
  }
  for (const arrow of arrows) for (const row of arrow.values) for (let k = 0; k < 3; k++) {
    low[k] = Math.min(low[k], row[k], row[k] + row[k + 3]);
    high[k] = Math.max(high[k], row[k], row[k] + row[k + 3]);
  }
  if (!Number.isFinite(low[0])) return { low: [-1, -1, -1], high: [1, 1, 1] };
  return { low, high };
})();
const middle = times(add(bounds.low, bounds.high), 0.5);
const radius = Math.hypot(...sub(bounds.high, bounds.low)) / 2 || 1;

let stage = null;
try { stage = new Stage(byId("stage"), data.up); } catch (error) {
  byId("failure").textContent = error.message;
  byId("failure").hidden = false;
  byId("hint").hidden = true;
}
// Where the eye is at first: azimuth and elevation.
const FROM = {
  slant: { azimuth: 0.6, elevation: 0.42 }, top: { azimuth: -Math.PI / 2, elevation: 1.55 },
};
// So far that a ball of this radius fills the height.
const distanceTo = (size) => 1.05 * size / Math.sin(0.3);
const seeAll = () => Object.assign(stage, { target: middle, distance: distanceTo(radius), ...FROM[data.view] });
const buffers = { traces: [], grid: null };
if (stage) {
  seeAll();
  const largest = Math.max(...bodies.map(reach));
  if (data.follow !== null) stage.distance = Math.min(distanceTo(radius), distanceTo(2.5 * (reach(bodies[data.follow]) || largest)));
  buffers.traces = traces.map((trace) => stage.tube(clock.map((_, n) => {
    const { at, axes } = poseAt(bodies[trace.body], [n, n, 0]);
    return add(at, turned3(axes, trace.point));
  }), Math.min(0.004 * radius, stage.distance * 0.0015)));
  // A floor below everything, of squares whose side is a power of ten, or twice or five times that.
  const raw = radius / 4, power = 10 ** Math.floor(Math.log10(raw));
  const side = [1, 2, 5, 10].find((s) => s * power >= raw) * power, n = Math.ceil(1.3 * radius / side);
  const [e1, e2, up] = stage.world, grid = [];
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((c) => [0, 1, 2].map((k) => (c >> k & 1 ? bounds.high : bounds.low)[k]));
  const floor = times(up, Math.min(...corners.map((corner) => dot(corner, up))));
  const centre = [e1, e2].map((e) => Math.round(dot(middle, e) / side) * side);
  const at = (u, v) => add(floor, add(times(e1, centre[0] + u * side), times(e2, centre[1] + v * side)));
  for (let k = -n; k <= n; k++) grid.push(...at(k, -n), ...at(k, n), ...at(-n, k), ...at(n, k));
  buffers.grid = { buffer: stage.buffer(grid), count: grid.length / 3, side };
}

let now = begin, playing = false, last = null;
const panels = data.panels.map((panel) => new Curves(panel, clock, (t) => seek(t)));
const bodyColour = (k) => COLOURS[k % COLOURS.length];
const arrowColour = (k) => COLOURS[(bodies.filter((b) => b.shapes.length).length + k + 1) % COLOURS.length];

const drawStage = (where, style) => {
  const paper = colourOf(style.ground), poses = bodies.map((body) => poseAt(body, where));
  const follow = byId("follow").value;
  if (follow !== "") stage.target = poses[follow].at;
  stage.begin(paper);
  const ink = colourOf(style.ink);
  stage.lines(buffers.grid.buffer, buffers.grid.count, [...ink, 0.13]);
  AXES.forEach(({ axis, colour }) => {
    stage.arrow([0, 0, 0], times(axis, 0.18 * radius), 0.0015 * stage.distance, colourOf(colour));
  });
  poses.forEach(({ at, axes }, k) => bodies[k].shapes.forEach((shape) => {
    const own = axesOf(shape.pose.slice(3)).map((e) => turned3(axes, e));
    stage.draw(shape.kind, own, add(at, turned3(axes, shape.pose.slice(0, 3))), shape.size,
      colourOf(shape.colour || bodyColour(k)));
  }));
  rods.forEach(({ from, to, radius: r }) => {
    stage.rod(poses[from].at, poses[to].at, r, colourOf(bodyColour(0)));
    [from, to].forEach((k) => stage.draw("ellipsoid", axesOf([0, 0, 0, 1]), poses[k].at, [1.5 * r, 1.5 * r, 1.5 * r],
      colourOf(bodyColour(1))));
  });
  if (byId("traces").checked) traces.forEach((trace, k) => {
    const colour = colourOf(bodyColour(trace.body)), tube = buffers.traces[k];
    const still = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0], [1, 1, 1]];
    stage.draw(tube, ...still, colour, where[0] * tube.each);
    stage.draw(tube, ...still, colour.map((c, i) => 0.25 * c + 0.75 * paper[i]));
  });
  if (byId("arrows").checked) arrows.forEach((arrow, k) => {
    const row = mixed(arrow.values, where);
    stage.arrow(row.slice(0, 3), row.slice(3), 0.003 * stage.distance, colourOf(arrowColour(k)));
  });
};

const draw = () => {
  const where = place(now), style = styleNow();
  if (stage) drawStage(where, style);
  panels.forEach((panel) => panel.draw(now, style));
  byId("slider").value = span ? (now - begin) / span : 0;
  byId("clock").textContent = `t = ${now.toFixed(Math.max(0, 3 - Math.floor(Math.log10(Math.abs(span) || 1))))}`;
  byId("play").textContent = playing ? "❚❚" : "▶";
};
const seek = (t) => { now = t; requestAnimationFrame(draw); };
const tick = (stamp) => {
  if (!playing) return;
  if (last !== null) now += (stamp - last) / 1000 * byId("speed").value * Math.sign(span);
  last = stamp;
  if ((now - end) * Math.sign(span) >= 0) { now = end; playing = false; }
  draw();
  if (playing) requestAnimationFrame(tick);
};
const toggle = () => {
  playing = !playing && span !== 0;
  if (playing && now === end) now = begin;
  last = null;
  draw();
  if (playing) requestAnimationFrame(tick);
};

// Speeds: as time goes, and the one at which everything lasts ten seconds.
const natural = Math.abs(span) / 10 || 1;
const speeds = [...new Set([0.1, 0.25, 0.5, 1, 2, 4, 10].map((s) => s).concat(Number(natural.toPrecision(2))))];
speeds.sort((a, b) => a - b).forEach((s) => byId("speed").add(new Option(`${s}×`, s)));
byId("speed").value = Math.abs(span) >= 2 && Math.abs(span) <= 30 ? 1 : Number(natural.toPrecision(2));
bodies.forEach((body, k) => byId("follow").add(new Option(body.name, k)));
byId("follow").value = data.follow ?? "";
const key = (name, colour) => {
  const item = byId("legend").appendChild(document.createElement("span"));
  item.className = "key";
  item.style.setProperty("--colour", colour);
  item.textContent = name;
};
bodies.forEach((body, k) => { if (body.shapes.length) key(body.name, body.shapes[0].colour || bodyColour(k)); });
arrows.forEach((arrow, k) => key(arrow.name, arrowColour(k)));
if (stage) AXES.forEach(({ name, colour }) => key(name, colour));
if (stage) key(`squares of ${Number(buffers.grid.side.toPrecision(3))}`, "var(--line)");

byId("play").addEventListener("click", toggle);
byId("slider").addEventListener("input", (event) => { playing = false; seek(begin + event.target.value * span); });
["traces", "arrows", "follow"].forEach((id) => byId(id).addEventListener("change", draw));
window.addEventListener("resize", draw);
window.addEventListener("keydown", (event) => {
  if (["SELECT", "INPUT", "BUTTON"].includes(event.target.tagName)) return;
  if (event.key === " ") { event.preventDefault(); toggle(); }
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (step) seek(span > 0 ? Math.min(end, Math.max(begin, now + step * span / 200)) : now);
});
if (stage) {
  const canvas = byId("stage");
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); canvas.focus(); });
  canvas.addEventListener("pointermove", (event) => {
    if (!event.buttons) return;
    if (event.shiftKey || event.buttons === 2) {
      const scale = 2 * Math.tan(0.3) * stage.distance / canvas.clientHeight, { x, y } = stage.axes;
      byId("follow").value = "";
      stage.target = add(stage.target, add(times(x, -event.movementX * scale), times(y, event.movementY * scale)));
    } else {
      stage.azimuth -= event.movementX * 0.008;
      stage.elevation = Math.min(1.55, Math.max(-1.55, stage.elevation + event.movementY * 0.008));
    }
    requestAnimationFrame(draw);
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    stage.distance *= Math.exp(event.deltaY * 0.001);
    requestAnimationFrame(draw);
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { byId("follow").value = ""; seeAll(); draw(); });
}
// `#t=1.5` opens the page at that time.
const wanted = /[#&]t=([-+.\de]+)/.exec(location.hash);
if (wanted) now = Math.min(Math.max(Number(wanted[1]), Math.min(begin, end)), Math.max(begin, end));
draw();
document.body.dataset.bodies = JSON.stringify(bodies.map((body) => poseAt(body, place(now)).at));
document.body.dataset.ready = stage ? "yes" : "without WebGL";
