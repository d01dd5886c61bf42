/** Groups nodes that differ by rounding, independently of the order of the nodes. */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import { type DisjointSets, disjointSets } from "./components.js";
import type { NearGrid } from "./near-grid.js";
import { comparePositions, type Rounding, squareBetween } from "./rounding-tolerance.js";

/** Largest number of nodes that are connected by pairs within rounding; more are a dense mesh, not noise. */
const MAX_CONNECTED = 256;

export interface NoisySoup {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly rounding: Rounding;
  readonly grid: NearGrid;
  readonly incidence: Incidence;
}

/** Returns the triangles at a node. */
export type Incidence = (node: number) => Uint32Array;

/** Returns the triangles at each node. O(n). */
export function* incidenceOf(triangles: Uint32Array, nodes: number): Steps<Incidence> {
  const ends = new Uint32Array(nodes + 1);
  yield* stepwise(triangles.length, (corner) => {
    const node = triangles[corner] ?? 0;
    ends[node + 1] = (ends[node + 1] ?? 0) + 1;
  });
  for (let node = 0; node < nodes; node++) ends[node + 1] = (ends[node + 1] ?? 0) + (ends[node] ?? 0);
  const begins = ends.slice();
  const found = new Uint32Array(triangles.length);
  yield* stepwise(triangles.length, (corner) => {
    const node = triangles[corner] ?? 0;
    const at = begins[node] ?? 0;
    found[at] = Math.floor(corner / 3);
    begins[node] = at + 1;
  });
  return (node) => found.subarray(ends[node], ends[node + 1]);
}

/**
 * Returns per node the smallest node of its group; undefined if each is on its own. `nodes`: those of open edges, to which
 * others are joined. In a group, all nodes differ by rounding, and no two have a triangle in common.
 */
export function* groupNoise(soup: NoisySoup, nodes: Uint32Array): Steps<Uint32Array | undefined> {
  const { points, rounding, grid } = soup;
  const count = points.length / 3;
  const sets = disjointSets(count);
  let pairs = 0;
  yield* stepwise(nodes.length, (i) => {
    const one = nodes[i] ?? 0;
    let found = 0;
    grid.near(one, rounding.largest, (other) => {
      if (!rounding.isWithin(one, other)) return true;
      found++;
      sets.join(one, other);
      // With more, it is part of a dense mesh, all of whose other pairs would take long.
      return found < MAX_CONNECTED;
    });
    pairs += found;
  });
  if (pairs === 0) return undefined;
  const groupOf = Uint32Array.from({ length: count }, (_, p) => p);
  const isOpen = new Uint8Array(count);
  for (const node of nodes) isOpen[node] = 1;
  for (const members of yield* membersOf(sets, count)) {
    if (members.length > MAX_CONNECTED) continue;
    for (const group of groupsOf(soup, members, isOpen)) {
      for (const node of group) groupOf[node] = group[0] ?? node;
    }
    yield PAUSE;
  }
  return groupOf;
}

/** Returns the connected nodes that are not alone, each list in ascending order. */
function* membersOf(sets: DisjointSets, count: number): Steps<Iterable<number[]>> {
  const components = new Map<number, number[]>();
  yield* stepwise(count, (p) => {
    const root = sets.rootOf(p);
    if (root === p) return;
    const known = components.get(root);
    if (known === undefined) components.set(root, [root, p]);
    else known.push(p);
  });
  return components.values();
}

/** Joins the nodes of a component, the nearest first, to groups that are as large as they can be. O(m² log m) for m nodes. */
function groupsOf(soup: NoisySoup, members: readonly number[], isOpen: Uint8Array): Iterable<number[]> {
  const conflicts = conflictsOf(soup, members);
  if (!conflicts.includes(1)) return [[...members]];
  const count = members.length;
  // The first member of each group stands for all of them.
  const firstOf = Uint16Array.from(members.keys());
  const groups = new Map(members.map((node, m) => [m, [node]]));
  for (const [one, other] of sortedPairs(soup, members, isOpen)) {
    const [first = 0, second = 0] = [firstOf[one], firstOf[other]].sort((a = 0, b = 0) => a - b);
    if (first === second || conflicts[first * count + second] === 1) continue;
    for (let m = 0; m < count; m++) {
      if (conflicts[second * count + m] === 1)
        conflicts[first * count + m] = conflicts[m * count + first] = 1;
      if (firstOf[m] === second) firstOf[m] = first;
    }
    groups.get(first)?.push(...(groups.get(second) ?? []));
    groups.delete(second);
  }
  return [...groups.values()].map((group) => group.sort((a, b) => a - b));
}

/** Returns a square matrix: 1 where two of the nodes differ by more than rounding, or have a triangle in common. */
function conflictsOf({ rounding, triangles, incidence }: NoisySoup, members: readonly number[]): Uint8Array {
  const count = members.length;
  const places = new Map(members.map((node, m) => [node, m]));
  const conflicts = new Uint8Array(count * count);
  for (const [m, one] of members.entries()) {
    for (let k = 0; k < m; k++) {
      if (!rounding.isWithin(one, members[k] ?? 0)) conflicts[m * count + k] = conflicts[k * count + m] = 1;
    }
    for (const t of incidence(one)) {
      for (let corner = 3 * t; corner < 3 * t + 3; corner++) {
        const k = places.get(triangles[corner] ?? 0);
        if (k !== undefined && k !== m) conflicts[m * count + k] = 1;
      }
    }
  }
  return conflicts;
}

/** Returns the places of pairs of a node of an open edge and another one, by their distance, then by their positions. */
function sortedPairs(
  { points, rounding }: NoisySoup,
  members: readonly number[],
  isOpen: Uint8Array,
): (readonly [number, number])[] {
  const inOrder = [...members.keys()].sort((a, b) =>
    comparePositions(points, members[a] ?? 0, members[b] ?? 0),
  );
  const pairs: { readonly places: readonly [number, number]; readonly square: number }[] = [];
  for (const [i, m] of inOrder.entries()) {
    const one = members[m] ?? 0;
    for (const k of inOrder.slice(i + 1)) {
      const other = members[k] ?? 0;
      if (isOpen[one] !== 1 && isOpen[other] !== 1) continue;
      if (rounding.isWithin(one, other))
        pairs.push({ places: [m, k], square: squareBetween(points, one, other) });
    }
  }
  // The sort is stable: of equal distances, the first position decides.
  return pairs.sort((a, b) => a.square - b.square).map(({ places }) => places);
}
