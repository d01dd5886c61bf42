/** The solids of an STL file that are prepared by themselves, because others of the file touch. */
import { inSteps } from "../calls/yielder.js";
import { solidsOfPatches } from "../formats/patch-solids.js";
import {
  boxOf,
  connectedGroups,
  nearPairs,
  partOfSolids,
  solidUnits,
  type SolidsSurface,
  unitedSurfaces,
} from "../formats/solid-units.js";
import { withSolidRegions } from "./solids.js";
import { withoutRegions } from "./stated-solids.js";
import type { SurfaceMesher } from "./surface-mesher.js";
import type { Mesh } from "../mesh/mesh.js";

/**
 * Returns the surfaces of solids that are prepared together, by their first solids; undefined if all are, or if the file states
 * other solids. Solids that touch are one surface, with their regions; those that may touch, but do not, one each; all others
 * one together. O(n log n) per pair of solids whose boxes are not apart.
 */
export async function solidParts(mesher: SurfaceMesher, given: Mesh): Promise<readonly Mesh[] | undefined> {
  const divided = await inSteps(solidsOfPatches(given));
  if (divided?.surfaceRegions === undefined) return undefined;
  const solids: SolidsSurface = { ...divided, surfaceRegions: divided.surfaceRegions };
  const units = solidUnits(solids);
  if (units.length < 2) return undefined;
  const surfaces = units.map((unit) => withoutRegions(partOfSolids(solids, unit)));
  for (const surface of surfaces) if (!(await isFillable(mesher, [surface]))) return undefined;
  const touching: (readonly [number, number])[] = [];
  for (const pair of nearPairs(surfaces.map(({ points }) => boxOf(points)))) {
    const two = pair.flatMap((unit) => surfaces[unit] ?? []);
    if (!(await isFillable(mesher, two))) touching.push(pair);
  }
  const groups = connectedGroups(units.length, touching);
  if (groups.length < 2) return undefined;
  const parts: SurfaceFile[] = [];
  for (const group of groups) {
    const own = group.flatMap((unit) => units[unit] ?? []).sort((a, b) => a - b);
    const surface = partOfSolids(solids, own);
    parts.push(group.length > 1 ? surface : await apart(mesher, surface));
  }
  return parts;
}

/** Returns solids that do not touch, with the regions on both sides of their triangles: one may lie within another. */
async function apart(mesher: SurfaceMesher, part: SolidsSurface): Promise<Mesh> {
  const { regions } = part.surfaceRegions;
  const located = regions.length < 2 ? part : (await withSolidRegions(mesher, part, part)).surface;
  return withoutRegions({ ...part, surfaceRegions: located.surfaceRegions });
}

async function isFillable(mesher: SurfaceMesher, surfaces: readonly Mesh[]): Promise<boolean> {
  const [first] = surfaces;
  const surface = surfaces.length === 1 && first !== undefined ? first : unitedSurfaces(surfaces);
  return (await mesher.inspectSurface(surface)).isFillable;
}
