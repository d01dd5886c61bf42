/** Uses the points of a file that mark regions and holes of its surface. */
import { hasRegionPoints } from "../api/input-checks.js";
import type { Mesher } from "../api/mesher-interface.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { InnerShells } from "../generated/constants.js";

export interface Located {
  readonly surface: SurfaceFile;
  /** Warnings about points without effect. */
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Returns the surface with its regions located; unchanged if its format has no points that mark them, or if the file has
 * none and `--inner-shells` leaves inner shells empty.
 */
export async function located(
  mesher: Mesher,
  surface: SurfaceFile,
  innerShells?: InnerShells,
): Promise<Located> {
  const isUnchanged =
    surface.regionPoints === undefined || (innerShells === "cavities" && !hasRegionPoints(surface));
  if (isUnchanged) return { surface, diagnostics: [] };
  const found = await mesher.locateRegions(surface);
  return innerShells === "cavities"
    ? { ...found, diagnostics: [shellsUnused(), ...found.diagnostics] }
    : found;
}

function shellsUnused(): Diagnostic {
  const message =
    "--inner-shells cavities has no effect: the points of the file decide which enclosed volumes are holes, and all others are regions";
  const remedy = "Omit it, or add a hole point to each cavity.";
  return packageDiagnostic("region-point", message, remedy, "warning");
}

/** Returns a sentence about points that a command does not use. */
export function unusedPointLines({ regionPoints }: Pick<SurfaceFile, "regionPoints">): string[] {
  const { holes = [], regions = [] } = regionPoints ?? {};
  const counts = [
    ...(holes.length > 0 ? [plural(holes.length, "hole point")] : []),
    ...(regions.length > 0 ? [plural(regions.length, "region point")] : []),
  ];
  return counts.length === 0 ? [] : [`${counts.join(" and ")} not written; \`tetrafront mesh\` uses them`];
}
