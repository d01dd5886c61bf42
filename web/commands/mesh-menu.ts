import type { App } from "../app/app";
import { scaleSizes } from "../document/size-edits";
import { canImprove } from "../session/run-state";
import { commandLabels, paletteStrings } from "../strings";
import { takeBackgroundFromMesh, toggleUniformSize } from "./background-actions";
import { bodyCommands } from "./body-commands";
import { define, type Command } from "./command";
import { hasTetrahedra, meshNeeded } from "./conditions";
import { splitCommand } from "./create-menu";
import { generateMesh, improveMesh } from "./mesh-actions";
import { showWorstElement, worstElement } from "./selection-actions";
import { sizeTools } from "./tool-commands";

const isBusy = (app: App): boolean => app.run.state.getState().busy;

/** Returns whether the shown mesh is stretched: it cannot be improved. */
const hasStretchedMesh = (app: App): boolean => app.run.state.getState().mesh?.metricShapes !== undefined;

/** Factors for all sizes. */
const finer = 0.8;
const coarser = 1.25;

export const meshMenu: readonly Command[] = [
  define("mesh", 0)("generate", commandLabels.generate, (app) => void generateMesh(app), {
    keys: ["mod+Enter"],
    inFields: true,
    enabled: (app) => !isBusy(app),
  }),
  define("mesh", 0)("improve", commandLabels.improve, (app) => void improveMesh(app), {
    enabled: (app) => canImprove(app.run.state.getState(), app.documents.state.getState()),
    needs: (app) => (!isBusy(app) && hasStretchedMesh(app) ? null : meshNeeded(app)),
  }),
  define("mesh", 0)(
    "cancel",
    (app) => commandLabels.cancel[app.run.state.getState().task],
    (app) => app.run.cancel(),
    { keys: ["shift+Escape"], inFields: true, enabled: isBusy, needs: paletteStrings.needs.run },
  ),
  define("mesh", 1)("refine", commandLabels.refine(finer), (app) =>
    app.documents.edit(scaleSizes(app.documents.project, finer)),
  ),
  define("mesh", 1)("coarsen", commandLabels.coarsen(coarser), (app) =>
    app.documents.edit(scaleSizes(app.documents.project, coarser)),
  ),
  ...sizeTools,
  splitCommand,
  define("mesh", 2)("cover", commandLabels.cover, (app) => app.shell.setState({ dialog: "cover" })),
  define("mesh", 2)(
    "background-from-mesh",
    commandLabels.backgroundFromMesh,
    (app) => void takeBackgroundFromMesh(app),
    {
      enabled: (app) => hasTetrahedra(app.run.state.getState()),
      needs: meshNeeded,
    },
  ),
  define("mesh", 2)("propose", commandLabels.propose, (app) => app.shell.setState({ dialog: "propose" })),
  define("mesh", 2)("uniform-size", commandLabels.uniformSize, toggleUniformSize, {
    checked: (app) => app.documents.project.meshing?.size !== undefined,
  }),
  define("mesh", 2)(
    "show-sizes",
    commandLabels.showSizes,
    (app) => app.view.setSizes({ enabled: !app.view.state.getState().sizes.enabled }),
    { keys: ["shift+D"], checked: (app) => app.view.state.getState().sizes.enabled },
  ),
  define("mesh", 3)("worst-element", commandLabels.worstElement, showWorstElement, {
    enabled: (app) => worstElement(app.run.state.getState()) !== undefined,
    needs: meshNeeded,
  }),
  define("mesh", 3)("problems", commandLabels.problems, (app) =>
    app.shell.setState({ bottomTab: "problems", drawer: "bottom" }),
  ),
  define("mesh", 3)(
    "log",
    commandLabels.log,
    (app) => app.shell.setState({ bottomTab: "log", drawer: "bottom" }),
    { inMenu: false },
  ),
  ...bodyCommands,
];
