import type { App } from "../app/app";
import { define, type Command } from "./command";
import { downloadMesh, downloadReport } from "./download-actions";
import { newProject, openFromDialog, save } from "./project-actions";

const hasMesh = (app: App): boolean => app.run.state.getState().mesh !== null;

/** Extension and label of each format. docs/FORMAT.md describes their content. */
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

/** Ids of the commands in the download menu of the header. */
export const DOWNLOADS: readonly string[] = [
  ...MESH_DOWNLOADS.map(([extension]) => `download-${extension}`),
  "download-report",
];

export const fileMenu: readonly Command[] = [
  define("file", 0)("new", "New project", newProject),
  define("file", 0)("open", "Open project…", (app) => void openFromDialog(app), {
    keys: ["mod+O"],
    inFields: true,
  }),
  define("file", 0)("recent", "Open recent…", (app) => app.shell.setState({ dialog: "recent" }), {
    keys: ["mod+shift+O"],
    inFields: true,
    enabled: (app) => app.library !== null,
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
