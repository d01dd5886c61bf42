/** Groups nodes that differ by rounding, independently of the order of the nodes. */
import { type Steps, stepwise } from "../base/steps.js";
import type { NearGrid } from "./near-grid.js";
import { comparePositions, type Rounding, squareBetween } from "./rounding-tolerance.js";

/** Largest number of nodes that are connected by pairs within rounding; more are a dense mesh, not noise. */
const MAX_CONNECTED = 64;

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
  const parent = Uint32Array.from({ length: points.length / 3 }, (_, p) => p);
  let pairs = 0;
  yield* stepwise(nodes.length, (i) => {
    const one = nodes[i] ?? 0;
    grid.near(one, rounding.largest, (other) => {
      if (!rounding.isWithin(one, other)) return;
      pairs++;
      connect(parent, one, other);
    });
  });
  if (pairs === 0) return undefined;
  const groupOf = Uint32Array.from(parent.keys());
  const isOpen = new Uint8Array(points.length / 3);
  for (const node of nodes) isOpen[node] = 1;
  const components = [...(yield* componentsOf(parent))].filter(({ length }) => length <= MAX_CONNECTED);
  yield* stepwise(components.length, (c) => {
    const members = components[c] ?? [];
    for (const group of isGroup(soup, members) ? [members] : nearestFirst(soup, members, isOpen)) {
      for (const node of group) groupOf[node] = group[0] ?? node;
    }
  });
  return groupOf;
}

function rootOf(parent: Uint32Array, given: number): number {
  let node = given;
  for (let above = parent[node] ?? node; above !== node; above = parent[node] ?? node) {
    const next = parent[above] ?? above;
    parent[node] = next;
    node = next;
  }
  return node;
}

function connect(parent: Uint32Array, one: number, other: number): void {
  const [a, b] = [rootOf(parent, one), rootOf(parent, other)];
  parent[Math.max(a, b)] = Math.min(a, b);
}

/** Returns the connected nodes that are not alone, each list in ascending order. */
function* componentsOf(parent: Uint32Array): Steps<Iterable<number[]>> {
  const components = new Map<number, number[]>();
  yield* stepwise(parent.length, (p) => {
    const root = rootOf(parent, p);
    if (root === p) return;
    const known = components.get(root);
    if (known === undefined) components.set(root, [root, p]);
    else known.push(p);
  });
  return components.values();
}

/** Returns whether all of these nodes differ by rounding, and no two have a triangle in common. */
function isGroup({ rounding, triangles, incidence }: NoisySoup, members: readonly number[]): boolean {
  for (const [i, one] of members.entries()) {
    for (let k = 0; k < i; k++) if (!rounding.isWithin(one, members[k] ?? 0)) return false;
  }
  return members.every((one) =>
    incidence(one).every((t) => {
      for (let corner = 3 * t; corner < 3 * t + 3; corner++) {
        const node = triangles[corner] ?? 0;
        if (node !== one && members.includes(node)) return false;
      }
      return true;
    }),
  );
}

/** Joins the nodes of a component, the nearest first, to groups that are as large as they can be. */
function nearestFirst(soup: NoisySoup, members: readonly number[], isOpen: Uint8Array): Iterable<number[]> {
  const groups = new Map(members.map((node) => [node, [node]]));
  for (const [one, other] of sortedPairs(soup, members, isOpen)) {
    const [left = [], right = []] = [groups.get(one), groups.get(other)];
    if (left === right) continue;
    const all = [...left, ...right].sort((a, b) => a - b);
    if (isGroup(soup, all)) for (const node of all) groups.set(node, all);
  }
  return new Set(groups.values());
}

/** Returns the pairs of a node of an open edge and another one, by their distance, then by their positions. */
function sortedPairs(
  { points, rounding }: NoisySoup,
  members: readonly number[],
  isOpen: Uint8Array,
): (readonly [number, number])[] {
  const inOrder = [...members].sort((a, b) => comparePositions(points, a, b));
  const pairs = inOrder.flatMap((one, i) =>
    inOrder
      .slice(i + 1)
      .filter((other) => isOpen[one] === 1 || isOpen[other] === 1)
      .filter((other) => rounding.isWithin(one, other))
      .map((other) => [one, other] as const),
  );
  const square = ([one, other]: readonly [number, number]) => squareBetween(points, one, other);
  // The sort is stable: of equal distances, the first position decides.
  return pairs.sort((a, b) => square(a) - square(b));
}
