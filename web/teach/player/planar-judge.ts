/**
 * What would happen if a candidate for a triangle were accepted: an independent check in doubles of the engine's verdicts
 * in the plane of a patch. The part of an edge that lies in the triangle is found by clipping, not by signs.
 */
import type { EdgeStep, PlanarFront, PlanePosition } from "tetrafront/trace";

/** How near to the border of a triangle an edge counts as touching it, as a share of the triangle's size. */
export const touching = 1e-9;
/** Limits of the length of new edges, in lengths of the base edge. */
const minLengthRatio = 0.55;
const maxLengthRatio = 2;
/** Least distance of a new node from every edge of the front, in lengths of the new edges. */
export const clearance = 0.55;

export const planeOf = (front: PlanarFront, node: number): PlanePosition => [
  front.plane[2 * node] ?? 0,
  front.plane[2 * node + 1] ?? 0,
];

export const endsOf = (front: PlanarFront, edge: number): readonly [number, number] => [
  front.edges[2 * edge] ?? 0,
  front.edges[2 * edge + 1] ?? 0,
];

/** Returns the indices of the edges of the front after a step, ascending. O(edges ever made). */
export function edgesAt(front: PlanarFront, step: number): number[] {
  const edges: number[] = [];
  front.edgesBorn.forEach((born, edge) => {
    if (born <= step && (front.edgesDied[edge] ?? 0) > step) edges.push(edge);
  });
  return edges;
}

/** Returns the length of a step of the plane in target sizes of space. */
export function metricLength([xx, xy, yy]: EdgeStep["metric"], [x, y]: PlanePosition): number {
  return Math.sqrt(xx * x * x + 2 * xy * x * y + yy * y * y);
}

/** Returns the target length of the new edges over a base edge, in target sizes of space. */
export function targetLength(front: PlanarFront, { nodes: [from, to], metric }: EdgeStep): number {
  const base = metricLength(metric, minus(planeOf(front, to), planeOf(front, from)));
  return Math.min(Math.max(1, minLengthRatio * base), maxLengthRatio * base);
}

/** Returns the distance of a position from an edge of the front, in target sizes of space. */
export function distanceToEdge(
  front: PlanarFront,
  metric: EdgeStep["metric"],
  position: PlanePosition,
  edge: number,
): number {
  const [a, b] = endsOf(front, edge).map((node) => planeOf(front, node)) as [PlanePosition, PlanePosition];
  const along = minus(b, a);
  const offset = minus(position, a);
  const [xx, xy, yy] = metric;
  const dot =
    xx * along[0] * offset[0] +
    xy * (along[0] * offset[1] + along[1] * offset[0]) +
    yy * along[1] * offset[1];
  const part = Math.min(1, Math.max(0, dot / metricLength(metric, along) ** 2));
  return metricLength(metric, [offset[0] - part * along[0], offset[1] - part * along[1]]);
}

/** A base edge and a candidate; the candidate's node is null if it is new. */
export interface NewTriangle {
  readonly nodes: readonly [number, number, number | null];
  readonly corners: readonly [PlanePosition, PlanePosition, PlanePosition];
}

export function newTriangle(
  front: PlanarFront,
  [from, to]: readonly [number, number],
  plane: PlanePosition,
  node: number | null,
): NewTriangle {
  return { nodes: [from, to, node], corners: [planeOf(front, from), planeOf(front, to), plane] };
}

/** Returns whether the apex is not clearly on the unmeshed side of the base edge. */
export function isBehindEdge(front: PlanarFront, { nodes, corners: [a, b, c] }: NewTriangle): boolean {
  if (areCollinear(front, nodes)) return true;
  const [along, arm] = [minus(b, a), minus(c, a)];
  return crossed(along, arm) <= touching * Math.hypot(...along) * Math.hypot(...arm);
}

/** Returns whether three nodes lie on one straight line of the boundary. */
function areCollinear({ carriers, boundaryNodes }: PlanarFront, nodes: NewTriangle["nodes"]): boolean {
  const [first = [], ...others] = nodes.map((node) =>
    node === null || node >= boundaryNodes ? [] : [...carriers.subarray(2 * node, 2 * node + 2)],
  );
  return first.some((carrier) => carrier > 0 && others.every((known) => known.includes(carrier)));
}

/** Returns the edges of the front that a triangle would cross, of those after a step, ascending. O(edges). */
export function crossedEdges(
  front: PlanarFront,
  step: number,
  triangle: NewTriangle,
  tolerance = -touching,
): number[] {
  return edgesAt(front, step).filter((edge) => crossesEdge(front, triangle, edge, tolerance));
}

/** Returns whether a triangle would cross an edge: with a positive tolerance also if they only touch. */
export function crossesEdge(
  front: PlanarFront,
  { nodes, corners }: NewTriangle,
  edge: number,
  tolerance: number,
): boolean {
  const [from, to] = endsOf(front, edge);
  const [a, b, apex] = nodes;
  const isFromShared = nodes.includes(from);
  const isToShared = nodes.includes(to);
  // The triangle may close an edge of the opposite direction, but not repeat one.
  if (isFromShared && isToShared) return (from === a && to === apex) || (from === apex && to === b);
  const inside = clipped(planeOf(front, from), planeOf(front, to), corners, tolerance);
  if (inside === null) return false;
  const [begin, end] = inside;
  // What they share at a common node is left out.
  const shared = 1e-6;
  if (isFromShared) return end > shared;
  if (isToShared) return begin < 1 - shared;
  return true;
}

/** Returns the part of an edge that lies in a triangle or touches it, as shares of its length, or null. */
export function partInside(
  front: PlanarFront,
  { corners }: NewTriangle,
  edge: number,
): readonly [number, number] | null {
  const [from, to] = endsOf(front, edge);
  return clipped(planeOf(front, from), planeOf(front, to), corners, touching);
}

/** Returns the part of a segment in a triangle that is enlarged by a share of its size, or null. */
function clipped(
  from: PlanePosition,
  to: PlanePosition,
  corners: NewTriangle["corners"],
  tolerance: number,
): readonly [number, number] | null {
  const size = Math.max(
    ...corners.map((corner, i) => Math.hypot(...minus(corner, corners[(i + 1) % 3] ?? corner))),
  );
  let begin = 0;
  let end = 1;
  for (let i = 0; i < 3; i++) {
    const a = corners[i] ?? from;
    const along = minus(corners[(i + 1) % 3] ?? from, a);
    const length = Math.hypot(...along);
    const atFrom = crossed(along, minus(from, a)) / length + tolerance * size;
    const atTo = crossed(along, minus(to, a)) / length + tolerance * size;
    if (atFrom < 0 && atTo < 0) return null;
    if (atFrom < 0) begin = Math.max(begin, atFrom / (atFrom - atTo));
    if (atTo < 0) end = Math.min(end, atFrom / (atFrom - atTo));
  }
  return begin <= end ? [begin, end] : null;
}

const minus = (a: PlanePosition, b: PlanePosition): PlanePosition => [a[0] - b[0], a[1] - b[1]];
const crossed = (a: PlanePosition, b: PlanePosition): number => a[0] * b[1] - a[1] * b[0];
