import type { App } from "../app/app";
import { commandLabels, exportStrings } from "../strings";
import { define, type Command } from "./command";
import { hasTetrahedra, meshNeeded } from "./conditions";
import { downloadReport } from "./download-actions";
import { newProject, openFromDialog, save } from "./project-actions";
import { importPart } from "./solid-commands";
import { importSurface } from "./surface-actions";

const hasMesh = (app: App): boolean => app.run.state.getState().mesh !== null;

const needsTetrahedra = {
  enabled: (app: App): boolean => hasTetrahedra(app.run.state.getState()),
  needs: meshNeeded,
};

export const fileMenu: readonly Command[] = [
  define("file", 0)("start", commandLabels.start, (app) => app.shell.setState({ startPage: true })),
  define("file", 0)("new", commandLabels.new, newProject),
  define("file", 0)("new-template", commandLabels.newTemplate, (app) =>
    app.shell.setState({ dialog: "templates" }),
  ),
  define("file", 0)("open", commandLabels.open, (app) => void openFromDialog(app), {
    keys: ["mod+O"],
    inFields: true,
  }),
  define("file", 0)("recent", commandLabels.recent, (app) => app.shell.setState({ dialog: "recent" }), {
    keys: ["mod+shift+O"],
    inFields: true,
    enabled: (app) => app.library !== null,
  }),
  define("file", 0)("import-surface", commandLabels.importSurface, (app) => void importSurface(app)),
  define("file", 0)("import-part", commandLabels.importPart, (app) => void importPart(app)),
  define("file", 0)("examples", commandLabels.examples, (app) =>
    app.shell.setState({ leftTab: "examples", drawer: "left" }),
  ),
  define("file", 1)("save", commandLabels.save, (app) => void save(app, false), {
    keys: ["mod+S"],
    inFields: true,
  }),
  define("file", 1)("save-as", commandLabels.saveAs, (app) => void save(app, true), {
    keys: ["mod+shift+S"],
    inFields: true,
  }),
  define("file", 1)("share", commandLabels.share, (app) => app.shell.setState({ dialog: "share" })),
  define("file", 1)("picture", commandLabels.picture, (app) => app.shell.setState({ dialog: "picture" }), {
    enabled: (app) => app.viewer.getState().viewer !== null,
  }),
  define("file", 2)("export", exportStrings.menu, (app) => app.shell.setState({ dialog: "export" }), {
    keys: ["mod+shift+E"],
    inFields: true,
    ...needsTetrahedra,
  }),
  define("file", 2)("download-report", commandLabels.downloadReport, (app) => downloadReport(app), {
    enabled: hasMesh,
    needs: meshNeeded,
  }),
];
