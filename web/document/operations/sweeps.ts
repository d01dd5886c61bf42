import { operationStrings } from "../../strings";
import type { Project } from "tetrafront/project";
import type { Entity } from "../entities";
import { planeOfLoop } from "../patch-planes";
import { findRecord } from "../entities";
import { orderLoops } from "../loops";
import type { Position } from "../position";
import { negative, valueOf } from "../../expressions/quantity";
import { quantityFrameAlong, scaleQuantities, valuesOf, type QuantityPosition } from "../quantity-positions";
import { offerExtrusion } from "../transforms/extrude";
import { offerHoleThrough } from "../transforms/hole-through";
import { offerCopies } from "../transforms/copies";
import { offerRevolution } from "../transforms/revolve";
import { typedTranslation } from "../transforms/typed-maps";
import { length, snappedToAxis, unit, worldFrame, zero } from "../vectors";
import type { Typed } from "./feature-numbers";
import { angleBetween, positiveLength } from "./number-specs";
import { typedNumber, typedPosition, type Operation } from "./operation";
import { pieceExtent, sizedOffer } from "./sizes";
import { sweepOperation } from "./solid-sweeps";
import type { FeatureOperation } from "./solids";

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

const extrudedPatches: Operation<Extrusion> = {
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

/** Returns the vector of an extrusion; of one along an axis of coordinates, only its length has an expression. */
function extrusionVector({ direction, distance: along }: Typed<Extrusion>): QuantityPosition {
  return scaleQuantities(quantityFrameAlong(direction).z, along);
}

const extrude = sweepOperation<Extrusion>(extrudedPatches, {
  noun: texts.extrude.noun,
  make: (values, profile) => ({ type: "extrude", profile, vector: extrusionVector(values) }),
  read: (feature) => {
    if (feature.type !== "extrude") return null;
    const { profile, vector } = feature;
    const plain = valuesOf(vector);
    const axis = [0, 1, 2].find((k) => plain.every((part, other) => other === k || part === 0));
    const component = axis === undefined ? undefined : vector[axis];
    const along = component ?? length(plain);
    const isNegative = valueOf(along) < 0;
    const values = {
      direction: unit(plain) ?? worldFrame.z,
      distance: isNegative ? negative(along) : along,
      keepBase: true,
    };
    return { values, profile };
  },
});

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

const revolvedPatches: Operation<Revolution> = {
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

const revolve = sweepOperation<Revolution>(revolvedPatches, {
  noun: texts.revolve.noun,
  make: ({ point, axis, angle }, profile) => ({ type: "revolve", profile, position: point, axis, angle }),
  read: (feature) => {
    if (feature.type !== "revolve") return null;
    const { profile, position, axis, angle } = feature;
    return { values: { point: position, axis, angle, keepBase: true }, profile };
  },
});

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

/** The operations that sweep a profile to patches, or to a solid. */
export const featureSweeps: readonly FeatureOperation[] = [extrude, revolve];

/** The operations that sweep a profile or drill a hole, in the order of the menu. */
export const sweepOperations: readonly Operation[] = [extrude, revolve, offsetCopy, holeThrough];
