import type { Project, ProjectPatch } from "tetrafront";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import { findRecord } from "../entities";
import { coincidenceLength, insertion, withInsertion } from "../insert-shape";
import { loopPolygon } from "../line-samples";
import { planeOfPatch, type PatchPlane } from "../patch-planes";
import { onCircle } from "../pieces/on-circle";
import type { Position } from "../position";
import { ShapeBuilder } from "../shape";
import { addScaled, cross, dot, frameAlong, fromFrame, length, subtract } from "../vectors";
import { replacing } from "./join-points";
import { distanceFrom, flattened, isInside } from "./polygons";

const texts = operationStrings.refusals;

/** Normals are parallel if the sine of their angle is at most this. */
const parallelSine = 1e-6;

export interface Hole {
  /** Id of a planar patch. */
  readonly patch: number;
  readonly centre: Position;
  readonly diameter: number;
}

/**
 * Offers a hole from a planar patch straight through to the planar patch opposite, which must be parallel: a circle in both,
 * and a tube between them.
 */
export function offerHoleThrough(project: Project, hole: Hole, label: string): Offer {
  const { patch, diameter } = hole;
  const plane = planeOfPatch(project, patch);
  if (!plane) return refuse(texts.onePatch);
  const away = dot(subtract(hole.centre, plane.centre), plane.normal);
  const centre = addScaled(hole.centre, plane.normal, -away);
  const radius = diameter / 2;
  if (!holdsCircle(project, patch, plane, centre, radius)) return refuse(texts.outside);
  const opposite = oppositePatch(project, patch, plane, centre);
  if (!opposite) return refuse(texts.noOpposite);
  const exit = addScaled(centre, plane.normal, opposite.distance);
  if (!holdsCircle(project, opposite.patch.id, plane, exit, radius)) return refuse(texts.outsideOpposite);
  const builder = new ShapeBuilder();
  const [near, far] = [centre, exit].map((middle) => {
    const frame = frameAlong(plane.normal, middle);
    const [a = 0, b = 0, c = 0] = [0, 1 / 4, 1 / 2].map((share) =>
      builder.point(fromFrame(frame, onCircle(radius, share, 0))),
    );
    return builder.line("circle", [a, b, c, a]);
  });
  builder.patch("tube", [[near ?? 0], [far ?? 0]], operationStrings.sweeps.hole.patch);
  const made = insertion(project, builder.shape, { join: true });
  const [nearId = 0, farId = 0] = made.lineIds;
  const lists = withInsertion(project, made);
  const withHole = (record: ProjectPatch): ProjectPatch => {
    const circle = record.id === patch ? nearId : record.id === opposite.patch.id ? farId : null;
    return circle === null ? record : { ...record, loops: [...record.loops, [circle]] };
  };
  return {
    possible: true,
    creation: {
      entities: made.patchIds.map((id) => ({ kind: "patch", id })),
      edit: { label, replace: replacing(project, { ...lists, patches: lists.patches.map(withHole) }) },
    },
  };
}

const refuse = (reason: string): Offer => ({ possible: false, reason });

/** Returns whether a circle lies within the outer loop of a patch and outside its holes. */
function holdsCircle(
  project: Project,
  id: number,
  plane: PatchPlane,
  centre: Position,
  radius: number,
): boolean {
  const loops = findRecord(project, "patch", id)?.loops ?? [];
  const polygons = loops.map((loop) => loopPolygon(project, loop));
  return (
    isWithin(polygons, plane, centre) && polygons.every((polygon) => distanceFrom(centre, polygon) > radius)
  );
}

/** Returns whether a position in the plane of loops lies within the first and outside the others. */
function isWithin(
  loops: readonly (readonly Position[])[],
  { normal }: PatchPlane,
  position: Position,
): boolean {
  const frame = frameAlong(normal, position);
  const [outer = [], ...holes] = loops.map((polygon) => flattened(polygon, frame));
  return isInside([0, 0], outer) && !holes.some((hole) => isInside([0, 0], hole));
}

/**
 * Returns the nearest planar patch that the straight line through a centre meets on the inner side, with its distance along
 * the normal; undefined unless it is parallel. On which side the inside is, the nearest of all parallel patches decides.
 */
function oppositePatch(project: Project, own: number, plane: PatchPlane, centre: Position) {
  const tolerance = coincidenceLength(project);
  const candidates = project.patches.flatMap((patch) => {
    if (patch.id === own) return [];
    const other = planeOfPatch(project, patch.id);
    if (!other || length(cross(other.normal, plane.normal)) > parallelSine) return [];
    const distance = dot(subtract(other.centre, centre), plane.normal);
    if (Math.abs(distance) <= tolerance) return [];
    const exit = addScaled(centre, plane.normal, distance);
    const loops = patch.loops.map((loop) => loopPolygon(project, loop));
    return isWithin(loops, plane, exit) ? [{ patch, distance }] : [];
  });
  const inward = candidates.filter(({ distance }) => distance * dot(plane.outward, plane.normal) < 0);
  const nearest = (list: typeof candidates) =>
    list.toSorted((a, b) => Math.abs(a.distance) - Math.abs(b.distance))[0];
  return nearest(inward) ?? nearest(candidates);
}
