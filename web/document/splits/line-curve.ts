import type { LineType } from "tetrafront/project";
import { arcThrough, circleThrough, onArc } from "../arcs";
import type { Position } from "../position";
import { add, addScaled, between, cross, distance, dot, scale, subtract } from "../vectors";

/**
 * Lines as functions of a parameter from 0 to 1, as in the engine (cpp/src/model/curve.cpp): cubic splines over the lengths
 * of their chords, with natural ends or closed without a seam.
 */
export interface LineCurve {
  readonly at: (t: number) => Position;
  /** Parameters at which the curve is not infinitely smooth, 0 and 1 included. */
  readonly knots: readonly number[];
}

/** Returns the curve of a line through the given points; null if they define none. */
export function lineCurve(type: LineType, points: readonly Position[]): LineCurve | null {
  const [a, b, c] = points;
  if (!a || !b) return null;
  switch (type) {
    case "straight":
      return { at: (t) => between(a, b, t), knots: [0, 1] };
    case "parabolic":
      return c ? { at: (t) => onParabola([a, b, c], t), knots: [0, 1] } : null;
    case "arc":
    case "circle": {
      const arc = c && (type === "arc" ? arcThrough(a, b, c) : circleThrough(a, b, c));
      return arc ? { at: (t) => onArc(arc, t), knots: [0, 1] } : null;
    }
    case "spline":
      return splineCurve(points);
    case "hermite":
      // Close enough to find a place on it: its tangents at the ends depend on its neighbours.
      return points.length < 3 ? { at: (t) => between(a, b, t), knots: [0, 1] } : splineCurve(points);
  }
}

/** Lagrange polynomials through the parameters 0, 1/2 and 1. */
function onParabola([a, b, c]: readonly [Position, Position, Position], t: number): Position {
  const s = 1 - t;
  return addScaled(addScaled(scale(a, s * (1 - 2 * t)), b, 4 * t * s), c, t * (2 * t - 1));
}

function splineCurve(points: readonly Position[]): LineCurve | null {
  const chords = points.slice(1).map((point, i) => distance(points[i] ?? point, point));
  const total = chords.reduce((sum, chord) => sum + chord, 0);
  if (points.length < 3 || chords.some((chord) => !(chord > 0))) return null;
  const steps = chords.map((chord) => chord / total);
  const knots = [0];
  for (const step of steps) knots.push((knots.at(-1) ?? 0) + step);
  knots[knots.length - 1] = 1;
  const isClosed = distance(points[0] ?? [0, 0, 0], points.at(-1) ?? [0, 0, 0]) === 0;
  const bends = secondDerivatives(points, steps, isClosed);
  const at = (t: number): Position => {
    const found = knots.findIndex((knot, i) => i > 0 && t <= knot);
    const i = (found < 0 ? knots.length - 1 : found) - 1;
    const [from, to] = [knots[i] ?? 0, knots[i + 1] ?? 1];
    const [p, q] = [points[i], points[i + 1]];
    const [m, n] = [bends[i], bends[i + 1]];
    if (!p || !q || !m || !n) return points[0] ?? [0, 0, 0];
    const step = to - from;
    const [u, v] = [(to - t) / step, (t - from) / step];
    const weight = (step * step) / 6;
    const chord = addScaled(scale(p, u), q, v);
    return addScaled(addScaled(chord, m, weight * (u ** 3 - u)), n, weight * (v ** 3 - v));
  };
  return { at, knots };
}

/** Solves the equations of a continuous slope by relaxation, which converges fast: they are diagonally dominant. */
function secondDerivatives(
  points: readonly Position[],
  steps: readonly number[],
  isClosed: boolean,
): readonly Position[] {
  const last = points.length - 1;
  const bends: Position[] = points.map(() => [0, 0, 0]);
  const slope = (i: number): Position =>
    scale(subtract(points[i + 1] ?? [0, 0, 0], points[i] ?? [0, 0, 0]), 1 / (steps[i] ?? 1));
  const settle = (i: number, before: number): number => {
    const after = i === last ? 0 : i;
    const [h, k] = [steps[before] ?? 1, steps[after] ?? 1];
    const change = scale(subtract(slope(after), slope(before)), 6);
    const sides = add(scale(bends[before] ?? [0, 0, 0], h), scale(bends[after + 1] ?? [0, 0, 0], k));
    const next = scale(subtract(change, sides), 1 / (2 * (h + k)));
    const moved = distance(next, bends[i] ?? next);
    bends[i] = next;
    return moved;
  };
  for (let round = 0; round < 100; ++round) {
    let moved = 0;
    let largest = 0;
    for (let i = 1; i < last; ++i) moved = Math.max(moved, settle(i, i - 1));
    if (isClosed) {
      moved = Math.max(moved, settle(last, last - 1));
      bends[0] = bends[last] ?? [0, 0, 0];
    }
    for (const bend of bends) largest = Math.max(largest, ...bend.map(Math.abs));
    if (moved <= 1e-15 * largest) break;
  }
  return bends;
}

/** Positions per span with which the nearest one is searched. */
const samples = 16;

/** Returns the parameter at which a curve is nearest to a position. */
export function nearestParameter({ at, knots }: LineCurve, position: Position): number {
  let [best, least] = [0, Infinity];
  let reach = 1;
  for (let i = 1; i < knots.length; ++i) {
    const [from, to] = [knots[i - 1] ?? 0, knots[i] ?? 1];
    const step = (to - from) / samples;
    for (let k = 0; k <= samples; ++k) {
      const away = distance(at(from + k * step), position);
      if (away < least) [best, least, reach] = [from + k * step, away, step];
    }
  }
  // Newton's method for a distance vector normal to the curve; halved where it would leave the neighbourhood.
  const isClosed = distance(at(0), at(1)) <= 1e-12 * distance(at(0), at(0.5));
  let t = best;
  for (let round = 0; round < 40; ++round) {
    const h = 1e-5 * reach;
    const [low, high] = [Math.max(0, t - h), Math.min(1, t + h)];
    const tangent = scale(subtract(at(high), at(low)), 1 / (high - low));
    const change = dot(subtract(position, at(t)), tangent) / dot(tangent, tangent);
    const moved = t + Math.max(-reach / 2, Math.min(reach / 2, change));
    // A closed curve goes on at its seam.
    const next = isClosed ? moved - Math.floor(moved) : Math.min(1, Math.max(0, moved));
    if (Math.abs(next - t) <= 1e-15) break;
    t = next;
  }
  return distance(at(t), position) <= least ? t : best;
}

/**
 * Returns where two curves cross near a position, by parameters; null if they do not come within a tolerance of each other
 * there.
 */
export function crossingNear(
  a: LineCurve,
  b: LineCurve,
  near: Position,
  tolerance: number,
): readonly [onA: number, onB: number] | null {
  let [s, t] = [nearestParameter(a, near), nearestParameter(b, near)];
  for (let round = 0; round < 30; ++round) {
    const [p, q] = [a.at(s), b.at(t)];
    const gap = subtract(q, p);
    const [u, v] = [tangentOf(a, s), tangentOf(b, t)];
    const normal = cross(u, v);
    const square = dot(normal, normal);
    if (square <= 1e-12 * dot(u, u) * dot(v, v)) return null;
    const [ds, dt] = [dot(cross(gap, v), normal) / square, dot(cross(gap, u), normal) / square];
    const clamp = (x: number): number => Math.min(1, Math.max(0, x));
    const [nextS, nextT] = [clamp(s + ds), clamp(t + dt)];
    const isSettled = Math.abs(nextS - s) + Math.abs(nextT - t) <= 1e-15;
    [s, t] = [nextS, nextT];
    if (isSettled) break;
  }
  return distance(a.at(s), b.at(t)) <= tolerance ? [s, t] : null;
}

function tangentOf({ at }: LineCurve, t: number): Position {
  const h = 1e-6;
  const [low, high] = [Math.max(0, t - h), Math.min(1, t + h)];
  return scale(subtract(at(high), at(low)), 1 / (high - low));
}
