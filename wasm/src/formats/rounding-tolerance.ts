/** How far two coordinates may differ by rounding. */
import { type Steps, stepwise } from "../base/steps.js";

/** Largest difference of two numbers that is due to rounding, in units in the last place. */
const ULPS = 4;
/** Unit in the last place / number, at most. */
const SINGLE = 2 ** -23;
const DOUBLE = 2 ** -52;
/** Decimal digits with which single precision is written. */
const SINGLE_DIGITS = 9;
/** Numbers with six decimals are this near to one of single precision, in units in its last place. */
const NEARLY = 1 / 64;

export const AXES = [0, 1, 2] as const;

export interface Rounding {
  /** Returns whether two points differ by no more than rounding. */
  readonly isWithin: (one: number, other: number) => boolean;
  /** The largest difference along each axis. */
  readonly largest: readonly [number, number, number];
}

/**
 * Returns how far points may differ: by the rounding of the numbers in the file, in the precision that they have, and by
 * that of a calculation with the size of the body. Returns undefined if the body has no size, or its size is no number.
 */
export function* roundingOf(points: Float64Array, nodes: Uint32Array): Steps<Rounding | undefined> {
  const { size, largest } = yield* extentOf(points);
  if (!(size > 0 && size < Infinity)) return undefined;
  const relative = largest.map(
    (value, axis) => ULPS * (isSinglePrecision(points, nodes, axis, value) ? SINGLE : DOUBLE),
  );
  const fixed = ULPS * SINGLE * size;
  const isWithin = (one: number, other: number) => {
    for (let axis = 0; axis < 3; axis++) {
      const [a, b] = [points[3 * one + axis] ?? 0, points[3 * other + axis] ?? 0];
      const limit = fixed + (relative[axis] ?? 0) * Math.max(Math.abs(a), Math.abs(b));
      if (Math.abs(a - b) > limit) return false;
    }
    return true;
  };
  const [x = 0, y = 0, z = 0] = largest.map((value, axis) => fixed + (relative[axis] ?? 0) * value);
  return { isWithin, largest: [x, y, z] };
}

interface Extent {
  /** Longest side of the box around all points. */
  readonly size: number;
  /** Largest absolute value of the coordinates along each axis. */
  readonly largest: readonly number[];
}

function* extentOf(points: Float64Array): Steps<Extent> {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  yield* stepwise(points.length / 3, (p) => {
    for (let axis = 0; axis < 3; axis++) {
      const value = points[3 * p + axis] ?? 0;
      if (value < (low[axis] ?? 0)) low[axis] = value;
      if (value > (high[axis] ?? 0)) high[axis] = value;
    }
  });
  return {
    size: Math.max(...high.map((value, axis) => value - (low[axis] ?? 0))),
    largest: high.map((value, axis) => Math.max(value, -(low[axis] ?? 0))),
  };
}

/**
 * Returns whether the coordinates of these nodes have single precision. Those that are noise near 0, compared to the largest
 * one, say nothing.
 */
function isSinglePrecision(points: Float64Array, nodes: Uint32Array, axis: number, largest: number): boolean {
  return nodes.every((node) => {
    const value = points[3 * node + axis] ?? 0;
    const error = Math.abs(value - Math.fround(value));
    if (error <= NEARLY * SINGLE * Math.abs(value) || Math.abs(value) < SINGLE * largest) return true;
    return Number(value.toPrecision(SINGLE_DIGITS)) === value;
  });
}

/** Orders points by their positions. */
export function comparePositions(points: Float64Array, one: number, other: number): number {
  for (const axis of AXES) {
    const difference = (points[3 * one + axis] ?? 0) - (points[3 * other + axis] ?? 0);
    if (difference !== 0) return difference;
  }
  return 0;
}

export function squareBetween(points: Float64Array, one: number, other: number): number {
  let sum = 0;
  for (const axis of AXES) {
    const difference = (points[3 * one + axis] ?? 0) - (points[3 * other + axis] ?? 0);
    sum += difference * difference;
  }
  return sum;
}
