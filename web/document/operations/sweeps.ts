import { operationStrings } from "../../strings";
import type { Project } from "tetrafront/project";
import type { Entity } from "../entities";
import { planeOfLoop } from "../patch-planes";
import { findRecord } from "../entities";
import { orderLoops } from "../loops";
import type { Position } from "../position";
import { quantityFrameAlong, scaleQuantities } from "../quantity-positions";
import { offerExtrusion } from "../transforms/extrude";
import { offerHoleThrough } from "../transforms/hole-through";
import { offerCopies } from "../transforms/copies";
import { offerRevolution } from "../transforms/revolve";
import { typedTranslation } from "../transforms/typed-maps";
import { snappedToAxis, unit, worldFrame, zero } from "../vectors";
import { angleBetween, positiveLength } from "./number-specs";
import { typedNumber, typedPosition, type Operation } from "./operation";
import { pieceExtent, sizedOffer } from "./sizes";

const { sweeps: texts, refusals } = operationStrings;
const labels = texts.fields;

/** Returns the plane of the first selected patch, or of the selected lines. */
function selectedPlane(project: Project, selection: readonly Entity[]) {
  const patch = selection.find(({ kind }) => kind === "patch");
  if (patch) return planeOfLoop(project, findRecord(project, "patch", patch.id)?.loops[0] ?? []);
  const found = orderLoops(
    project,
    selection.flatMap(({ kind, id }) => (kind === "line" ? [id] : [])),
  );
  return found.success ? planeOfLoop(project, found.loops[0] ?? []) : undefined;
}

const normalOf = (project: Project, selection: readonly Entity[]): Position =>
  snappedToAxis(selectedPlane(project, selection)?.outward ?? worldFrame.z);

type Extrusion = { readonly direction: Position; readonly distance: number; readonly keepBase: boolean };

const extrude: Operation<Extrusion> = {
  id: "extrude",
  ...texts.extrude,
  action: operationStrings.apply,
  usesSelection: true,
  initial: ({ project, selection }) => ({
    direction: normalOf(project, selection),
    distance: pieceExtent(project),
    keepBase: true,
  }),
  fields: () => [
    // First, so that it can be typed at once.
    { kind: "number", key: "distance", label: labels.distance, unit: "length" },
    { kind: "direction", key: "direction", label: labels.direction },
    { kind: "switch", key: "keepBase", label: labels.keepBase },
  ],
  make: ({ project, selection }, values, expressions) => {
    const { direction, keepBase } = values;
    if (!unit(direction)) return { possible: false, reason: operationStrings.noDirection };
    const along = quantityFrameAlong(typedPosition(values, "direction", expressions)).z;
    const vector = scaleQuantities(along, typedNumber(values, "distance", expressions));
    const options = { label: texts.extrude.step, keepBase };
    return sizedOffer(project, offerExtrusion(project, selection, vector, options));
  },
};

type Offset = { readonly distance: number };

const offsetCopy: Operation<Offset> = {
  id: "offset-copy",
  ...texts.offset,
  action: operationStrings.apply,
  usesSelection: true,
  initial: ({ project }) => ({ distance: pieceExtent(project) }),
  fields: () => [{ kind: "number", key: "distance", label: labels.distance, unit: "length" }],
  make: ({ project, selection }, values, expressions) => {
    if (!selectedPlane(project, selection)) return { possible: false, reason: refusals.noProfile };
    const distance = typedNumber(values, "distance", expressions);
    const offset = scaleQuantities(normalOf(project, selection), distance);
    return offerCopies(project, selection, [typedTranslation(offset)], {
      label: texts.offset.step,
      join: true,
    });
  },
};

type Revolution = {
  readonly point: Position;
  readonly axis: Position;
  readonly angle: number;
  readonly keepBase: boolean;
};

const revolve: Operation<Revolution> = {
  id: "revolve",
  ...texts.revolve,
  action: operationStrings.apply,
  usesSelection: true,
  initial: () => ({ point: zero, axis: worldFrame.z, angle: 360, keepBase: true }),
  fields: ({ angle }) => [
    { kind: "position", key: "point", label: labels.point },
    { kind: "direction", key: "axis", label: labels.axis },
    angleBetween("angle", labels.angle, -360, 360),
    ...(Math.abs(angle) < 360 ? [{ kind: "switch", key: "keepBase", label: labels.keepBase } as const] : []),
  ],
  note: ({ angle }, _, expressions) =>
    Math.abs(angle) >= 360 && expressions?.["angle"] !== undefined ? operationStrings.fullTurn : "",
  make: ({ project, selection }, values, expressions) => {
    const revolution = {
      point: typedPosition(values, "point", expressions),
      axis: typedPosition(values, "axis", expressions),
      angle: typedNumber(values, "angle", expressions),
    };
    const options = { label: texts.revolve.step, keepBase: values.keepBase };
    return sizedOffer(project, offerRevolution(project, selection, revolution, options));
  },
};

type HoleValues = { readonly diameter: number; readonly centre: Position };

const holeThrough: Operation<HoleValues> = {
  id: "hole-through",
  ...texts.hole,
  action: operationStrings.create,
  usesSelection: true,
  initial: ({ project, selection }) => ({
    diameter: pieceExtent(project),
    centre: selectedPlane(project, selection)?.centre ?? zero,
  }),
  fields: () => [
    positiveLength("diameter", labels.diameter),
    { kind: "position", key: "centre", label: labels.centre },
  ],
  make: ({ project, selection }, values, expressions) => {
    const [only, ...others] = selection;
    if (only?.kind !== "patch" || others.length > 0) return { possible: false, reason: refusals.onePatch };
    const centre = typedPosition(values, "centre", expressions);
    const diameter = typedNumber(values, "diameter", expressions);
    return offerHoleThrough(project, { patch: only.id, centre, diameter }, texts.hole.step);
  },
};

/** The operations that sweep a profile or drill a hole, in the order of the menu. */
export const sweepOperations: readonly Operation[] = [extrude, revolve, offsetCopy, holeThrough];
