// The stage: WebGL, a camera that turns about what is up, solids and lines.

const VERTEX = `
attribute vec3 at; attribute vec3 normal; attribute float shade;
uniform mat4 view; uniform mat3 turn; uniform vec3 place, size;
varying vec3 out_normal; varying float out_shade;
void main() {
  out_normal = turn * (normal / size);
  out_shade = shade;
  gl_Position = view * vec4(turn * (at * size) + place, 1.0);
}`;
const FRAGMENT = `
precision mediump float;
uniform vec3 colour, light;
varying vec3 out_normal; varying float out_shade;
void main() {
  float lit = 0.62 + 0.38 * dot(normalize(out_normal), light);
  vec3 base = mix(colour, mix(colour, vec3(1.0), 0.45), out_shade);
  gl_FragColor = vec4(base * lit, 1.0);
}`;
const LINE_VERTEX = "attribute vec3 at; uniform mat4 view; void main() { gl_Position = view * vec4(at, 1.0); }";
const LINE_FRAGMENT = "precision mediump float; uniform vec4 ink; void main() { gl_FragColor = ink; }";

const sub = (a, b) => a.map((x, k) => x - b[k]);
const add = (a, b) => a.map((x, k) => x + b[k]);
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / (Math.hypot(...a) || 1));
// Columns of the rotation of a quaternion i, j, k, w: the axes of the body.
const axesOf = ([i, j, k, w]) => [
  [1 - 2 * (j * j + k * k), 2 * (i * j + k * w), 2 * (i * k - j * w)],
  [2 * (i * j - k * w), 1 - 2 * (i * i + k * k), 2 * (j * k + i * w)],
  [2 * (i * k + j * w), 2 * (j * k - i * w), 1 - 2 * (i * i + j * j)],
];
const turned3 = (axes, v) => [0, 1, 2].map((k) => axes[0][k] * v[0] + axes[1][k] * v[1] + axes[2][k] * v[2]);
// Axes of which the third points along a vector.
const axesAlong = (v) => {
  const e3 = unit(v), other = Math.abs(e3[1]) < 0.9 ? [0, 1, 0] : [0, 0, 1];
  const e1 = unit(cross(other, e3));
  return [e1, cross(e3, e1), e3];
};
const colourOf = (css) => {
  const pen = colourOf.pen ||= document.createElement("canvas").getContext("2d");
  pen.fillStyle = "#888888"; pen.fillStyle = css;
  const hex = pen.fillStyle;
  return hex[0] === "#" ? [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255) : [0.5, 0.5, 0.5];
};

class Stage {
  constructor(canvas, up) {
    // Right-handed, the third axis up.
    this.canvas = canvas;
    this.world = axesAlong(up);
    const gl = this.gl = canvas.getContext("webgl", { antialias: true, alpha: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser draws no WebGL, so the motion cannot be shown; the curves below can");
    this.solid = this.program(VERTEX, FRAGMENT);
    this.line = this.program(LINE_VERTEX, LINE_FRAGMENT);
    this.meshes = {};
    for (const [name, mesh] of Object.entries(SOLIDS)) {
      this.meshes[name] = { buffer: this.buffer(mesh), count: mesh.length / 7 };
    }
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    Object.assign(this, { target: [0, 0, 0], distance: 5, azimuth: -0.9, elevation: 0.42 });
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const places = {};
    for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k++) {
      const { name } = gl.getActiveUniform(program, k);
      places[name] = gl.getUniformLocation(program, name);
    }
    return { program, places };
  }

  buffer(numbers) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
    return buffer;
  }

  // From the eye, which looks at the target.
  back() {
    const [c, s] = [Math.cos(this.elevation), Math.sin(this.elevation)];
    const [a, b, up] = this.world;
    return add(add(times(a, c * Math.cos(this.azimuth)), times(b, c * Math.sin(this.azimuth))), times(up, s));
  }

  begin(paper) {
    const gl = this.gl, ratio = window.devicePixelRatio || 1;
    const [w, h] = [this.canvas.clientWidth * ratio, this.canvas.clientHeight * ratio].map(Math.round);
    if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, { width: w, height: h });
    gl.viewport(0, 0, w, h);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const z = this.back(), x = unit(cross(this.world[2], z)), y = cross(z, x);
    const eye = add(this.target, times(z, this.distance));
    const f = 1 / Math.tan(0.3), near = this.distance / 50, far = this.distance * 50;
    const rows = [times(x, f * h / w), times(y, f), times(z, (far + near) / (near - far)), times(z, -1)];
    const last = [-dot(rows[0], eye), -dot(rows[1], eye),
      -dot(rows[2], eye) + 2 * far * near / (near - far), -dot(rows[3], eye)];
    this.view = new Float32Array([0, 1, 2].flatMap((k) => rows.map((row) => row[k])).concat(last));
    this.light = unit(add(add(z, times(x, -0.5)), times(y, 0.8)));
    this.axes = { x, y, z };
  }

  // A mesh with its axes, its place, its half lengths and its colour; the first `count` of its corners.
  draw(name, axes, place, size, colour, count) {
    const gl = this.gl, { program, places } = this.solid, mesh = this.meshes[name] || name;
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    [["at", 3, 0], ["normal", 3, 12], ["shade", 1, 24]].forEach(([attribute, length, offset]) => {
      const index = gl.getAttribLocation(program, attribute);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, length, gl.FLOAT, false, 28, offset);
    });
    gl.uniformMatrix4fv(places.view, false, this.view);
    gl.uniformMatrix3fv(places.turn, false, axes.flat());
    gl.uniform3fv(places.place, place);
    // What has no thickness keeps a normal.
    gl.uniform3fv(places.size, size.map((s) => Math.max(s, 1e-6 * Math.max(...size))));
    gl.uniform3fv(places.colour, colour);
    gl.uniform3fv(places.light, this.light);
    gl.drawArrays(gl.TRIANGLES, 0, count ?? mesh.count);
  }

  // What is drawn meanwhile is before all else.
  before(draw) {
    this.gl.depthRange(0, 0.01);
    draw();
    this.gl.depthRange(0, 1);
  }

  // Points joined in pairs.
  lines(buffer, count, ink) {
    const gl = this.gl, { program, places } = this.line;
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const index = gl.getAttribLocation(program, "at");
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, 3, gl.FLOAT, false, 0, 0);
    gl.uniformMatrix4fv(places.view, false, this.view);
    gl.uniform4fv(places.ink, ink);
    gl.drawArrays(gl.LINES, 0, count);
  }

  // A tube along points; its corners in their order, so many for each gap.
  tube(points, radius) {
    const mesh = [], sides = 5;
    const rings = points.map((point, n) => {
      const along = sub(points[Math.min(n + 1, points.length - 1)], points[Math.max(n - 1, 0)]);
      const [e1, e2] = axesAlong(along);
      return Array.from({ length: sides }, (_, k) => {
        const a = 2 * Math.PI * k / sides, out = add(times(e1, Math.cos(a)), times(e2, Math.sin(a)));
        return [add(point, times(out, radius)), out];
      });
    });
    for (let n = 0; n + 1 < points.length; n++) for (let k = 0; k < sides; k++) {
      const [a, b] = [rings[n], rings[n + 1]], l = (k + 1) % sides;
      for (const [at, normal] of [a[k], b[k], b[l], a[k], b[l], a[l]]) mesh.push(...at, ...normal, 0);
    }
    return { buffer: this.buffer(mesh), count: mesh.length / 7, each: 6 * sides };
  }

  rod(from, to, radius, colour) {
    const along = sub(to, from), length = Math.hypot(...along);
    if (length > 0) {
      this.draw("rod", axesAlong(along), times(add(from, to), 0.5), [radius, radius, length / 2], colour);
    }
  }

  arrow(from, vector, radius, colour) {
    const length = Math.hypot(...vector);
    if (length === 0) return;
    const head = Math.min(6 * radius, length), axes = axesAlong(vector), e = unit(vector);
    this.rod(from, add(from, times(e, length - head)), radius, colour);
    this.draw("cone", axes, add(from, times(e, length - head / 2)), [2.4 * radius, 2.4 * radius, head / 2], colour);
  }
}
