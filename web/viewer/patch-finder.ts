import type { SurfaceMesh } from "tetrafront";

/**
 * Position of the patch that a boundary face belongs to, from its three nodes in any order; null if no triangle
 * of the boundary has these nodes. Looks at all triangles, some milliseconds at most for 60 000.
 */
export function patchOfFace(
  { triangles, trianglePatch }: SurfaceMesh,
  nodes: readonly number[],
): number | null {
  const wanted = (corner: number): boolean => nodes.includes(triangles[corner] ?? -1);
  for (let t = 0; t < trianglePatch.length; ++t) {
    if (wanted(3 * t) && wanted(3 * t + 1) && wanted(3 * t + 2)) return trianglePatch[t] ?? null;
  }
  return null;
}
