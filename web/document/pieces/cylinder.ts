import { strings } from "../../strings";
import { ShapeBuilder, type Shape } from "../shape";
import { addCircle } from "./rings";

const names = strings.pieces.patches;

/**
 * Returns a cylinder or the frustum of a cone around the z axis, with its base at z = 0: two planar patches within
 * circles and a tube between them, which represent it exactly. Both radii are above 0.
 */
export function cylinder(radius: number, topRadius: number, height: number): Shape {
  const builder = new ShapeBuilder();
  const base = addCircle(builder, radius, 0);
  const top = addCircle(builder, topRadius, height);
  builder.patch("planar", [[-base]], names.bottom);
  builder.patch("planar", [[top]], names.top);
  builder.patch("tube", [[base], [top]], names.side);
  return builder.shape;
}
