import type { App } from "../app/app";
import { isEmptyProject } from "../document/entities";
import type { Operation } from "../document/operations/operation";
import { pieceOperations } from "../document/operations/pieces";
import { loftOperations } from "../document/operations/solid-lofts";
import { sweepOperations } from "../document/operations/sweeps";
import { duplicateOperation, transformOperations } from "../document/operations/transforms";
import { settledProject } from "../session/document-store";
import { operationStrings } from "../strings";
import { copySelection, hasNoText, pasteFragment } from "./clipboard-actions";
import { hasSelection, needsSelection, selectionNeeded } from "./conditions";
import { startOperation } from "./start-operation";
import { define, type Command, type MenuName } from "./command";

/** Accepts what the open operation gives. A model that was empty before is fitted into the view. */
export function acceptOperation(app: App): void {
  const wasEmpty = isEmptyProject(settledProject(app.documents.state.getState()));
  if (!app.operations.accept()) return;
  app.shell.setState({ rightTab: "inspector", leftTab: "model" });
  if (wasEmpty) app.viewer.getState().viewer?.framing.fit(null);
}

const open = (menu: MenuName, section: number, operation: Operation, key?: string): Command =>
  define(menu, section)(
    operation.id,
    operationStrings.opens(operation.title),
    (app) => startOperation(app, operation),
    key === undefined ? {} : { keys: [key] },
  );

/** Commands that open the panel of an operation that creates. */
export const pieceCommands: readonly Command[] = pieceOperations.map((operation) =>
  open("create", 10, operation),
);

/** Commands that open the panel of an operation that sweeps the selection or drills a hole. */
export const sweepCommands: readonly Command[] = [
  ...sweepOperations.slice(0, 2),
  ...loftOperations,
  ...sweepOperations.slice(2),
].map((operation) => open("create", 12, operation));

/** Commands that copy the selection, accept the open operation, or open the panel of an operation that transforms it. */
export const transformCommands: readonly Command[] = [
  define("edit", 5)("copy", operationStrings.copy, (app) => void copySelection(app), {
    keys: ["mod+C"],
    enabled: (app) => hasSelection(app) && hasNoText(),
    needs: selectionNeeded,
  }),
  define("edit", 5)(
    "paste",
    operationStrings.opens(operationStrings.paste.title),
    (app) => void pasteFragment(app),
    {
      keys: ["mod+V"],
    },
  ),
  define("edit", 5)(
    "duplicate",
    operationStrings.duplicate,
    (app) => startOperation(app, duplicateOperation),
    {
      keys: ["mod+D"],
      ...needsSelection,
    },
  ),
  define("edit", 5)("accept-operation", operationStrings.accept, acceptOperation, {
    keys: ["Enter"],
    enabled: ({ operations }) => operations.state.getState().open !== null,
  }),
  ...transformOperations.map((operation) => open("edit", 6, operation)),
];
