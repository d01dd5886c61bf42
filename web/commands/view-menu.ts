import type { App } from "../app/app";
import type { CutAxis, Layer, Shading, Smoothness } from "../document/selection";
import { schemes } from "../session/shell";
import type { StandardView } from "../viewer/camera";
import { commandLabels } from "../strings";
import { define, type Command } from "./command";
import { hasHighlight, hasSelection, needsSelection, selectionNeeded } from "./conditions";
import { isolate } from "./selection-actions";

const hasViewer = (app: App): boolean => app.viewer.getState().viewer !== null;
const viewState = (app: App) => app.view.state.getState();

const standardViews: readonly (readonly [StandardView, key: string])[] = [
  ["isometric", "0"],
  ["front", "1"],
  ["right", "3"],
  ["top", "7"],
  ["back", "alt+1"],
  ["left", "alt+3"],
  ["bottom", "alt+7"],
];

const layers: readonly Layer[] = ["points", "lines", "patches", "background", "sources", "mesh"];
const smoothnesses: readonly Smoothness[] = ["none", "zebra", "gaussian", "largest"];
const shadings: readonly Shading[] = ["radius-ratio", "dihedral", "region", "plain"];

const cutAxes: readonly CutAxis[] = ["x", "y", "z"];

export const viewMenu: readonly Command[] = [
  define("view", 0)("fit", commandLabels.fit, (app) => app.viewer.getState().viewer?.framing.fit(null), {
    keys: ["F"],
    enabled: hasViewer,
  }),
  define("view", 0)(
    "fit-selection",
    commandLabels.fitSelection,
    (app) => {
      const { selection } = viewState(app);
      const { viewer } = app.viewer.getState();
      if (!hasHighlight(app)) viewer?.framing.fit(selection);
      else viewer?.framing.fitSelectedFaces();
    },
    {
      keys: ["shift+F"],
      enabled: (app) => hasViewer(app) && (hasSelection(app) || hasHighlight(app)),
      needs: selectionNeeded,
    },
  ),
  ...standardViews.map(([view, key]) =>
    define("view", 1)(
      `view-${view}`,
      commandLabels.views[view],
      (app) => app.viewer.getState().viewer?.look(view),
      {
        keys: [key],
        enabled: hasViewer,
      },
    ),
  ),
  define("view", 2)(
    "cut",
    commandLabels.cut,
    (app) => app.view.setCut({ enabled: !viewState(app).cut.enabled }),
    {
      keys: ["X"],
      checked: (app) => viewState(app).cut.enabled,
    },
  ),
  define("view", 2)(
    "cut-flip",
    commandLabels.flipCut,
    (app) => app.view.setCut({ flipped: !viewState(app).cut.flipped }),
    { keys: ["shift+X"], enabled: (app) => viewState(app).cut.enabled },
  ),
  ...cutAxes.map((axis) =>
    define("view", 2)(`cut-${axis}`, commandLabels.cutAcross(axis), (app) => app.view.cutAcross(axis), {
      checked: (app) => viewState(app).cut.enabled && viewState(app).cut.axis === axis,
    }),
  ),
  ...layers.map((layer) =>
    define("view", 3)(`layer-${layer}`, commandLabels.layers[layer], (app) => app.view.toggleLayer(layer), {
      checked: (app) => viewState(app).layers[layer],
    }),
  ),
  define("view", 4)("hide", commandLabels.hide, (app) => app.view.setHidden(viewState(app).selection, true), {
    keys: ["H"],
    ...needsSelection,
  }),
  define("view", 4)("isolate", commandLabels.isolate, (app) => isolate(app, viewState(app).selection), {
    keys: ["I"],
    ...needsSelection,
  }),
  define("view", 4)("show-all", commandLabels.showAll, (app) => app.view.showAll(), { keys: ["shift+H"] }),
  ...shadings.map((shading) =>
    define("view", 5)(
      `shade-${shading}`,
      commandLabels.shadings[shading],
      (app) => app.view.state.setState({ shading }),
      {
        checked: (app) => viewState(app).shading === shading,
      },
    ),
  ),
  ...smoothnesses.map((smoothness) =>
    define("view", 5)(
      `patches-${smoothness}`,
      commandLabels.smoothness[smoothness],
      (app) => app.view.state.setState({ smoothness }),
      {
        checked: (app) => viewState(app).smoothness === smoothness,
      },
    ),
  ),
  define("view", 5)(
    "edges",
    commandLabels.elementEdges,
    (app) => app.view.state.setState({ edges: !viewState(app).edges }),
    {
      keys: ["E"],
      checked: (app) => viewState(app).edges,
    },
  ),
  define("view", 6)(
    "numbers",
    commandLabels.numbers,
    ({ view }) => view.state.setState(({ numbers }) => ({ numbers: !numbers })),
    {
      checked: (app) => viewState(app).numbers,
    },
  ),
  define("view", 6)(
    "left-orbits",
    commandLabels.leftOrbits,
    ({ view }) =>
      view.state.setState(({ leftDrag }) => ({ leftDrag: leftDrag === "orbit" ? "select" : "orbit" })),
    { checked: (app) => viewState(app).leftDrag === "orbit" },
  ),
  ...schemes.map((scheme) =>
    define("view", 6)(
      `scheme-${scheme}`,
      commandLabels.schemes[scheme],
      (app) => app.shell.setState({ scheme }),
      {
        checked: (app) => app.shell.getState().scheme === scheme,
      },
    ),
  ),
];
