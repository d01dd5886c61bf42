/** Names the solids whose triangles intersect, where a surface consists of several. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { NO_REGION } from "../generated/constants.js";
import type { SurfaceRegions } from "../mesh/file-mesh.js";

/** Two solids with intersecting triangles: indices of their regions, the smaller first. */
export interface TouchingPair {
  readonly regions: readonly [number, number];
  /** Where two of the triangles intersect. */
  readonly position: Diagnostic["position"];
}

/**
 * Returns the pairs of solids whose triangles intersect, according to the diagnostics of an inspection. `given`: the
 * regions of the surface whose triangles the diagnostics number, which is the one before a repair.
 */
export function touchingPairs(
  given: SurfaceRegions | undefined,
  diagnostics: readonly Diagnostic[],
): TouchingPair[] {
  if (given === undefined) return [];
  const { triangleRegions } = given;
  const pairs = new Map<string, TouchingPair>();
  for (const { code, entities, position } of diagnostics) {
    if (code !== "self-intersection" && code !== "duplicate-triangle") continue;
    const [one = [], other = []] = entities
      .filter(({ kind }) => kind === "triangle")
      // The index of a triangle of a filled hole is not one of the given surface.
      .map(({ index, label }) => (label.startsWith("filled") ? [] : sidesOf(triangleRegions, index)));
    const [first, second] = [one[0], other[0]];
    if (first === undefined || second === undefined || one.some((region) => other.includes(region))) continue;
    const regions = first < second ? ([first, second] as const) : ([second, first] as const);
    const key = regions.join(" ");
    if (!pairs.has(key)) pairs.set(key, { regions, position });
  }
  return [...pairs.values()];
}

function sidesOf(triangleRegions: Uint32Array, triangle: number): number[] {
  return [...triangleRegions.subarray(2 * triangle, 2 * triangle + 2)].filter(
    (region) => region !== NO_REGION,
  );
}

/** Returns one error per pair of solids whose triangles intersect. The parameters are those of `touchingPairs`. */
export function touchingSolids(
  given: SurfaceRegions | undefined,
  diagnostics: readonly Diagnostic[],
): Diagnostic[] {
  return touchingPairs(given, diagnostics).map(({ regions, position }) => {
    const message = `The solids ${namesOf(given, regions)} overlap, or touch in faces with different boundaries`;
    const remedy =
      "Divide the faces where the solids touch (an imprint or fragment operation of the CAD program), or mesh the solids one by one.";
    return { ...packageDiagnostic("touching-solids", message, remedy), ...(position && { position }) };
  });
}

/** Returns a warning that two solids share a volume. */
export function overlapWarning(
  given: SurfaceRegions | undefined,
  { regions, position }: TouchingPair,
): Diagnostic {
  const message = `The solids ${namesOf(given, regions)} overlap. The repair joins what overlaps, and a solid may lose its region`;
  const remedy = "Move the solids apart, or subtract one from the other.";
  return {
    ...packageDiagnostic("touching-solids", message, remedy, "warning"),
    ...(position && { position }),
  };
}

function namesOf(given: SurfaceRegions | undefined, regions: readonly number[]): string {
  return regions.map((region) => `"${given?.regions[region]?.name ?? ""}"`).join(" and ");
}
