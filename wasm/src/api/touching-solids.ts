/** Names the solids whose triangles intersect, where a surface consists of several. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import { NO_REGION } from "../generated/constants.js";

/**
 * Returns one error per pair of regions of the file whose triangles intersect, according to the diagnostics of an
 * inspection of this surface.
 */
export function touchingSolids(
  { surfaceRegions }: Pick<SurfaceFile, "surfaceRegions">,
  diagnostics: readonly Diagnostic[],
): Diagnostic[] {
  if (surfaceRegions === undefined) return [];
  const { regions, triangleRegions } = surfaceRegions;
  const pairs = new Map<string, Diagnostic>();
  for (const { code, entities, position } of diagnostics) {
    if (code !== "self-intersection" && code !== "duplicate-triangle") continue;
    const [one, other] = entities
      .filter(({ kind }) => kind === "triangle")
      .map(({ index }) =>
        [...triangleRegions.subarray(2 * index, 2 * index + 2)].filter((region) => region !== NO_REGION),
      );
    if (one === undefined || other === undefined || one.some((region) => other.includes(region))) continue;
    const [a = 0, b = 0] = [one[0] ?? 0, other[0] ?? 0].sort((x, y) => x - y);
    const names = [a, b].map((region) => `"${regions[region]?.name ?? ""}"`).join(" and ");
    if (pairs.has(names)) continue;
    const message = `The solids ${names} overlap, or touch in faces with different boundaries`;
    const remedy =
      "Divide the faces where the solids touch (an imprint or fragment operation of the CAD program), or mesh the solids one by one.";
    pairs.set(names, {
      ...packageDiagnostic("touching-solids", message, remedy),
      ...(position && { position }),
    });
  }
  return [...pairs.values()];
}
