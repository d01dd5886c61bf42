/** Whether a surface states the regions of its solids, apart from what is done with them: most surfaces have one solid. */
import type { Mesh } from "../mesh/mesh.js";

/** Returns whether a surface states the regions of several solids. */
export const hasSolids = ({ surfaceRegions, givenRegions }: Mesh): boolean =>
  givenRegions !== undefined && (surfaceRegions?.regions.length ?? 0) > 1;

/** Returns the surface alone: triangles of overlapping solids, and new ones between solids, contradict the given regions. */
export function withoutRegions<Surface extends { readonly givenRegions?: unknown }>({
  givenRegions: _,
  ...surface
}: Surface): Omit<Surface, "givenRegions"> {
  return surface;
}
