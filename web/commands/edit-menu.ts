import type { App } from "../app/app";
import { define, type Command } from "./command";
import { hasHighlight, hasSelection } from "./conditions";
import { deleteSelection } from "./selection-actions";

const past = (app: App) => app.documents.state.getState().history.past;
const future = (app: App) => app.documents.state.getState().history.future;

const withLabel = (verb: string, label: string | undefined): string =>
  label === undefined ? verb : `${verb}: ${label}`;

export const editMenu: readonly Command[] = [
  define("edit", 0)(
    "undo",
    (app) => withLabel("Undo", past(app).at(-1)?.label),
    (app) => app.documents.undo(),
    { keys: ["mod+Z"], enabled: (app) => past(app).length > 0 },
  ),
  define("edit", 0)(
    "redo",
    (app) => withLabel("Redo", future(app)[0]?.label),
    (app) => app.documents.redo(),
    { keys: ["mod+shift+Z", "mod+Y"], enabled: (app) => future(app).length > 0 },
  ),
  define("edit", 1)("delete", "Delete selection", deleteSelection, {
    keys: ["Delete"],
    enabled: hasSelection,
  }),
  define("edit", 1)(
    "select-several",
    "Select several (each click toggles)",
    (app) => app.view.state.setState(({ several }) => ({ several: !several })),
    { checked: (app) => app.view.state.getState().several },
  ),
  define("edit", 1)("deselect", "Clear selection", (app) => app.view.clear(), {
    keys: ["Escape"],
    enabled: (app) => hasSelection(app) || hasHighlight(app),
  }),
];
