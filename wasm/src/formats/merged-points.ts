/** Detects points that a format's precision makes equal. */
import { plural } from "../base/plural.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { Note } from "./file-format.js";
import { PointWelder } from "./weld.js";

/** Reports how many different points become equal in `written`, by default float32. O(n) expected. */
export function* noteMerged(
  points: Float64Array,
  note: Note,
  written: Float64Array | Float32Array = Float32Array.from(points),
  why = "the format has single precision",
): Steps<void> {
  const lost = (yield* differentOf(points)) - (yield* differentOf(written));
  if (lost > 0) note(`${plural(lost, "point")} became equal to others: ${why}`);
}

function* differentOf(points: Float64Array | Float32Array): Steps<number> {
  const welder = new PointWelder();
  yield* stepwise(points.length / 3, (p) =>
    welder.add(points[3 * p] ?? 0, points[3 * p + 1] ?? 0, points[3 * p + 2] ?? 0),
  );
  return welder.count;
}
