// What every page has on its stage: bodies with their shapes, a floor, axes, and a camera that mouse and fingers move.

const AXES = [
  { name: "k₁", axis: [1, 0, 0], colour: "#c0392b" },
  { name: "k₂", axis: [0, 1, 0], colour: "#27ae60" },
  { name: "k₃", axis: [0, 0, 1], colour: "#2c6fbb" },
];
const bodyColour = (k) => COLOURS[k % COLOURS.length];
// So far that a ball of this radius fills the height.
const distanceTo = (size) => 1.05 * size / Math.sin(0.3);
// How far points are off the middle of the picture, in parts of half its width and half its height.
const offMiddle = (stage, points) => {
  const z = stage.back(), x = unit(cross(stage.world[2], z)), y = cross(z, x), slope = Math.tan(0.3);
  const wide = stage.canvas.clientWidth / stage.canvas.clientHeight || 1;
  return points.map((point) => sub(point, stage.target)).map((p) =>
    [dot(p, x) / wide / slope, dot(p, y) / slope].map((side) => side / (stage.distance - dot(p, z))));
};
const filled = (stage, points) => {
  const off = offMiddle(stage, points);
  return [0, 1].map((k) => [Math.min(...off.map((o) => o[k])), Math.max(...off.map((o) => o[k]))]);
};
// Moves the eye along the picture and toward it, so that all points are in it and it is full. With p the side of a
// point and d its depth, |p − a| ≤ slope (D − d) is D ∓ a / slope ≥ ±p / slope + d: the largest of each side decide.
const fit = (stage, points, otherwise) => {
  const z = stage.back(), x = unit(cross(stage.world[2], z)), y = cross(z, x);
  const wide = stage.canvas.clientWidth / stage.canvas.clientHeight || 1, { target } = stage;
  const sides = [[x, wide * Math.tan(0.3)], [y, Math.tan(0.3)]].map(([axis, slope]) => {
    let [low, high] = [-Infinity, -Infinity];
    for (const point of points) {
      const p = sub(point, target), side = dot(p, axis) / slope, depth = dot(p, z);
      [low, high] = [Math.max(low, depth - side), Math.max(high, depth + side)];
    }
    return { along: times(axis, slope * (high - low) / 2), distance: (high + low) / 2 };
  });
  stage.target = sides.reduce((sum, { along }) => add(sum, along), target);
  stage.distance = 1.08 * Math.max(...sides.map(({ distance }) => distance)) || otherwise;
};
const styleNow = () => {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(["ink", "pale", "line", "ground"].map((k) => [k, style.getPropertyValue(`--${k}`).trim()]));
};

// The shapes of a body at its place, with its axes.
const drawBody = (stage, shapes, { at, axes }, colour) => shapes.forEach((shape) => {
  const own = axesOf(shape.pose.slice(3)).map((e) => turned3(axes, e));
  stage.draw(shape.kind, own, add(at, turned3(axes, shape.pose.slice(0, 3))), shape.size,
    colourOf(shape.colour || colour));
});
const drawAxes = (stage, length) => AXES.forEach(({ axis, colour }) => {
  stage.arrow([0, 0, 0], times(axis, length), 0.0015 * stage.distance, colourOf(colour));
});

// Squares whose side is a power of ten, or twice or five times that: a floor, at a height along what is up; or by
// other axes.
const floorOf = (stage, middle, radius, height, [e1, e2, up] = stage.world) => {
  const raw = radius / 4, power = 10 ** Math.floor(Math.log10(raw));
  const side = [1, 2, 5, 10].find((s) => s * power >= raw) * power, n = Math.ceil(1.3 * radius / side);
  const grid = [], floor = times(up, height);
  const centre = [e1, e2].map((e) => Math.round(dot(middle, e) / side) * side);
  const at = (u, v) => add(floor, add(times(e1, centre[0] + u * side), times(e2, centre[1] + v * side)));
  for (let k = -n; k <= n; k++) grid.push(...at(k, -n), ...at(k, n), ...at(-n, k), ...at(n, k));
  return { buffer: stage.buffer(grid), count: grid.length / 3, side };
};

// Mouse and fingers: `changed` draws anew, `released` is called when the camera no longer goes with a body, `all`
// shows everything.
const steer = (stage, canvas, { changed, released, all }) => {
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); canvas.focus(); });
  canvas.addEventListener("pointermove", (event) => {
    if (!event.buttons) return;
    if (event.shiftKey || event.buttons === 2) {
      const scale = 2 * Math.tan(0.3) * stage.distance / canvas.clientHeight, { x, y } = stage.axes;
      released();
      stage.target = add(stage.target, add(times(x, -event.movementX * scale), times(y, event.movementY * scale)));
    } else {
      stage.azimuth -= event.movementX * 0.008;
      stage.elevation = Math.min(1.55, Math.max(-1.55, stage.elevation + event.movementY * 0.008));
    }
    requestAnimationFrame(changed);
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    stage.distance *= Math.exp(event.deltaY * 0.001);
    requestAnimationFrame(changed);
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { released(); all(); changed(); });
};

// A word of the legend with its colour.
const key = (legend, name, colour) => {
  const item = legend.appendChild(document.createElement("span"));
  item.className = "key";
  item.style.setProperty("--colour", colour);
  item.textContent = name;
};
