/**
 * Finds the faces that closed parts of a surface have in common up to rounding: programs that place a part compute the same
 * corner anew.
 */
import { type Steps, stepwise } from "../base/steps.js";
import { nodeComponentsOf } from "./components.js";
import { NearGrid } from "./near-grid.js";
import { type Rounding, roundingOf } from "./rounding-tolerance.js";

const NONE = 0xffffffff;

/**
 * Returns per node the smaller one of it and its partner in another part: the corners of triangles that are the same up to
 * rounding, and face each other. Undefined if there are none. O(n).
 */
export function* contactGroups(points: Float64Array, triangles: Uint32Array): Steps<Uint32Array | undefined> {
  const parts = nodeComponentsOf(triangles, points.length / 3);
  if (triangles.every((node) => parts[node] === parts[triangles[0] ?? 0])) return undefined;
  const rounding = yield* roundingOf(points, triangles);
  if (rounding === undefined) return undefined;
  const partners = yield* partnersOf(points, parts, rounding);
  const candidates: number[] = [];
  yield* stepwise(triangles.length / 3, (t) => {
    if (cornersOf(triangles, t).every((node) => partners[node] !== NONE)) candidates.push(t);
  });
  const known = new Set(candidates.map((t) => keyOf(cornersOf(triangles, t))));
  const groupOf = Uint32Array.from({ length: points.length / 3 }, (_, node) => node);
  let isAny = false;
  for (const t of candidates) {
    const corners = cornersOf(triangles, t);
    // Seen from the other part, the corners are in the opposite order.
    if (!known.has(keyOf(corners.map((node) => partners[node] ?? NONE).reverse()))) continue;
    isAny = true;
    for (const node of corners) groupOf[node] = Math.min(node, partners[node] ?? NONE);
  }
  return isAny ? groupOf : undefined;
}

/** Returns per node the only one of another part within rounding, if it is the only one for that, too. */
function* partnersOf(points: Float64Array, parts: Uint32Array, rounding: Rounding): Steps<Uint32Array> {
  const grid = yield* NearGrid.of(points, rounding.largest);
  const nearest = new Uint32Array(parts.length).fill(NONE);
  yield* stepwise(parts.length, (node) => {
    grid.near(node, rounding.largest, (other) => {
      if (parts[other] === parts[node] || !rounding.isWithin(node, other)) return true;
      const isFirst = nearest[node] === NONE;
      nearest[node] = isFirst ? other : NONE;
      return isFirst;
    });
  });
  return nearest.map((other, node) => (other !== NONE && nearest[other] === node ? other : NONE));
}

const cornersOf = (triangles: Uint32Array, t: number): readonly number[] => [
  ...triangles.subarray(3 * t, 3 * t + 3),
];

/** Returns the same text for the same nodes in the same cyclic order. */
function keyOf(nodes: readonly number[]): string {
  const first = nodes.indexOf(Math.min(...nodes));
  return [...nodes.slice(first), ...nodes.slice(0, first)].join(" ");
}
