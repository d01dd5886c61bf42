import type { SurfaceMesh } from "tetrafront";

/** The middle of a triangle, or null where the surface has no such triangle. */
export function triangleCentre(
  { points, triangles }: SurfaceMesh,
  triangle: number,
): readonly [number, number, number] | null {
  const nodes = triangles.subarray(3 * triangle, 3 * triangle + 3);
  if (nodes.length < 3) return null;
  const along = (axis: number): number =>
    nodes.reduce((sum, node) => sum + (points[3 * node + axis] ?? NaN) / 3, 0);
  return [along(0), along(1), along(2)];
}
