import { layerNames } from "./entities";

/** Labels of the commands in menus, palette and help. */
export const commandLabels = {
  new: "New project",
  newTemplate: "New from template…",
  open: "Open…",
  importSurface: "Import surface…",
  recent: "Open recent…",
  examples: "Open example…",
  save: "Save project",
  saveAs: "Save project as…",
  download: (format: string) => `Download mesh as ${format}`,
  downloadReport: "Download mesh report (JSON)",

  undo: (step: string | undefined) => (step === undefined ? "Undo" : `Undo: ${step}`),
  redo: (step: string | undefined) => (step === undefined ? "Redo" : `Redo: ${step}`),
  delete: "Delete selection",
  history: "Show history",
  rename: "Rename",
  group: "Group selection",
  selectSeveral: "Select several (each click toggles)",
  deselect: "Clear selection",
  selecting: {
    all: "Select all",
    inverse: "Invert selection",
    "same-kind": "Select all of the same kind",
    connected: "Select what is connected",
    boundary: "Select boundary",
    loop: "Select loop",
  },
  mergePatches: "Merge selected patches of a body",

  tools: {
    select: "Select",
    point: "Draw points",
    line: "Draw lines",
    patch: "Draw patches",
    node: "Draw background grid",
    source: "Draw sources",
    move: "Move",
    measure: "Measure",
  },
  planes: {
    xy: "Work plane XY",
    xz: "Work plane XZ",
    yz: "Work plane YZ",
    selection: "Work plane from selection",
  },
  newPoint: "Point by coordinates…",
  newNode: "Background node…",
  lines: {
    straight: "Straight line through points",
    parabolic: "Parabola through points",
    spline: "Cubic spline through points",
    closed: "Closed spline through points",
    arc: "Arc through three points",
    circle: "Circle through three points",
  },
  patches: {
    any: "Patch within lines",
    planar: "Planar patch",
    coons: "Coons patch",
    "isoparametric-triangle": "Isoparametric triangle",
    serendipity: "Serendipity patch",
    "barnhill-gregory-nielson": "Barnhill–Gregory–Nielson patch",
    tube: "Tube between two loops",
  },
  hole: "Hole in the patch",
  tetrahedron: "Background tetrahedron",
  split: "Split background tetrahedra",
  sources: { point: "Point source", segment: "Segment source", triangle: "Triangle source" },

  fit: "Fit model",
  fitSelection: "Fit selection",
  views: {
    isometric: "Isometric view",
    front: "Front view",
    right: "Right view",
    top: "Top view",
    back: "Back view",
    left: "Left view",
    bottom: "Bottom view",
  },
  cut: "Cut",
  flipCut: "Flip side of the cut",
  cutAcross: (axis: string) => `Cut across ${axis}`,
  layers: layerNames,
  hide: "Hide selection",
  isolate: "Isolate selection",
  showAll: "Show all",
  shadings: {
    "radius-ratio": "Shade by radius ratio",
    dihedral: "Shade by smallest dihedral angle",
    region: "Shade by region",
    plain: "Plain shading",
  },
  elementEdges: "Element edges",

  generate: "Generate mesh",
  cancel: { mesh: "Cancel meshing", improve: "Stop improving" },
  improve: "Improve mesh",
  refine: (factor: number) => `Make all sizes finer (× ${factor})`,
  coarsen: (factor: number) => `Make all sizes coarser (× ${factor})`,
  cover: "Create covering grid…",
  backgroundFromMesh: "Use this mesh as background grid",
  propose: "Propose sizes…",
  showSizes: "Show target sizes",
  uniformSize: "Uniform size",
  problems: "Show problems",

  front: {
    record: "Record the front",
    play: "Play or pause the front",
    forward: "Step of the front forward",
    back: "Step of the front back",
    farForward: (steps: number) => `${steps} steps of the front forward`,
    farBack: (steps: number) => `${steps} steps of the front back`,
    start: "First state of the front",
    end: "Last state of the front",
    close: "Show the model instead of the front",
  },

  lessons: "Lessons",
  present: "Presenter mode",
  help: "Keyboard and mouse",
} as const;

/** Names of the file formats of a mesh, by extension. */
export const downloadFormats = {
  vtu: "VTU (ParaView)",
  msh: "MSH 4.1 (Gmsh, scikit-fem)",
  "foam.zip": "polyMesh (OpenFOAM)",
  su2: "SU2",
  inp: "INP (Abaqus)",
  bdf: "BDF (Nastran)",
  "b8.ugrid": "UGRID",
  mesh: "Medit",
  vtk: "legacy VTK",
  stl: "STL (boundary)",
  glb: "GLB (boundary)",
} as const;

/** Formats for second-order elements, by extension. */
export const secondOrderFormats = {
  vtu: "second-order .vtu",
  msh: "second-order .msh",
  inp: "second-order .inp",
  bdf: "second-order .bdf",
} as const;

/** Keys whose names on a keyboard differ from those in the code. */
export const keyWords: Readonly<Record<string, string>> = {
  mod: "Ctrl",
  shift: "Shift",
  alt: "Alt",
  Escape: "Esc",
  Delete: "Del",
};
