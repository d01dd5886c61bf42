/** Texts of the page around the panels: header, view, status bar, dialogs and messages. */
import { formatCount } from "./format";
/** Number of deleted entities that a notice names. */
const maxNamed = 6;

const noStorage =
  "This browser keeps no documents for this page, as in some private windows or with blocked site data.";

export const pageStrings = {
  appName: "Tetrafront",
  menus: { file: "File", edit: "Edit", create: "Create", view: "View", mesh: "Mesh", help: "Help" },
  /** Sections of menus that are menus of their own, by their number. */
  submenus: {
    edit: { 2: "Select related", 4: "Work plane", 5: "Snapping", 6: "Transform", 7: "Combine bodies" },
    view: { 5: "Colours and edges", 6: "Settings" },
    create: {
      2: "Line from points",
      3: "Patch from lines",
      5: "Source",
      10: "Solid piece",
      11: "Solid from patches, features",
      12: "Sweep",
    },
  } as Readonly<
    Partial<Record<"file" | "edit" | "create" | "view" | "mesh" | "help", Readonly<Record<number, string>>>>
  >,
  header: {
    palette: "Search commands",
    paletteEmpty: "No command matches",
    tools: "Frequent commands",
    generate: "Generate mesh",
    generateShort: "Mesh",
    download: "Download mesh",
    light: "Light theme",
    dark: "Dark theme",
    panels: "Panels",
    busy: { mesh: "Meshing…", improve: "Improving…", adapt: "Adapting…" },
    cancel: { mesh: "Cancel", improve: "Stop", adapt: "Stop" },
    menu: "Menu",
  },
  gallery: {
    intro:
      "Opening an example meshes it right away. Your project remains available under File ▸ Open recent.",
    current: "open",
  },
  viewport: {
    label: "Three-dimensional view",
    tools: "Tools",
    menu: "Selection",
    showHidden: (count: number) => `Show ${count} hidden`,
    openEdges: (count: number) => (count === 1 ? "1 open edge" : `${count} open edges`),
    roles: "Roles and directions of the selected patch's lines in the paper's equation",
    stale: "Out of date",
    staleHint: "The model has changed since this mesh was made.",
    update: "Remesh",
    incomplete: "Incomplete",
    incompleteStalled: "The front stalled. Its remaining faces are orange.",
    incompleteCancelled: "The faces of the front are orange.",
    incompleteUnverified: "Cancelled before optimization and verification finished.",
    noWebgl: "This browser cannot show the view",
    noWebglHint:
      "The view needs WebGL 2. Turn on hardware acceleration or use a current browser. Everything else works, including downloads.",
    contextLost: "The graphics driver reset the view",
    contextLostHint: "The view returns in a moment. Your model and mesh are safe.",
    legend: "Colour scale",
    unoptimized: "not optimized yet",
    hints: [
      ["Right", "orbit"],
      ["Middle", "pan"],
      ["Wheel", "zoom"],
      ["F", "fit"],
    ],
    drop: "Drop a project, a surface file or a mesh file to open it",
    summaryNoMesh: (name: string) => `${name}, not meshed yet.`,
    summary: (name: string, tetrahedra: string, minAngle: string) =>
      `${name}, meshed with ${tetrahedra} tetrahedra, smallest dihedral angle ${minAngle}.`,
    summaryCancelled: (name: string, cancelled: string) => `${name}, not meshed to the end. ${cancelled}.`,
    cube: "View cube",
    cubeFaces: {
      front: "Front",
      back: "Back",
      right: "Right",
      left: "Left",
      top: "Top",
      bottom: "Bottom",
    },
    summaryCut: " The mesh is cut open.",
    summaryStale: " The mesh is out of date.",
    keys: "Arrow keys orbit, Shift with arrow keys pans, plus and minus zoom.",
  },
  status: {
    ready: "Ready",
    saved: "saved",
    unsaved: "unsaved changes",
    unchanged: "no changes",
    "without-mesh": "mesh not in the project",
    nodes: (count: string) => `${count} nodes`,
    tetrahedra: (count: string) => `${count} tetrahedra`,
    minDihedral: (angle: string) => `min dihedral ${angle}`,
    front: (count: string) => `${count} front faces`,
    filling: "Filling remaining pockets",
    /** While a number of elements is sought. */
    ofMesh: (phase: string, mesh: number) =>
      `Mesh ${mesh}: ${phase.charAt(0).toLowerCase()}${phase.slice(1)}`,
    cancel: { mesh: "Cancel meshing", improve: "Stop improving", adapt: "Stop adapting" },
    cancelling: { mesh: "Cancelling…", improve: "Stopping…", adapt: "Stopping…" },
    progress: {
      mesh: "Meshing progress",
      improve: "Progress of the improvement",
      adapt: "Progress of the adaptation",
    },
    timeLeft: ({ value, unit }: { readonly value: number; readonly unit: string }) =>
      `about ${value} ${unit} left`,
    improving: "Improving the elements",
    opened: (file: string) => `Mesh of ${file}`,
    done: "Mesh is up to date",
    stale: "Mesh is out of date",
    invalid: "The model has errors",
    stalled: "Mesh is incomplete",
    cancelled: "Meshing was cancelled",
  },
  messages: {
    openFailed: (file: string) => `${file} could not be opened`,
    addressFailed: "What the address asks for could not be shown",
    someFailed: (count: number) => `${count} files could not be opened`,
    noOpenDialog: "The browser did not open its dialog. Try again, or drop the file here.",
    saveFailed: "The project could not be saved",
    galleryFailed: "The examples could not be loaded",
    unknownExample: (id: string) => `There is no example “${id}”`,
    knownExamples: (ids: readonly string[]) => `Use one of these names: ${ids.join(", ")}.`,
    engineFailed: "The mesher failed",
    notDrawn: "The mesh could not be shown",
    partFailed:
      "A part of the application could not be loaded. Your model is safe. Reload the page when you are online.",
    reload: "Reload",
    downloadFailed: "The mesh could not be written",
    notImproved: "The mesh could not be improved",
    close: "Close",
  },
  notices: {
    label: "Notices",
    documentLeft: (name: string) => `“${name}” is available under File ▸ Open recent.`,
    reopen: "Reopen",
    noStorage,
    /** A refusal of the browser is a sentence already. */
    autosaveFailed: (reason: string) =>
      reason === noStorage
        ? `${noStorage} Save the project to a file before you close it.`
        : `The browser could not store your changes: ${reason.replace(/\.$/, "")}. Save the project to a file. The app keeps trying.`,
    retry: "Try again",
    dismiss: "Dismiss",
    undo: "Undo",
    deleted: (step: string, others: readonly string[]) =>
      `${step.replace(/^Delete /, "Deleted ")}: ${others.slice(0, maxNamed).join(", ")}${others.length > maxNamed ? ` and ${others.length - maxNamed} more` : ""}.`,
    understood: "OK",
    comparingRepairs: "Two repairs of the surface are compared. The better one is made, and then the mesh.",
    repairNow: "Do not wait",
    showLog: "Show log",
    improvementDiscarded: "The improvement was discarded, because the model has changed meanwhile.",
    showQuality: "Show quality",
  },
  files: {
    description: "Tetrafront project",
    part: "CAD part",
    anyDescription: "Project, surface or mesh",
    unknownFormat: (extension: string) =>
      extension === ""
        ? "A file without an extension is of no known format."
        : `Files that end in ${extension} cannot be opened.`,
    /** Given the extensions of CAD files, of surfaces, and of meshes. */
    knownFormats: ([cad = [], surfaces = [], meshes = []]: readonly (readonly string[])[]) => [
      "These can be opened:",
      "Projects: .json",
      `CAD: ${cad.join(", ")}`,
      `Surfaces: ${surfaces.join(", ")}`,
      `Meshes: ${meshes.join(", ")}`,
    ],
    meshDescription: "Surface or mesh file",
    meshNotSaved:
      "Projects contain the surface of an opened mesh, not its elements. Download the mesh to keep it.",
    meshFields: (names: readonly string[]) =>
      `The mesh has fields: ${names.join(", ")}. The tab Solution shows them.`,
    noCadLibrary:
      "The library that reads CAD files is not kept in this browser, and there is no network. Open a CAD file once with a network, or use Keep for offline use in the Help menu.",
    keptTriangles:
      "Its triangles are well shaped, so Generate mesh keeps them, unless they must be repaired or joined to those of other bodies. Those that are far too large beside small ones are divided. Select Remesh under Triangles to replace all.",
    needles: (needles: number, triangles: number) =>
      `${formatCount(needles)} of ${formatCount(triangles)} triangles are needles, so Generate mesh replaces all by well-shaped ones. Select Keep under Triangles to mesh them as they are.`,
    regionPointsUnused: (count: number) =>
      `${count === 1 ? "A point that marks a region or hole is" : `${count} points that mark regions and holes are`} not used in projects. The command line uses them: tetrafront mesh.`,
    scaledUnit: (name: string, unit: string, units: string) =>
      `“${name}” is in ${unit} and was scaled to ${units}, the unit of the project.`,
    otherUnit: (name: string, unit: string, units: string) =>
      `“${name}” is in ${unit}, the project in ${units}. Set the scale of its bodies.`,
    furtherProject: "A project cannot be added to another document. Drop it alone.",
    reason: (file: string, reasons: readonly string[]) => `${file}: ${reasons.join(" ")}`,
    error: (message: string, line: number | undefined) =>
      line === undefined ? message : `Line ${line}: ${message}`,
  },
  recent: {
    title: "Open recent",
    hint: "This browser stores every project that you change, with its undo history.",
    none: "No project has been changed yet.",
    openIn: { "this-tab": "Open now", "another-tab": "Open in another tab" },
    /** The same, after the time of the last change. */
    alsoOpenIn: { "this-tab": "open now", "another-tab": "open in another tab" },
    loading: "Reading the list",
    /** A refusal of the browser is a sentence already. */
    noList: (reason: string) => (reason === noStorage ? reason : `The list cannot be read: ${reason}.`),
    remove: (name: string) => `Remove “${name}”`,
    failures: {
      "open-in-another-tab": "The project is open in another tab.",
      missing: "The browser no longer stores this project.",
      unreadable: "The stored project cannot be read.",
    },
  },
  help: {
    title: "Keyboard and mouse",
    keys: "The keys of all commands, and what the mouse and fingers do in the view.",
    contents: "Contents of the help",
    search: "Search the help",
    inMenu: (menu: string) => `menu ${menu}`,
    found: (count: number, shown: number) =>
      count === 0
        ? "Nothing found"
        : count === 1
          ? "1 section"
          : count === shown
            ? `${count} sections`
            : `The first ${shown} of ${count} sections`,
    documents: {
      readme: "Introduction",
      format: "Files and formats",
      package: "Package for programs",
      adaptive: "Adaptive meshes",
      lessons: "Writing lessons",
      trace: "Recorded fronts",
      paper: "The paper",
      design: "How it works",
      architecture: "Architecture",
      benchmarks: "Benchmarks",
      cad: "CAD files",
      actions: "Actions per task",
      changelog: "Changes",
    } as Readonly<Record<string, string>>,
    mouse: [
      ["Click", "select; in the view, Shift adds and Ctrl toggles"],
      ["Shift click, Shift ↑ ↓", "in the tree and in lists: select all rows between; Ctrl Shift adds them"],
      ["Ctrl click", "in the tree and in lists: add or remove a row"],
      ["Tab, Shift Tab", "after a click: select the next or previous entity under the pointer instead"],
      ["Double click", "edit the entity under the pointer; elsewhere, and by a finger, fit the view"],
      [
        "Left drag",
        "select in a box: to the right what lies inside, to the left what is touched; with Alt a lasso: clockwise what lies inside, counter-clockwise what is touched",
      ],
      ["Right click", "menu of the selection"],
      ["Right drag", "orbit"],
      ["Middle drag, Shift drag", "pan"],
      ["Wheel", "zoom at the pointer"],
      ["One finger, two fingers", "orbit; pan and zoom"],
    ],
    fields: [
      ["↑ ↓", "step a number; Shift × 10, Alt ÷ 10"],
      ["Enter, Esc", "apply or discard a typed value"],
      [
        "0–9 @ ( + − =",
        "while drawing: open the field for coordinates. So does a letter that begins a parameter or function; if it is a hotkey, too, its command runs after a moment or by Enter",
      ],
      ["Arrow keys", "in the view: orbit; Shift pans; + − zoom"],
      [
        "Arrow keys, Page ↑ ↓",
        "in the move tool: move the selection by a step of the grid; Shift × 10, Alt ÷ 10",
      ],
    ],
    about:
      "Tetrafront fills shapes with tetrahedra by the advancing-front method of R. Löhner and P. Parikh, “Generation of three-dimensional unstructured grids by the advancing-front method”, Int. J. Numer. Methods Fluids 8 (1988).",
    license: "Licence of Tetrafront: MIT",
    notices: "licences of works of others",
    cadLibrary:
      "CAD files are read by a library that is loaded when the first one is opened. Its licence is the LGPL 2.1:",
  },
  presenter: {
    title: "Presenter mode",
    laser: "Laser",
    end: "End",
    blank: "The screen is black. Press B to show it again.",
  },
} as const;
