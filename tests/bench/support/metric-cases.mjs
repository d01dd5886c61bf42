// The four metrics of the Unstructured Grid Adaptation Working Group, and lengths and qualities in them. Lengths are the
// logarithmic mean of those in the metrics of both ends; the quality is the mean ratio in the metric of the corner with the
// smallest sizes, the worst of those within rounding of it.

const LEAST = 1e-3;
const LARGE = 0.1;
const across = (distance) => LEAST + 2 * (LARGE - LEAST) * Math.abs(distance);

/** Sizes along x, y and z at a position. */
function linear([, , z]) {
  const size = across(z - 0.5);
  return [LARGE ** -2, 0, 0, LARGE ** -2, 0, size ** -2];
}

/** Sizes along the radius, around the axis and along it. */
function polar(around) {
  return ([x, y]) => {
    const r = Math.hypot(x, y);
    const [c, s] = [x / r, y / r];
    const [a, b] = [across(r - 0.5) ** -2, around(r) ** -2];
    return [a * c * c + b * s * s, (a - b) * c * s, 0, a * s * s + b * c * c, 0, LARGE ** -2];
  };
}

/** Sizes around the axis of the second polar case: small near the cylinder of radius 0.6. */
function aroundSecond(r) {
  const d = 10 * (0.6 - r);
  return d < 0 ? LARGE : d / 40 + (1 - d) * LARGE;
}

/** By name: the metric xx xy xz yy yz zz at a position, the model, and the best published figures, per column. */
export const METRIC_CASES = {
  linear: { metricAt: linear, model: "cube", published: "98.3 % / .49" },
  "cylinder-linear": { metricAt: linear, model: "cylinder", published: "94.0 % / .30" },
  polar1: { metricAt: polar(() => LARGE), model: "cylinder", published: "89.2 % / .14" },
  polar2: { metricAt: polar(aroundSecond), model: "cylinder", published: "93.8 % / .30" },
};

/** Returns the metric at all nodes. */
export function metricsAt(points, metricAt) {
  const metrics = new Float64Array(2 * points.length);
  for (let node = 0; node < points.length / 3; ++node) {
    metrics.set(metricAt(points.subarray(3 * node, 3 * node + 3)), 6 * node);
  }
  return metrics;
}

const squareIn = (m, [x, y, z]) =>
  m[0] * x * x + m[3] * y * y + m[5] * z * z + 2 * (m[1] * x * y + m[2] * x * z + m[4] * y * z);
const determinant = ([a, b, c, d, e, f]) => a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d);

const EDGES = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]; // prettier-ignore
/** Determinants within this factor of the largest are those of the smallest sizes. */
const TIE = 1 - 1e-9;

/** Returns elements, the share of unit edges, and the least and mean quality of a mesh in a metric. */
export function metricStatistics({ points, tetrahedra }, metricAt) {
  const metrics = metricsAt(points, metricAt);
  const at = (node) => points.subarray(3 * node, 3 * node + 3);
  const metric = (node) => metrics.subarray(6 * node, 6 * node + 6);
  const between = (a, b) => [0, 1, 2].map((k) => at(b)[k] - at(a)[k]);
  const count = points.length / 3;
  const seen = new Set();
  let [unit, edges, least, sum] = [0, 0, 1, 0];
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const nodes = [...tetrahedra.subarray(t, t + 4)];
    const vectors = EDGES.map(([i, j]) => between(nodes[i], nodes[j]));
    EDGES.forEach(([i, j], e) => {
      const key = Math.min(nodes[i], nodes[j]) * count + Math.max(nodes[i], nodes[j]);
      if (seen.has(key)) return;
      seen.add(key);
      const [a, b] = [i, j].map((k) => Math.sqrt(squareIn(metric(nodes[k]), vectors[e])));
      const length = Math.abs(a - b) > 1e-3 ? (a - b) / Math.log(a / b) : (a + b) / 2;
      ++edges;
      if (length >= Math.SQRT1_2 && length <= Math.SQRT2) ++unit;
    });
    const [u, v, w] = vectors;
    const volume = Math.abs(
      ((u[1] * v[2] - u[2] * v[1]) * w[0] +
        (u[2] * v[0] - u[0] * v[2]) * w[1] +
        (u[0] * v[1] - u[1] * v[0]) * w[2]) /
        6,
    );
    const determinants = nodes.map((node) => determinant(metric(node)));
    const largest = Math.max(...determinants);
    const qualities = nodes.flatMap((node, k) => {
      if (determinants[k] < TIE * largest) return [];
      const squares = vectors.reduce((total, vector) => total + squareIn(metric(node), vector), 0) / 6;
      return [(volume * Math.sqrt(determinants[k]) * 6 * Math.SQRT2) ** (2 / 3) / squares];
    });
    const quality = Math.min(...qualities);
    least = Math.min(least, quality);
    sum += quality;
  }
  return { elements: tetrahedra.length / 4, unit: unit / edges, least, mean: (4 * sum) / tetrahedra.length };
}

/** Chords of the quarter of a cylinder of radius 0.5: its area is then good to 1e-4. */
const CHORDS = 60;

/** Returns the unit cube, or the unit cube less the cylinder of radius 0.5 about the z axis, as triangles with a patch per face. */
export function caseSurface(model) {
  const round = (k) => [
    0.5 * Math.cos((Math.PI / 2) * (k / CHORDS)),
    0.5 * Math.sin((Math.PI / 2) * (k / CHORDS)),
  ];
  const arc = Array.from({ length: CHORDS + 1 }, (_, k) => (k === CHORDS ? [0, 0.5] : round(k)));
  const outer = [[1, 0], [1, 1], [0, 1]]; // prettier-ignore
  if (model === "cube") return prism([[0, 0], ...outer], [[0, 1, 2], [0, 2, 3]]); // prettier-ignore
  const ring = [...outer, ...arc.toReversed()];
  return prism(ring, capTriangles(ring.length), (k) =>
    k >= 3 && k < ring.length - 1 ? 2 : 3 + Math.min(k, 4),
  );
}

/**
 * Returns a prism of a ring of positions x y, counter-clockwise, divided into triangles by `cap`. The patches are the bottom (0), the
 * top (1) and one per side, by default from 3; `patchOf`: the patch of the side after a position of the ring.
 */
export function prism(ring, cap, patchOf = (k) => 3 + k, height = 1) {
  const count = ring.length;
  const points = [0, height].flatMap((z) => ring.flatMap(([x, y]) => [x, y, z]));
  const triangles = [];
  const patch = [];
  const add = (a, b, c, of) => {
    triangles.push(a, b, c);
    patch.push(of);
  };
  for (const [a, b, c] of cap) {
    add(a, c, b, 0);
    add(count + a, count + b, count + c, 1);
  }
  for (let k = 0; k < count; ++k) {
    const next = (k + 1) % count;
    add(k, next, count + next, patchOf(k));
    add(k, count + next, count + k, patchOf(k));
  }
  return {
    points: Float64Array.from(points),
    triangles: Uint32Array.from(triangles),
    trianglePatch: Uint32Array.from(patch),
  };
}

/** Triangles of the ring (1, 0), (1, 1), (0, 1), arc from (0, .5) to (.5, 0): fans from the three corners. */
function capTriangles(count) {
  const middle = 3 + CHORDS / 2;
  const fans = [];
  for (let k = 3; k < middle; ++k) fans.push([2, k, k + 1]);
  fans.push([1, 2, middle]);
  for (let k = middle; k < count - 1; ++k) fans.push([1, k, k + 1]);
  fans.push([0, 1, count - 1]);
  return fans;
}
