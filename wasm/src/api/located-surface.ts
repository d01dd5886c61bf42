/** Uses the points of a file that mark regions and holes of its surface. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { InnerShells } from "../generated/constants.js";
import { hasRegionPoints } from "./input-checks.js";
import type { SurfaceMesher } from "./surface-mesher.js";
import type { Mesh } from "../mesh/mesh.js";

export interface Located {
  readonly surface: Mesh;
  /** Warnings about points without effect. */
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Returns the surface with its regions located; unchanged if its format has no points that mark them, or if the file has
 * none and `innerShells` leaves inner shells empty.
 */
export async function located(
  mesher: Pick<SurfaceMesher, "locateRegions">,
  surface: Mesh,
  innerShells?: InnerShells,
): Promise<Located> {
  const isUnchanged =
    surface.regionPoints === undefined || (innerShells === "cavities" && !hasRegionPoints(surface));
  if (isUnchanged) return { surface, diagnostics: [] };
  const { mesh, diagnostics } = await mesher.locateRegions(surface);
  return innerShells === "cavities"
    ? { surface: mesh, diagnostics: [shellsUnused(), ...diagnostics] }
    : { surface: mesh, diagnostics };
}

function shellsUnused(): Diagnostic {
  const message =
    '`innerShells: "cavities"` has no effect: the points of the file decide which enclosed volumes are holes, and all others are regions';
  const remedy = "Omit it, or add a hole point to each cavity.";
  return packageDiagnostic("region-point", message, remedy, "warning");
}
