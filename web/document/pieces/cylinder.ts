import type { Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import type { QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { addCircle } from "./rings";

const names = strings.pieces.patches;

/**
 * Returns a cylinder or the frustum of a cone around the z axis, with its base at z = 0: two planar patches within
 * circles and a tube between them, which represent it exactly. Both radii are above 0.
 */
export function cylinder(radius: number, topRadius: number, height: number): Shape;
export function cylinder(radius: Quantity, topRadius: Quantity, height: Quantity): Shape<QuantityPosition>;
export function cylinder(radius: Quantity, topRadius: Quantity, height: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const base = addCircle(builder, radius, 0);
  const top = addCircle(builder, topRadius, height);
  builder.patch("planar", [[-base]], names.bottom);
  builder.patch("planar", [[top]], names.top);
  builder.patch("tube", [[base], [top]], names.side);
  return builder.shape;
}
