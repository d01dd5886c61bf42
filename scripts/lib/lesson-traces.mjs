// Records the traces that lessons show: the engine of this build records them, so that they are never out of date.
import { createMesher } from "tetrafront";
import { recordTrace } from "tetrafront/trace";

/** Largest trace of a lesson in bytes: it is fetched when its figure is near. */
export const MAX_TRACE_BYTES = 60_000;

/** @typedef {readonly [number, number, number]} Triple */

/**
 * @param {readonly Triple[]} points
 * @param {readonly Triple[]} triangles
 */
const surfaceOf = (points, triangles) => ({
  points: Float64Array.from(points.flat()),
  triangles: Uint32Array.from(triangles.flat()),
});

/** Welds the corners of triangles at the same position. */
function welded(/** @type {readonly (readonly Triple[])[]} */ corners) {
  /** @type {Triple[]} */
  const points = [];
  const indices = new Map();
  const indexOf = (/** @type {Triple} */ point) => {
    const key = point.map((coordinate) => Math.round(1e9 * coordinate) + 0).join();
    if (!indices.has(key)) indices.set(key, points.push(point) - 1);
    return indices.get(key);
  };
  const triangles = corners.map(([a, b, c]) => /** @type {Triple} */ ([indexOf(a), indexOf(b), indexOf(c)]));
  return surfaceOf(points, triangles);
}

/** A ball: each face of an icosahedron in n² triangles, moved onto the sphere of radius 1. */
function ball(/** @type {number} */ n) {
  const golden = (1 + Math.sqrt(5)) / 2;
  const edges = [-1, 1].flatMap((a) => [-golden, golden].map((b) => [a, b]));
  const nodes = [0, 1, 2].flatMap((axis) =>
    edges.map(([a, b]) => /** @type {Triple} */ ([0, 1, 2].map((k) => [0, a, b][(k - axis + 3) % 3]))),
  );
  const isEdge = (/** @type {Triple} */ p, /** @type {Triple} */ q) =>
    Math.abs(Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) - 2) < 1e-9;
  const corners = [];
  for (const [i, a] of nodes.entries()) {
    for (const [j, b] of nodes.entries()) {
      for (const [k, c] of nodes.entries()) {
        if (i < j && j < k && isEdge(a, b) && isEdge(b, c) && isEdge(c, a))
          corners.push(...divided(isOutward(a, b, c) ? [a, b, c] : [a, c, b], n));
      }
    }
  }
  return welded(corners.map((triangle) => triangle.map(onSphere)));
}

/** Whether a triangle of three nodes around the origin is counter-clockwise from outside. */
function isOutward(/** @type {Triple} */ a, /** @type {Triple} */ b, /** @type {Triple} */ c) {
  const crossed = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
  return a[0] * crossed[0] + a[1] * crossed[1] + a[2] * crossed[2] > 0;
}

/** @returns {Triple} */
function onSphere(/** @type {Triple} */ [x, y, z]) {
  const length = Math.sqrt(x * x + y * y + z * z);
  return [x / length, y / length, z / length];
}

/** Divides a triangle into n² ones. */
function divided(/** @type {readonly Triple[]} */ [a, b, c], /** @type {number} */ n) {
  const at = (/** @type {number} */ i, /** @type {number} */ j) =>
    /** @type {Triple} */ (a.map((from, axis) => from + ((b[axis] - from) * i + (c[axis] - from) * j) / n));
  const triangles = [];
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n - i; j++) {
      triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
      if (i + j < n - 1) triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  }
  return triangles;
}

/** A cube of n³ unit cubes, each of its squares in two triangles. */
function box(/** @type {number} */ n) {
  const corners = [];
  for (const axis of [0, 1, 2]) {
    for (const end of [0, n]) {
      for (let i = 0; i < n; i++) {
        for (let j = 0; j < n; j++) {
          const at = (/** @type {number} */ u, /** @type {number} */ v) =>
            /** @type {Triple} */ ([0, 1, 2].map((k) => [end, i + u, j + v][(k - axis + 3) % 3]));
          const square = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
          const [a, b, c, d] = end === n ? square : square.reverse();
          corners.push([a, b, c], [a, c, d]);
        }
      }
    }
  }
  return welded(corners);
}

/**
 * A prism over a triangle, whose upper end is turned by 45° against its walls' diagonals: no tetrahedra between its six nodes
 * fill it, but one node inside sees all of its faces.
 */
function pocket() {
  const ends = [0, 1].map((end) =>
    [0, 1, 2].map((i) => {
      const angle = (2 * Math.PI * i) / 3 - (end * Math.PI) / 4;
      return /** @type {Triple} */ ([Math.cos(angle), Math.sin(angle), 0.5 * end]);
    }),
  );
  const [low, high] = ends;
  const walls = [0, 1, 2].flatMap((i) => {
    const j = (i + 1) % 3;
    return [
      [low[i], low[j], high[i]],
      [low[j], high[j], high[i]],
    ];
  });
  return welded([[low[0], low[2], low[1]], high, ...walls]);
}

/** Per name of a file: what is filled, and how. */
const LESSON_TRACES = {
  /** A ball, to be opened: the front from its boundary to its middle. */
  ball: () => ({ surface: ball(4), optimization: "none" }),
  /** A cube of twelve triangles, for "Be the mesher". */
  cube: () => ({ surface: box(1), optimization: "none" }),
  /** A box with the sweeps of the optimizer. */
  box: () => ({ surface: box(3), optimization: "default" }),
  /** A pocket that the front cannot fill, and recovery can. */
  pocket: () => ({ surface: pocket(), optimization: "none" }),
};

/** The names of the traces. */
export const lessonTraceNames = Object.keys(LESSON_TRACES);

/** Records all traces. Returns their files by name. */
export async function recordLessonTraces() {
  const mesher = await createMesher();
  try {
    /** @type {Record<string, Uint8Array>} */
    const files = {};
    for (const [name, make] of Object.entries(LESSON_TRACES)) {
      const { surface, ...options } = make();
      const { trace, result } = await recordTrace(mesher, surface, { ...options, name });
      if (trace === undefined || trace.length > MAX_TRACE_BYTES) {
        const bytes =
          trace === undefined ? "no trace" : `${trace.length} of at most ${MAX_TRACE_BYTES} bytes`;
        throw new Error(
          `The trace "${name}" of the lessons cannot be recorded: ${bytes}, ${result.report.status}`,
        );
      }
      files[name] = trace;
    }
    return files;
  } finally {
    mesher.dispose();
  }
}
