/** Proposes sizes for a surface: those of a remeshing, and what results from them. */
import type { EngineClient } from "../engine/engine-client.js";
import type { RunControl } from "../engine/control.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { checkLocatedSurface, checkSurface, withInnerShells } from "./input-checks.js";
import { changeDiagnostics } from "./inspection.js";
import type { SurfaceSizeProposal } from "./mesher-interface.js";
import type { SurfaceProposalOptions } from "./option-types.js";
import { checkSurfaceProposalOptions, engineRemeshOptions } from "./surface-options.js";
import { surfaceNamer, triangleRegionsOf } from "./surface-numbers.js";

/** Implements `Mesher.proposeSurfaceSizes`. */
export async function proposeSurfaceSizes(
  client: EngineClient,
  surface: SurfaceInput,
  options: SurfaceProposalOptions,
  control: RunControl,
): Promise<SurfaceSizeProposal> {
  refuse([...checkSurface(surface), ...checkSurfaceProposalOptions(options)]);
  refuse(checkLocatedSurface(surface));
  const { points, triangles, trianglePatch = new Uint32Array() } = surface;
  const settings = engineRemeshOptions(withInnerShells(surface, options));
  const regions = triangleRegionsOf(surface);
  const given = [points.slice(), triangles.slice(), trianglePatch.slice(), settings, regions] as const;
  const found = await client.ask("proposeSurfaceSizes", given, control);
  refuse(changeDiagnostics(found, surfaceNamer(surface)));
  const { size, minSize, tolerance, tetrahedra } = found;
  return {
    size,
    minSize,
    tolerance,
    triangles: Math.round(found.triangles),
    tetrahedra: Math.round(tetrahedra),
  };
}
