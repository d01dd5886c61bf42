import type { Quantity } from "../../expressions/quantity";
import type { QuantityPosition } from "../quantity-positions";
import type { ShapeBuilder } from "../shape";
import { onCircle } from "./on-circle";

/** Adds a circle around the z axis, from the x axis towards the y axis. Returns its number. */
export function addCircle(builder: ShapeBuilder<QuantityPosition>, radius: Quantity, z: Quantity): number {
  const [a = 0, b = 0, c = 0] = [0, 1 / 4, 1 / 2].map((share) => builder.point(onCircle(radius, share, z)));
  return builder.line("circle", [a, b, c, a]);
}

/** Points of a ring and the arcs between them. */
export interface Ring {
  readonly corners: readonly number[];
  /** The line from each corner to the next. */
  readonly arcs: readonly number[];
}

/** Adds a circle around the z axis as arcs of equal length, from the x axis towards the y axis. */
export function addRing(
  builder: ShapeBuilder<QuantityPosition>,
  radius: Quantity,
  z: Quantity,
  count: number,
): Ring {
  const corners = Array.from({ length: count }, (_, i) => builder.point(onCircle(radius, i / count, z)));
  const arcs = corners.map((corner, i) => {
    const middle = builder.point(onCircle(radius, (i + 0.5) / count, z));
    return builder.line("arc", [corner, middle, corners[(i + 1) % count] ?? corner]);
  });
  return { corners, arcs };
}
