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

/** Objects, and not pairs: the stress is computed many thousand times per frame, and small objects need no memory. */
interface Complex {
  readonly re: number;
  readonly im: number;
}

const complex = (re: number, im: number): Complex => ({ re, im });
const real = (re: number): Complex => complex(re, 0);
const times = (p: Complex, q: Complex): Complex =>
  complex(p.re * q.re - p.im * q.im, p.re * q.im + p.im * q.re);
const plus = (p: Complex, q: Complex): Complex => complex(p.re + q.re, p.im + q.im);
const scaled = (p: Complex, by: number): Complex => complex(p.re * by, p.im * by);
const squared = (p: Complex): number => p.re * p.re + p.im * p.im;
const inverse = (p: Complex): Complex => complex(p.re / squared(p), -p.im / squared(p));
/** Returns the root with a real part of at least 0. */
function root(p: Complex): Complex {
  const size = Math.sqrt(squared(p));
  const re = Math.sqrt(Math.max(0, (size + p.re) / 2));
  const im = Math.sqrt(Math.max(0, (size - p.re) / 2));
  return complex(re, p.im < 0 ? -im : im);
}

/** Returns the stress at a point outside the hole; a point inside is moved to its edge. */
export function exactStress({ at, a, b }: Hole, point: PlanePoint): Stress {
  const radius = (a + b) / 2;
  const m = (a - b) / (a + b);
  const z = complex(point[0] - at[0], point[1] - at[1]);
  // Of the two solutions of z = R (ζ + m / ζ), the one outside the unit circle.
  const half = scaled(z, 1 / (2 * radius));
  const offset = root(plus(times(half, half), real(-m)));
  const [first, second] = [plus(half, offset), plus(half, scaled(offset, -1))];
  let zeta = squared(first) > squared(second) ? first : second;
  const size = Math.sqrt(squared(zeta));
  if (size < 1) zeta = size > 0 ? scaled(zeta, 1 / size) : real(1);
  const u = inverse(zeta);
  const u2 = times(u, u);
  const u3 = times(u2, u);
  // φ = R/4 (ζ + (2 − m) / ζ), its derivatives, and those of the map.
  const map1 = scaled(plus(real(1), scaled(u2, -m)), radius);
  const map2 = scaled(u3, 2 * m * radius);
  const phi1 = scaled(plus(real(1), scaled(u2, m - 2)), radius / 4);
  const phi2 = scaled(u3, ((2 - m) * radius) / 2);
  const perMap = inverse(map1);
  const phi = times(phi1, perMap);
  const slope = times(
    times(plus(times(phi2, map1), scaled(times(phi1, map2), -1)), times(perMap, perMap)),
    perMap,
  );
  // ψ = −R/2 (ζ + (1 + m² − m − 1/ζ²) ζ / (ζ² − m)), and its derivative.
  const below = inverse(plus(times(zeta, zeta), real(-m)));
  const above = plus(scaled(zeta, 1 + m * m - m), scaled(u, -1));
  const above1 = plus(real(1 + m * m - m), u2);
  const quotient1 = plus(
    times(above1, below),
    scaled(times(times(above, scaled(zeta, 2)), times(below, below)), -1),
  );
  const psi = times(scaled(plus(real(1), quotient1), -radius / 2), perMap);
  const sum = 4 * phi.re;
  const rest = scaled(plus(times(complex(z.re, -z.im), slope), psi), 2);
  return [(sum - rest.re) / 2, (sum + rest.re) / 2, rest.im / 2];
}

/** Returns the largest stress along the pull: that at the top and the bottom of the hole (G. Kirsch 1898, C. E. Inglis 1913). */
export const highestStress = ({ a, b }: Hole): number => 1 + (2 * b) / a;
