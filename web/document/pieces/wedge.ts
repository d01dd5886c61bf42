import { minus, over, valueOf, type Quantity } from "../../expressions/quantity";
import type { QuantityPosition } from "../quantity-positions";
import type { Shape } from "../shape";
import { box } from "./box";

/** Returns a box whose top has another length in the direction x, from its left side on: as `box`, with an oblique right side. */
export function wedge(
  width: Quantity,
  depth: Quantity,
  height: Quantity,
  topLength: Quantity,
): Shape<QuantityPosition> {
  const shape = box(width, depth, height);
  const right = minus(topLength, over(width, 2));
  const points = shape.points.map(([x, y, z]): QuantityPosition =>
    valueOf(z) > 0 && valueOf(x) > 0 ? [right, y, z] : [x, y, z],
  );
  return { ...shape, points };
}
