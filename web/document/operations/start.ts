import { bodyBox } from "tetrafront/internal";
import { bodySurface, type Project, type ProjectBody } from "tetrafront/project";
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

interface Start {
  readonly position: Position;
  readonly axis: Position;
}

/**
 * Returns where a new piece begins: on a selected planar patch, pointing away from the model; at selected points; or at
 * the origin.
 */
export function startOf(project: Project, selection: readonly Entity[]): Start {
  return selectedStart(project, selection) ?? { position: zero, axis: worldFrame.z };
}

/** Returns where a hole into a solid begins: at what is selected, or above the middle of the solid, on its highest plane. */
export function holeStart(project: Project, selection: readonly Entity[], solid: ProjectBody): Start {
  const selected = selectedStart(project, selection);
  if (selected) return selected;
  const [low, high] = bodyBox(solid);
  return {
    position: [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[2]],
    axis: worldFrame.z,
  };
}

function selectedStart(project: Project, selection: readonly Entity[]): Start | undefined {
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
  return positions.length === 0 ? undefined : { position: mean(positions), axis: worldFrame.z };
}
