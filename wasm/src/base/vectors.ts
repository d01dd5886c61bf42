/** Vectors of space, and the corners of triangles. */

export type Vector = readonly [number, number, number];
export type Corners = readonly [Vector, Vector, Vector];

/** What the positions of triangles are read from: x y z per node, and three nodes per triangle. */
interface Triangles {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}

export const plus = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const scaled = (a: Vector, factor: number): Vector => [a[0] * factor, a[1] * factor, a[2] * factor];
export const minus = (a: Vector, b: Vector): Vector => plus(a, scaled(b, -1));
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const lengthOf = (a: Vector): number => Math.sqrt(dot(a, a));
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

export const pointOf = (points: Float64Array, node: number): Vector => [
  points[3 * node] ?? 0,
  points[3 * node + 1] ?? 0,
  points[3 * node + 2] ?? 0,
];

export function cornersOf({ points, triangles }: Triangles, triangle: number): Corners {
  const corner = (k: number) => pointOf(points, triangles[3 * triangle + k] ?? 0);
  return [corner(0), corner(1), corner(2)];
}

export const centroidOf = ([a, b, c]: Corners): Vector => scaled(plus(plus(a, b), c), 1 / 3);

/** Returns a vector across a triangle, with twice its area as length. */
export const normalOf = ([a, b, c]: Corners): Vector => cross(minus(b, a), minus(c, a));
