import type { Project } from "tetrafront";
import type { Entity } from "../entities";
import { findRecord } from "../entities";
import type { Position } from "../position";
import { planeOfPatch } from "../patch-planes";
import { distance, mean, worldFrame, zero } from "../vectors";

/** Directions that differ by less are the same but for rounding. */
const tolerance = 1e-12;

/** Returns a direction exactly along an axis of coordinates if it is so but for rounding: it is then shown as this axis. */
function rounded(direction: Position): Position {
  const [x = 0, y = 0, z = 0] = direction.map((component) => Math.round(component) + 0);
  const axis: Position = [x, y, z];
  return distance(axis, direction) < tolerance ? axis : direction;
}

/**
 * Returns where a new piece begins: on a selected planar patch, pointing away from the model; at selected points; or at
 * the origin.
 */
export function startOf(
  project: Project,
  selection: readonly Entity[],
): { readonly position: Position; readonly axis: Position } {
  const [only] = selection;
  if (selection.length === 1 && only?.kind === "patch") {
    const plane = planeOfPatch(project, only.id);
    if (plane) return { position: plane.centre, axis: rounded(plane.outward) };
  }
  const positions = selection.flatMap(({ kind, id }) => {
    const record = kind === "point" || kind === "background-node" ? findRecord(project, kind, id) : undefined;
    return record ? [record.position] : [];
  });
  return { position: positions.length > 0 ? mean(positions) : zero, axis: worldFrame.z };
}
