/** Splines of CAD files with flat knots, each covering a range of its parameter. */
import type { SplineCurve } from "./trimmed-model.js";

/** Knots of a direction of a spline, as OpenCascade stores them: each once, with its multiplicity. */
export interface Knots {
  readonly degree: number;
  readonly isPeriodic: boolean;
  readonly values: Float64Array;
  readonly multiplicities: readonly number[];
}

/** Flat knots, and which of the stored poles belongs to each pole. */
export interface FlatKnots {
  readonly knots: Float64Array;
  readonly poles: readonly number[];
}

/** Returns the number of poles that knots need; 0 if the multiplicities are invalid. */
export function poleCount({ degree, isPeriodic, multiplicities }: Knots): number {
  const sum = multiplicities.reduce((total, count) => total + count, 0);
  if (degree < 1 || multiplicities.some((count) => count < 1 || count > degree + 1)) return 0;
  return Math.max(0, isPeriodic ? sum - (multiplicities.at(-1) ?? 0) : sum - degree - 1);
}

/** Returns flat knots. A periodic spline is unrolled over as many periods as cover the range. */
export function flatKnots(knots: Knots, first: number, last: number): FlatKnots {
  const { degree, isPeriodic, values, multiplicities } = knots;
  const repeated = multiplicities.flatMap((count, k) => new Array<number>(count).fill(values[k] ?? 0));
  const count = poleCount(knots);
  if (!isPeriodic)
    return { knots: Float64Array.from(repeated), poles: Array.from({ length: count }, (_, i) => i) };
  const [begin = 0, end = 1] = [values[0], values.at(-1)];
  const period = end - begin;
  const slack = 1e-9;
  const below = Math.max(0, Math.ceil((begin - first) / period - slack));
  const above = Math.max(0, Math.ceil((last - end) / period - slack));
  // Knot j of the endless sequence; knot 0 is the first of those at the beginning of the period.
  const knotAt = (j: number) => {
    const turn = Math.floor(j / count);
    return (repeated[j - turn * count] ?? 0) + turn * period;
  };
  const from = (multiplicities[0] ?? 1) - 1 - degree - below * count;
  const to = count + degree + above * count;
  const flat = Float64Array.from({ length: to - from + 1 }, (_, i) => knotAt(from + i));
  return { knots: flat, poles: Array.from({ length: flat.length - degree - 1 }, (_, i) => i % count) };
}

/** Returns the entries of poles or weights, `size` numbers each, at the given indices. */
export function picked(values: Float64Array, indices: readonly number[], size: number): Float64Array {
  if (values.length === 0) return values;
  return Float64Array.from({ length: indices.length * size }, (_, i) => {
    const pole = indices[Math.floor(i / size)] ?? 0;
    return values[pole * size + (i % size)] ?? 0;
  });
}

/**
 * Returns the position of a spline, with `size` coordinates per pole: De Boor's algorithm on weighted poles. Outside of its knots, it is
 * that at the nearest end.
 */
export function splineAt({ degree, knots, poles, weights }: SplineCurve, t: number, size: number): number[] {
  const count = poles.length / size;
  const knot = (k: number): number => knots[k] ?? 0;
  const at = Math.min(Math.max(t, knot(degree)), knot(count));
  let span = degree;
  while (span + 1 < count && at >= knot(span + 1)) span++;
  let rows = Array.from({ length: degree + 1 }, (_, k) => {
    const pole = span - degree + k;
    const weight = weights[pole] ?? 1;
    const coordinates = Array.from(poles.subarray(size * pole, size * (pole + 1)), (x) => weight * x);
    return [...coordinates, weight];
  });
  for (let level = 1; level <= degree; level++)
    rows = rows.slice(1).map((row, k) => {
      const begin = knot(span - degree + k + level);
      const share = (at - begin) / (knot(span + 1 + k) - begin);
      return row.map((x, axis) => (1 - share) * (rows[k]?.[axis] ?? 0) + share * x);
    });
  const [row = []] = rows;
  return row.slice(0, size).map((x) => x / (row[size] ?? 1));
}

/** Returns the knots of one Bézier piece from 0 to 1. */
export const bezierKnots = (degree: number): Knots => ({
  degree,
  isPeriodic: false,
  values: Float64Array.of(0, 1),
  multiplicities: [degree + 1, degree + 1],
});

/** A curve by its position and its first two derivatives at a parameter, as components. */
export type Derivatives = (t: number) => readonly [number[], number[], number[]];

const QUINTIC = 5;

/** Returns a spline of degree 5 that has the curve's position and two derivatives at the ends of equal pieces. */
export function quinticSpline(curve: Derivatives, first: number, last: number, pieces: number): SplineCurve {
  const step = (last - first) / pieces;
  const knots: number[] = [first];
  const poles: number[] = [];
  for (let piece = 0; piece < pieces; piece++) {
    const [begin, end] = [first + piece * step, piece + 1 === pieces ? last : first + (piece + 1) * step];
    const [[p0, d0, s0], [p1, d1, s1]] = [curve(begin), curve(end)];
    const at = (of: number[], i: number) => of[i] ?? 0;
    const h = end - begin;
    const rows = p0.map((_, i) => [
      at(p0, i),
      at(p0, i) + (h / 5) * at(d0, i),
      at(p0, i) + ((2 * h) / 5) * at(d0, i) + ((h * h) / 20) * at(s0, i),
      at(p1, i) - ((2 * h) / 5) * at(d1, i) + ((h * h) / 20) * at(s1, i),
      at(p1, i) - (h / 5) * at(d1, i),
      at(p1, i),
    ]);
    for (let k = piece === 0 ? 0 : 1; k <= QUINTIC; k++) poles.push(...rows.map((row) => row[k] ?? 0));
    knots.push(...new Array<number>(QUINTIC).fill(begin));
  }
  knots.push(...new Array<number>(QUINTIC + 1).fill(last));
  return {
    degree: QUINTIC,
    knots: Float64Array.from(knots),
    poles: Float64Array.from(poles),
    weights: new Float64Array(),
  };
}
