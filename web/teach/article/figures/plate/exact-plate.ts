/**
 * Stress in an unbounded plate with an elliptical hole that is pulled along x with stress 1. The exact solution in complex
 * potentials, after N. I. Muskhelishvili, Some basic problems of the mathematical theory of elasticity (1953): the map
 * z = R (ζ + m / ζ) takes the outside of the unit circle to the outside of the hole.
 */
import type { PlanePoint } from "../../kit/plane-view";

/** An ellipse with its half axes along x and y. */
export interface Hole {
  readonly at: PlanePoint;
  readonly a: number;
  readonly b: number;
}

/** Stresses xx, yy and xy. */
export type Stress = readonly [number, number, number];

type Complex = readonly [number, number];

const times = ([a, b]: Complex, [c, d]: Complex): Complex => [a * c - b * d, a * d + b * c];
const plus = ([a, b]: Complex, [c, d]: Complex): Complex => [a + c, b + d];
const scaled = ([a, b]: Complex, by: number): Complex => [a * by, b * by];
const inverse = ([a, b]: Complex): Complex => {
  const square = a * a + b * b;
  return [a / square, -b / square];
};
/** Returns the root with a real part of at least 0. */
function root([a, b]: Complex): Complex {
  const size = Math.hypot(a, b);
  const real = Math.sqrt(Math.max(0, (size + a) / 2));
  const imaginary = Math.sqrt(Math.max(0, (size - a) / 2));
  return [real, b < 0 ? -imaginary : imaginary];
}

/** Returns the stress at a point outside the hole; a point inside is moved to its edge. */
export function exactStress({ at, a, b }: Hole, [px, py]: PlanePoint): Stress {
  const radius = (a + b) / 2;
  const m = (a - b) / (a + b);
  const z: Complex = [px - at[0], py - at[1]];
  // Of the two solutions of z = R (ζ + m / ζ), the one outside the unit circle.
  const half = scaled(z, 1 / (2 * radius));
  const offset = root(plus(times(half, half), [-m, 0]));
  const [first, second] = [plus(half, offset), plus(half, scaled(offset, -1))];
  let zeta = Math.hypot(...first) > Math.hypot(...second) ? first : second;
  const size = Math.hypot(...zeta);
  if (size < 1) zeta = size > 0 ? scaled(zeta, 1 / size) : [1, 0];
  const u = inverse(zeta);
  const u2 = times(u, u);
  const u3 = times(u2, u);
  // φ = R/4 (ζ + (2 − m) / ζ), its derivatives, and those of the map.
  const map1 = scaled(plus([1, 0], scaled(u2, -m)), radius);
  const map2 = scaled(u3, 2 * m * radius);
  const phi1 = scaled(plus([1, 0], scaled(u2, m - 2)), radius / 4);
  const phi2 = scaled(u3, ((2 - m) * radius) / 2);
  const perMap = inverse(map1);
  const phi = times(phi1, perMap);
  const slope = times(
    times(plus(times(phi2, map1), scaled(times(phi1, map2), -1)), times(perMap, perMap)),
    perMap,
  );
  // ψ = −R/2 (ζ + (1 + m² − m − 1/ζ²) ζ / (ζ² − m)), and its derivative.
  const below = inverse(plus(times(zeta, zeta), [-m, 0]));
  const above = plus(scaled(zeta, 1 + m * m - m), scaled(u, -1));
  const above1 = plus([1 + m * m - m, 0], u2);
  const quotient1 = plus(
    times(above1, below),
    scaled(times(times(above, scaled(zeta, 2)), times(below, below)), -1),
  );
  const psi = times(scaled(plus([1, 0], quotient1), -radius / 2), perMap);
  const sum = 4 * phi[0];
  const rest = scaled(plus(times([z[0], -z[1]], slope), psi), 2);
  return [(sum - rest[0]) / 2, (sum + rest[0]) / 2, rest[1] / 2];
}

/** Returns the largest stress along the pull: that at the top and the bottom of the hole (G. Kirsch 1898, C. E. Inglis 1913). */
export const highestStress = ({ a, b }: Hole): number => 1 + (2 * b) / a;
