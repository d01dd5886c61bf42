import type { Project, ProjectBody, SolidFeature } from "tetrafront/project";
import { addBodies, replaceBody } from "../body-edits";
import type { Offer } from "../create";
import type { ProjectEdit } from "../edit";
import { bodiesOf, bodyLabel, type Entity } from "../entities";
import { bodyStepNames, operationStrings, stepNames } from "../../strings";
import type { Frame } from "../vectors";
import type { FieldExpressions, SolidMaker, Subject } from "./operation";

const texts = operationStrings.fields;

/** What a piece becomes: patches, a solid of its own, or a change of a solid. */
export type PieceUse = "patches" | "new" | "join" | "cut" | "intersect";

type Piece = Extract<SolidFeature, { readonly operation: unknown }>;
type WithoutHead<One> = One extends unknown ? Omit<One, "id" | "name" | "isOff" | "operation"> : never;
/** A feature that has not been added to a list. */
export type NewPiece = WithoutHead<Piece>;

/** How a piece is a feature of a solid. */
export interface SolidForm<Sizes> {
  /** Returns the feature of sizes, with its base at the origin of a frame and its axis along z. */
  make(sizes: Sizes, frame: Frame): NewPiece;
  /** Returns the sizes and the place of the base of such a feature. */
  read(feature: SolidFeature): { readonly sizes: Sizes; readonly position: Frame["origin"] } | null;
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

export function solidNote(
  use: Exclude<PieceUse, "patches">,
  subject: Subject,
  expressions: FieldExpressions,
): string {
  const solid = use === "new" ? undefined : solidIn(subject);
  const what = solid && use !== "new" ? texts.solidNote[use](bodyLabel(solid)) : texts.solidNote.new;
  return [what, numbersNote(expressions)].filter((note) => note !== "").join(" ");
}

/** Says that expressions are not kept, if there are any. */
export const numbersNote = (expressions: FieldExpressions = {}): string =>
  Object.keys(expressions).length > 0 ? texts.numbersOnly : "";

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
export async function addedFeature(
  { subject, solids, noun, use }: Addition,
  piece: NewPiece,
): Promise<Offer> {
  const { project } = subject;
  const solid = use === "new" ? undefined : solidIn(subject);
  const features = solid?.features ?? [];
  const id = nextFeatureId(features);
  const added = { ...piece, id, operation: solid ? use : "new" } as SolidFeature;
  if (solid) {
    refuseMoved(solid);
    return offeredSolid({ project, solids, solid }, [...features, added], id, stepNames.add(noun));
  }
  const { body } = await solids.bodyOf(project, { name: noun }, [added]);
  const edit = { ...addBodies(project, [body]), label: stepNames.add(noun) };
  return { possible: true, creation: { entities: [{ kind: "body", id: body.id }], edit } };
}

interface SolidChange {
  readonly project: Project;
  readonly solids: SolidMaker;
  readonly solid: Solid;
}

/** Throws if a body was moved as a whole: its features have coordinates of their own, and the view shows others. */
export function refuseMoved({ placement }: Solid): void {
  if (placement) throw new Error(operationStrings.solids.moved);
}

/** Offers a solid with other features. Refused if the one that is added or changed fails; others that fail are a note. */
export async function offeredSolid(
  { project, solids, solid }: SolidChange,
  features: readonly SolidFeature[],
  id: number,
  label: string,
): Promise<Offer> {
  const { body, failures } = await solids.bodyOf(project, solid, features);
  const own = failures.find(({ feature }) => feature === id);
  if (own) return { possible: false, reason: `${own.message} ${own.remedy}` };
  const others = failures.map(({ feature }) => feature);
  const note = others.length > 0 ? operationStrings.solids.othersFail(others) : "";
  const edit = replaceBody(project, label, body);
  return { possible: true, creation: { entities: [{ kind: "body", id: solid.id }], edit, note } };
}

/** Returns the edit that gives a solid other features. */
export async function changedSolid(
  { project, solids, solid }: SolidChange,
  features: readonly SolidFeature[],
): Promise<ProjectEdit> {
  const { body } = await solids.bodyOf(project, solid, features);
  return replaceBody(project, bodyStepNames.features, body);
}
