import { operationStrings, stepNames } from "../../strings";
import type { Offer } from "../create";
import { createShape } from "../insert-shape";
import type { Position } from "../position";
import { placedIn, type Shape } from "../shape";
import { frameAlong, scale, unit } from "../vectors";
import type { FieldSpec, FieldValues, Operation, Subject } from "./operation";
import { pieceExtent, withSizes } from "./sizes";
import { startOf } from "./start";

const texts = operationStrings.fields;

/** Values that all solid pieces have. */
export type PiecePlacement = {
  readonly position: Position;
  readonly axis: Position;
  readonly anchor: "base" | "centre";
  readonly join: boolean;
};

/** What distinguishes a kind of solid piece. */
export interface PieceKind<Sizes extends FieldValues> {
  readonly id: string;
  /** The noun: "box". Also the beginning of the names of its patches. */
  readonly noun: string;
  readonly title: string;
  /** Sizes at first, for a piece of about the given extent. */
  readonly sizes: (extent: number) => Sizes;
  readonly fields: readonly FieldSpec[];
  /** Distance from the base to the centre along the axis; 0 if the position is always that of the centre. */
  readonly middle: (sizes: Sizes) => number;
  /** Returns why the sizes do not fit together; null if they do. */
  readonly refuse?: (sizes: Sizes) => string | null;
  /** The piece with its axis along z and its base at the origin. */
  readonly shape: (sizes: Sizes) => Shape;
}

/** Defines the operation that creates a kind of solid piece. */
export function pieceOperation<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
): Operation<Sizes & PiecePlacement> {
  return {
    id: kind.id,
    title: kind.title,
    step: stepNames.add(kind.noun),
    action: operationStrings.create,
    usesSelection: false,
    initial: ({ project, selection }) => ({
      ...kind.sizes(pieceExtent(project)),
      ...startOf(project, selection),
      anchor: "base" as const,
      join: true,
    }),
    fields: (values) => [
      ...kind.fields,
      ...(kind.middle(values) > 0 ? [anchorField] : []),
      { kind: "position", key: "position", label: values.anchor === "base" ? texts.base : texts.centre },
      { kind: "direction", key: "axis", label: texts.axis },
      { kind: "switch", key: "join", label: texts.join },
    ],
    make: (subject, values) => makePiece(kind, subject, values),
  };
}

const anchorField: FieldSpec = {
  kind: "choice",
  key: "anchor",
  label: texts.anchor,
  choices: [
    { value: "base", label: texts.anchors.base },
    { value: "centre", label: texts.anchors.centre },
  ],
};

function makePiece<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  { project }: Subject,
  values: Sizes & PiecePlacement,
): Offer {
  const { position, axis, anchor, join } = values;
  const reason = unit(axis) ? kind.refuse?.(values) : operationStrings.noDirection;
  if (reason) return { possible: false, reason };
  const along = frameAlong(axis);
  const lift = anchor === "centre" ? -kind.middle(values) : 0;
  const origin = position.map((x, k) => x + (scale(along.z, lift)[k] ?? 0)) as unknown as Position;
  const shape = placedIn(kind.shape(values), { ...along, origin });
  const prefix = freePrefix(
    kind.noun,
    project.patches.flatMap(({ name }) => (name === undefined ? [] : [name])),
  );
  const named = {
    ...shape,
    patches: shape.patches.map((patch) => ({ ...patch, name: `${prefix} ${patch.name ?? ""}`.trim() })),
  };
  const { edit, entities } = createShape(project, named, stepNames.add(kind.noun), { join });
  if (!("change" in edit)) return { possible: false, reason: operationStrings.noDirection };
  return { possible: true, creation: { entities, edit: { ...edit, ...withSizes(project, edit) } } };
}

/** Returns the noun, with a number from 2 on if names begin with it: "box", "box 2". */
function freePrefix(noun: string, names: readonly string[]): string {
  const isTaken = (prefix: string) => names.some((name) => name === prefix || name.startsWith(`${prefix} `));
  if (!isTaken(noun)) return noun;
  for (let count = 2; ; ++count) if (!isTaken(`${noun} ${count}`)) return `${noun} ${count}`;
}
