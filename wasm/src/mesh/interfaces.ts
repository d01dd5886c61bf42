/** Interfaces: triangles of a surface between two regions. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { index, integers } from "../calls/schemas.js";
import { NO_REGION } from "../generated/constants.js";
import type { SurfaceMesh } from "./mesh.js";

const withRegions = v.object({ triangleRegions: integers(2) });

/** Returns whether a triangle lies between two regions. */
export function isInterface(surface: SurfaceMesh, triangle: number): boolean {
  checkArgument("surface", surface, withRegions);
  checkArgument("triangle", triangle, index);
  return (surface.triangleRegions[2 * triangle + 1] ?? NO_REGION) !== NO_REGION;
}
