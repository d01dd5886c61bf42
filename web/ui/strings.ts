import type { MeshReport } from "tetrafront";
import type { DrawnKind } from "../document/entities";

/** All texts of the application. */

export const entityWords: { readonly [K in DrawnKind]: { readonly one: string; readonly many: string } } = {
  point: { one: "Point", many: "Points" },
  line: { one: "Line", many: "Lines" },
  patch: { one: "Patch", many: "Patches" },
  "background-node": { one: "Node", many: "Background grid" },
  source: { one: "Source", many: "Sources" },
};

export const lineTypeNames = {
  straight: "straight",
  parabolic: "parabola",
  spline: "cubic spline",
} as const;

export const patchTypeNames = {
  planar: "planar",
  coons: "Coons",
  "isoparametric-triangle": "isoparametric triangle",
  serendipity: "serendipity",
  "barnhill-gregory-nielson": "Barnhill–Gregory–Nielson",
} as const;

/** The lines that each type of patch needs. */
export const patchTypeHints = {
  planar: "Any lines that lie in one plane; holes allowed.",
  coons: "Four lines of any type; opposite lines are blended. Holes allowed.",
  "isoparametric-triangle": "Three parabolic lines: a curved triangle with six nodes. Holes allowed.",
  serendipity: "Four parabolic lines: a curved quadrilateral with eight nodes. Holes allowed.",
  "barnhill-gregory-nielson": "Three lines of any type; the second one, F2, has another role. Holes allowed.",
} as const;

export const sourceTypeNames = { point: "point", segment: "segment", triangle: "triangle" } as const;

export const phaseNames = {
  check: "Checking the model",
  sides: "Dividing lines",
  surface: "Meshing patches",
  volume: "Advancing the front",
  optimize: "Optimizing the elements",
  verify: "Verifying",
} as const;

export const measureNames = {
  "radius-ratio": "Radius ratio",
  dihedral: "Smallest dihedral angle",
} as const;

/** Returns a code such as "loop-not-closed" as a heading. */
function problemTitle(code: string): string {
  const words = code.replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const counted = (count: number, one: string, many: string): string =>
  count === 1 ? `1 ${one}` : `${count.toLocaleString("en-US")} ${many}`;

/** Returns a sentence for each kind of recovery that the run needed. */
export function recoverySteps({
  relaxed,
  starred,
  remeshed,
  filled,
  steinerPoints,
}: MeshReport["recovery"]): readonly string[] {
  const steps: readonly (readonly [count: number, step: string])[] = [
    [
      relaxed,
      `Relaxed: ${counted(relaxed, "element was", "elements were")} accepted by a more lenient rule.`,
    ],
    [starred, `Starred: ${counted(starred, "pocket was", "pockets were")} joined to one interior point.`],
    [
      remeshed,
      `Remeshed: ${counted(remeshed, "pocket was", "pockets were")} filled after the surrounding elements were removed.`,
    ],
    [filled, `Filled: ${counted(filled, "pocket was", "pockets were")} closed by the exact fill.`],
    [
      steinerPoints,
      `Steiner points: the exact fill added ${counted(steinerPoints, "interior point", "interior points")}.`,
    ],
  ];
  return steps.flatMap(([count, step]) => (count > 0 ? [step] : []));
}

export const strings = {
  problemTitle,
  appName: "Tetrafront",
  menus: { file: "File", edit: "Edit", create: "Create", view: "View", mesh: "Mesh", help: "Help" },
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
    meshing: "Meshing…",
    menu: "Menu",
  },
  tree: {
    model: "Model",
    examples: "Examples",
    filter: "Filter (name, type, id)",
    clearFilter: "Clear filter",
    nothing: "Nothing matches.",
    empty: "This project is empty. Create a point (Create menu), or open an example or a project file.",
    add: (what: string) => `Add ${what}`,
    show: (what: string) => `Show ${what}`,
    hide: (what: string) => `Hide ${what}`,
    problems: (count: number) => (count === 1 ? "1 problem" : `${count} problems`),
  },
  gallery: {
    intro: "Opening an example meshes it right away. Your project stays under File ▸ Open recent.",
    current: "open",
  },
  inspector: {
    title: "Inspector",
    display: "Display",
    nothingSelected: "Select an entity in the tree or in the view to edit it.",
    several: (count: number) => `${count} entities selected`,
    closedChain: (count: number) => `${count} points, closed`,
    closed: "Closed",
    more: (count: number) => `and ${count} more`,
    makeOf: "Create from selection",
    deleteAll: "Delete selection",
    name: "Name",
    position: "Position",
    size: "Size",
    stretching: "Stretching",
    direction: "Direction",
    type: "Type",
    points: "Points",
    outerLoop: "Outer loop",
    hole: (index: number) => `Hole ${index}`,
    usedBy: "Used by",
    project: "Project",
    linePointsHint: "Point ids along the line, separated by commas.",
    loopHint: "Line ids in order; a minus reverses a line.",
    lines: "Lines",
    makeSecond: (line: string) => `Make ${line} F2`,
    makeSecondShort: "make F2",
    holeHint:
      "To cut a hole, also select the lines around it (Ctrl click, or Select several in the Edit menu), then create a hole from them.",
    secondRole:
      "Equation (14) gives F2 other weights than F1 and F3. Another F2 keeps the three lines but changes the surface between them.",
    backwards: "reversed",
    removeHole: (index: number) => `Remove hole ${index}`,
    distance: "Distance",
    growth: "Growth",
    place: (index: number, of: number) => (of === 1 ? "Position" : `Position ${index + 1}`),
    sourceRule:
      "Limits elements to Size within Distance. Beyond it, the limit rises by Growth per unit of distance.",
    valid: "valid",
    element: (index: string) => `Tetrahedron ${index}`,
    elementNodes: "Nodes",
  },
  fields: {
    notANumber: "Enter a number, such as 0.25 or 1/3",
    aboveZero: "Must be above 0",
    atLeastOne: "Must be at least 1",
    notNegative: "Must not be below 0",
    atMost: (most: number) => `Must be at most ${most}`,
    unknownPoint: (id: string) => `There is no point ${id}`,
    unknownLine: (id: string) => `There is no line ${id}`,
    twoPoints: "A line needs at least two points",
    oneLine: "A loop needs at least one line",
    zeroDirection: "The direction must not be 0, 0, 0",
  },
  quality: {
    title: "Mesh quality",
    min: "min",
    mean: "mean",
    tetrahedra: "Tetrahedra",
    nodes: "Nodes",
    triangles: "Boundary triangles",
    volume: "Volume",
    dihedral: "Dihedral angles",
    time: "Time",
    fingerprint: "Fingerprint",
    copied: "copied",
    none: "No mesh yet.",
    unmeasured: "–",
    bar: (count: string, from: string, to: string) => `${count} tetrahedra from ${from} to ${to}`,
    histogram: (measure: string) => `Histogram of the ${measure.toLowerCase()}`,
  },
  report: {
    tab: "Quality",
    title: "Quality report",
    notFinished: "The mesh is not finished, so it has no statistics yet.",
    stretchedHint:
      "The background grid asks for stretched elements. Histograms, worst elements and missed angles are measured in its metric; min, max and mean are measured in space.",
    verdicts: { passed: "Verified", failed: "Verification failed", none: "Not verified" },
    verdictHints: {
      passed:
        "Verified in exact arithmetic: every element has positive volume, elements share whole faces, and the boundary is the given one.",
      failed: "",
      none: "The mesh is verified when it is finished.",
    },
    region: "Region",
    allRegions: (tetrahedra: string) => `All regions: ${tetrahedra} tetrahedra`,
    oneRegion: (region: number, tetrahedra: string) => `Region ${region}: ${tetrahedra} tetrahedra`,
    dihedral: "Dihedral angles",
    radiusRatio: "Radius ratio",
    edge: "Edge length / target",
    angles: "angles",
    tetrahedra: "tetrahedra",
    edges: "edges",
    max: "max",
    bar: (count: string, noun: string, from: string, to: string) => `${count} ${noun} from ${from} to ${to}`,
    nearTarget: (from: number, to: number) => `${from} to ${to}`,
    volumeRatio: "Volume ratio (max / min)",
    smallest: "Smallest volume",
    outOfRange: "Outside 30°–135°",
    outOfRangeHint:
      "Counts tetrahedra with a dihedral angle outside 30°–135°, except those limited by the boundary.",
    limited: "Limited by the boundary",
    limitedHint:
      "Counts tetrahedra with a dihedral angle outside 30°–135° at a sharp boundary edge, at a needle triangle of the boundary, or in a gap narrower than an element.",
    limitedTitle: (count: string) => `Limited by the boundary: ${count}`,
    worst: (count: number) => `Worst ${count}`,
    columns: ["Position", "Min", "Max", "Ratio"],
    show: (tetrahedron: string, place: string) => `Go to tetrahedron ${tetrahedron} at ${place}`,
    recovery: "How the front closed",
    noRecovery: "The front closed without recovery.",
    all: "All statistics",
  },
  patches: {
    tab: "Patches",
    title: "Patch triangulations",
    one: "Triangulation",
    patch: "Patch",
    triangles: "Triangles",
    minAngle: "Min angle",
    meanRatio: "Mean 2r/R",
    meanEdge: "Mean edge / target",
    deviation: "Chord deviation",
    none: "No statistics: mesh the current model.",
  },
  display: {
    layers: "Layers",
    points: "Points",
    lines: "Lines",
    patches: "Patches",
    background: "Background grid",
    sources: "Sources",
    mesh: "Mesh",
    shading: "Shading",
    region: "Region",
    plain: "Plain",
    dihedral: "Dihedral",
    edges: "Element edges",
    cut: "Cut",
    cutOn: "Cut mesh",
    cutAxis: "Cut axis",
    cutPosition: "Position",
    flip: "Flip side",
  },
  create: {
    point: "New point",
    node: "New background node",
    position: "Position",
    size: "Size",
    add: "Add",
    addNext: "Add and next",
    added: (what: string) => `Added ${what}.`,
    nodeHint: "A node takes effect as a corner of a tetrahedron: select four nodes and press T.",
    line: "New line",
    lineHint: [
      "Select its points in order (Ctrl click adds one). Then press L for straight lines, Q for a parabola or S for a cubic spline. Shift click the first point again to close the chain; Shift S closes a spline directly.",
    ],
    patch: "New patch",
    patchHint: [
      "Select its lines in any order (Ctrl click adds one). Then press A, or choose a type in the Create menu. Several loops make a patch with holes.",
    ],
  },
  background: {
    cover: "Create covering grid",
    coverHint: "Creates a background grid around the whole model, with the same element size at every node.",
    shape: "Shape",
    box: "Box, 5 tetrahedra",
    tetrahedron: "One tetrahedron",
    replaces: "This replaces the current background grid and keeps the sources. You can undo it.",
    make: "Create",
    cancel: "Cancel",
    apply: "Apply",
    applyAnyway: "Apply anyway",
    tooMany:
      "Meshing this many elements takes minutes and gigabytes of memory. Thin regions need more elements than it seems.",
    coarser: (count: string) => `Larger elements: fewer than ${count}`,
    backgroundFromMesh: "Use this mesh as background grid",
    propose: "Propose sizes",
    proposeHint: "Proposes sources with smaller sizes at curved lines and patches and in narrow gaps.",
    wishes: {
      uniform: "Largest size",
      smallest: "Smallest size",
      elementsPerCircle: "Elements per circle",
      elementsPerGap: "Elements per gap",
      growth: "Growth",
    },
    coverToo: "Also create a covering grid with the largest size",
    replaceSources: (count: number) =>
      count === 1 ? "Replace the existing source" : `Replace the ${count} existing sources`,
    asking: "Analysing the model…",
    largest: "Largest size",
    smallestFound: "Smallest size",
    sources: "Sources to add",
    expected: "Expected",
    about: (count: string) => `about ${count} tetrahedra`,
    present: "Current mesh",
    elementSize: "Element size",
    fromGrid: "Background grid",
    uniform: "Uniform",
    uniformSize: "Uniform size",
    uniformHint: "Uses one size everywhere; only sources make it smaller.",
    noGrid: "There is no background grid yet.",
    gridCounts: (nodes: string, tetrahedra: string) =>
      `${nodes} nodes, ${tetrahedra} ${tetrahedra === "1" ? "tetrahedron" : "tetrahedra"}`,
  },
  meshing: {
    title: "Mesh settings",
    order: "Front order",
    orders: { layered: "Layered", "smallest-first": "Smallest first" },
    orderHints: {
      layered: "Advances the front layer by layer, which is fastest.",
      "smallest-first": "Takes the smallest face of the front next, as in the paper.",
    },
    optimization: "Optimization",
    optimizations: { none: "None", fast: "Fast", default: "Default", thorough: "Thorough" },
    optimizationHints: {
      none: "keeps the elements that the front made.",
      fast: "swaps edges and moves nodes, then improves the worst elements.",
      default:
        "also splits and collapses edges; angles end between 30° and 135° where the boundary allows it.",
      thorough: "continues towards angles between 35° and 130°.",
    },
    gradation: "Gradation",
    gradationHint: "Limits the size ratio of neighbouring elements in the background grid; 0 means no limit.",
    invalidGradation: "Must be 0, or above 1 and up to 10",
    innerShells: "Inner shells",
    innerShellModes: { cavities: "Cavities", regions: "Regions" },
    innerShellHints: {
      cavities: "Leaves closed shells inside a region empty.",
      regions: "Meshes closed shells inside a region as regions of their own.",
    },
  },
  regions: {
    title: "Regions",
    hide: "Hide region",
    show: "Show region",
  },
  triangles: {
    count: (count: string, single: boolean) => (single ? "1 triangle" : `${count} triangles`),
    one: (triangle: string) => `Triangle ${triangle}`,
    all: "Show all",
  },
  severities: { error: "Error", warning: "Warning" },
  bottom: {
    title: "Log and problems",
    log: "Log",
    problems: "Problems",
    logEmpty: "The mesher's messages appear here.",
    noProblems: "No problems found.",
    show: "Show",
    at: (position: string) => `at ${position}`,
    showPosition: (position: string) => `Go to ${position}`,
    count: (count: number, severity: "error" | "warning") =>
      count === 1 ? `1 ${severity}` : `${count} ${severity}s`,
  },
  viewport: {
    label: "Three-dimensional view",
    roles: "Roles of the selected patch's lines in equation (14)",
    stale: "Out of date",
    staleHint: "The model has changed since this mesh was made.",
    update: "Remesh",
    incomplete: "Incomplete",
    incompleteStalled: "The front stalled. Its remaining faces are orange.",
    incompleteCancelled: "Cancelled. The remaining faces of the front are orange.",
    incompleteUnpolished: "Cancelled before optimization and verification finished.",
    noWebgl: "This browser cannot show the view",
    noWebglHint:
      "The view needs WebGL 2. Turn on hardware acceleration or use a current browser. Everything else works, including downloads.",
    contextLost: "The graphics driver reset the view",
    contextLostHint: "The view returns in a moment. Your model and mesh are safe.",
    legend: "Colour scale",
    hints: [
      ["Drag", "orbit"],
      ["Middle", "pan"],
      ["Wheel", "zoom"],
      ["F", "fit"],
    ],
    drop: "Drop a project file to open it",
    summaryNoMesh: (name: string) => `${name}, not meshed yet.`,
    summary: (name: string, tetrahedra: string, minAngle: string) =>
      `${name}, meshed with ${tetrahedra} tetrahedra, smallest dihedral angle ${minAngle}.`,
    summaryCut: " Cut open.",
    summaryStale: " The mesh is out of date.",
    keys: "Arrow keys orbit, Shift with arrow keys pans, plus and minus zoom.",
  },
  status: {
    ready: "Ready",
    saved: "saved",
    unsaved: "unsaved changes",
    nodes: (count: string) => `${count} nodes`,
    tetrahedra: (count: string) => `${count} tetrahedra`,
    minDihedral: (angle: string) => `min dihedral ${angle}`,
    front: (count: string) => `front ${count} faces`,
    filling: "Filling remaining pockets",
    exactFill: (fraction: string) => `exact fill ${fraction}`,
    cancel: "Cancel meshing",
    cancelling: "Cancelling…",
    progress: "Meshing progress",
    done: "Mesh is up to date",
    stale: "Mesh is out of date",
    invalid: "The model has errors",
    stalled: "Mesh is incomplete",
    cancelled: "Meshing was cancelled",
  },
  messages: {
    openFailed: (file: string) => `${file} could not be opened`,
    noOpenDialog: "The browser did not open its dialog. Try again, or drop the file here.",
    saveFailed: "The project could not be saved",
    galleryFailed: "The examples could not be loaded",
    engineFailed: "The mesher failed",
    notDrawn: "The mesh could not be shown",
    partFailed:
      "A part of the application could not be loaded. Your model is safe. Reload the page when you are online.",
    reload: "Reload",
    downloadFailed: "The mesh could not be written",
    close: "Close",
  },
  notices: {
    label: "Notices",
    documentLeft: (name: string) => `“${name}” is kept under File ▸ Open recent.`,
    reopen: "Reopen",
    autosaveFailed: (reason: string) =>
      `The browser could not keep your changes: ${reason}. Save the project to a file; the app keeps trying.`,
    retry: "Try again",
    dismiss: "Dismiss",
  },
  recent: {
    title: "Open recent",
    hint: "This browser keeps every project that you change, with its steps of undo.",
    none: "No project has been changed yet.",
    open: "Open now",
    loading: "Reading the list",
    remove: (name: string) => `Remove “${name}”`,
    failures: {
      "open-in-another-tab": "The project is open in another tab.",
      missing: "The browser does not keep the project any more.",
      unreadable: "The kept project cannot be read.",
    },
  },
  help: {
    title: "Keyboard and mouse",
    mouse: [
      ["Click", "select; Shift adds (in the tree: extends to here), Ctrl toggles"],
      ["Double click", "fit the entity under the pointer"],
      ["Left or right drag", "orbit"],
      ["Middle drag", "pan"],
      ["Wheel", "zoom at the pointer"],
      ["One finger, two fingers", "orbit; pan and zoom"],
    ],
    fields: [
      ["↑ ↓", "step a number; Shift × 10, Alt ÷ 10"],
      ["Enter, Esc", "apply or discard a typed value"],
      ["Arrow keys", "in the view: orbit; Shift pans; + − zoom"],
    ],
    about:
      "Tetrafront fills shapes with tetrahedra by the advancing-front method of R. Löhner and P. Parikh, “Generation of three-dimensional unstructured grids by the advancing-front method”, Int. J. Numer. Methods Fluids 8 (1988).",
  },
} as const;
