import type { Position } from "./position";
import { add, length, subtract, unit } from "./vectors";

/** Lengths and angles between two or three places. */
export interface Measurement {
  readonly distance: number;
  readonly offset: Position;
  /** Angle at the second of three places, in degrees; null for two places. */
  readonly angle: number | null;
}

/** Measures two places, or three. Returns null for fewer. */
export function measure(places: readonly Position[]): Measurement | null {
  const [a, b, c] = places;
  if (!a || !b) return null;
  const offset = subtract(b, a);
  return { distance: length(offset), offset, angle: c ? angleAt(a, b, c) : null };
}

/** Returns the angle at b, in degrees; 0 if a or c is at b. */
function angleAt(a: Position, b: Position, c: Position): number {
  const [u, v] = [unit(subtract(a, b)), unit(subtract(c, b))];
  if (!u || !v) return 0;
  // Accurate for all angles, unlike the arc cosine.
  return 2 * Math.atan2(length(subtract(u, v)), length(add(u, v))) * (180 / Math.PI);
}
