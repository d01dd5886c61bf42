/** Interfaces: triangles of a surface between two regions. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { index, integers } from "../calls/schemas.js";
import type { SurfaceMesh } from "./mesh.js";

/** In {@link SurfaceMesh.triangleRegions}: no region on that side. */
export const NO_REGION = 0xffffffff;

const withRegions = v.object({ triangleRegions: integers(2) });

/** Returns whether a triangle lies between two regions. */
export function isInterface(surface: SurfaceMesh, triangle: number): boolean {
  checkArgument("surface", surface, withRegions);
  checkArgument("triangle", triangle, index);
  return (surface.triangleRegions[2 * triangle + 1] ?? NO_REGION) !== NO_REGION;
}
