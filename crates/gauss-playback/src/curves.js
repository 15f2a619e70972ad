// Curves over time, on plain canvases; a click goes to that time.

const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#a07a2c", "#666666"];
const MARGIN = { left: 84, right: 16, top: 8, bottom: 22 };

// Round numbers, about `count` of them, inside an interval.
const ticks = (low, high, count) => {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((s) => s * power >= raw) * power;
  const all = [];
  for (let n = Math.ceil(low / step); n * step <= high * (1 + 1e-12); n++) all.push(n * step);
  return { all, digits: -Math.floor(Math.log10(step) + 1e-9) };
};
// With as many digits as tell it from its neighbours.
const label = (value, digits) => {
  if (value === 0 && digits > 4) return "0";
  const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9), isPlain = digits <= 4 && Math.abs(value) < 1e6;
  const text = isPlain ? value.toFixed(Math.max(0, digits)) : value.toExponential(Math.max(0, power + digits));
  return text.replace("e+0", "").replaceAll("-", "−");
};

class Curves {
  constructor(panel, times, seek, { over = "t", least = 1 } = {}) {
    // `over`: what stands at the axis of time; `least`: half the axis of what is zero throughout.
    Object.assign(this, { panel, times, seek, over, least });
    const box = document.createElement("div");
    box.className = "panel";
    // Above the curves, in as many lines as it takes: on a narrow screen it would cover them.
    const legend = box.appendChild(document.createElement("div"));
    this.canvas = box.appendChild(document.createElement("canvas"));
    legend.appendChild(document.createElement("b")).textContent = panel.title;
    panel.curves.forEach((curve, k) => {
      const key = legend.appendChild(document.createElement("span"));
      key.className = "key";
      key.style.setProperty("--colour", COLOURS[k % COLOURS.length]);
      key.textContent = curve.name;
    });
    document.getElementById("panels").appendChild(box);
    this.fit();
    const go = (event) => {
      const x = (event.offsetX - MARGIN.left) / (this.canvas.clientWidth - MARGIN.left - MARGIN.right);
      seek(times[0] + Math.min(1, Math.max(0, x)) * (times.at(-1) - times[0]));
    };
    this.canvas.addEventListener("pointerdown", (event) => { this.canvas.setPointerCapture(event.pointerId); go(event); });
    this.canvas.addEventListener("pointermove", (event) => { if (event.buttons) go(event); });
  }

  // The axis so that every value is on it.
  fit() {
    const all = this.panel.curves.flatMap((curve) => [Math.min(...curve.values), Math.max(...curve.values)]);
    let [low, high] = [Math.min(...all), Math.max(...all)];
    // What is constant but for rounding is a straight line, not noise across the panel.
    const least = 1e-9 * Math.max(Math.abs(low), Math.abs(high)) || this.least;
    if (high - low < least) [low, high] = [low - least, high + least];
    const room = 0.06 * (high - low);
    [this.low, this.high] = [low - room, high + room];
  }

  draw(t, style) {
    const ratio = window.devicePixelRatio || 1, { canvas, times } = this;
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    Object.assign(canvas, { width: w * ratio, height: h * ratio });
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const span = times.at(-1) - times[0] || 1;
    const x = (time) => MARGIN.left + (time - times[0]) / span * (w - MARGIN.left - MARGIN.right);
    const y = (v) => MARGIN.top + (this.high - v) / (this.high - this.low) * (h - MARGIN.top - MARGIN.bottom);
    pen.font = "12px system-ui, sans-serif";
    pen.strokeStyle = style.line; pen.fillStyle = style.pale; pen.lineWidth = 1;
    const rows = ticks(this.low, this.high, 5), columns = ticks(Math.min(times[0], times.at(-1)), Math.max(times[0], times.at(-1)), Math.min(8, Math.max(2, w / 75)));
    pen.beginPath();
    pen.textAlign = "right"; pen.textBaseline = "middle";
    for (const v of rows.all) {
      pen.moveTo(MARGIN.left, y(v)); pen.lineTo(w - MARGIN.right, y(v));
      pen.fillText(label(v, rows.digits), MARGIN.left - 8, y(v));
    }
    pen.stroke();
    pen.textBaseline = "top";
    pen.fillText(this.over, MARGIN.left - 16, h - MARGIN.bottom + 5);
    pen.textAlign = "center";
    for (const time of columns.all) pen.fillText(label(time, columns.digits), x(time), h - MARGIN.bottom + 5);
    pen.lineWidth = 1.6; pen.lineJoin = "round";
    this.panel.curves.forEach((curve, k) => {
      pen.strokeStyle = COLOURS[k % COLOURS.length];
      pen.beginPath();
      curve.values.forEach((v, n) => { if (n) pen.lineTo(x(times[n]), y(v)); else pen.moveTo(x(times[n]), y(v)); });
      pen.stroke();
    });
    pen.strokeStyle = style.ink; pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(x(t), MARGIN.top - 4); pen.lineTo(x(t), h - MARGIN.bottom); pen.stroke();
  }
}
