import { bodySurface, type Project } from "tetrafront/project";
import type { Entity } from "../entities";
import { bodyOfPatch, findRecord } from "../entities";
import { patchFacts } from "../patch-facts";
import type { Position } from "../position";
import { planeOfPatch } from "../patch-planes";
import { mean, snappedToAxis, worldFrame, zero } from "../vectors";

/** Returns what is known of a patch of a solid. */
function faceOf(project: Project, id: number) {
  const body = bodyOfPatch(project, id);
  // Other bodies may have millions of triangles.
  if (!body?.features) return undefined;
  return patchFacts(
    bodySurface(body),
    body.patches.findIndex((patch) => patch.id === id),
    body.placement,
  );
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
    if (plane) return { position: plane.centre, axis: snappedToAxis(plane.outward) };
  }
  const face = selection.length === 1 && only?.kind === "body-patch" ? faceOf(project, only.id) : undefined;
  if (face?.normal) return { position: face.centre, axis: snappedToAxis(face.normal) };
  const positions = selection.flatMap(({ kind, id }) => {
    const record = kind === "point" || kind === "background-node" ? findRecord(project, kind, id) : undefined;
    return record ? [record.position] : [];
  });
  return { position: positions.length > 0 ? mean(positions) : zero, axis: worldFrame.z };
}
