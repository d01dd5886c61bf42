/** What formats of float32 coordinates lose. */
import type { Note } from "./file-format.js";
import { PointWelder } from "./weld.js";

/** Tells how many of different points such a format makes equal. O(n) expected. */
export function noteMerged(points: Float64Array, note: Note): void {
  const lost = differentOf(points) - differentOf(Float32Array.from(points));
  if (lost > 0) note(`${lost} of the points fall on others, for the format has single precision`);
}

function differentOf(points: Float64Array | Float32Array): number {
  const welder = new PointWelder();
  for (let i = 0; i < points.length; i += 3) {
    welder.add(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0);
  }
  return welder.count;
}
