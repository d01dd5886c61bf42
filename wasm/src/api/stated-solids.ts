/** Whether a surface states the regions of its solids, apart from what is done with them: most surfaces have one solid. */
import type { Mesh } from "../mesh/mesh.js";

/** Returns whether a surface states the regions of several solids. */
export const hasSolids = ({ surfaceRegions }: Mesh): boolean =>
  surfaceRegions?.areMeshed === true && surfaceRegions.regions.length > 1;

/** Returns the surface with the names of its regions only: triangles of overlapping solids, and new ones between solids, contradict what is meshed. */
export function withoutRegions<Surface extends Pick<Mesh, "surfaceRegions">>(surface: Surface): Surface {
  const { surfaceRegions } = surface;
  return surfaceRegions ? { ...surface, surfaceRegions: { ...surfaceRegions, areMeshed: false } } : surface;
}
