import { Vector3 } from "three";
import type { Position } from "../document/position";
import type { Bounds } from "./bounds";

/** The view of a point or an element contains at least this share of the model. */
const minShare = 0.12;

/**
 * Returns two corners of the box to show, relative to `origin`: the box of a target, or the part of the model around a
 * target that is much smaller than the model.
 */
export function closeUpBox(
  { low, high, centre, radius }: Pick<Bounds, "low" | "high" | "centre" | "radius">,
  modelRadius: number,
  [x, y, z]: Position,
): readonly [from: Vector3, to: Vector3] {
  const minRadius = minShare * modelRadius;
  if (radius >= minRadius) {
    return [
      new Vector3(low[0] - x, low[1] - y, low[2] - z),
      new Vector3(high[0] - x, high[1] - y, high[2] - z),
    ];
  }
  const from = new Vector3(centre[0] - x, centre[1] - y, centre[2] - z).subScalar(minRadius);
  return [from, from.clone().addScalar(2 * minRadius)];
}
