/**
 * Welds the nodes of a surface without topology that differ by rounding: programs that compute each triangle by itself
 * write a common corner as 0 in one triangle and as -3e-16 in the next. Exact welding has left open edges there. Nodes
 * of open edges are welded to others within a few units in the last place of single precision, if an edge is closed by
 * it and no triangle is lost: a closed surface stays as it is, however small its features. Of several, those are welded that have
 * a face in common. Which nodes are welded depends on their positions alone, not on their order.
 */
import { type Steps, stepwise } from "../base/steps.js";
import { NearGrid } from "./near-grid.js";
import { openEdges } from "./open-edges.js";
import { contactGroups } from "./rounding-contacts.js";
import { groupNoise, incidenceOf } from "./rounding-groups.js";
import { AXES, comparePositions, type Rounding, roundingOf, squareBetween } from "./rounding-tolerance.js";

interface Soup {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}

export interface WeldedByRounding extends Soup {
  /** Number of nodes that were welded to others. */
  readonly welded: number;
  /** Largest distance by which one of them was moved. */
  readonly distance: number;
}

/**
 * Returns the surface, whose points all differ, with its noise of rounding welded. Each group of welded nodes gets the
 * position of one of them. O(n) for closed surfaces, and O(n log n) for others.
 */
export function* weldRounding(soup: Soup): Steps<WeldedByRounding> {
  const { points, triangles } = soup;
  const nothing = { points, triangles, welded: 0, distance: 0 };
  const open = yield* openEdges(triangles, points.length / 3);
  if (open.length === 0) return (yield* weldContacts(soup)) ?? nothing;
  const rounding = yield* roundingOf(points, open);
  if (rounding === undefined) return nothing;
  const groupOf = yield* noiseGroups(soup, open, rounding);
  if (groupOf === undefined) return nothing;
  const all = yield* rebuilt(soup, groupOf);
  const stillOpen = yield* openEdges(all.triangles, all.points.length / 3);
  // Each group has a node of an open edge.
  if (stillOpen.length === 0) return all;
  dissolveUseless(groupOf, open, { indices: all.indices, stillOpen });
  return yield* rebuilt(soup, groupOf);
}

/** Welds the faces that closed parts have in common up to rounding. */
function* weldContacts(soup: Soup): Steps<WeldedByRounding | undefined> {
  const groupOf = yield* contactGroups(soup.points, soup.triangles);
  return groupOf && (yield* rebuilt(soup, groupOf));
}

/** Returns per node the smallest node of its group; undefined if each is on its own. */
function* noiseGroups(
  { points, triangles }: Soup,
  open: Uint32Array,
  rounding: Rounding,
): Steps<Uint32Array | undefined> {
  const nodes = Uint32Array.from(new Set(open));
  const grid = yield* NearGrid.of(points, rounding.largest);
  const incidence = yield* incidenceOf(triangles, points.length / 3);
  return yield* groupNoise({ points, triangles, rounding, grid, incidence }, nodes);
}

interface Closing {
  /** Per given node: its index after the weld. */
  readonly indices: Uint32Array;
  /** The edges that are open after the weld, as `openEdges` returns them. */
  readonly stillOpen: Uint32Array;
}

/** Dissolves the groups that close no open edge. */
function dissolveUseless(groupOf: Uint32Array, open: Uint32Array, { indices, stillOpen }: Closing): void {
  const isUseful = new Uint8Array(groupOf.length);
  for (let i = 0; i < open.length; i += 2) {
    const [from, to] = [open[i] ?? 0, open[i + 1] ?? 0];
    if (hasEdge(stillOpen, indices[from] ?? 0, indices[to] ?? 0)) continue;
    isUseful[groupOf[from] ?? 0] = 1;
    isUseful[groupOf[to] ?? 0] = 1;
  }
  groupOf.forEach((group, node) => {
    if (isUseful[group] === 0) groupOf[node] = node;
  });
}

/** Searches the sorted edges. */
function hasEdge(edges: Uint32Array, from: number, to: number): boolean {
  const [first, second] = [Math.min(from, to), Math.max(from, to)];
  let [low, high] = [0, edges.length / 2];
  while (low < high) {
    const middle = (low + high) >>> 1;
    const order = (edges[2 * middle] ?? 0) - first || (edges[2 * middle + 1] ?? 0) - second;
    if (order === 0) return true;
    if (order < 0) low = middle + 1;
    else high = middle;
  }
  return false;
}

/** Returns the surface with one node per group, in the order in which the groups first appear. */
function* rebuilt(
  { points: given, triangles }: Soup,
  groupOf: Uint32Array,
): Steps<WeldedByRounding & Pick<Closing, "indices">> {
  const source = yield* sourcesOf(given, triangles, groupOf);
  const indices = new Uint32Array(groupOf.length);
  let [kept, square] = [0, 0];
  const points = new Float64Array(given.length);
  yield* stepwise(groupOf.length, (p) => {
    const group = groupOf[p] ?? p;
    const from = source[group] ?? p;
    square = Math.max(square, squareBetween(given, p, from));
    if (group !== p) {
      // The first node of a group is its smallest.
      indices[p] = indices[group] ?? 0;
      return;
    }
    points.set(given.subarray(3 * from, 3 * from + 3), 3 * kept);
    indices[p] = kept++;
  });
  const welded = new Uint32Array(triangles.length);
  yield* stepwise(welded.length, (i) => (welded[i] = indices[triangles[i] ?? 0] ?? 0));
  return {
    points: points.slice(0, 3 * kept),
    triangles: welded,
    indices,
    welded: groupOf.length - kept,
    distance: Math.sqrt(square),
  };
}

/**
 * Returns per group the node whose position it gets: the one with the most coordinates that are exactly 0, then with the
 * most triangles, then the nearest to the origin.
 */
function* sourcesOf(points: Float64Array, triangles: Uint32Array, groupOf: Uint32Array): Steps<Uint32Array> {
  const uses = new Uint32Array(groupOf.length);
  yield* stepwise(triangles.length, (corner) => {
    const node = triangles[corner] ?? 0;
    uses[node] = (uses[node] ?? 0) + 1;
  });
  const sizesOf = (node: number) => AXES.map((axis) => Math.abs(points[3 * node + axis] ?? 0));
  const nonzero = (node: number) => sizesOf(node).filter((size) => size > 0).length;
  const sum = (node: number) => sizesOf(node).reduce((all, size) => all + size, 0);
  const compare = (a: number, b: number) =>
    nonzero(a) - nonzero(b) ||
    (uses[b] ?? 0) - (uses[a] ?? 0) ||
    sum(a) - sum(b) ||
    comparePositions(points, a, b);
  const source = Uint32Array.from(groupOf.keys());
  yield* stepwise(groupOf.length, (node) => {
    const group = groupOf[node] ?? node;
    if (group !== node && compare(node, source[group] ?? group) < 0) source[group] = node;
  });
  return source;
}
