import type { Project } from "tetrafront/project";
import type { App } from "../app/app";
import {
  allEntities,
  boundaryOf,
  loopAround,
  connectedTo,
  invertedSelection,
  sameKinds,
  shownAmong,
} from "../document/select-related";
import type { Entity } from "../document/entities";
import type { ViewState } from "../document/selection";
import { commandLabels, paletteStrings } from "../strings";
import { define, type Command, type Extra } from "./command";
import { hasHighlight, hasSelection, needsSelection, selectionNeeded } from "./conditions";
import { canGroup, groupSelection } from "./group-actions";
import { canRename, deleteSelection, rename } from "./selection-actions";
import { mergeableBody, mergeSelectedPatches } from "./surface-actions";

const past = (app: App) => app.documents.state.getState().history.past;
const future = (app: App) => app.documents.state.getState().history.future;

const canTakeBack = (app: App): boolean => app.drawing.state.getState().canTakeBack;

const hasTool = (app: App): boolean => app.view.state.getState().tool !== "select";
const hasOperation = (app: App): boolean => app.operations.state.getState().open !== null;

/** Cancels the open operation; without one, puts the tool away; without a tool, clears the selection. */
function leaveLevel(app: App): void {
  if (hasOperation(app)) app.operations.cancel();
  else if (hasTool(app)) app.view.setTool("select");
  else app.view.clear();
}

const needsNothing = { enabled: () => true };

/** A command that replaces the selection by related entities. */
const select = (
  id: keyof typeof commandLabels.selecting,
  related: (project: Project, selection: readonly Entity[], view: ViewState) => readonly Entity[],
  keys: readonly string[],
  condition: Pick<Extra, "enabled" | "needs"> = needsSelection,
): Command =>
  define("edit", 2)(
    `select-${id}`,
    commandLabels.selecting[id],
    ({ documents, view }) => {
      const state = view.state.getState();
      view.selectAll(related(documents.project, state.selection, state));
    },
    { keys, ...condition },
  );

export const editMenu: readonly Command[] = [
  define("edit", 0)(
    "undo",
    (app) => (canTakeBack(app) ? commandLabels.undoPlace : commandLabels.undo(past(app).at(-1)?.label)),
    (app) => {
      if (!app.drawing.takeBack()) app.documents.undo();
    },
    {
      keys: ["mod+Z"],
      enabled: (app) => canTakeBack(app) || past(app).length > 0,
      needs: paletteStrings.needs.past,
    },
  ),
  define("edit", 0)(
    "redo",
    (app) => commandLabels.redo(future(app)[0]?.label),
    (app) => app.documents.redo(),
    {
      keys: ["mod+shift+Z", "mod+Y"],
      enabled: (app) => future(app).length > 0,
      needs: paletteStrings.needs.future,
    },
  ),
  define("edit", 0)("history", commandLabels.history, (app) =>
    app.shell.setState({ bottomTab: "history", drawer: "bottom" }),
  ),
  define("edit", 1)("delete", commandLabels.delete, deleteSelection, {
    keys: ["Delete"],
    ...needsSelection,
  }),
  define("edit", 1)(
    "select-several",
    commandLabels.selectSeveral,
    (app) => app.view.state.setState(({ several }) => ({ several: !several })),
    { checked: (app) => app.view.state.getState().several },
  ),
  define("edit", 1)("rename", commandLabels.rename, rename, {
    keys: ["F2"],
    enabled: canRename,
    needs: (app) => selectionNeeded(app) ?? paletteStrings.needs.single,
  }),
  define("edit", 1)("group", commandLabels.group, groupSelection, {
    enabled: canGroup,
    needs: selectionNeeded,
  }),
  define("edit", 1)("merge-patches", commandLabels.mergePatches, (app) => void mergeSelectedPatches(app), {
    enabled: (app) => mergeableBody(app.documents.project, app.view.state.getState().selection) !== undefined,
  }),
  define("edit", 1)("deselect", commandLabels.deselect, leaveLevel, {
    keys: ["Escape"],
    enabled: (app) => hasSelection(app) || hasHighlight(app) || hasTool(app) || hasOperation(app),
  }),
  // What the user does not see must not be changed or deleted with the rest.
  select(
    "all",
    (project, _, view) => shownAmong(project, allEntities(project), view),
    ["mod+A"],
    needsNothing,
  ),
  select(
    "inverse",
    (project, selection, view) => shownAmong(project, invertedSelection(project, selection), view),
    ["mod+I"],
    needsNothing,
  ),
  select("same-kind", sameKinds, []),
  select("connected", connectedTo, []),
  select("boundary", boundaryOf, []),
  select("loop", loopAround, [], {
    enabled: ({ view }) => view.state.getState().selection.some(({ kind }) => kind === "line"),
    needs: paletteStrings.needs.line,
  }),
];
