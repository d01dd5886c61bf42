// Makes a unit sphere for benchmarks: an icosahedron whose faces are divided n × n, giving 20 n² triangles.

const GOLDEN = (1 + Math.sqrt(5)) / 2;
const CORNERS = [
  [-1, GOLDEN, 0], [1, GOLDEN, 0], [-1, -GOLDEN, 0], [1, -GOLDEN, 0],
  [0, -1, GOLDEN], [0, 1, GOLDEN], [0, -1, -GOLDEN], [0, 1, -GOLDEN],
  [GOLDEN, 0, -1], [GOLDEN, 0, 1], [-GOLDEN, 0, -1], [-GOLDEN, 0, 1],
]; // prettier-ignore
const FACES = [
  [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
  [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
  [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
  [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
]; // prettier-ignore

/** @param {number} n @returns {{ points: Float64Array, triangles: Uint32Array }} */
export function geodesicSphere(n) {
  const points = [];
  const triangles = [];
  const known = new Map();

  // Returns the node on a face with these integer weights, which sum to n. Nodes of shared corners and edges are
  // reused.
  const node = (face, weights) => {
    const parts = face.map((corner, i) => [corner, weights[i]]).filter(([, weight]) => weight > 0);
    const key = parts
      .sort((p, q) => p[0] - q[0])
      .flat()
      .join(" ");
    let id = known.get(key);
    if (id === undefined) {
      const sum = [0, 1, 2].map((axis) =>
        parts.reduce((total, [corner, weight]) => total + CORNERS[corner][axis] * weight, 0),
      );
      const length = Math.hypot(...sum);
      id = points.length / 3;
      points.push(...sum.map((x) => x / length));
      known.set(key, id);
    }
    return id;
  };

  for (const face of FACES) {
    for (let i = 0; i < n; ++i) {
      for (let j = 0; j < n - i; ++j) {
        const k = n - i - j;
        const right = node(face, [k - 1, i + 1, j]);
        const left = node(face, [k - 1, i, j + 1]);
        triangles.push(node(face, [k, i, j]), right, left);
        if (k >= 2) triangles.push(right, node(face, [k - 2, i + 1, j + 1]), left);
      }
    }
  }
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

/** Returns the text of an OFF file, from which the doubles are restored exactly. */
export function toOff({ points, triangles }) {
  const lines = ["OFF", `${points.length / 3} ${triangles.length / 3} 0`];
  for (let i = 0; i < points.length; i += 3) lines.push(points.subarray(i, i + 3).join(" "));
  for (let i = 0; i < triangles.length; i += 3) {
    lines.push(`3 ${triangles.subarray(i, i + 3).join(" ")}`);
  }
  return `${lines.join("\n")}\n`;
}
