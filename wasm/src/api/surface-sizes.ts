/** Proposes sizes for a surface: those of a remeshing, and what results from them. */
import type { EngineClient } from "../engine/engine-client.js";
import type { RunControl } from "../engine/control.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { checkLocatedSurface, checkSurface, withInnerShells } from "./input-checks.js";
import { changeDiagnostics } from "./inspection.js";
import type { SurfaceSizeProposal } from "./mesher-interface.js";
import type { SurfaceProposalOptions } from "./option-types.js";
import { checkSurfaceProposalOptions, engineRemeshOptions } from "./options.js";
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
  const question = {
    kind: "propose-surface",
    id: client.nextId(),
    points: surface.points.slice(),
    triangles: surface.triangles.slice(),
    groups: surface.trianglePatch?.slice() ?? new Uint32Array(),
    options: engineRemeshOptions(withInnerShells(surface, options)),
    triangleRegions: triangleRegionsOf(surface),
  } as const;
  const found = await client.ask(question, control);
  refuse(changeDiagnostics(found, surfaceNamer(surface)));
  const { size, minSize, tolerance, triangles, tetrahedra } = found;
  return {
    size,
    minSize,
    tolerance,
    triangles: Math.round(triangles),
    tetrahedra: Math.round(tetrahedra),
  };
}
