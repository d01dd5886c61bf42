/** Whether a surface states the regions of its solids, apart from what is done with them: most surfaces have one solid. */
import type { SurfaceFile } from "../formats/surface-file.js";

/** Returns whether a surface states the regions of several solids. */
export const hasSolids = ({ surfaceRegions, givenRegions }: SurfaceFile): boolean =>
  givenRegions !== undefined && (surfaceRegions?.regions.length ?? 0) > 1;

/** Returns the surface alone: triangles of overlapping solids, and new ones between solids, contradict the given regions. */
export function withoutRegions({ givenRegions: _, ...surface }: SurfaceFile): SurfaceFile {
  return surface;
}
