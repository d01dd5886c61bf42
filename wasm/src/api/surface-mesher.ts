/** The calls of a mesher with which surfaces are prepared. */
import type { RunControl } from "../engine/control.js";
import type { Mesher } from "./mesher-interface.js";

export type SurfaceMesher = Pick<
  Mesher,
  "inspectSurface" | "repairSurface" | "locateRegions" | "splitPatches"
>;

/** Returns the calls of a mesher with a control for all those that are given none. */
export function withControl(mesher: SurfaceMesher, control: RunControl): SurfaceMesher {
  return {
    inspectSurface: (surface, options, own = control) => mesher.inspectSurface(surface, options, own),
    repairSurface: (surface, options, own = control) => mesher.repairSurface(surface, options, own),
    locateRegions: (surface, own = control) => mesher.locateRegions(surface, own),
    splitPatches: (surface, options, own = control) => mesher.splitPatches(surface, options, own),
  };
}
