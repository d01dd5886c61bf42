import type { Position } from "./position";

/** Arithmetic of positions and directions. Nothing is changed in place. */

export const zero: Position = [0, 0, 0];

export function add(a: Position, b: Position): Position {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Position, b: Position): Position {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scale(a: Position, factor: number): Position {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

/** Returns a + factor · b. */
export function addScaled(a: Position, b: Position, factor: number): Position {
  return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
}

export function dot(a: Position, b: Position): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Position, b: Position): Position {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Position): number {
  return Math.hypot(a[0], a[1], a[2]);
}

export function distance(a: Position, b: Position): number {
  return length(subtract(a, b));
}

/** Returns the point at a share of the way from a to b: 0 gives a, 1 gives b. */
export function between(a: Position, b: Position, share: number): Position {
  return addScaled(scale(a, 1 - share), b, share);
}

/** Returns the direction of length 1; null for the zero vector and for numbers that are not finite. */
export function unit(a: Position): Position | null {
  const norm = length(a);
  return norm > 0 && Number.isFinite(norm) ? scale(a, 1 / norm) : null;
}

/** The directions of x, y and z. */
export const axisDirections: readonly [Position, Position, Position] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Two unit vectors with a smaller distance differ by rounding only. */
const rounding = 1e-12;

/**
 * Returns the axis of coordinates from which a unit vector differs by rounding only, so that it is shown as this axis; the
 * vector itself if there is none.
 */
export function snappedToAxis(direction: Position): Position {
  const [x = 0, y = 0, z = 0] = direction.map((component) => Math.round(component) + 0);
  const axis: Position = [x, y, z];
  return distance(axis, direction) < rounding ? axis : direction;
}

/** Three perpendicular directions of length 1, right-handed, at an origin. */
export interface Frame<P = Position> {
  readonly origin: P;
  readonly x: P;
  readonly y: P;
  readonly z: P;
}

/** The axes of coordinates. */
export const worldFrame: Frame = { origin: zero, x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/**
 * Returns a frame whose z axis has a direction, which must not be zero. An axis of coordinates permutes the others, so
 * that nothing is rounded: z gives x y z, x gives y z x, y gives z x y.
 */
export function frameAlong(direction: Position, origin: Position = zero): Frame {
  const z = unit(direction) ?? worldFrame.z;
  const helper = axisBeside(z);
  const x = unit(addScaled(helper, z, -dot(helper, z))) ?? worldFrame.x;
  return { origin, x, y: cross(z, x), z };
}

/** Returns the frame along a direction whose x axis is the part of another direction across it. */
export function frameTowards(direction: Position, towards: Position): Frame {
  const along = frameAlong(direction);
  const x = unit(addScaled(towards, along.z, -dot(towards, along.z))) ?? along.x;
  return { ...along, x, y: cross(along.z, x) };
}

/**
 * Returns a direction orthogonal to another one: the given one if it is up to rounding, else its part across, else any. The given
 * one without another one.
 */
export function orthogonalTo(other: Position | undefined, given: Position): Position {
  const axis = other && unit(other);
  const direction = unit(given);
  if (!axis || !direction) return given;
  const along = dot(axis, direction);
  if (Math.abs(along) < rounding) return given;
  return unit(addScaled(direction, axis, -along)) ?? frameAlong(axis).x;
}

/** Returns the axis of coordinates that lies in the plane of z and x of the frame along a direction of length 1. */
export function axisBeside(z: Position): Position {
  const smallest = [0, 1, 2].reduce((best, axis) =>
    Math.abs(z[axis] ?? 0) < Math.abs(z[best] ?? 0) ? axis : best,
  );
  const axis = [0, 1, 2].find((k) => Math.abs(z[k] ?? 0) === 1);
  const basis = [worldFrame.x, worldFrame.y, worldFrame.z] as const;
  return basis[axis === undefined ? smallest : (axis + 1) % 3] ?? worldFrame.x;
}

/** Returns the position whose coordinates in a frame are given. */
export function fromFrame({ origin, x, y, z }: Frame, local: Position): Position {
  return addScaled(addScaled(addScaled(origin, x, local[0]), y, local[1]), z, local[2]);
}

/** Returns the coordinates of a position in a frame. */
export function toFrame({ origin, x, y, z }: Frame, position: Position): Position {
  const offset = subtract(position, origin);
  return [dot(offset, x), dot(offset, y), dot(offset, z)];
}

/** Returns the area vector of a closed polygon: its direction is the normal, its length the area (Newell). */
export function areaVector(polygon: readonly Position[]): Position {
  const [first] = polygon;
  if (!first) return zero;
  const twice = polygon.reduce<Position>((sum, a, i) => {
    const b = polygon[(i + 1) % polygon.length] ?? first;
    return add(sum, cross(subtract(a, first), subtract(b, first)));
  }, zero);
  return scale(twice, 0.5);
}

export interface Box {
  readonly low: Position;
  readonly high: Position;
}

/** Returns the box around points, x y z each; that of the origin without any. */
export function boxOf(points: ArrayLike<number>): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    const [axis, x] = [i % 3, points[i] ?? 0];
    if (x < (low[axis] ?? 0)) low[axis] = x;
    if (x > (high[axis] ?? 0)) high[axis] = x;
  }
  return points.length === 0 ? { low: zero, high: zero } : { low, high };
}

/** Returns the mean of positions; the origin without any. */
export function mean(positions: readonly Position[]): Position {
  if (positions.length === 0) return zero;
  return scale(positions.reduce(add, zero), 1 / positions.length);
}

/** Cosine and sine of a share of a full turn, exact for multiples of a quarter: no rounding where none is needed. */
export function turn(share: number): readonly [cosine: number, sine: number] {
  const quarters = 4 * share;
  if (Number.isInteger(quarters)) {
    const exact = [
      [1, 0],
      [0, 1],
      [-1, 0],
      [0, -1],
    ] as const;
    return exact[((quarters % 4) + 4) % 4] ?? [1, 0];
  }
  const angle = 2 * Math.PI * share;
  return [Math.cos(angle), Math.sin(angle)];
}

/** Returns the length of a vector in an array of numbers: that of the components from an index on. */
export function lengthAt(values: Float64Array, first: number, components: number): number {
  let sum = 0;
  for (let i = first; i < first + components; ++i) sum += (values[i] ?? 0) ** 2;
  return Math.sqrt(sum);
}
