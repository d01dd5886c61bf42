import type { Project, ProjectBody, SolidFeature } from "tetrafront/project";
import type { Quantities } from "../../expressions/quantity";
import { bodyStepNames, operationStrings, stepNames } from "../../strings";
import { replaceBody } from "../body-edits";
import type { Offer } from "../create";
import type { ProjectEdit } from "../edit";
import { bodiesOf, bodyLabel, type Entity } from "../entities";
import { turnOf } from "../placement";
import type { Position } from "../position";
import type { QuantityPosition } from "../quantity-positions";
import { zero } from "../vectors";
import { featureLabel } from "./feature-names";
import { handlesInView } from "./feature-view";
import { expressionsIn, plain, withFeatureExpressions, type Typed } from "./feature-numbers";
import type { FieldExpressions, FieldSpec, FieldValues, Operation, SolidMaker, Subject } from "./operation";

const texts = operationStrings.fields;

/** What a piece becomes: patches, a solid of its own, or a change of a solid. */
export type PieceUse = "patches" | "new" | "join" | "cut" | "intersect";

type Without<One, Key extends PropertyKey> = One extends unknown ? Omit<One, Key> : never;

/** A feature that has not been added to a list. */
export type NewFeature = Without<SolidFeature, "id">;

/** A piece without what it does to a solid. */
export type NewPiece = Without<Extract<SolidFeature, { readonly operation: unknown }>, "id" | "operation">;

/** Where a piece is: its base is at the position, and its axis along z. */
export interface PiecePlace {
  readonly position: QuantityPosition;
  readonly axis: QuantityPosition;
  readonly x: Position | undefined;
}

/** How a piece is a feature of a solid. */
export interface SolidForm<Sizes extends object> {
  make(sizes: Quantities<Sizes>, place: PiecePlace): Typed<NewPiece>;
  /** Returns the sizes of such a feature. */
  read(feature: Typed<SolidFeature>): Quantities<Sizes> | null;
}

/** A body with a list of features. */
export type Solid = ProjectBody & { readonly features: readonly SolidFeature[] };

export const isSolid = (body: ProjectBody): body is Solid => body.features !== undefined;

/** Returns the solids of a project. */
export const solidsOf = (project: Project): Solid[] => bodiesOf(project).filter(isSolid);

/** Returns the solid that a selection means: the selected one, that of selected patches, or the only one. */
export function solidIn({ project, selection }: Subject): Solid | undefined {
  const solids = solidsOf(project);
  const selected = solids.find((solid) => selection.some((entity) => isPartOf(solid, entity)));
  return selected ?? (solids.length === 1 ? solids[0] : undefined);
}

function isPartOf(solid: Solid, { kind, id }: Entity): boolean {
  if (kind === "body") return solid.id === id;
  return kind === "body-patch" && solid.patches.some((patch) => patch.id === id);
}

export function solidNote(use: Exclude<PieceUse, "patches">, subject: Subject): string {
  const solid = use === "new" ? undefined : solidIn(subject);
  return solid && use !== "new" ? texts.solidNote[use](bodyLabel(solid)) : texts.solidNote.new;
}

/** The choice of what a piece becomes. */
export const makesField = (hasSolid: boolean): FieldSpec => ({
  kind: "choice",
  key: "makes",
  label: texts.makes,
  testId: "piece-operation",
  choices: (["patches", "new", ...(hasSolid ? (["join", "cut", "intersect"] as const) : [])] as const).map(
    (value) => ({ value, label: texts.operations[value] }),
  ),
});

/** A feature stays one. */
export const withoutPatches = (field: FieldSpec): FieldSpec =>
  field.kind === "choice" && field.key === "makes"
    ? { ...field, choices: field.choices.filter(({ value }) => value !== "patches") }
    : field;

/** Returns the next id of a list of features. */
export const nextFeatureId = (features: readonly SolidFeature[]): number =>
  features.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;

interface Addition {
  readonly subject: Subject;
  readonly solids: SolidMaker;
  /** "box". */
  readonly noun: string;
  readonly use: Exclude<PieceUse, "patches">;
}

/** Makes a new solid of a piece, or adds it to the features of the solid of the selection. */
export async function addedPiece(
  { subject, solids, noun, use }: Addition,
  piece: Typed<NewPiece>,
): Promise<Offer> {
  const { project } = subject;
  const solid = use === "new" ? undefined : solidIn(subject);
  const given = { ...piece, operation: solid ? use : "new" } as Typed<NewFeature>;
  if (solid) return addedFeature({ project, solids, solid }, given, stepNames.add(noun));
  const feature = withId(given, 1);
  const body = await solids.bodyOf(project, { name: noun }, [feature]);
  const label = stepNames.add(noun);
  const expressions = withFeatureExpressions(project, body.id, feature, expressionsIn(given));
  const edit: ProjectEdit = { label, replace: { bodies: [...bodiesOf(project), body], expressions } };
  return { possible: true, creation: { entities: [{ kind: "body", id: body.id }], edit } };
}

/** Returns a feature that is in a list, without the expressions of its numbers. */
const withId = (feature: Typed<NewFeature>, id: number): SolidFeature => ({
  ...plain<NewFeature>(feature),
  id,
});

export interface SolidChange {
  readonly project: Project;
  readonly solids: SolidMaker;
  readonly solid: Solid;
}

/** Offers a solid with one more feature. */
export async function addedFeature(
  { solid, ...change }: SolidChange,
  given: Typed<NewFeature>,
  label: string,
): Promise<Offer> {
  const placed = withoutPlacement(solid);
  const feature = withId(given, nextFeatureId(placed.features));
  return offered({ ...change, solid: placed }, [...placed.features, feature], feature, given, label);
}

/** Offers a solid in which a feature has other values. What the values do not say stays. */
async function changedFeature(
  change: SolidChange,
  before: SolidFeature,
  given: Typed<NewFeature>,
  label: string,
): Promise<Offer> {
  const feature = { ...before, ...withId(given, before.id) };
  const features = change.solid.features.map((one) => (one.id === feature.id ? feature : one));
  return offered(change, features, feature, given, label);
}

/**
 * Returns a solid whose placement is a feature, so that the next feature has the coordinates of the view. Throws if it was scaled,
 * which no feature does.
 */
export function withoutPlacement({ placement, ...solid }: Solid): Solid {
  if (!placement) return solid;
  const { position: translation, rotation, scale = 1 } = placement;
  if (scale !== 1) throw new Error(operationStrings.solids.scaled);
  const turn = rotation && turnOf(rotation);
  const move: SolidFeature = {
    id: nextFeatureId(solid.features),
    type: "move",
    ...(translation && { translation }),
    ...(turn && { rotation: { position: zero, ...turn } }),
  };
  return { ...solid, features: [...solid.features, move] };
}

/** Offers a solid with other features. Refused if the one that is added or changed fails; others that fail are a note. */
async function offered(
  { project, solids, solid }: SolidChange,
  features: readonly SolidFeature[],
  { id }: SolidFeature,
  given: Typed<NewFeature>,
  label: string,
): Promise<Offer> {
  const body = await solids.bodyOf(project, solid, features);
  const { failures = [] } = body;
  const own = failures.find(({ feature }) => feature === id);
  if (own) return { possible: false, reason: `${own.message} ${own.remedy}` };
  const others = failures.map(({ feature }) => featureLabel(features, feature));
  const note = others.length > 0 ? operationStrings.solids.othersFail(others) : "";
  const expressions = withFeatureExpressions(project, solid.id, { id }, expressionsIn(given));
  const bodies = bodiesOf(project).map((other) => (other.id === body.id ? body : other));
  const edit: ProjectEdit = { label, replace: { bodies, expressions } };
  return { possible: true, creation: { entities: [{ kind: "body", id: solid.id }], edit, note } };
}

/** Returns the edit that gives a solid other features. */
export async function changedSolid(
  { project, solids, solid }: SolidChange,
  features: readonly SolidFeature[],
): Promise<ProjectEdit> {
  return replaceBody(project, bodyStepNames.features, await solids.bodyOf(project, solid, features));
}

/** An operation that adds a feature to a solid, or changes it. */
export interface FeatureOperation<Values extends FieldValues = FieldValues> extends Operation<Values> {
  /** Returns the operation that changes a feature with the given expressions; null for features of other kinds. */
  edit(solid: Solid, feature: SolidFeature, expressions?: FieldExpressions): Operation<Values> | null;
}

/** What the panel of a feature shows. */
interface FeaturePanel<Values extends FieldValues> {
  readonly operation: Operation<Values>;
  readonly noun: string;
  readonly solid: Solid;
  readonly feature: SolidFeature;
  readonly values: Typed<Values>;
  /** Returns the feature of other values; null if they do not fit together. */
  readonly made: (
    values: Values,
    expressions: FieldExpressions,
    subject: Subject,
    solids: SolidMaker,
  ) => MadeFeature | null;
}

type MadeFeature = Typed<NewFeature> | Promise<Typed<NewFeature>>;

/** Returns the operation that changes a feature: the one that adds such, with the values of the feature. */
export function editOf<Values extends FieldValues>({
  operation,
  noun,
  solid,
  feature,
  values,
  made,
}: FeaturePanel<Values>): Operation<Values> {
  const step = stepNames.change(noun);
  return {
    ...operation,
    id: `edit-${operation.id}`,
    title: operationStrings.edit(noun),
    step,
    action: operationStrings.apply,
    usesSelection: false,
    initial: () => plain<Values>(values),
    expressions: () => expressionsIn(values),
    note: () => "",
    handles: (changed) => handlesInView(operation.handles?.(changed) ?? [], solid, feature),
    makeLater: (subject, changed, solids, expressions = {}) => {
      const given = made(changed, expressions, subject, solids);
      if (!given) return null;
      const change = { project: subject.project, solids, solid };
      return Promise.resolve(given).then((one) => changedFeature(change, feature, one, step));
    },
  };
}
