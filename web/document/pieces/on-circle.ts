import { times, type Quantity } from "../../expressions/quantity";
import type { Position } from "../position";
import type { QuantityPosition } from "../quantity-positions";
import { turn } from "../vectors";

/** Returns the point of a circle around the z axis at a share of a full turn from the x axis, at a height z. */
export function onCircle(radius: number, share: number, z: number): Position;
export function onCircle(radius: Quantity, share: number, z: Quantity): QuantityPosition;
export function onCircle(radius: Quantity, share: number, z: Quantity): QuantityPosition {
  const [cosine, sine] = turn(share);
  return [times(radius, cosine), times(radius, sine), z];
}
