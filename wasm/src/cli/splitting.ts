/** `--split-patches`: patches by the sharp edges of a surface. */
import type { SurfaceMesher } from "../api/surface-mesher.js";
import type { SplitOptions } from "../api/option-types.js";
import { checkSplitOptions } from "../api/surface-options.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { numberIn, refuseOptions } from "./input.js";
import type { Mesh } from "../mesh/mesh.js";

/** Options as commander passes them. */
export interface SplitCommandOptions {
  /** An angle in degrees, or true without one. */
  readonly splitPatches?: string | true;
}

/** Returns the options of a split, undefined if none is requested. Throws an InvalidInput. */
export function splitOptions({ splitPatches }: SplitCommandOptions): SplitOptions | undefined {
  if (splitPatches === undefined) return undefined;
  const options: SplitOptions = splitPatches === true ? {} : { angle: numberIn(splitPatches) };
  refuseOptions(checkSplitOptions(options));
  return options;
}

/** Throws an InvalidInput if a split is requested for a project. */
export function refuseSplit(options: SplitOptions | undefined): void {
  if (options === undefined) return;
  const message = "--split-patches is for surfaces, but the input is a project";
  const remedy = "Omit it, or split the surface when you convert it to a project.";
  refuseOptions([invalidOption("--split-patches", message, remedy)]);
}

/** Returns the surface with its patches split, if that is requested. */
export async function withSplit(
  mesher: SurfaceMesher,
  surface: Mesh,
  options: SplitOptions | undefined,
): Promise<Mesh> {
  return options === undefined ? surface : (await mesher.splitPatches(surface, options)).mesh;
}
