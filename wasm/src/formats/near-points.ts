/** Welding within a distance, for surfaces whose faces were triangulated one by one. */
import { inRanges, type Steps, stepwise } from "../base/steps.js";
import type { WeldedPoints } from "./weld.js";

/** Direction along which points are sorted: no plane or line that is common in parts is perpendicular to it. */
const DIRECTION = [0.7360221, 0.5408271, 0.4072913] as const;

/** Returns how far a point is along a direction in which few points are near each other. */
export function distanceAlong(points: Float64Array, p: number): number {
  return DIRECTION.reduce((sum, part, axis) => sum + part * (points[3 * p + axis] ?? 0), 0);
}

/**
 * Welds each point to the first kept point, in their order, within the distance; no point moves further. O(n log n) if
 * few points are near each other along one direction.
 */
export function* weldWithin(given: Float64Array, distance: number): Steps<WeldedPoints> {
  const count = given.length / 3;
  const along = new Float64Array(count);
  yield* stepwise(count, (p) => {
    along[p] = distanceAlong(given, p);
  });
  const order = Uint32Array.from(along.keys()).sort((a, b) => (along[a] ?? 0) - (along[b] ?? 0) || a - b);
  const rank = new Uint32Array(count);
  order.forEach((p, r) => (rank[p] = r));
  const indices = new Uint32Array(count).fill(UNKNOWN);
  let kept = 0;
  yield* stepwise(count, (p) => {
    if (indices[p] !== UNKNOWN) return;
    indices[p] = kept;
    for (const side of [-1, 1]) {
      for (let r = (rank[p] ?? 0) + side; r >= 0 && r < count; r += side) {
        const other = order[r] ?? 0;
        if (Math.abs((along[other] ?? 0) - (along[p] ?? 0)) > distance) break;
        if (indices[other] === UNKNOWN && gap(given, p, other) <= distance) indices[other] = kept;
      }
    }
    kept++;
  });
  const points = new Float64Array(3 * kept);
  let next = 0;
  yield* inRanges(count, (begin, end) => {
    for (let p = begin; p < end; p++) {
      if (indices[p] !== next) continue;
      points.set(given.subarray(3 * p, 3 * p + 3), 3 * next);
      next++;
    }
  });
  return { points, indices };
}

const UNKNOWN = 0xffffffff;

function gap(points: Float64Array, a: number, b: number): number {
  const [x = 0, y = 0, z = 0] = [0, 1, 2].map(
    (axis) => (points[3 * a + axis] ?? 0) - (points[3 * b + axis] ?? 0),
  );
  // Unlike Math.hypot, this gives the same result on all machines.
  return Math.sqrt(x * x + y * y + z * z);
}

/** Returns the length of the diagonal of the box around all points. */
export function diagonalOf(points: Float64Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    const [axis, value] = [i % 3, points[i] ?? 0];
    if (value < (low[axis] ?? 0)) low[axis] = value;
    if (value > (high[axis] ?? 0)) high[axis] = value;
  }
  return points.length === 0
    ? 0
    : Math.sqrt(high.reduce((sum, h, axis) => sum + (h - (low[axis] ?? 0)) ** 2, 0));
}
