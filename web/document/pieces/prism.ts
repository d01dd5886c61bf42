import type { Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import type { QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { onCircle } from "./on-circle";

const names = strings.pieces.patches;

/**
 * Returns the prism of a regular polygon around the z axis, with its base at z = 0: planar patches, which represent it
 * exactly. `radius` is the distance of the corners from the axis; the first corner lies on the x axis.
 */
export function prism(sides: number, radius: number, height: number): Shape;
export function prism(sides: number, radius: Quantity, height: Quantity): Shape<QuantityPosition>;
export function prism(sides: number, radius: Quantity, height: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const ring = (z: Quantity): number[] =>
    Array.from({ length: sides }, (_, i) => builder.point(onCircle(radius, i / sides, z)));
  const [base, top] = [ring(0), ring(height)];
  builder.patch("planar", [builder.polygon(base.toReversed())], names.bottom);
  builder.patch("planar", [builder.polygon(top)], names.top);
  for (const [i, corner] of base.entries()) {
    const next = (i + 1) % sides;
    const loop = [corner, base[next] ?? 0, top[next] ?? 0, top[i] ?? 0];
    builder.patch("planar", [builder.polygon(loop)], names.numbered(names.side, i + 1));
  }
  return builder.shape;
}
