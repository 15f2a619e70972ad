// Meshes of unit size, each a list of triangles: positions, normals, and which of two shades.

const put = (mesh, triangle, normals, shade) => {
  triangle.forEach((p, i) => { mesh.push(...p, ...normals[i], shade(triangle)); });
};
// Two shades in eight parts: by the signs of the coordinates in the middle of a triangle.
const byOctant = (triangle) => {
  const m = [0, 1, 2].map((k) => triangle.reduce((sum, p) => sum + p[k], 0));
  return (m[0] > 0) !== (m[1] > 0) !== (m[2] > 0) ? 1 : 0;
};
const quads = (mesh, point, normal, n, m, shade) => {
  for (let i = 0; i < n; i++) for (let j = 0; j < m; j++) {
    const at = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => [a / n, b / m]);
    for (const [a, b, c] of [[0, 1, 2], [0, 2, 3]]) {
      const corners = [at[a], at[b], at[c]];
      put(mesh, corners.map(([u, v]) => point(u, v)), corners.map(([u, v]) => normal(u, v)), shade);
    }
  }
};

const ball = () => {
  const mesh = [];
  const point = (u, v) => {
    const [a, b] = [2 * Math.PI * u, Math.PI * v];
    return [Math.sin(b) * Math.cos(a), Math.sin(b) * Math.sin(a), Math.cos(b)];
  };
  quads(mesh, point, point, 48, 32, byOctant);
  return mesh;
};

const box = () => {
  const mesh = [];
  for (let axis = 0; axis < 3; axis++) for (const side of [-1, 1]) {
    const along = (u, v) => {
      const p = [0, 0, 0];
      p[axis] = side; p[(axis + 1) % 3] = 2 * u - 1; p[(axis + 2) % 3] = 2 * v - 1;
      return p;
    };
    const out = [0, 0, 0];
    out[axis] = side;
    quads(mesh, along, () => out, 2, 2, byOctant);
  }
  return mesh;
};

// A wall from radius `low` at z = −1 to radius `high` at z = 1, closed below and above.
const turned = (low, high, shade) => {
  const mesh = [];
  const [n, slope] = [32, (low - high) / 2];
  const ring = (u) => [Math.cos(2 * Math.PI * u), Math.sin(2 * Math.PI * u)];
  const wall = (u, v) => { const [c, s] = ring(u), r = low + (high - low) * v; return [r * c, r * s, 2 * v - 1]; };
  const out = (u) => { const [c, s] = ring(u), l = Math.hypot(1, slope); return [c / l, s / l, slope / l]; };
  quads(mesh, wall, out, n, 2, shade);
  for (const [radius, z] of [[low, -1], [high, 1]]) if (radius > 0) {
    const cap = (u, v) => { const [c, s] = ring(u); return [radius * v * c, radius * v * s, z]; };
    quads(mesh, cap, () => [0, 0, z], n, 1, shade);
  }
  return mesh;
};

const SOLIDS = {
  ellipsoid: ball(), cuboid: box(), cylinder: turned(1, 1, byOctant),
  rod: turned(1, 1, () => 0), cone: turned(1, 0, () => 0),
};
