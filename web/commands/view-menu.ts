import type { App } from "../app/app";
import type { CutAxis, Layer, Shading } from "../document/selection";
import type { StandardView } from "../viewer/camera";
import { define, type Command } from "./command";
import { hasHighlight, hasSelection } from "./conditions";

const hasViewer = (app: App): boolean => app.viewer.getState().viewer !== null;
const viewState = (app: App) => app.view.state.getState();

const standardViews: readonly (readonly [StandardView, string, string])[] = [
  ["isometric", "Isometric", "0"],
  ["front", "Front", "1"],
  ["right", "Right", "3"],
  ["top", "Top", "7"],
  ["back", "Back", "alt+1"],
  ["left", "Left", "alt+3"],
  ["bottom", "Bottom", "alt+7"],
];

const layerNames: readonly (readonly [Layer, string])[] = [
  ["points", "Points"],
  ["lines", "Lines"],
  ["patches", "Patches"],
  ["background", "Background grid"],
  ["sources", "Sources"],
  ["mesh", "Mesh"],
];

const shadings: readonly (readonly [Shading, string])[] = [
  ["radius-ratio", "Shade by radius ratio"],
  ["dihedral", "Shade by smallest dihedral angle"],
  ["region", "Shade by region"],
  ["plain", "Plain shading"],
];

const cutAxes: readonly CutAxis[] = ["x", "y", "z"];

export const viewMenu: readonly Command[] = [
  define("view", 0)("fit", "Fit model", (app) => app.viewer.getState().viewer?.fit(null), {
    keys: ["F"],
    enabled: hasViewer,
  }),
  define("view", 0)(
    "fit-selection",
    "Fit selection",
    (app) => {
      const { selection } = viewState(app);
      const { viewer } = app.viewer.getState();
      if (!hasHighlight(app)) viewer?.fit(selection);
      else viewer?.fitSelectedFaces();
    },
    {
      keys: ["shift+F"],
      enabled: (app) => hasViewer(app) && (hasSelection(app) || hasHighlight(app)),
    },
  ),
  ...standardViews.map(([view, name, key]) =>
    define("view", 1)(`view-${view}`, `${name} view`, (app) => app.viewer.getState().viewer?.look(view), {
      keys: [key],
      enabled: hasViewer,
    }),
  ),
  define("view", 2)("cut", "Cut", (app) => app.view.setCut({ enabled: !viewState(app).cut.enabled }), {
    keys: ["X"],
    checked: (app) => viewState(app).cut.enabled,
  }),
  define("view", 2)(
    "cut-flip",
    "Other side of the cut",
    (app) => app.view.setCut({ flipped: !viewState(app).cut.flipped }),
    { keys: ["shift+X"], enabled: (app) => viewState(app).cut.enabled },
  ),
  ...cutAxes.map((axis) =>
    define("view", 2)(`cut-${axis}`, `Cut across ${axis}`, (app) => app.view.cutAcross(axis), {
      checked: (app) => viewState(app).cut.enabled && viewState(app).cut.axis === axis,
    }),
  ),
  ...layerNames.map(([layer, name]) =>
    define("view", 3)(`layer-${layer}`, name, (app) => app.view.toggleLayer(layer), {
      checked: (app) => viewState(app).layers[layer],
    }),
  ),
  define("view", 4)("hide", "Hide selection", (app) => app.view.setHidden(viewState(app).selection, true), {
    keys: ["H"],
    enabled: hasSelection,
  }),
  define("view", 4)("show-all", "Show all", (app) => app.view.showAll(), { keys: ["shift+H"] }),
  ...shadings.map(([shading, name]) =>
    define("view", 5)(`shade-${shading}`, name, (app) => app.view.state.setState({ shading }), {
      checked: (app) => viewState(app).shading === shading,
    }),
  ),
  define("view", 5)(
    "edges",
    "Element edges",
    (app) => app.view.state.setState({ edges: !viewState(app).edges }),
    {
      keys: ["E"],
      checked: (app) => viewState(app).edges,
    },
  ),
];
