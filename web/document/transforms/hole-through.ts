import type { Project, ProjectPatch } from "tetrafront/project";
import { formulaText, over, valueOf, type Quantity } from "../../expressions/quantity";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import { findRecord } from "../entities";
import { expressionFinder } from "../expression-edits";
import { coincidenceLength, insertion, withInsertion } from "../insert-shape";
import { loopPolygon } from "../line-samples";
import { planeOfPatch, type PatchPlane } from "../patch-planes";
import { onCircle } from "../pieces/on-circle";
import type { Position } from "../position";
import {
  addQuantities,
  dotQuantities,
  isPlain,
  quantitiesFromFrame,
  quantityPosition,
  scaleQuantities,
  storableTexts,
  subtractQuantities,
  valuesOf,
  type QuantityPosition,
} from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { addScaled, cross, dot, frameAlong, length, subtract } from "../vectors";
import { keptCoordinates, keptInstead } from "./mapped-expressions";
import { distanceFrom, flattened } from "./polygons";
import { isInside } from "../planar-loops";

const texts = operationStrings.refusals;

/** Normals are parallel if the sine of their angle is at most this. */
const parallelSine = 1e-6;
/** Components of a unit normal up to this are 0 but for rounding. */
const rounding = 1e-12;

export interface Hole {
  /** Id of a planar patch. */
  readonly patch: number;
  readonly centre: QuantityPosition;
  readonly diameter: Quantity;
}

/**
 * Offers a hole from a planar patch straight through to the planar patch opposite, which must be parallel: a circle in both,
 * and a tube between them.
 */
export function offerHoleThrough(project: Project, hole: Hole, label: string): Offer {
  const { patch } = hole;
  const plane = planeOfPatch(project, patch);
  if (!plane) return refuse(texts.onePatch);
  const typedRadius = over(hole.diameter, 2);
  const radius = valueOf(typedRadius);
  const typedCentre = onPlaneOf(project, patch, plane, hole.centre);
  const centre = valuesOf(typedCentre ?? hole.centre);
  const away = dot(subtract(centre, plane.centre), plane.normal);
  const near = addScaled(centre, plane.normal, -away);
  if (!holdsCircle(project, patch, plane, near, radius)) return refuse(texts.outside);
  const opposite = oppositePatch(project, patch, plane, near);
  if (!opposite) return refuse(texts.noOpposite);
  const far = addScaled(near, plane.normal, opposite.distance);
  if (!holdsCircle(project, opposite.patch.id, plane, far, radius)) return refuse(texts.outsideOpposite);
  const typedExit = typedCentre && onPlaneOf(project, opposite.patch.id, plane, typedCentre);
  const drilled = drilling(plane, [near, far], radius);
  const made = insertion(project, drilled, { join: true });
  const [nearId = 0, farId = 0] = made.lineIds;
  const lists = withInsertion(project, made);
  const withHole = (record: ProjectPatch): ProjectPatch => {
    const circle = record.id === patch ? nearId : record.id === opposite.patch.id ? farId : null;
    return circle === null ? record : { ...record, loops: [...record.loops, [circle]] };
  };
  const kept =
    typedCentre && typedExit && storableTexts(drilling(plane, [typedCentre, typedExit], typedRadius).points);
  return {
    possible: true,
    creation: {
      entities: made.patchIds.map((id) => ({ kind: "patch", id })),
      ...(!kept && { note: operationStrings.numbersKept }),
      edit: {
        label,
        replace: {
          ...lists,
          patches: lists.patches.map(withHole),
          ...keptInstead(project, keptCoordinates(project, made.pointIds, kept ?? [])),
        },
      },
    },
  };
}

/** Returns circles around two centres, and the tube between them. */
function drilling(plane: PatchPlane, centres: readonly [Position, Position], radius: number): Shape;
function drilling(
  plane: PatchPlane,
  centres: readonly [QuantityPosition, QuantityPosition],
  radius: Quantity,
): Shape<QuantityPosition>;
function drilling(
  { normal }: PatchPlane,
  centres: readonly [QuantityPosition, QuantityPosition],
  radius: Quantity,
): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const [near, far] = centres.map((origin) => {
    const frame = { ...frameAlong(normal), origin };
    const [a = 0, b = 0, c = 0] = [0, 1 / 4, 1 / 2].map((share) =>
      builder.point(quantitiesFromFrame(frame, onCircle(radius, share, 0))),
    );
    return builder.line("circle", [a, b, c, a]);
  });
  builder.patch("tube", [[near ?? 0], [far ?? 0]], operationStrings.sweeps.hole.patch);
  return builder.shape;
}

/**
 * Returns where the normal through a position meets the plane of a patch, with the expressions that follow from those of the
 * position and of the patch. Returns null if its normal depends on expressions, as far as that is to be seen: not if it is an
 * axis of coordinates, and all points have the same coordinate along it.
 */
function onPlaneOf(
  project: Project,
  id: number,
  { normal }: PatchPlane,
  position: QuantityPosition,
): QuantityPosition | null {
  const textOf = expressionFinder(project);
  const lines = new Set(findRecord(project, "patch", id)?.loops.flat().map(Math.abs));
  const ids = new Set(project.lines.filter((line) => lines.has(line.id)).flatMap(({ points }) => points));
  const corners = project.points
    .filter((point) => ids.has(point.id))
    .map((point) =>
      quantityPosition(
        point.position,
        [0, 1, 2].map((axis) => textOf({ kind: "point", id: point.id, field: `position.${axis}` })),
      ),
    );
  const [corner] = corners;
  if (!corner) return null;
  const axis = [0, 1, 2].find((k) =>
    normal.every((part, other) => other === k || Math.abs(part) <= rounding),
  );
  if (axis !== undefined) {
    const [x, y, z] = position.map((part, k) => (k === axis ? (corner[k] ?? 0) : part));
    const texts = new Set(corners.map((one) => formulaText(one[axis] ?? 0)));
    return texts.size === 1 ? [x ?? 0, y ?? 0, z ?? 0] : null;
  }
  if (!corners.every(isPlain)) return null;
  const away = dotQuantities(subtractQuantities(corner, position), normal);
  return addQuantities(position, scaleQuantities(normal, away));
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
