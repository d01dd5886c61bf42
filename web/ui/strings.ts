import type { MeshReport } from "tetrafront";
import type { DrawnKind } from "../document/entities";

/** Every text of the app, in one place. The words are those of the method: point, line, patch, side … */

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

/** What each type of patch is spanned by. */
export const patchTypeHints = {
  planar: "Any lines that lie in one plane; holes allowed.",
  coons: "Four lines of any type; opposite lines are blended. Holes allowed.",
  "isoparametric-triangle": "Three parabolic lines: a curved triangle of six nodes. Holes allowed.",
  serendipity: "Four parabolic lines: a curved quadrangle of eight nodes. Holes allowed.",
  "barnhill-gregory-nielson": "Three lines of any type; the second, F2, plays another role. Holes allowed.",
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

/** A code such as "loop-not-closed" as a heading. */
function problemTitle(code: string): string {
  const words = code.replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const counted = (count: number, one: string, many: string): string =>
  count === 1 ? `1 ${one}` : `${count.toLocaleString("en-US")} ${many}`;

/** What was done where the front did not close by itself; nothing of what was not needed. */
export function recoverySteps({
  relaxed,
  starred,
  reopened,
  filled,
  steinerPoints,
}: MeshReport["recovery"]): readonly string[] {
  const steps: readonly (readonly [count: number, step: string])[] = [
    [
      relaxed,
      `Relaxed: ${counted(relaxed, "element was", "elements were")} accepted by a more lenient rule.`,
    ],
    [starred, `Starred: ${counted(starred, "pocket was", "pockets were")} filled from one point inside.`],
    [
      reopened,
      `Reopened: ${counted(reopened, "pocket was", "pockets were")} filled after the elements around had been taken away.`,
    ],
    [filled, `Filled: ${counted(filled, "pocket was", "pockets were")} left to the exact fill.`],
    [
      steinerPoints,
      `Steiner points: the exact fill added ${counted(steinerPoints, "point", "points")} inside.`,
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
    paletteEmpty: "No command of that name",
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
    filter: "Filter (name, type, number)",
    clearFilter: "Clear the filter",
    nothing: "Nothing of that name.",
    empty: "This project is empty. Begin with a point (Create menu), an example or a project file.",
    add: (what: string) => `Add ${what}`,
    show: (what: string) => `Show ${what}`,
    hide: (what: string) => `Hide ${what}`,
    problems: (count: number) => (count === 1 ? "1 problem" : `${count} problems`),
  },
  gallery: {
    intro: "Open one and it is meshed at once. Undo brings back what you had.",
    current: "open",
  },
  inspector: {
    title: "Inspector",
    display: "Display",
    nothingSelected: "Select something in the tree or in the view to edit it.",
    several: (count: number) => `${count} entities selected`,
    closedChain: (count: number) => `${count} points, closed`,
    closed: "Closed",
    more: (count: number) => `and ${count} more`,
    makeOf: "Make of the selection",
    deleteAll: "Delete these",
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
    linePointsHint: "Point numbers along the line, separated by commas.",
    loopHint: "Line numbers in walking order; a minus walks backwards.",
    lines: "Lines",
    makeSecond: (line: string) => `Make ${line} F2`,
    makeSecondShort: "make F2",
    holeHint:
      "To cut a hole, select the lines around it as well (Ctrl click, or Select several in the Edit menu) and make a hole of them.",
    secondRole:
      "Equation (14) blends F2 with other weights than F1 and F3. Another F2 keeps the three lines but changes the surface between them.",
    backwards: "walked backwards",
    removeHole: (index: number) => `Remove hole ${index}`,
    distance: "Distance",
    growth: "Growth",
    place: (index: number, of: number) => (of === 1 ? "Place" : `Place ${index + 1}`),
    sourceRule: "Elements are no larger than the size up to the distance, then grow by this much per unit.",
    valid: "valid",
    element: (index: string) => `Tetrahedron ${index}`,
    elementNodes: "Nodes",
  },
  fields: {
    notANumber: "Type a number, such as 0.25 or 1/3",
    aboveZero: "Must be above 0",
    atLeastOne: "Must be at least 1",
    notNegative: "Must not be below 0",
    unknownPoint: (id: string) => `There is no point ${id}`,
    unknownLine: (id: string) => `There is no line ${id}`,
    twoPoints: "A line needs at least two points",
    oneLine: "A loop needs at least one line",
    zeroDirection: "Needs a direction other than 0, 0, 0",
  },
  quality: {
    title: "Mesh quality",
    min: "min",
    mean: "mean",
    tetrahedra: "Tetrahedra",
    points: "Points",
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
    notFinished: "The mesh is not finished: its elements have not been measured.",
    verdicts: { passed: "Verified", failed: "Verification failed", none: "Not verified" },
    verdictHints: {
      passed:
        "In exact arithmetic every element has positive volume, the elements fit together face to face, and the boundary is the given one.",
      failed: "",
      none: "A mesh is verified when it is finished.",
    },
    region: "Region",
    allRegions: (tetrahedra: string) => `All regions: ${tetrahedra} tetrahedra`,
    oneRegion: (region: number, tetrahedra: string) => `Region ${region}: ${tetrahedra} tetrahedra`,
    dihedral: "Dihedral angles",
    radiusRatio: "Radius ratio",
    edge: "Edge length by wanted length",
    angles: "angles",
    tetrahedra: "tetrahedra",
    edges: "edges",
    max: "max",
    bar: (count: string, noun: string, from: string, to: string) => `${count} ${noun} from ${from} to ${to}`,
    nearWanted: (from: number, to: number) => `${from} to ${to}`,
    volumeRatio: "Largest by smallest volume",
    smallest: "Smallest volume",
    missed: "Angles missed",
    missedHint: "Tetrahedra with an angle below 30° or above 135° which the boundary does not excuse",
    limited: "Limited by the boundary",
    limitedHint:
      "Tetrahedra that miss their angles because they lie in a sharper edge of the boundary, on one of its needle triangles, or between two parts of it that are nearer than an element is wide.",
    limitedTitle: (count: string) => `Limited by the boundary: ${count}`,
    worst: (count: number) => `Worst ${count}`,
    columns: ["Place", "Min", "Max", "Ratio"],
    show: (tetrahedron: string, place: string) => `Go to tetrahedron ${tetrahedron} at ${place}`,
    recovery: "How the front closed",
    noRecovery: "By its own rules; nothing had to be recovered.",
    all: "All figures",
  },
  patches: {
    tab: "Patches",
    title: "Patch triangulations",
    one: "Triangulation",
    patch: "Patch",
    triangles: "Triangles",
    minAngle: "Min angle",
    meanRatio: "Mean 2r/R",
    meanEdge: "Mean edge / wanted",
    deviation: "Chord deviation",
    none: "No figures: mesh the model as it now is.",
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
    plain: "Plain",
    dihedral: "Dihedral",
    edges: "Element edges",
    cut: "Cut",
    cutOn: "Cut the mesh open",
    cutAxis: "Cut across",
    cutPosition: "Position",
    flip: "Other side",
  },
  create: {
    point: "New point",
    node: "New background node",
    position: "Position",
    size: "Size",
    add: "Add",
    addNext: "Add and next",
    added: (what: string) => `Added ${what}.`,
    nodeHint: "It takes effect as a corner of a tetrahedron: select four nodes and press T.",
    line: "New line",
    lineHint: [
      "Select the points it runs through, in order (Ctrl click adds one), then press L for straight lines, Q for a parabola or S for a cubic spline. Shift click on the first point again closes the chain; Shift S closes a spline by itself.",
    ],
    patch: "New patch",
    patchHint: [
      "Select the lines around it, in any order (Ctrl click adds one), then press A, or choose a type in the Create menu. Several loops make a patch with holes.",
    ],
  },
  background: {
    cover: "Make covering grid",
    coverHint: "A background grid around the whole model, with one element size at every node.",
    shape: "Shape",
    box: "Box, 5 tetrahedra",
    tetrahedron: "One tetrahedron",
    replaces: "The present background grid is replaced; undo brings it back. Sources stay.",
    make: "Make it",
    cancel: "Cancel",
    apply: "Apply",
    applyAnyway: "Apply all the same",
    tooMany: "So many elements take minutes and gigabytes. Thin places ask for more of them than they look.",
    coarser: (count: string) => `Larger elements: fewer than ${count}`,
    meshAsGrid: "Use this mesh as background grid",
    propose: "Propose sizes",
    proposeHint: "Sources of smaller size where lines and patches bend or come near each other.",
    wishes: {
      uniform: "Largest size",
      smallest: "Smallest size",
      elementsPerCircle: "Elements per circle",
      elementsPerGap: "Elements per gap",
      growth: "Growth",
    },
    coverToo: "Make a covering grid of the largest size",
    replaceSources: (count: number) =>
      count === 1 ? "Replace the source there is" : `Replace the ${count} sources there are`,
    asking: "Looking at the model…",
    largest: "Largest size",
    smallestFound: "Smallest size",
    sources: "Sources to add",
    expected: "Expected",
    about: (count: string) => `about ${count} tetrahedra`,
    present: "Present mesh",
    elementSize: "Element size",
    fromGrid: "Background grid",
    uniform: "Uniform",
    uniformSize: "Uniform size",
    uniformHint: "One size everywhere; only sources make it smaller.",
    noGrid: "There is no background grid yet.",
    gridCounts: (nodes: string, tetrahedra: string) =>
      `${nodes} nodes, ${tetrahedra} ${tetrahedra === "1" ? "tetrahedron" : "tetrahedra"}`,
  },
  meshing: {
    title: "Mesh settings",
    order: "Order",
    orders: { layered: "Layered", "smallest-first": "Smallest first" },
    orderHints: {
      layered: "The front advances layer by layer: fastest.",
      "smallest-first": "The smallest face of the front comes next, as in the paper.",
    },
    optimization: "Optimization",
    optimizations: { none: "None", fast: "Fast", default: "Default", strive: "Strive" },
    optimizationHints: {
      none: "the elements stay as the front made them.",
      fast: "swaps and moves, then repair of the worst.",
      default: "splits and collapses too; angles between 30° and 135° where the boundary allows them.",
      strive: "repair goes on towards angles between 35° and 130°.",
    },
    gradation: "Gradation",
    gradationHint: "Most by which sizes grow from one element to the next; 0 takes them as they are.",
    badGradation: "Must be 0, or above 1",
    enclosed: "Enclosed",
    enclosedBodies: { cavities: "Cavities", regions: "Regions" },
    enclosedHints: {
      cavities: "Closed patches within a body bound an empty space.",
      regions: "Closed patches within a body bound a region of its own, meshed to fit.",
    },
  },
  triangles: {
    count: (count: string, single: boolean) => (single ? "1 triangle" : `${count} triangles`),
    one: (triangle: string) => `Triangle ${triangle}`,
    all: "Show all of them",
  },
  severities: { error: "Error", warning: "Warning" },
  bottom: {
    title: "Log and problems",
    log: "Log",
    problems: "Problems",
    logEmpty: "The mesher's messages appear here.",
    noProblems: "No problems found.",
    show: "Show",
    at: (place: string) => `at ${place}`,
    showPlace: (place: string) => `Go to the place ${place}`,
    count: (count: number, severity: "error" | "warning") =>
      count === 1 ? `1 ${severity}` : `${count} ${severity}s`,
  },
  viewport: {
    label: "Three-dimensional view",
    roles: "Lines of the selected patch by their roles in equation (14)",
    stale: "Out of date",
    staleHint: "The model has changed since this mesh was made.",
    update: "Mesh again",
    incomplete: "Incomplete",
    incompleteStalled: "The front stalled; what is left of it is orange.",
    incompleteCancelled: "Cancelled; what is left of the front is orange.",
    incompleteUnpolished: "Cancelled before the mesh was improved and verified.",
    noWebgl: "This browser cannot draw the view",
    noWebglHint:
      "The view needs WebGL 2. Turn on hardware acceleration or use a current browser; everything else still works, downloads too.",
    contextLost: "The graphics driver has reset the view",
    contextLostHint: "It comes back by itself in a moment. Your model and mesh are safe.",
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
    keys: "Arrow keys turn, Shift with arrow keys pans, plus and minus zoom.",
  },
  status: {
    ready: "Ready",
    saved: "saved",
    unsaved: "unsaved changes",
    points: (count: string) => `${count} points`,
    tetrahedra: (count: string) => `${count} tetrahedra`,
    minDihedral: (angle: string) => `min dihedral ${angle}`,
    front: (count: string) => `front ${count} faces`,
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
    saveFailed: "The project could not be saved",
    galleryFailed: "The examples could not be loaded",
    engineFailed: "The mesher failed",
    notDrawn: "The mesh could not be drawn",
    partFailed:
      "This part of the app could not be loaded. Your model is safe; reload when there is a network.",
    reload: "Reload",
    downloadFailed: "The mesh could not be written",
    close: "Close",
  },
  help: {
    title: "Keyboard and mouse",
    mouse: [
      ["Click", "select; Shift adds (in the tree: up to here), Ctrl toggles"],
      ["Double click", "fit what is under the pointer"],
      ["Left or right drag", "orbit"],
      ["Middle drag", "pan"],
      ["Wheel", "zoom to the pointer"],
      ["One finger, two fingers", "orbit; pan and zoom"],
    ],
    fields: [
      ["↑ ↓", "step a number; Shift × 10, Alt ÷ 10"],
      ["Enter, Esc", "take a typed value, or give it up"],
      ["Arrow keys", "in the view: turn; Shift pans; + − zoom"],
    ],
    about:
      "Tetrafront fills shapes with tetrahedra by the advancing-front method of R. Löhner and P. Parikh, “Generation of three-dimensional unstructured grids by the advancing-front method”, Int. J. Numer. Methods Fluids 8 (1988).",
  },
} as const;
