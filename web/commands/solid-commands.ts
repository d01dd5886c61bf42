import type { App } from "../app/app";
import { bodiesOf } from "../document/entities";
import { replaceBody } from "../document/body-edits";
import { pieceOperations } from "../document/operations/pieces";
import { changeOperations } from "../document/operations/solid-changes";
import { changedSolid, solidsOf, type Solid } from "../document/operations/solids";
import { bodyStepNames, operationStrings } from "../strings";
import type { SolidFeature } from "tetrafront/project";
import { define, type Command } from "./command";
import { showFailure } from "./messages";
import { startOperation } from "./start-operation";

const hasSolid = (app: App): boolean => solidsOf(app.documents.project).length > 0;

/** Commands that open the panel of an operation that changes a solid. */
export const solidCommands: readonly Command[] = changeOperations.map((operation) =>
  define("create", 12)(
    operation.id,
    operationStrings.opens(operation.title),
    (app) => startOperation(app, operation),
    { enabled: hasSolid, needs: () => operationStrings.solids.noSolid },
  ),
);

/** Opens the panel of a feature. Returns false for features that have none. */
export function editFeature(app: App, solid: Solid, feature: SolidFeature): boolean {
  const operation = [...pieceOperations, ...changeOperations]
    .map((one) => one.edit(solid, feature))
    .find((one) => one !== null);
  if (!operation) return false;
  startOperation(app, operation);
  return true;
}

/** Gives a solid other features, as one step of undo. A solid that was changed meanwhile stays as it is. */
export async function setFeatures(app: App, solid: Solid, features: readonly SolidFeature[]): Promise<void> {
  app.operations.cancel();
  const { project } = app.documents;
  try {
    const edit = await changedSolid({ project, solids: app.solids, solid }, features);
    if (bodiesOf(app.documents.project).find(({ id }) => id === solid.id) === solid) app.documents.edit(edit);
  } catch (error) {
    showFailure(app, operationStrings.features.title, error);
  }
}

/** Makes a solid a body without features. */
export function explodeSolid(app: App, solid: Solid): void {
  const { features: _, ...body } = solid;
  app.documents.edit(replaceBody(app.documents.project, bodyStepNames.explode, body));
}
