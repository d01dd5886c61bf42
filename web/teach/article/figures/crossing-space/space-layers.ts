/** The layers before equation (1), for two triangles in space: their boxes, and the planes through them. */
import type { Position } from "../../../../document/position";
import { cross, distance, dot, subtract } from "../../../../document/vectors";
import type { Triangle } from "../../../player/crossing";

/**
 * Returns the layer that decides: 1 if the boxes are apart, 2 if all corners of one triangle are on one side of the plane of the
 * other, else 3. As ends may overshoot by t, what is nearer than that is not apart.
 */
export function decidingLayer(one: Triangle, other: Triangle, tolerance: number): 1 | 2 | 3 {
  if (boxGap(one, other) > 2 * tolerance * (longestSide(one) + longestSide(other))) return 1;
  return isBeyond(one, other, tolerance) || isBeyond(other, one, tolerance) ? 2 : 3;
}

/** Returns the largest gap between the boxes along an axis; negative if they overlap. */
function boxGap(one: Triangle, other: Triangle): number {
  const gaps = ([0, 1, 2] as const).map((axis) => {
    const [a, b] = [one.map((corner) => corner[axis]), other.map((corner) => corner[axis])];
    return Math.max(Math.min(...b) - Math.max(...a), Math.min(...a) - Math.max(...b));
  });
  return Math.max(...gaps);
}

const longestSide = ([a, b, c]: Triangle): number => Math.max(distance(a, b), distance(b, c), distance(c, a));

/** Returns whether all corners lie on one side of the plane through a triangle, farther than ends may overshoot. */
function isBeyond(corners: Triangle, [a, b, c]: Triangle, tolerance: number): boolean {
  const normal = cross(subtract(b, a), subtract(c, a));
  const heights = corners.map((corner: Position) => dot(normal, subtract(corner, a)));
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  return Math.max(low, -high) > 2 * tolerance * (high - low);
}
