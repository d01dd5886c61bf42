/** Positions in text. */
import { short } from "./short.js";

/** Coordinates below this share of the largest one are rounding errors: no digit of it that is shown is as small. */
const NOISE = 1e-12;

/** Returns "(1, 2, 0.5)", with six significant digits, or `digits`. */
export function positionText(position: readonly number[], digits?: number): string {
  const largest = position.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const shown = position.map((value) => short(Math.abs(value) < NOISE * largest ? 0 : value, digits));
  return `(${shown.join(", ")})`;
}
