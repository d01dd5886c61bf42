import { negative, over, type Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import type { QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";

const names = strings.pieces.patches;

/**
 * Returns a box with its base centred at the origin: 8 points, 12 straight lines and 6 planar patches, which represent
 * it exactly. Loops are counter-clockwise from outside.
 *
 *      7---6      z
 *     /|  /|      |  y
 *    4---5 |      | /
 *    | 3-|-2      |/
 *    |/  |/       +---x
 *    0---1
 */
export function box(width: number, depth: number, height: number): Shape;
export function box(width: Quantity, depth: Quantity, height: Quantity): Shape<QuantityPosition>;
export function box(width: Quantity, depth: Quantity, height: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const [x, y] = [over(width, 2), over(depth, 2)];
  const [left, front] = [negative(x), negative(y)];
  for (const z of [0, height]) {
    builder.point([left, front, z]);
    builder.point([x, front, z]);
    builder.point([x, y, z]);
    builder.point([left, y, z]);
  }
  const faces: readonly (readonly [string, readonly number[]])[] = [
    [names.bottom, [0, 3, 2, 1]],
    [names.top, [4, 5, 6, 7]],
    [names.front, [0, 1, 5, 4]],
    [names.right, [1, 2, 6, 5]],
    [names.back, [2, 3, 7, 6]],
    [names.left, [3, 0, 4, 7]],
  ];
  for (const [name, corners] of faces) builder.patch("planar", [builder.polygon(corners)], name);
  return builder.shape;
}
