import type { App } from "../app/app";
import { scaleSizes } from "../document/edits";
import { takeBackgroundFromMesh, toggleUniformSize } from "./background-actions";
import { define, type Command } from "./command";

const isBusy = (app: App): boolean => app.run.state.getState().busy;

/** Factors for all sizes. */
const finer = 0.8;
const coarser = 1.25;

export const meshMenu: readonly Command[] = [
  define("mesh", 0)("generate", "Generate mesh", (app) => void app.run.generate(), {
    keys: ["mod+Enter"],
    inFields: true,
    enabled: (app) => !isBusy(app),
  }),
  define("mesh", 0)("cancel", "Cancel meshing", (app) => app.run.cancel(), {
    keys: ["shift+Escape"],
    inFields: true,
    enabled: isBusy,
  }),
  define("mesh", 1)("refine", "Make all sizes finer (× 0.8)", (app) =>
    app.documents.edit(scaleSizes(app.documents.project, finer)),
  ),
  define("mesh", 1)("coarsen", "Make all sizes coarser (× 1.25)", (app) =>
    app.documents.edit(scaleSizes(app.documents.project, coarser)),
  ),
  define("mesh", 2)("cover", "Create covering grid…", (app) => app.shell.setState({ dialog: "cover" })),
  define("mesh", 2)(
    "background-from-mesh",
    "Use this mesh as background grid",
    (app) => void takeBackgroundFromMesh(app),
    {
      enabled: (app) => (app.run.state.getState().mesh?.report.tetrahedra ?? 0) > 0,
    },
  ),
  define("mesh", 2)("propose", "Propose sizes…", (app) => app.shell.setState({ dialog: "propose" })),
  define("mesh", 2)("uniform-size", "Uniform size", toggleUniformSize, {
    checked: (app) => app.documents.project.meshing?.size !== undefined,
  }),
  define("mesh", 3)("problems", "Show problems", (app) =>
    app.shell.setState({ bottomTab: "problems", drawer: "bottom" }),
  ),
];
