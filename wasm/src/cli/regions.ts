/** Uses the points of a file that mark regions and holes of its surface. */
import type { Mesher } from "../api/mesher-interface.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { SurfaceFile } from "../formats/surface-file.js";

export interface Located {
  readonly surface: SurfaceFile;
  /** Warnings about points without effect. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Returns the surface with its regions located, unchanged if its file has no such points. */
export async function located(mesher: Mesher, surface: SurfaceFile, control?: RunControl): Promise<Located> {
  return surface.regionPoints === undefined
    ? { surface, diagnostics: [] }
    : mesher.locateRegions(surface, control);
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
