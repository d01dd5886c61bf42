import type { App } from "../app/app";
import { isEmptyProject } from "../document/entities";
import type { Operation } from "../document/operations/operation";
import { pieceOperations } from "../document/operations/pieces";
import { settledProject } from "../session/document-store";
import { operationStrings } from "../strings";
import { define, type Command, type MenuName } from "./command";

/** Opens the panel of an operation. */
export function startOperation(app: App, operation: Operation): void {
  app.shell.setState({ drawer: null, dialog: null });
  app.operations.start(operation);
}

/** Accepts what the open operation gives. A model that was empty before is fitted into the view. */
export function acceptOperation(app: App): void {
  const wasEmpty = isEmptyProject(settledProject(app.documents.state.getState()));
  if (!app.operations.accept()) return;
  app.shell.setState({ rightTab: "inspector", leftTab: "model" });
  if (wasEmpty) app.viewer.getState().viewer?.fit(null);
}

const open = (menu: MenuName, section: number, operation: Operation, key?: string): Command =>
  define(menu, section)(
    operation.id,
    operationStrings.opens(operation.title),
    (app) => startOperation(app, operation),
    key === undefined ? {} : { keys: [key] },
  );

/** Commands that open the panel of an operation. */
export const operationCommands: readonly Command[] = pieceOperations.map((operation) =>
  open("create", 10, operation),
);
