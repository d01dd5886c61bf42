import type { App } from "../app/app";
import { bodiesOf } from "../document/entities";
import { replaceBody } from "../document/body-edits";
import { expressionsOfFeature } from "../document/operations/feature-numbers";
import { pieceOperations } from "../document/operations/pieces";
import { loftOperations } from "../document/operations/solid-lofts";
import { featureSweeps } from "../document/operations/sweeps";
import { explode } from "../document/operations/solid-explosion";
import { sew } from "../document/operations/solid-sewing";
import { editBoolean } from "../document/operations/solid-booleans";
import { changeOperations } from "../document/operations/solid-changes";
import { unitFactor, unitOf } from "../document/length-units";
import { chooseCadFile, fileStem } from "../session/files";
import { commandLabels } from "../strings/commands";
import { addedPiece, changedSolid, solidsOf, type Solid } from "../document/operations/solids";
import { bodyStepNames, operationStrings } from "../strings";
import type { SolidFeature } from "tetrafront/project";
import { define, type Command } from "./command";
import { showFailure } from "./messages";
import { startOperation } from "./start-operation";

const hasSolid = (app: App): boolean => solidsOf(app.documents.project).length > 0;

/** Commands that open the panel of an operation that changes a solid, or makes one of what is drawn. */
export const solidCommands: readonly Command[] = [
  ...changeOperations.map((operation) =>
    define("create", 11)(
      operation.id,
      operationStrings.opens(operation.title),
      (app) => startOperation(app, operation),
      { enabled: hasSolid, needs: () => operationStrings.solids.noSolid },
    ),
  ),
  define("create", 11)(sew.id, operationStrings.opens(sew.title), (app) => startOperation(app, sew), {
    enabled: (app) => app.documents.project.patches.length > 0,
    needs: () => operationStrings.solids.noPatches,
  }),
  define("create", 11)(
    explode.id,
    operationStrings.opens(explode.title),
    (app) => startOperation(app, explode),
    { enabled: hasSolid, needs: () => operationStrings.solids.exploded.noSolid },
  ),
];

/** Adds the solids of a CAD file as a solid, whose first feature they are. */
export async function importPart(app: App): Promise<void> {
  try {
    const file = await chooseCadFile();
    if (!file) return;
    const { left, project } = app.documents;
    const { units } = project;
    const format = /\.brp$|\.brep$/i.test(file.name) ? "brep" : "step";
    const unit = unitOf(units);
    const scale = unit === undefined || format === "brep" ? 1 : unitFactor("mm", unit);
    const bytes = new Uint8Array(await file.arrayBuffer());
    const part = await app.solids.importPart({ format, bytes, scale });
    await app.documents.afterGesture();
    if (left.aborted) return;
    const subject = { project: app.documents.project, selection: [] };
    const noun = fileStem(file.name);
    const offer = await addedPiece(
      { subject, solids: app.solids, noun, use: "new" },
      { type: "import", ...part },
    );
    if (!offer.possible || app.documents.left !== left) return;
    app.documents.edit(offer.creation.edit);
    app.view.selectAll(offer.creation.entities);
    app.viewer.getState().viewer?.framing.fitUnlessShown(offer.creation.entities);
  } catch (error) {
    showFailure(app, commandLabels.importPart, error);
  }
}

/** Opens the panel of a feature. Returns false for features that have none. */
export function editFeature(app: App, solid: Solid, feature: SolidFeature): boolean {
  const expressions = expressionsOfFeature(app.documents.project, solid.id, feature.id);
  const operation = [
    ...pieceOperations,
    ...featureSweeps,
    ...loftOperations,
    ...changeOperations,
    editBoolean,
  ]
    .map((one) => one.edit(solid, feature, expressions))
    .find((one) => one !== null);
  if (!operation) return false;
  startOperation(app, operation);
  return true;
}

/** The change of features that each app makes last: the next one begins after it. */
const lastChange = new WeakMap<App, Promise<void>>();

/** Changes the features of a solid, as one step of undo, after the changes that are being made. */
export function setFeatures(
  app: App,
  id: number,
  change: (features: readonly SolidFeature[]) => readonly SolidFeature[],
): Promise<void> {
  app.operations.cancel();
  const next = (lastChange.get(app) ?? Promise.resolve()).then(() => changeNow(app, id, change));
  lastChange.set(app, next);
  return next;
}

async function changeNow(
  app: App,
  id: number,
  change: (features: readonly SolidFeature[]) => readonly SolidFeature[],
): Promise<void> {
  const { project } = app.documents;
  const solid = solidsOf(project).find((one) => one.id === id);
  if (!solid) return;
  try {
    const edit = await changedSolid({ project, solids: app.solids, solid }, change(solid.features));
    if (bodiesOf(app.documents.project).find((one) => one.id === id) === solid) app.documents.edit(edit);
  } catch (error) {
    showFailure(app, operationStrings.features.title, error);
  }
}

/** Makes a solid a body without features. */
export function explodeSolid(app: App, solid: Solid): void {
  const { features: _, ...body } = solid;
  app.documents.edit(replaceBody(app.documents.project, bodyStepNames.explode, body));
}
