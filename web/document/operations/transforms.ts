import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Position } from "../position";
import { over, times, type Quantity } from "../../expressions/quantity";
import { quantityFrameAlong, scaleQuantities, type QuantityPosition } from "../quantity-positions";
import type { Affine } from "../transforms/affine";
import { typedReflection, typedRotation, typedScaling, typedTranslation } from "../transforms/typed-maps";
import { boxOf, middleOf } from "../transforms/middle";
import { offerCopies } from "../transforms/copies";
import { offerTransform, transformStep } from "../transforms/transform";
import { unit, worldFrame } from "../vectors";
import { wholeNumber } from "./number-specs";
import {
  typedNumber,
  typedPosition,
  type FieldExpressions,
  type FieldSpec,
  type FieldValues,
  type Operation,
  type Subject,
} from "./operation";
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
  readonly make: (subject: Subject, values: Values & Joining, typed: TypedFields) => Offer;
  readonly note?: (values: Values, expressions: FieldExpressions) => string;
}

/** The numbers of fields, with the expressions that they were typed as. */
interface TypedFields {
  readonly number: (key: string) => Quantity;
  readonly position: (key: string) => QuantityPosition;
}

const typedFields = (values: FieldValues, expressions?: FieldExpressions): TypedFields => ({
  number: (key) => typedNumber(values, key, expressions),
  position: (key) => typedPosition(values, key, expressions),
});

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
    note: (values, _, expressions = {}) => kind.note?.(values, expressions) ?? "",
    make: (subject, values, expressions) => kind.make(subject, values, typedFields(values, expressions)),
  };
}

/** Moves the selection by a map, or leaves it and adds copies. `map` returns the map applied a number of times. */
function moveOrCopy(
  { project, selection }: Subject,
  map: (count: number) => Affine,
  copies: number,
  options: { readonly label: string; readonly join: boolean },
): Offer {
  if (copies === 0) return offerTransform(project, selection, map(1), options);
  return offerCopies(project, selection, repeated(map, copies), options);
}

/** Returns the map applied once, twice, and so on. */
const repeated = (map: (count: number) => Affine, count: number): Affine[] =>
  Array.from({ length: count }, (_, i) => map(i + 1));

const refuse = (reason: string): Offer => ({ possible: false, reason });

const move = transformOperation({
  id: "transform-move",
  ...texts.move,
  initial: ({ project }) => ({ offset: [pieceExtent(project), 0, 0] as Position, copies: 0 }),
  fields: [position("offset", labels.offset), copiesField],
  make: (subject, { copies, join }, typed) =>
    moveOrCopy(subject, (i) => typedTranslation(scaleQuantities(typed.position("offset"), i)), copies, {
      label: copies > 0 ? texts.duplicate.step : transformStep("move", subject.selection),
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
  // What is different each time comes first: it has the focus.
  fields: [
    degrees("angle", labels.angle),
    direction("axis", labels.axis),
    position("centre", labels.centre),
    copiesField,
  ],
  make: (subject, { axis, copies, join }, typed) => {
    if (!unit(axis)) return refuse(operationStrings.noDirection);
    const [about, along] = [typed.position("centre"), typed.position("axis")];
    const map = (i: number): Affine => typedRotation(about, along, times(i, typed.number("angle")));
    return moveOrCopy(subject, map, copies, { label: transformStep("rotate", subject.selection), join });
  },
});

const scaling = transformOperation({
  id: "transform-scale",
  ...texts.scale,
  initial: (subject) => ({
    centre: middleOf(subject.project, subject.selection),
    factors: [2, 2, 2] as Position,
  }),
  fields: [position("factors", labels.factors), position("centre", labels.centre)],
  make: ({ project, selection }, { join }, typed) => {
    const map = typedScaling(typed.position("centre"), typed.position("factors"));
    return offerTransform(project, selection, map, { label: transformStep("scale", selection), join });
  },
});

/** Gap up to which a selection touches a plane, as a share of its extent: rounding errors of coordinates. */
const touching = 1e-9;

/**
 * Returns a plane that no point of the image crosses. The coordinates of its point suit every axis: 0 if the
 * selection is beside the origin or touches it, as half of a symmetrical model does, otherwise the upper end of the selection.
 */
function likelyMirror({ project, selection }: Subject): {
  readonly point: Position;
  readonly normal: Position;
} {
  const box = boxOf(project, selection);
  if (!box) return { point: [0, 0, 0], normal: worldFrame.x };
  const extent = Math.max(...box.map(([low, high]) => high - low));
  const tolerance = touching * extent;
  const [x, y, z] = box.map(([low, high]) => (low < -tolerance && high > tolerance ? high : 0));
  // In a direction without extent, the image would be the selection itself if this touches the plane.
  const axis = box.findIndex(([low, high]) => high - low > tolerance);
  return {
    point: [x ?? 0, y ?? 0, z ?? 0],
    normal: [worldFrame.x, worldFrame.y, worldFrame.z][axis] ?? worldFrame.x,
  };
}

const mirror = transformOperation({
  id: "transform-mirror",
  ...texts.mirror,
  initial: (subject) => ({ ...likelyMirror(subject), keep: true }),
  fields: [
    position("point", labels.point),
    direction("normal", labels.normal),
    { kind: "switch", key: "keep", label: labels.keep },
  ],
  make: (subject, { normal, keep, join }, typed) => {
    if (!unit(normal)) return refuse(operationStrings.noDirection);
    const map = typedReflection(typed.position("point"), typed.position("normal"));
    return moveOrCopy(subject, () => map, Number(keep), { label: texts.mirror.step, join });
  },
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
  make: ({ project, selection }, { axis, spacing, count, join }, typed) => {
    if (!unit(axis)) return refuse(operationStrings.noDirection);
    if (spacing === 0) return refuse(refusals.nothingMoves);
    const { z } = quantityFrameAlong(typed.position("axis"));
    const step = typed.number("spacing");
    const maps = repeated((i) => typedTranslation(scaleQuantities(z, times(i, step))), count - 1);
    return offerCopies(project, selection, maps, { label: texts.linearArray.step, join });
  },
});

const isFullTurn = (degrees: number): boolean => degrees !== 0 && Math.abs(degrees) % 360 === 0;

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
  make: ({ project, selection }, { axis, total, count, join }, typed) => {
    if (!unit(axis)) return refuse(operationStrings.noDirection);
    if (total === 0) return refuse(refusals.nothingMoves);
    // A full turn has as many steps as copies: the last one would coincide with the first.
    const steps = isFullTurn(total) ? count : count - 1;
    const [about, along] = [typed.position("centre"), typed.position("axis")];
    // A full turn stays one when parameters change: otherwise, the gap at its end would differ from the others.
    const turn = isFullTurn(total) ? total : typed.number("total");
    const angle = (i: number): Quantity => over(times(i, turn), steps);
    const maps = repeated((i) => typedRotation(about, along, angle(i)), count - 1);
    return offerCopies(project, selection, maps, { label: texts.circularArray.step, join });
  },
  note: ({ total }, expressions) =>
    isFullTurn(total) && expressions["total"] !== undefined ? operationStrings.fullTurn : "",
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
