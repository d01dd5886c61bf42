import type { App } from "../app/app";
import { takeMeshAsGrid, toggleUniformSize } from "./background-actions";
import { define, type Command } from "./command";
import { createMenu } from "./create-menu";
import { deleteSelection, downloadMesh, downloadReport, newProject, openFromDialog, save } from "./actions";
import { scaleSizes } from "../document/edits";
import type { CutAxis, Layer, Shading } from "../document/selection";
import type { StandardView } from "../viewer/camera";

const hasMesh = (app: App): boolean => app.run.state.getState().mesh !== null;
const isBusy = (app: App): boolean => app.run.state.getState().busy;
const hasSelection = (app: App): boolean => app.view.state.getState().selection.length > 0;
const hasMarks = (app: App): boolean =>
  viewState(app).element !== null || viewState(app).triangles.length > 0;
const hasViewer = (app: App): boolean => app.viewer.getState().viewer !== null;
const viewState = (app: App) => app.view.state.getState();
const past = (app: App) => app.documents.state.getState().history.past;
const future = (app: App) => app.documents.state.getState().history.future;

const withLabel = (verb: string, label: string | undefined): string =>
  label === undefined ? verb : `${verb}: ${label}`;

/** By the end of the file's name; what is in them is told in docs/FORMAT.md. */
const MESH_DOWNLOADS = [
  ["vtu", "VTU (ParaView)"],
  ["msh", "MSH 4.1 (Gmsh)"],
  ["foam.zip", "polyMesh (OpenFOAM)"],
  ["su2", "SU2"],
  ["inp", "INP (Abaqus)"],
  ["bdf", "BDF (Nastran)"],
  ["b8.ugrid", "UGRID"],
  ["mesh", "Medit"],
  ["vtk", "legacy VTK"],
  ["stl", "STL (boundary)"],
  ["glb", "GLB (boundary)"],
] as const;

/** What the download menu offers. */
export const DOWNLOADS: readonly string[] = [
  ...MESH_DOWNLOADS.map(([extension]) => `download-${extension}`),
  "download-report",
];

const fileMenu: readonly Command[] = [
  define("file", 0)("new", "New project", newProject),
  define("file", 0)("open", "Open project…", (app) => void openFromDialog(app), {
    keys: ["mod+O"],
    inFields: true,
  }),
  define("file", 0)("examples", "Open example…", (app) =>
    app.shell.setState({ leftTab: "examples", drawer: "left" }),
  ),
  define("file", 1)("save", "Save project", (app) => void save(app, false), {
    keys: ["mod+S"],
    inFields: true,
  }),
  define("file", 1)("save-as", "Save project as…", (app) => void save(app, true), {
    keys: ["mod+shift+S"],
    inFields: true,
  }),
  ...MESH_DOWNLOADS.map(([extension, format]) =>
    define("file", 2)(
      `download-${extension}`,
      `Download mesh as ${format}`,
      (app) => void downloadMesh(app, extension),
      { enabled: hasMesh },
    ),
  ),
  define("file", 2)("download-report", "Download mesh report (JSON)", downloadReport, { enabled: hasMesh }),
];

const editMenu: readonly Command[] = [
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
    { checked: (app) => viewState(app).several },
  ),
  define("edit", 1)("deselect", "Clear selection", (app) => app.view.clear(), {
    keys: ["Escape"],
    enabled: (app) => hasSelection(app) || hasMarks(app),
  }),
];

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

const viewMenu: readonly Command[] = [
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
      if (!hasMarks(app)) viewer?.fit(selection);
      else viewer?.fitMarked();
    },
    {
      keys: ["shift+F"],
      enabled: (app) => hasViewer(app) && (hasSelection(app) || hasMarks(app)),
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

/** Factors on all sizes of the background grid. */
const finer = 0.8;
const coarser = 1.25;

const meshMenu: readonly Command[] = [
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
  define("mesh", 2)("cover", "Make covering grid…", (app) => app.shell.setState({ dialog: "cover" })),
  define("mesh", 2)("mesh-as-grid", "Use this mesh as background grid", (app) => void takeMeshAsGrid(app), {
    enabled: (app) => (app.run.state.getState().mesh?.report.tetrahedra ?? 0) > 0,
  }),
  define("mesh", 2)("propose", "Propose sizes…", (app) => app.shell.setState({ dialog: "propose" })),
  define("mesh", 2)("uniform-size", "Uniform size", toggleUniformSize, {
    checked: (app) => app.documents.project.meshing?.size !== undefined,
  }),
  define("mesh", 3)("problems", "Show problems", (app) =>
    app.shell.setState({ bottomTab: "problems", drawer: "bottom" }),
  ),
];

const helpMenu: readonly Command[] = [
  define("help", 0)("help", "Keyboard and mouse", (app) => app.shell.setState({ dialog: "help" }), {
    keys: ["shift+?"],
  }),
];

/** Every command, in the order of the menus. */
export const commands: readonly Command[] = [
  ...fileMenu,
  ...editMenu,
  ...createMenu,
  ...viewMenu,
  ...meshMenu,
  ...helpMenu,
];

const byId = new Map(commands.map((command) => [command.id, command]));

/** The command of a name that is known to exist. */
export function commandNamed(id: string): Command {
  const command = byId.get(id);
  if (!command) throw new Error(`There is no command "${id}"`);
  return command;
}

/** Runs a command if it may run now. */
export function runCommand(app: App, command: Command): void {
  if (command.enabled(app)) command.run(app);
}

/** A hotkey for people: "mod+shift+Z" as "Ctrl Shift Z". */
export function keyNames(key: string): readonly string[] {
  const names: Readonly<Record<string, string>> = {
    mod: "Ctrl",
    shift: "Shift",
    alt: "Alt",
    Escape: "Esc",
    Delete: "Del",
  };
  return key.split("+").map((part) => names[part] ?? part);
}
