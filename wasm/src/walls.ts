/** Walls: triangles of a surface with a region on either side. */
import type { SurfaceMesh } from "./types.js";

/** In {@link SurfaceMesh.triangleRegions}: nothing is meshed on that side. */
export const NO_REGION = 0xffffffff;

/** Whether a triangle lies between two regions. */
export function isWall({ triangleRegions }: SurfaceMesh, triangle: number): boolean {
  return (triangleRegions[2 * triangle + 1] ?? NO_REGION) !== NO_REGION;
}
