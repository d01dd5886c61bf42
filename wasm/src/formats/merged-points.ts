/** What formats lose of coordinates. */
import { plural } from "../plural.js";
import type { Note } from "./file-format.js";
import { PointWelder } from "./weld.js";

/** Tells how many of different points are equal as they are `written`: as float32 if not given. O(n) expected. */
export function noteMerged(
  points: Float64Array,
  note: Note,
  written: Float64Array | Float32Array = Float32Array.from(points),
  why = "the format has single precision",
): void {
  const lost = differentOf(points) - differentOf(written);
  if (lost > 0) note(`${plural(lost, "point")} came to lie on others, for ${why}`);
}

function differentOf(points: Float64Array | Float32Array): number {
  const welder = new PointWelder();
  for (let i = 0; i < points.length; i += 3) {
    welder.add(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0);
  }
  return welder.count;
}
