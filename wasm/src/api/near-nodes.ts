/** Finds nodes of open edges that nearly coincide: cracks that a weld within a small distance closes. */
import { roundedUp } from "../base/rounded-up.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { type EntityNamer } from "../diagnostics/entity-names.js";
import { sentence } from "../diagnostics/package-diagnostic.js";
import { NearGrid } from "../formats/near-grid.js";
import { diagonalOf } from "../formats/near-points.js";
import { openEdges } from "../formats/open-edges.js";
import { squareBetween } from "../formats/rounding-tolerance.js";
import type { SurfaceInput } from "../mesh/mesh.js";

/** Largest distance / shortest open edge at both nodes: a weld moves no node far along the boundary. */
const PER_EDGE = 0.25;
/** Largest distance / diagonal of the surface. */
const PER_DIAGONAL = 1e-3;
/** Margin of the distance of the weld. */
const MARGIN = 1.01;
/** The limits of a class differ by at most this power of two. */
const PER_CLASS = 2;
/** Largest number of nodes with which one is compared: more are a heap of triangles, whose pairs mean nothing. */
const MAX_VISITS = 1024;
/** Number of pairs that the message names. */
const NAMED_PAIRS = 3;

interface Pair {
  readonly one: number;
  readonly other: number;
  readonly distance: number;
}

/** Returns the distance that welds all nodes that nearly coincide; 0 without any. */
export function* nearNodeWeld({ points, triangles }: SurfaceInput): Steps<number> {
  const pairs = yield* nearPairs(points, yield* openEdges(triangles, points.length / 3));
  return pairs.length === 0 ? 0 : weldDistance(pairs);
}

function weldDistance(pairs: readonly Pair[]): number {
  return roundedUp(MARGIN * widest(pairs));
}

function widest(pairs: readonly Pair[]): number {
  return pairs.reduce((most, { distance }) => Math.max(most, distance), 0);
}

/** Returns a warning that names pairs of nodes that nearly coincide, and the distance that welds all of them. */
export function* nearNodeWarnings(
  { points, triangles }: SurfaceInput,
  name: EntityNamer,
): Steps<Diagnostic[]> {
  const pairs = yield* nearPairs(points, yield* openEdges(triangles, points.length / 3));
  if (pairs.length === 0) return [];
  const gap = widest(pairs);
  const distance = weldDistance(pairs);
  const named = [...pairs].sort((a, b) => a.one - b.one || a.other - b.other).slice(0, NAMED_PAIRS);
  const words = named.map((pair) => {
    const [one, other] = [name("surface-node", pair.one), name("surface-node", pair.other)];
    return `${one.label} and ${other.label} (${digits(pair.distance)} apart)`;
  });
  const count = pairs.length;
  const begin = count === 1 ? "1 pair of nodes nearly coincides" : `${count} pairs of nodes nearly coincide`;
  const more = count > named.length ? `, and ${count - named.length} more` : "";
  const warning: DiagnosticOf<"near-nodes"> = {
    code: "near-nodes",
    severity: "warning",
    message: sentence(`${begin}, at most ${digits(gap)} apart: ${words.join(", ")}${more}`),
    remedy: `If they are meant to be the same, use \`weld: ${distance}\`, or move them apart.`,
    entities: named.flatMap(({ one, other }) => [name("surface-node", one), name("surface-node", other)]),
    position: positionOf(points, named[0]?.one ?? 0),
    data: { count, distance },
  };
  return [warning];
}

/** Returns pairs of nodes of open edges that are much nearer to each other than their neighbours on these edges. */
function* nearPairs(points: Float64Array, open: Uint32Array): Steps<readonly Pair[]> {
  const shortest = yield* shortestEdges(points, open);
  const limit = PER_DIAGONAL * diagonalOf(points);
  const limitAt = (node: number) => Math.min(limit, PER_EDGE * (shortest.get(node) ?? 0));
  const pairs: Pair[] = [];
  let larger: readonly number[] = [];
  // Each node is compared with those of the same and of larger limits, in cells that fit its own.
  for (const [reach, nodes] of yield* byLimit(shortest.keys(), limitAt)) {
    const all = Uint32Array.from([...nodes, ...larger]);
    const grid = yield* NearGrid.of(points, [reach, reach, reach], all);
    const ranks = new Map(nodes.map((node, rank) => [node, rank]));
    yield* stepwise(nodes.length, (i) => {
      const one = nodes[i] ?? 0;
      const own = limitAt(one);
      let visits = 0;
      grid.near(one, [own, own, own], (other) => {
        if ((ranks.get(other) ?? Infinity) < i) return true;
        const distance = distanceOf(points, one, other);
        if (distance > 0 && distance <= Math.min(own, limitAt(other)))
          pairs.push({ one: Math.min(one, other), other: Math.max(one, other), distance });
        return ++visits < MAX_VISITS;
      });
    });
    larger = [...all];
  }
  return pairs;
}

/** Returns the nodes in classes of similar limits, the largest first, each with a number that its limits do not exceed. */
function* byLimit(
  nodes: Iterable<number>,
  limitAt: (node: number) => number,
): Steps<readonly (readonly [number, number[]])[]> {
  const classes = new Map<number, number[]>();
  const all = Uint32Array.from(nodes);
  yield* stepwise(all.length, (i) => {
    const node = all[i] ?? 0;
    const limit = limitAt(node);
    if (!(limit > 0 && limit < Infinity)) return;
    const reach = 2 ** (PER_CLASS * Math.ceil(Math.log2(limit) / PER_CLASS));
    const known = classes.get(reach);
    if (known === undefined) classes.set(reach, [node]);
    else known.push(node);
  });
  return [...classes].sort(([a], [b]) => b - a);
}

/** Returns the length of the shortest open edge at each of their nodes. */
function* shortestEdges(points: Float64Array, open: Uint32Array): Steps<ReadonlyMap<number, number>> {
  const shortest = new Map<number, number>();
  yield* stepwise(open.length / 2, (e) => {
    const [from, to] = [open[2 * e] ?? 0, open[2 * e + 1] ?? 0];
    const length = distanceOf(points, from, to);
    for (const node of [from, to]) shortest.set(node, Math.min(length, shortest.get(node) ?? Infinity));
  });
  return shortest;
}

function distanceOf(points: Float64Array, one: number, other: number): number {
  return Math.sqrt(squareBetween(points, one, other));
}

function positionOf(points: Float64Array, node: number): [number, number, number] {
  return [points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0];
}

function digits(value: number): number {
  return Number(value.toPrecision(2));
}
