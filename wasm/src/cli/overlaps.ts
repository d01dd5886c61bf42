/** Finds solids of a surface whose volumes overlap. */
import type { Mesher } from "../api/mesher-interface.js";
import { overlapWarning, touchingPairs, type TouchingPair } from "../api/touching-solids.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import type { SurfaceFile } from "../formats/surface-file.js";

/** Smallest common volume, relative to the smaller solid: curved faces that touch overlap by their deviation. */
const SMALLEST_OVERLAP = 1e-3;

/** Returns one warning per pair of solids that share a volume, of those whose triangles intersect. */
export async function overlappingSolids(
  mesher: Mesher,
  given: SurfaceFile,
  diagnostics: readonly Diagnostic[],
): Promise<Diagnostic[]> {
  const { surfaceRegions } = given;
  const warnings: Diagnostic[] = [];
  for (const pair of touchingPairs(surfaceRegions, diagnostics))
    if (await isOverlap(mesher, given, pair)) warnings.push(overlapWarning(surfaceRegions, pair));
  return warnings;
}

/** Two solids share a volume if the repaired surface of both encloses less than they do one by one. */
async function isOverlap(mesher: Mesher, given: SurfaceFile, { regions }: TouchingPair): Promise<boolean> {
  const volumes = regions.map((region) => volumeOf(given, region));
  const triangles = trianglesOf(given, new Set<number>(regions));
  const { surface } = await mesher.repairSurface({ points: given.points, triangles });
  const { isFillable, volume } = await mesher.inspectSurface(surface);
  const [one = 0, other = 0] = volumes;
  return isFillable && one + other - volume > SMALLEST_OVERLAP * Math.min(one, other);
}

function trianglesOf({ triangles, surfaceRegions }: SurfaceFile, regions: ReadonlySet<number>): Uint32Array {
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  return triangles.filter((_, corner) => {
    const side = 2 * Math.floor(corner / 3);
    return regions.has(sides[side] ?? -1) || regions.has(sides[side + 1] ?? -1);
  });
}

/** Returns the volume of a solid, whose triangles face outward where it is on their first side. */
function volumeOf({ points, triangles, surfaceRegions }: SurfaceFile, region: number): number {
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  let sixfold = 0;
  for (let t = 0; t < triangles.length / 3; t++) {
    const sign = Number(sides[2 * t] === region) - Number(sides[2 * t + 1] === region);
    if (sign === 0) continue;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    sixfold += sign * sixfoldVolume(points, 0, a, b, c).volume;
  }
  return sixfold / 6;
}
