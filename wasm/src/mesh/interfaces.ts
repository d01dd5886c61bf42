/** Walls: triangles of a surface with a region on either side. */
import { aPosition, arrayOf, checkArgument, objectOf } from "../calls/argument-checks.js";
import type { SurfaceMesh } from "./mesh.js";

/** In {@link SurfaceMesh.triangleRegions}: nothing is meshed on that side. */
export const NO_REGION = 0xffffffff;

const hasRegions = objectOf({ triangleRegions: arrayOf(Uint32Array, 2) });

/** Whether a triangle lies between two regions. */
export function isInterface(surface: SurfaceMesh, triangle: number): boolean {
  checkArgument("surface", surface, hasRegions);
  checkArgument("triangle", triangle, aPosition);
  return (surface.triangleRegions[2 * triangle + 1] ?? NO_REGION) !== NO_REGION;
}
