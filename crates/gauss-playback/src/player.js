// The clock, what is drawn at a time, and what mouse and keys do.

const data = JSON.parse(document.getElementById("data").textContent);
const { times: clock, bodies, rods, traces, arrows, contacts } = data;
const byId = (id) => document.getElementById(id);
const [begin, end] = [clock[0], clock.at(-1)];
const span = end - begin;
// The unit, in scenes that say that they are in those of the SI.
const inUnits = (name) => data.si ? name : "";

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
  const [low, high] = [Infinity, -Infinity].map((v) => [v, v, v]);
  const take = (point, size) => [0, 1, 2].forEach((k) => {
    low[k] = Math.min(low[k], point[k] - size[k]);
    high[k] = Math.max(high[k], point[k] + size[k]);
  });
  for (const body of bodies) body.poses.forEach((_, n) => {
    const { at, axes } = poseAt(body, [n, n, 0]);
    take(at, [0, 0, 0]);
    for (const shape of body.shapes) {
      const own = axesOf(shape.pose.slice(3)).map((e) => turned3(axes, e));
      const half = [0, 1, 2].map((k) => own.reduce((sum, e, i) => sum + Math.abs(e[k]) * shape.size[i], 0));
      take(add(at, turned3(axes, shape.pose.slice(0, 3))), half);
    }
  });
  for (const arrow of [...arrows, ...contacts]) for (const row of arrow.values) {
    const from = row.slice(0, 3);
    for (const point of [from, add(from, row.slice(3))]) take(point, [0, 0, 0]);
  }
  if (!Number.isFinite(low[0])) return { low: [-1, -1, -1], high: [1, 1, 1] };
  return { low, high };
})();
const cornersOf = (low, high) => [0, 1, 2, 3, 4, 5, 6, 7].map((c) => [0, 1, 2].map((k) => (c >> k & 1 ? high : low)[k]));
const corners = cornersOf(bounds.low, bounds.high);
// What shall be in the picture: the corners of all shapes and the ends of arrows, in two hundred pictures or fewer.
const outline = (() => {
  const points = [], every = Math.max(1, Math.ceil(clock.length / 200));
  for (let n = 0; n < clock.length; n += every) {
    for (const body of bodies) {
      const { at, axes } = poseAt(body, [n, n, 0]);
      points.push(at);
      for (const { pose, size } of body.shapes) {
        const own = axesOf(pose.slice(3));
        for (const corner of cornersOf(times(size, -1), size)) {
          points.push(add(at, turned3(axes, add(pose.slice(0, 3), turned3(own, corner)))));
        }
      }
    }
    for (const { values } of [...arrows, ...contacts]) {
      points.push(values[n].slice(0, 3), add(values[n].slice(0, 3), values[n].slice(3)));
    }
  }
  return points.length ? points : corners;
})();
const middle = times(add(bounds.low, bounds.high), 0.5);
const radius = Math.hypot(...sub(bounds.high, bounds.low)) / 2 || 1;

let now = begin, playing = false, last = null;
// Before the stage: they leave it the height that it has.
const titled = (panel) => ({ ...panel, title: panel.unit ? panel.title + inUnits(` / ${panel.unit}`) : panel.title });
const panels = data.panels.map((panel) => new Curves(titled(panel), clock, (t) => seek(t), { over: data.si ? "t / s" : "t" }));

let stage = null;
try { stage = new Stage(byId("stage"), data.up); } catch (error) {
  byId("failure").textContent = error.message;
  byId("failure").hidden = false;
  byId("hint").hidden = true;
}
// Where the eye is at first: azimuth and elevation.
const FROM = {
  slant: { azimuth: 0.6, elevation: 0.42 }, top: { azimuth: -Math.PI / 2, elevation: 1.55 },
  side: { azimuth: -Math.PI / 2, elevation: 0.1 },
};
// So near that everything is still in the picture, which it fills from side to side or from top to bottom.
const seeAll = () => {
  Object.assign(stage, { target: middle, ...FROM[data.view] });
  fit(stage, outline, distanceTo(radius));
};
// Everything, or near the body that the camera goes with; until the camera is moved by hand.
let moved = false;
const look = () => {
  if (!stage || moved) return;
  seeAll();
  const largest = Math.max(...bodies.map(reach));
  if (data.follow !== null) stage.distance = Math.min(stage.distance, distanceTo(2.5 * (reach(bodies[data.follow]) || largest)));
};
const buffers = { traces: [], grids: [] };
if (stage) {
  look();
  buffers.traces = traces.map((trace) => stage.tube(clock.map((_, n) => {
    const { at, axes } = poseAt(bodies[trace.body], [n, n, 0]);
    return add(at, turned3(axes, trace.point));
  }), Math.min(0.004 * radius, stage.distance * 0.0015)));
  // Planes that are touched, or a floor below everything.
  const height = Math.min(...corners.map((corner) => dot(corner, stage.world[2])));
  buffers.grids = data.planes.map(({ normal, height: h }) => floorOf(stage, middle, radius, h, axesAlong(normal)));
  if (!data.planes.length) buffers.grids.push(floorOf(stage, middle, radius, height));
}

// What contacts do, and its colours.
const TOUCHES = { open: "#9aa0a6", closed: "#56b4e9", sticks: "#009e73", slides: "#d55e00" };
const arrowColour = (k) => COLOURS[(bodies.filter((b) => b.shapes.length).length + k + 1) % COLOURS.length];

const drawStage = (where, style) => {
  const paper = colourOf(style.ground), poses = bodies.map((body) => poseAt(body, where));
  const follow = byId("follow").value;
  if (follow !== "") stage.target = poses[follow].at;
  stage.begin(paper);
  const ink = colourOf(style.ink);
  buffers.grids.forEach((grid) => stage.lines(grid.buffer, grid.count, [...ink, 0.13]));
  drawAxes(stage, 0.18 * radius);
  poses.forEach((pose, k) => drawBody(stage, bodies[k].shapes, pose, bodyColour(k)));
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
  // Before all else: they lie under bodies and on floors.
  stage.before(() => contacts.forEach(({ touches, values }) => {
    const row = mixed(values, where), colour = colourOf(TOUCHES[touches[where[2] < 1 ? where[0] : where[1]]]);
    const size = (touches[where[0]] === "open" ? 0.005 : 0.007) * stage.distance;
    stage.draw("ellipsoid", axesOf([0, 0, 0, 1]), row.slice(0, 3), [size, size, size], colour);
    if (byId("arrows").checked) stage.arrow(row.slice(0, 3), row.slice(3), 0.003 * stage.distance, colour);
  }));
};

const draw = () => {
  const where = place(now), style = styleNow();
  if (stage) drawStage(where, style);
  panels.forEach((panel) => panel.draw(now, style));
  byId("slider").value = span ? (now - begin) / span : 0;
  byId("clock").textContent = `t = ${now.toFixed(Math.max(0, 3 - Math.floor(Math.log10(Math.abs(span) || 1))))}${inUnits(" s")}`;
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
const legend = byId("legend");
bodies.forEach((body, k) => { if (body.shapes.length) key(legend, body.name, body.shapes[0].colour || bodyColour(k)); });
arrows.forEach((arrow, k) => key(legend, arrow.name, arrowColour(k)));
const touched = new Set(contacts.flatMap(({ touches }) => touches));
Object.keys(TOUCHES).filter((touch) => touched.has(touch)).forEach((touch) => key(legend, `contact ${touch}`, TOUCHES[touch]));
if (stage) AXES.forEach(({ name, colour }) => key(legend, name, colour));
if (stage) key(legend, `squares of ${Number(buffers.grids[0].side.toPrecision(3))}${inUnits(" m")}`, "var(--line)");

byId("play").addEventListener("click", toggle);
byId("slider").addEventListener("input", (event) => { playing = false; seek(begin + event.target.value * span); });
["traces", "arrows", "follow"].forEach((id) => byId(id).addEventListener("change", draw));
window.addEventListener("resize", () => { look(); draw(); });
window.addEventListener("keydown", (event) => {
  if (["SELECT", "INPUT", "BUTTON"].includes(event.target.tagName)) return;
  if (event.key === " ") { event.preventDefault(); toggle(); }
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (step) seek(span > 0 ? Math.min(end, Math.max(begin, now + step * span / 200)) : now);
});
if (stage) {
  const released = () => { byId("follow").value = ""; };
  const changed = () => { moved = true; draw(); };
  steer(stage, byId("stage"), { changed, released, all: seeAll });
}
// `#t=1.5` opens the page at that time.
const wanted = /[#&]t=([-+.\de]+)/.exec(location.hash);
if (wanted) now = Math.min(Math.max(Number(wanted[1]), Math.min(begin, end)), Math.max(begin, end));
// The legend above has taken its place.
look();
draw();
document.body.dataset.bodies = JSON.stringify(bodies.map((body) => poseAt(body, place(now)).at));
document.body.dataset.filled = JSON.stringify(stage ? filled(stage, outline) : null);
document.body.dataset.ready = stage ? "yes" : "without WebGL";
