import type { Mesh } from "tetrafront";
import type { Position } from "./position";

/** Returns the centroid of a triangle; null if the surface has no such triangle. */
export function triangleCentroid(
  { points, triangles }: Pick<Mesh, "points" | "triangles">,
  triangle: number,
): Position | null {
  const nodes = triangles.subarray(3 * triangle, 3 * triangle + 3);
  if (nodes.length < 3) return null;
  const along = (axis: number): number =>
    nodes.reduce((sum, node) => sum + (points[3 * node + axis] ?? NaN) / 3, 0);
  return [along(0), along(1), along(2)];
}
