import { Vector3 } from "three";
import type { Position } from "../document/position";
import type { Bounds } from "./bounds";

/** Share of the diagonal of the model that is visible around a point or an element, on each side. */
const surroundings = 0.1;
/** Most surroundings of a target with an extent, on each side, in halves of its diagonal: an element among smaller ones is seen. */
const maxSurroundings = 4;

/**
 * Returns two corners of the box to show, relative to `origin`: the box of a target, with surroundings that are the larger the
 * smaller the target is beside the model, up to `maxMargin` halves of its own diagonal.
 */
export function closeUpBox(
  { low, high, radius }: Pick<Bounds, "low" | "high" | "radius">,
  modelRadius: number,
  [x, y, z]: Position,
  maxMargin = maxSurroundings,
): readonly [from: Vector3, to: Vector3] {
  const usual = 2 * surroundings * Math.max(0, modelRadius - radius);
  const margin = radius > 0 ? Math.min(usual, maxMargin * radius) : usual;
  return [
    new Vector3(low[0] - x, low[1] - y, low[2] - z).subScalar(margin),
    new Vector3(high[0] - x, high[1] - y, high[2] - z).addScalar(margin),
  ];
}
