/** Numbers of elements that are asked for, cycle by cycle, until the meshes have the wanted number. */
import type { Mesh } from "../mesh/mesh.js";

/** Largest factor, either way, by which a number of elements is corrected. */
const MAX_CORRECTION = 2;

/**
 * Returns the number of elements to ask for so that a mesh has the wanted number: corrected by the factor by which the given mesh has
 * more or fewer elements than its sizes asked for, at most 2 either way. `asked`: the number that those sizes asked for.
 */
export function correctedNumber(
  wanted: number | undefined,
  { tetrahedra }: Pick<Mesh, "tetrahedra">,
  asked: number | undefined,
): number | undefined {
  if (wanted === undefined || asked === undefined) return wanted;
  // Rounded as in reports, so that a resumed run computes the same.
  const excess = tetrahedra.length / 4 / Math.max(1, Math.round(asked));
  return Math.max(1, Math.round(wanted / Math.min(MAX_CORRECTION, Math.max(1 / MAX_CORRECTION, excess))));
}
