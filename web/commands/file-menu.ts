import type { App } from "../app/app";
import { encodingsOf, exportFormats, extensionIn } from "../document/export-formats";
import { commandLabels, exportStrings } from "../strings";
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

/** Extension and name of each format that the palette saves at once, without the dialog. */
const formats = exportFormats.flatMap((format) =>
  encodingsOf(format).map((encoding) => {
    const kind = format.content === "boundary" ? " (boundary)" : "";
    const name = `${exportStrings.formats[format.id] ?? format.id}${kind}`;
    return [
      extensionIn(format, encoding),
      encoding === encodingsOf(format)[0] ? name : `${name}, ${encoding}`,
    ];
  }),
) as readonly (readonly [extension: string, name: string])[];
const secondOrder = exportFormats
  .filter(({ hasSecondOrder }) => hasSecondOrder)
  .map((format) => extensionIn(format, "binary"));

/** Ids of the commands that save the mesh at once. */
export const DOWNLOADS: readonly string[] = [
  ...formats.map(([extension]) => `download-${extension}`),
  ...secondOrder.map((extension) => `download-second-order-${extension}`),
  "download-report",
];

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
  ...formats.map(([extension, format]) =>
    define("file", 2)(
      `download-${extension}`,
      commandLabels.download(format),
      (app) => void downloadMesh(app, extension),
      { ...needsTetrahedra, inMenu: false },
    ),
  ),
  ...secondOrder.map((extension) =>
    define("file", 2)(
      `download-second-order-${extension}`,
      commandLabels.download(`second-order .${extension}`),
      (app) => void downloadMesh(app, extension, { elementOrder: 2 }),
      { ...needsTetrahedra, inMenu: false },
    ),
  ),
  define("file", 2)("download-report", commandLabels.downloadReport, downloadReport, {
    enabled: hasMesh,
    needs: meshNeeded,
  }),
];
