import type { Project } from "tetrafront/project";
import type { Entity } from "../entities";
import { findRecord } from "../entities";
import type { Position } from "../position";
import { planeOfPatch } from "../patch-planes";
import { mean, snappedToAxis, worldFrame, zero } from "../vectors";

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
    if (plane) return { position: plane.centre, axis: snappedToAxis(plane.outward) };
  }
  const positions = selection.flatMap(({ kind, id }) => {
    const record = kind === "point" || kind === "background-node" ? findRecord(project, kind, id) : undefined;
    return record ? [record.position] : [];
  });
  return { position: positions.length > 0 ? mean(positions) : zero, axis: worldFrame.z };
}
