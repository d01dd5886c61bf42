import type { App } from "../app/app";
import { commandLabels, downloadFormats, secondOrderFormats } from "../strings";
import { define, type Command } from "./command";
import { hasTetrahedra, meshNeeded } from "./conditions";
import { downloadMesh, downloadReport } from "./download-actions";
import { newProject, openFromDialog, save } from "./project-actions";
import { importSurface } from "./surface-actions";

const hasMesh = (app: App): boolean => app.run.state.getState().mesh !== null;

const needsTetrahedra = {
  enabled: (app: App): boolean => hasTetrahedra(app.run.state.getState()),
  needs: meshNeeded,
};

/** Extension and name of each format. docs/FORMAT.md describes their content. */
const formats = Object.entries(downloadFormats);
const secondOrder = Object.entries(secondOrderFormats);

/** Ids of the commands in the download menu of the header. */
export const DOWNLOADS: readonly string[] = [
  ...formats.map(([extension]) => `download-${extension}`),
  ...secondOrder.map(([extension]) => `download-second-order-${extension}`),
  "download-report",
];

export const fileMenu: readonly Command[] = [
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
  ...formats.map(([extension, format]) =>
    define("file", 2)(
      `download-${extension}`,
      commandLabels.download(format),
      (app) => void downloadMesh(app, extension),
      needsTetrahedra,
    ),
  ),
  ...secondOrder.map(([extension, format]) =>
    define("file", 2)(
      `download-second-order-${extension}`,
      commandLabels.download(format),
      (app) => void downloadMesh(app, extension, 2),
      needsTetrahedra,
    ),
  ),
  define("file", 2)("download-report", commandLabels.downloadReport, downloadReport, {
    enabled: hasMesh,
    needs: meshNeeded,
  }),
];
