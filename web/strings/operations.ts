import { entityNouns, pluralNouns } from "./entities";
import { shortened } from "./shortened";

const countOf = (count: number, kind: keyof typeof entityNouns): string =>
  `${count} ${count === 1 ? entityNouns[kind] : pluralNouns[kind]}`;

/** Texts of the operations that add or change many entities by a few values. */
export const operationStrings = {
  create: "Create",
  cancel: "Cancel",
  copy: "Copy selection",
  accept: "Accept what the panel makes",
  duplicate: "Duplicate…",
  apply: "Apply",
  aboveZero: "Must be above 0.",
  wholeBetween: (min: number, max: number) => `A whole number from ${min} to ${max}.`,
  notNegative: "Must be 0 or more.",
  between: (min: number, max: number) => `From ${min} to ${max}.`,
  noDirection: "A direction must not be zero.",
  opens: (title: string) => `${title}…`,
  /** What an operation gives: "6 patches". */
  result: (entities: readonly { readonly kind: keyof typeof entityNouns }[]) =>
    [...new Set(entities.map(({ kind }) => kind))]
      .map((kind) => countOf(entities.filter((entity) => entity.kind === kind).length, kind))
      .join(", "),
  booleans: {
    title: "Boolean operation",
    kind: "Operation",
    kinds: { union: "Union", difference: "Difference", intersection: "Intersection" },
    commands: {
      union: "Union of two bodies…",
      difference: "Difference of two bodies…",
      intersection: "Intersection of two bodies…",
    },
    steps: { union: "Unite bodies", difference: "Subtract body", intersection: "Intersect bodies" },
    swap: "Subtract the first body",
    planar: "Both bodies are planar. The result is points, lines and planar patches again.",
    triangulated:
      "A body has curved patches. The result is a body with a triangulated boundary; its patches keep their names.",
    twoBodies: (count: number) =>
      `Select two closed bodies that share no lines, for example one patch of each. Found ${count === 1 ? "1 body" : `${count} bodies`}.`,
    open: "One of the bodies is not closed: each of its edges must have exactly two patches.",
    nothing: "Nothing is left.",
    innerRegions:
      "A body has inner shells, which are meshed as regions. Boolean operations need bodies of one region: set inner shells to cavities, or select a body without inner shells.",
    body: "Combination",
    patch: (number: number) => `part ${number}`,
  },
  fields: {
    width: "Width (x)",
    depth: "Depth (y)",
    height: "Height",
    radius: "Radius",
    topRadius: "Radius of top",
    cornerRadius: "Radius of corners",
    ringRadius: "Radius of ring",
    tubeRadius: "Radius of tube",
    angle: "Angle",
    digits: "NACA digits",
    chord: "Chord of root",
    tipChord: "Chord of tip",
    span: "Span",
    sweep: "Sweep",
    twist: "Twist of tip",
    sides: "Sides",
    anchor: "Position of",
    anchors: { base: "Base", centre: "Centre" },
    base: "Base centre",
    centre: "Centre",
    axis: "Axis",
    join: "Join what coincides",
    share: "Share touching faces",
  },
  longExpressions: "The expressions are too long to be kept: the piece will not follow its parameters.",
  numbersKept:
    "The expressions are too long to be kept, or bodies or planes cannot follow them. The numbers are kept: they will not follow parameters.",
  fullTurn: "A full turn stays one: its angle does not follow parameters.",
  wholeNumber: (value: number) => `The number ${value} is used: whole numbers do not follow parameters.`,
  imprint: {
    overlaps: (count: number) =>
      `Overlaps ${count === 1 ? "1 face" : `${count} faces`} of the model. Share touching faces for one watertight model with several regions, or use a Boolean operation afterwards.`,
    shared: (count: number) =>
      `Shares ${count === 1 ? "1 face" : `${count} faces`} with the model: the mesh keeps a boundary between two regions there.`,
    incomplete:
      "Overlaps a face of the model that cannot be shared, because lines only touch there, or a curved patch needs its lines. Move the piece, or use a Boolean operation afterwards.",
  },
  refusals: {
    nothingSelected: "Select points, lines, patches, bodies or sources.",
    bodies:
      "Bodies can be moved, rotated and scaled by equal factors only. Use equal factors, or deselect the bodies.",
    arcs: "Arcs and circles stay round only with equal factors. Use equal factors, or draw them as splines first.",
    flat: "A factor must not be 0.",
    refusedLine: (line: string) =>
      `Nothing was pasted: "${shortened(line, 80)}" is no position. Use two or three numbers per line.`,
    noFragment:
      "The clipboard has neither entities of Tetrafront nor a list of coordinates, two or three numbers per line.",
    noProfile: "Select patches, or lines.",
    onePatch: "Select one planar patch.",
    noOpposite: "No planar patch opposite is parallel to this one, so that the hole cannot go through.",
    outside: "The circle does not lie within the patch.",
    outsideOpposite: "The circle does not lie within the patch opposite.",
    closedProfile: "Circles and closed splines cannot be revolved; draw them as several arcs.",
    acrossAxis: "The profile must lie on one side of the axis.",
    allCoincide:
      "All copies coincide with what is there. Move the plane or the axis, or change the distance.",
    nothingMoves: "Nothing moves.",
    tubeRadius: "The radius of the tube must be less than that of the ring.",
    thickness: "The last two digits are the thickness and must not be 00.",
  },
  sweeps: {
    extrude: { title: "Extrude", step: "Extrude" },
    revolve: { title: "Revolve", step: "Revolve" },
    offset: { title: "Offset copy", step: "Add offset copy" },
    hole: { title: "Hole through", step: "Add hole through", patch: "hole" },
    fields: {
      direction: "Direction",
      distance: "Distance",
      keepBase: "Keep the selected patches",
      point: "Point of axis",
      axis: "Axis",
      angle: "Angle",
      diameter: "Diameter",
      centre: "Centre",
    },
  },
  paste: {
    title: "Paste",
    step: "Paste",
    numbersKept:
      "The project does not have the parameters of the expressions, or they have other values here: the numbers are pasted.",
  },
  transforms: {
    move: { title: "Move or copy", step: "Move selection" },
    duplicate: { title: "Duplicate", step: "Copy selection" },
    rotate: { title: "Rotate or copy", step: "Rotate selection" },
    scale: { title: "Scale", step: "Scale selection" },
    mirror: { title: "Mirror", step: "Mirror selection" },
    linearArray: { title: "Linear array", step: "Add linear array" },
    circularArray: { title: "Circular array", step: "Add circular array" },
    fields: {
      offset: "Offset",
      copies: "Copies",
      centre: "Centre",
      axis: "Axis",
      angle: "Angle",
      total: "Total angle",
      factors: "Factors",
      point: "Point",
      normal: "Normal",
      keep: "Keep the original",
      count: "Number in all",
      spacing: "Spacing",
      join: "Join coinciding points",
    },
  },
  directions: { x: "X", y: "Y", z: "Z", other: "Other" },
  pieces: {
    box: { noun: "box", title: "Box" },
    cylinder: { noun: "cylinder", title: "Cylinder" },
    sphere: { noun: "sphere", title: "Sphere" },
    cone: { noun: "cone", title: "Cone or frustum" },
    torus: { noun: "torus", title: "Torus" },
    wing: { noun: "wing", title: "NACA wing" },
    prism: { noun: "prism", title: "Prism" },
  },
} as const;
