import { times, type Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import type { QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { addCircle, addRing } from "./rings";

const names = strings.pieces.patches;

/** Triangles around the apex. */
const tipTriangles = 8;
/** Height of the part with the triangles / height of the cone. */
const tipShare = 0.25;

/**
 * Returns a cone around the z axis, with its base at z = 0. A tube represents its lower part exactly. Around the apex, where
 * a tube cannot end, eight Barnhill–Gregory–Nielson triangles lie inside the cone by at most 0.29 % of the radius.
 */
export function cone(radius: number, height: number): Shape;
export function cone(radius: Quantity, height: Quantity): Shape<QuantityPosition>;
export function cone(radius: Quantity, height: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const base = addCircle(builder, radius, 0);
  const ring = addRing(builder, times(tipShare, radius), times(1 - tipShare, height), tipTriangles);
  const apex = builder.point([0, 0, height]);
  builder.patch("planar", [[-base]], names.bottom);
  builder.patch("tube", [[base], ring.arcs], names.side);
  for (const [i, arc] of ring.arcs.entries()) {
    const from = ring.corners[i] ?? apex;
    const to = ring.corners[(i + 1) % tipTriangles] ?? apex;
    // The arc is the second line, which has a role of its own.
    const loop = [builder.straight(apex, from), arc, builder.straight(to, apex)];
    builder.patch("barnhill-gregory-nielson", [loop], names.numbered(names.tip, i + 1));
  }
  return builder.shape;
}
