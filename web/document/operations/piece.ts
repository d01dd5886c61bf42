import type { Project, SolidFeature } from "tetrafront/project";
import { negative, quantity, valueOf, type Quantities, type Quantity } from "../../expressions/quantity";
import { operationStrings, stepNames } from "../../strings";
import type { Offer } from "../create";
import type { DraftEdit } from "../edit";
import { keepCoordinates } from "../expression-edits";
import { imprinted, type Imprint } from "../imprint/imprint";
import { insertion, withInsertion, type Insertion } from "../insert-shape";
import type { Position } from "../position";
import {
  addQuantities,
  quantitiesFromFrame,
  quantityFrameAlong,
  scaleQuantities,
  storableTexts,
  valuesOf,
  type QuantityPosition,
} from "../quantity-positions";
import { placedIn, type Shape } from "../shape";
import {
  addScaled,
  dot,
  frameAlong,
  frameTowards,
  fromFrame,
  subtract,
  unit,
  zero,
  type Frame,
} from "../vectors";
import { typed, type Typed } from "./feature-numbers";
import {
  typedPosition,
  type FieldExpressions,
  type FieldSpec,
  type FieldValues,
  type Operation,
  type OperationHandle,
  type Subject,
} from "./operation";
import { pieceExtent, withSizes } from "./sizes";
import {
  addedPiece,
  editOf,
  makesField,
  solidIn,
  solidNote,
  withoutPatches,
  type FeatureOperation,
  type PiecePlace,
  type PieceUse,
  type SolidForm,
} from "./solids";
import { startOf } from "./start";

const texts = operationStrings.fields;

/** Values that all solid pieces have. */
export type PiecePlacement = {
  readonly position: Position;
  readonly axis: Position;
  readonly anchor: "base" | "centre";
  readonly join: boolean;
  /** Whether planar faces that overlap faces of the model are shared with it. */
  readonly share: boolean;
  /** Whether it becomes patches, a solid of its own, or changes a solid. */
  readonly makes: PieceUse;
};

/** A handle for a length of a piece whose axis is z and whose base is at the origin. */
export interface LengthHandle<Sizes> {
  readonly key: keyof Sizes & string;
  readonly from: Position;
  /** Unit vector. */
  readonly along: Position;
  /** Distance of the handle from the beginning of its line / the length; 1 if it is not stated. */
  readonly share?: number;
}

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
  readonly middle: (sizes: Quantities<Sizes>) => Quantity;
  /** Returns why the sizes do not fit together; null if they do. */
  readonly refuse?: (sizes: Sizes) => string | null;
  /** The handles of its lengths. */
  readonly handles: (sizes: Sizes) => readonly LengthHandle<Sizes>[];
  /** The piece as a feature of a solid; undefined if it is patches only. */
  readonly feature?: SolidForm<Sizes>;
  /** The piece with its axis along z and its base at the origin. */
  readonly shape: (sizes: Quantities<Sizes>) => Shape<QuantityPosition>;
}

/** Defines the operation that creates a kind of solid piece. */
export function pieceOperation<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
): FeatureOperation<Sizes & PiecePlacement> {
  const operation = createOperation(kind);
  return {
    ...operation,
    edit: (solid, feature, expressions = {}) => {
      const { feature: form, noun } = kind;
      const given = typed<SolidFeature>(feature, expressions);
      const sizes = form?.read(given);
      if (!form || !sizes || !("axis" in feature && "axis" in given && "operation" in feature)) return null;
      const { position, axis } = given;
      const rest = { anchor: "base", join: false, share: false, makes: feature.operation } as const;
      const isFirst = solid.features[0]?.id === feature.id;
      /** The direction that a field does not show; of the place that the axis gives, if it was changed. */
      const xOf = (changed: Position): Position | undefined =>
        "x" in feature && changed.every((part, k) => part === feature.axis[k]) ? feature.x : undefined;
      return editOf<Sizes & PiecePlacement>({
        operation: {
          ...operation,
          fields: (values, subject) => {
            const all = operation.fields(values, subject);
            // The first feature of a solid has nothing to be combined with.
            return isFirst ? all.filter(({ key }) => key !== "makes") : all.map(withoutPatches);
          },
          handles: (values) => handlesOf(kind, values, xOf(values.axis)),
          make: (_subject, values) => ({ possible: false, reason: refusalOf(kind, values) ?? "" }),
        },
        noun,
        solid,
        feature,
        values: { ...sizes, position, axis, ...rest } as Typed<Sizes & PiecePlacement>,
        made: (values, changed) => {
          if (values.makes === "patches" || refusalOf(kind, values) !== null) return null;
          const place = placeOf(kind, values, changed);
          const x = xOf(values.axis) ?? place.x;
          return { ...form.make(sizesOf(values, changed), { ...place, x }), operation: values.makes };
        },
      });
    },
  };
}

function createOperation<Sizes extends FieldValues>(
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
      share: false,
      makes: kind.feature && solidIn({ project, selection }) ? "join" : "patches",
    }),
    fields: (values, { project, selection }) => {
      const hasBase = valueOf(kind.middle(sizesOf(values))) > 0;
      const position = hasBase && values.anchor === "base" ? texts.base : texts.centre;
      const arePatches = values.makes === "patches";
      return [
        ...kind.fields,
        ...(hasBase ? [anchorField] : []),
        { kind: "position", key: "position", label: position },
        { kind: "direction", key: "axis", label: texts.axis },
        ...(kind.feature ? [makesField(solidIn({ project, selection }) !== undefined)] : []),
        ...(arePatches ? [{ kind: "switch", key: "join", label: texts.join } as const] : []),
        ...(arePatches && canShare(kind, project, values)
          ? [{ kind: "switch", key: "share", label: texts.share } as const]
          : []),
      ];
    },
    handles: (values) => handlesOf(kind, values),
    note: (values, subject, expressions = {}) =>
      values.makes === "patches"
        ? noteOf(kind, values, subject, expressions)
        : solidNote(values.makes, subject),
    make: (subject, values, expressions = {}) => makePiece(kind, subject, values, expressions),
    makeLater: (subject, values, solids, expressions) => {
      const { makes } = values;
      if (makes === "patches" || !kind.feature || refusalOf(kind, values) !== null) return null;
      const piece = kind.feature.make(sizesOf(values, expressions), placeOf(kind, values, expressions));
      return addedPiece({ subject, solids, noun: kind.noun, use: makes }, piece);
    },
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

/** A piece in a project: alone, and with shared faces. */
interface Inserted {
  readonly project: Project;
  /** The id of each point of the shape; undefined for points that only lines shared with the project use. */
  readonly pointIds: Insertion["pointIds"];
  readonly alone: Pick<Imprint, "drawn" | "patches">;
  readonly imprint: Imprint;
}

/** The piece that values gave last: its panel asks for it several times. */
const known = new WeakMap<FieldValues, Inserted>();

/** Adds a piece to the lists of a project. The values must be valid. */
function insertPiece<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  project: Project,
  values: Sizes & PiecePlacement,
): Inserted {
  const before = known.get(values);
  if (before?.project === project) return before;
  const { join } = values;
  const plain = kind.shape(sizesOf(values));
  const shape = placedIn({ ...plain, points: plain.points.map(valuesOf) }, frameOf(kind, values));
  const prefix = freePrefix(
    kind.noun,
    project.patches.flatMap(({ name }) => (name === undefined ? [] : [name])),
  );
  const named = {
    ...shape,
    patches: shape.patches.map((patch) => ({ ...patch, name: `${prefix} ${patch.name ?? ""}`.trim() })),
  };
  const made = insertion(project, named, { join });
  const drawn = withInsertion(project, made);
  const imprint = imprinted({ ...project, ...drawn }, new Set(join ? made.patches.map(({ id }) => id) : []));
  const patches = new Map(made.patchIds.map((id) => [id, imprint.patches.get(id) ?? [id]]));
  const inserted = {
    project,
    pointIds: made.pointIds,
    alone: { drawn, patches: new Map(made.patchIds.map((id) => [id, [id]])) },
    imprint: { ...imprint, drawn: { ...drawn, ...imprint.drawn }, patches },
  };
  known.set(values, inserted);
  return inserted;
}

/** Returns the place of a piece: its axis is z, and its base at the origin. */
function frameOf<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  x?: Position,
): Frame {
  const { position, axis, anchor } = values;
  const along = x ? frameTowards(axis, x) : frameAlong(axis);
  const lift = anchor === "centre" ? -valueOf(kind.middle(sizesOf(values))) : 0;
  return { ...along, origin: addScaled(position, along.z, lift) };
}

/** Returns the handles of the lengths and of the position of a piece. */
function handlesOf<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  x?: Position,
): OperationHandle[] {
  if (unit(values.axis) === null) return [];
  const { position } = values;
  const placed = placedHandles(kind, values, x);
  const lengths = placed.map(({ key, along, ...at }, index) => {
    // Of a piece that grows to both sides, a length grows by more than its handle moves.
    const longer = { ...values, [key]: Number(values[key]) + 1 };
    const moved = placedHandles(kind, longer, x)[index]?.position ?? at.position;
    return { key, along, ...at, rate: 1 / dot(subtract(moved, at.position), along) };
  });
  return [...lengths, { key: "position", position, from: position, along: null, rate: 1 }];
}

function placedHandles<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  x: Position | undefined,
) {
  const frame = frameOf(kind, values, x);
  return kind.handles(values).map(({ key, from, along, share = 1 }) => ({
    key,
    from: fromFrame(frame, from),
    along: fromFrame({ ...frame, origin: zero }, along),
    position: fromFrame(frame, addScaled(from, along, share * Number(values[key]))),
  }));
}

/** Returns whether a piece overlaps faces of the model that it can share. */
function canShare<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  project: Project,
  values: Sizes & PiecePlacement,
): boolean {
  return refusalOf(kind, values) === null && insertPiece(kind, project, values).imprint.shared > 0;
}

const refusalOf = <Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
): string | null => (unit(values.axis) ? (kind.refuse?.(values) ?? null) : operationStrings.noDirection);

function makePiece<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  { project }: Subject,
  values: Sizes & PiecePlacement,
  expressions: FieldExpressions,
): Offer {
  const reason = refusalOf(kind, values);
  if (reason !== null) return { possible: false, reason };
  const { alone, imprint, pointIds } = insertPiece(kind, project, values);
  const { drawn, patches } = values.share ? imprint : alone;
  const ids = new Set([...patches.values()].flat());
  const formulas = pieceFormulas(kind, values, expressions) ?? [];
  // Points that the model had keep their own expressions.
  const before = new Set(project.points.map(({ id }) => id));
  const typed = pointIds.flatMap((id, index) =>
    id === undefined || before.has(id) ? [] : [{ id, expressions: formulas[index] }],
  );
  const change: DraftEdit["change"] = (draft) => {
    Object.assign(draft.project, drawn);
    keepCoordinates(draft.project, typed);
  };
  return {
    possible: true,
    creation: {
      entities: [...ids].map((id) => ({ kind: "patch", id })),
      edit: { label: stepNames.add(kind.noun), ...withSizes(project, { change }) },
    },
  };
}

/**
 * Returns the expressions of the coordinates of each point of a piece: none if no field has one. Returns null if one of them
 * would be too long for the file.
 */
function pieceFormulas<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  expressions: FieldExpressions,
): readonly (readonly (string | null)[])[] | null {
  if (Object.keys(expressions).length === 0) return [];
  const frame = quantityFrameOf(kind, values, expressions);
  const { points } = kind.shape(sizesOf(values, expressions));
  return storableTexts(points.map((position) => quantitiesFromFrame(frame, position)));
}

/** As `frameOf`, with the expressions of its numbers. */
function quantityFrameOf<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  expressions: FieldExpressions,
): Frame<QuantityPosition> {
  const frame = quantityFrameAlong(typedPosition(values, "axis", expressions));
  const lift = values.anchor === "centre" ? negative(kind.middle(sizesOf(values, expressions))) : 0;
  const position = typedPosition(values, "position", expressions);
  return { ...frame, origin: addQuantities(position, scaleQuantities(frame.z, lift)) };
}

/** Returns where a piece is as a feature. */
const placeOf = <Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  expressions: FieldExpressions = {},
): PiecePlace => ({
  position: quantityFrameOf(kind, values, expressions).origin,
  axis: typedPosition(values, "axis", expressions),
  x: frameOf(kind, values).x,
});

/** Returns the values of a piece, with the expressions of its numbers. */
function sizesOf<Sizes extends FieldValues>(
  values: Sizes & PiecePlacement,
  expressions: FieldExpressions = {},
) {
  return Object.fromEntries(
    Object.entries(values).map(([key, value]) => [
      key,
      typeof value === "number" ? quantity(value, expressions[key]) : value,
    ]),
  ) as Quantities<Sizes>;
}

/** Says which faces of the model a piece overlaps, and what becomes of them and of the expressions. */
function noteOf<Sizes extends FieldValues>(
  kind: PieceKind<Sizes>,
  values: Sizes & PiecePlacement,
  { project }: Subject,
  expressions: FieldExpressions,
): string {
  if (refusalOf(kind, values) !== null) return "";
  if (!pieceFormulas(kind, values, expressions)) return operationStrings.longExpressions;
  const { shared, isIncomplete } = insertPiece(kind, project, values).imprint;
  const { imprint } = operationStrings;
  if (isIncomplete) return imprint.incomplete;
  if (shared === 0) return "";
  return values.share ? imprint.shared(shared) : imprint.overlaps(shared);
}

/** Returns the noun, with a number from 2 on if names begin with it: "box", "box 2". */
function freePrefix(noun: string, names: readonly string[]): string {
  const isTaken = (prefix: string) => names.some((name) => name === prefix || name.startsWith(`${prefix} `));
  if (!isTaken(noun)) return noun;
  for (let count = 2; ; ++count) if (!isTaken(`${noun} ${count}`)) return `${noun} ${count}`;
}
