/** Interfaces: triangles of a mesh between two regions. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { index, integers } from "../calls/schemas.js";
import { NO_REGION } from "../generated/constants.js";
import type { Mesh } from "./mesh.js";

const withRegions = v.object({ triangleRegions: v.optional(integers(2)) });

/** Returns whether a triangle lies between two regions. */
export function isInterface(mesh: Pick<Mesh, "triangleRegions">, triangle: number): boolean {
  checkArgument("mesh", mesh, withRegions);
  checkArgument("triangle", triangle, index);
  return (mesh.triangleRegions?.[2 * triangle + 1] ?? NO_REGION) !== NO_REGION;
}
