/** Positions in text. */
import { DIGITS as SHORT_DIGITS, short } from "./short.js";

/** Coordinates below this share of the largest one are rounding errors: no digit of it that is shown is as small. */
const NOISE = 1e-12;

/** Digits after the point that six significant digits leave to a body of size 100: one far from the origin needs as many. */
const DECIMALS = 3;
const MOST_DIGITS = 15;

/** Returns "(1, 2, 0.5)", with six significant digits and three after the point of large numbers, or with `digits`. */
export function positionText(position: readonly number[], given?: number): string {
  const largest = position.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const needed = Math.ceil(Math.log10(Math.max(1, largest))) + DECIMALS;
  const digits = given ?? Math.min(MOST_DIGITS, Math.max(SHORT_DIGITS, needed));
  const shown = position.map((value) => short(Math.abs(value) < NOISE * largest ? 0 : value, digits));
  return `(${shown.join(", ")})`;
}
