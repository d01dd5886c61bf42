import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Position } from "../position";
import {
  reflectionAt,
  repeated,
  rotationAbout,
  scalingAbout,
  translation,
  type Affine,
} from "../transforms/affine";
import { middleOf } from "../transforms/middle";
import { offerCopies } from "../transforms/copies";
import { offerTransform } from "../transforms/transform";
import { length, scale, unit, worldFrame } from "../vectors";
import { wholeNumber } from "./number-specs";
import type { FieldSpec, FieldValues, Operation, Subject } from "./operation";
import { pieceExtent } from "./sizes";

const { transforms: texts, refusals } = operationStrings;
const labels = texts.fields;

type Joining = { readonly join: boolean };

const joinField: FieldSpec = { kind: "switch", key: "join", label: labels.join };
const copiesField = wholeNumber("copies", labels.copies, 0, 1000);
const position = (key: string, label: string): FieldSpec => ({ kind: "position", key, label });
const direction = (key: string, label: string): FieldSpec => ({ kind: "direction", key, label });
const degrees = (key: string, label: string): FieldSpec => ({ kind: "number", key, label, unit: "degrees" });

interface TransformKind<Values extends FieldValues> {
  readonly id: string;
  readonly title: string;
  readonly step: string;
  readonly initial: (subject: Subject) => Values;
  readonly fields: readonly FieldSpec[];
  readonly make: (subject: Subject, values: Values & Joining) => Offer;
}

function transformOperation<Values extends FieldValues>(
  kind: TransformKind<Values>,
): Operation<Values & Joining> {
  const { id, title, step } = kind;
  return {
    id,
    title,
    step,
    action: operationStrings.apply,
    usesSelection: true,
    initial: (subject) => ({ ...kind.initial(subject), join: true }),
    fields: () => [...kind.fields, joinField],
    make: kind.make,
  };
}

/** Moves the selection by a map, or leaves it and adds copies, each moved once more. */
function moveOrCopy(
  { project, selection }: Subject,
  map: Affine,
  copies: number,
  options: { readonly label: string; readonly join: boolean },
): Offer {
  if (copies === 0) return offerTransform(project, selection, map, options);
  return offerCopies(project, selection, repeated(map, copies), options);
}

const refuse = (reason: string): Offer => ({ possible: false, reason });

const move = transformOperation({
  id: "transform-move",
  ...texts.move,
  initial: ({ project }) => ({ offset: [pieceExtent(project), 0, 0] as Position, copies: 0 }),
  fields: [position("offset", labels.offset), copiesField],
  make: (subject, { offset, copies, join }) =>
    moveOrCopy(subject, translation(offset), copies, {
      label: copies > 0 ? texts.duplicate.step : texts.move.step,
      join,
    }),
});

const rotate = transformOperation({
  id: "transform-rotate",
  ...texts.rotate,
  initial: (subject) => ({
    centre: middleOf(subject.project, subject.selection),
    axis: worldFrame.z,
    angle: 90,
    copies: 0,
  }),
  fields: [
    position("centre", labels.centre),
    direction("axis", labels.axis),
    degrees("angle", labels.angle),
    copiesField,
  ],
  make: (subject, { centre, axis, angle, copies, join }) =>
    unit(axis)
      ? moveOrCopy(subject, rotationAbout(centre, axis, angle), copies, { label: texts.rotate.step, join })
      : refuse(operationStrings.noDirection),
});

const scaling = transformOperation({
  id: "transform-scale",
  ...texts.scale,
  initial: (subject) => ({
    centre: middleOf(subject.project, subject.selection),
    factors: [2, 2, 2] as Position,
  }),
  fields: [position("centre", labels.centre), position("factors", labels.factors)],
  make: ({ project, selection }, { centre, factors, join }) =>
    offerTransform(project, selection, scalingAbout(centre, factors), { label: texts.scale.step, join }),
});

const mirror = transformOperation({
  id: "transform-mirror",
  ...texts.mirror,
  initial: () => ({ point: [0, 0, 0] as Position, normal: worldFrame.x, keep: true }),
  fields: [
    position("point", labels.point),
    direction("normal", labels.normal),
    { kind: "switch", key: "keep", label: labels.keep },
  ],
  make: (subject, { point, normal, keep, join }) =>
    unit(normal)
      ? moveOrCopy(subject, reflectionAt(point, normal), Number(keep), { label: texts.mirror.step, join })
      : refuse(operationStrings.noDirection),
});

const linearArray = transformOperation({
  id: "array-linear",
  ...texts.linearArray,
  initial: ({ project }) => ({ axis: worldFrame.x, spacing: 2 * pieceExtent(project), count: 3 }),
  fields: [
    direction("axis", labels.axis),
    { kind: "number", key: "spacing", label: labels.spacing, unit: "length" },
    wholeNumber("count", labels.count, 2, 1000),
  ],
  make: ({ project, selection }, { axis, spacing, count, join }) => {
    const along = unit(axis);
    if (!along) return refuse(operationStrings.noDirection);
    if (length(scale(along, spacing)) === 0) return refuse(refusals.nothingMoves);
    const maps = repeated(translation(scale(along, spacing)), count - 1);
    return offerCopies(project, selection, maps, { label: texts.linearArray.step, join });
  },
});

const circularArray = transformOperation({
  id: "array-circular",
  ...texts.circularArray,
  initial: () => ({ centre: [0, 0, 0] as Position, axis: worldFrame.z, total: 360, count: 6 }),
  fields: [
    position("centre", labels.centre),
    direction("axis", labels.axis),
    degrees("total", labels.total),
    wholeNumber("count", labels.count, 2, 1000),
  ],
  make: ({ project, selection }, { centre, axis, total, count, join }) => {
    if (!unit(axis)) return refuse(operationStrings.noDirection);
    if (total === 0) return refuse(refusals.nothingMoves);
    // A full turn has as many steps as copies: the last one would coincide with the first.
    const steps = Math.abs(total) % 360 === 0 ? count : count - 1;
    const maps = Array.from({ length: count - 1 }, (_, i) =>
      rotationAbout(centre, axis, (total * (i + 1)) / steps),
    );
    return offerCopies(project, selection, maps, { label: texts.circularArray.step, join });
  },
});

/** The operations that transform or copy the selection, in the order of the menu. */
export const transformOperations: readonly Operation[] = [
  move,
  rotate,
  scaling,
  mirror,
  linearArray,
  circularArray,
];

/** Copies the selection once, beside itself. */
export const duplicateOperation: Operation = {
  ...move,
  id: "duplicate",
  title: texts.duplicate.title,
  step: texts.duplicate.step,
  initial: (subject) => ({ ...move.initial(subject), copies: 1 }),
};
