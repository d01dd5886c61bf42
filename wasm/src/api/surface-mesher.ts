/** The calls of a mesher with which surfaces are prepared. */
import type { RunControl } from "../engine/control.js";
import type { Mesher } from "./mesher-interface.js";

export type SurfaceMesher = Pick<
  Mesher,
  "inspectSurface" | "repairSurface" | "locateRegions" | "splitPatches"
>;

/** Returns the calls of a mesher with a control for those that are given none. `next`: returns the control of the next call. */
export function withControl(mesher: SurfaceMesher, next: () => RunControl): SurfaceMesher {
  return {
    inspectSurface: (surface, options, own = next()) => mesher.inspectSurface(surface, options, own),
    repairSurface: (surface, options, own = next()) => mesher.repairSurface(surface, options, own),
    locateRegions: (surface, own = next()) => mesher.locateRegions(surface, own),
    splitPatches: (surface, options, own = next()) => mesher.splitPatches(surface, options, own),
  };
}
