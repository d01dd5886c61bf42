/** Grids without second stretchings, for pages that load nothing of projects. */
import type { GridArrays } from "../generated/constants.js";

/** Returns the second stretchings of such a grid. The arrays are new each time, because they are transferred. */
export function noSecondStretchings(): GridArrays["secondStretchings"] {
  return { stretching: new Float64Array(), direction: new Float64Array() };
}
