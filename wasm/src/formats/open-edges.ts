/** Finds the open edges of triangles: edges with one triangle. */
import { type Steps, stepwise } from "../base/steps.js";

/**
 * Returns the two nodes of each open edge, one edge after the other, the smaller index first, sorted. O(n), and
 * O(m log m) for the m edges between nodes with an odd number of triangles at an edge.
 */
export function* openEdges(triangles: Uint32Array, nodes: number): Steps<Uint32Array> {
  const isOdd = yield* oddNodes(triangles, nodes);
  const found: number[] = [];
  yield* stepwise(triangles.length, (corner) => {
    const [from, to] = [triangles[corner] ?? 0, triangles[nextCorner(corner)] ?? 0];
    if (isOdd[from] !== 0 && isOdd[to] !== 0) found.push(Math.min(from, to) * nodes + Math.max(from, to));
  });
  // Sorted numbers, because a Map holds 2^24 keys at most.
  const edges = Float64Array.from(found).sort();
  const open: number[] = [];
  yield* stepwise(edges.length, (i) => {
    const edge = edges[i] ?? 0;
    if (edge !== edges[i - 1] && edge !== edges[i + 1]) open.push(Math.floor(edge / nodes), edge % nodes);
  });
  return Uint32Array.from(open);
}

/** Returns the corner of a triangle that follows this one. */
export function nextCorner(corner: number): number {
  return corner % 3 === 2 ? corner - 2 : corner + 1;
}

/**
 * Returns a value per node that is 0 if an even number of triangles meet at each of its edges: the exclusive or of the
 * hashes of all neighbours, once per triangle. A closed surface, which most are, needs no sorting of its edges.
 */
function* oddNodes(triangles: Uint32Array, nodes: number): Steps<Uint32Array> {
  const sums = new Uint32Array(nodes);
  yield* stepwise(triangles.length, (corner) => {
    const [from, to] = [triangles[corner] ?? 0, triangles[nextCorner(corner)] ?? 0];
    sums[from] = (sums[from] ?? 0) ^ hashOf(to);
    sums[to] = (sums[to] ?? 0) ^ hashOf(from);
  });
  return sums;
}

/** The finalizer of MurmurHash3 (A. Appleby), a bijection of 32-bit numbers. */
function hashOf(node: number): number {
  let h = node + 1;
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return h ^ (h >>> 16);
}
