/** Texts about bodies. */
import { formatCount, formatCounted } from "./format";
import type { PreparedBody, RepairChange } from "tetrafront";

type ChangeOf<Kind extends RepairChange["kind"]> = Extract<RepairChange, { readonly kind: Kind }>;

/** Largest number of names in a sentence. */
const maxNames = 4;

function listed(names: readonly string[]): string {
  if (names.length > maxNames) return `${names.length} bodies`;
  const last = names.at(-1) ?? "";
  return names.length < 2 ? last : `${names.slice(0, -1).join(", ")} and ${last}`;
}

/** Names of the steps of undo. */
export const bodyStepNames = {
  features: "Change features",
  explode: "Explode solid",
  setUnit: (id: number) => `Set unit of body ${id}`,
  addMany: (count: number) => `Add ${count} bodies`,
  surface: (body: string) => `Change treatment of ${body}`,
  surfaces: (count: number) => `Change treatment of ${count} bodies`,
  remeshing: {
    size: "Set size of remeshing",
    minSize: "Set smallest size",
    maxSize: "Set largest size",
    tolerance: "Set tolerance",
    featureAngle: "Set feature angle",
    anglePerEdge: "Set angle per edge",
    layers: "Set layers",
    dropDetails: "Set details to drop",
    growth: "Set growth of remeshing",
  },
  repair: (body: string) => `Repair ${body}`,
  join: (bodies: readonly string[]) => `Join ${listed(bodies)}`,
  merge: (count: number) => `Merge ${count} patches`,
  split: (what: string) => `Split ${what}`,
} as const;

export const bodyStrings = {
  opening: (file: string) => `Opening ${file}…`,
  cancelOpening: "Cancel opening",
  import: "Import surface",
  shape: "Surface",
  solid: "Solid",
  box: "Size",
  triangles: "Triangles",
  nodes: "Nodes",
  shells: "Shells",
  patches: "Patches",
  regions: "Regions",
  volume: "Volume",
  area: "Area",
  worst: "Smallest 2r/R",
  open: (count: number) => formatCounted(count, "open edge"),
  cavities: (count: number) => formatCounted(count, "cavity", "cavities"),
  inspecting: "Inspecting the surface…",
  states: { closed: "closed", problems: "has problems" },
  problems: "Problems of the surface",
  allProblems: (count: number) => `Show all ${formatCount(count)} problems`,
  repair: {
    title: "Repair",
    intro: "The repair makes these changes:",
    none: "The repair finds nothing that it can change.",
    first: "“Generate mesh” makes this repair first.",
    changes: {
      "welded-node": (count: number) => `welds ${formatCounted(count, "node")}`,
      "removed-node": (count: number) => `removes ${formatCounted(count, "unused node")}`,
      "removed-triangle": (count: number) => `removes ${formatCounted(count, "degenerate triangle")}`,
      "removed-duplicate": (count: number) => `removes ${formatCounted(count, "duplicate triangle")}`,
      "split-triangle": (count: number) => `splits ${formatCounted(count, "triangle")}`,
      "filled-hole": (count: number) => `fills ${formatCounted(count, "hole")}`,
      "flipped-triangle": (count: number) => `flips ${formatCounted(count, "triangle")}`,
      "resolved-intersection": (count: number) => `cuts ${formatCounted(count, "intersecting triangle")}`,
      "removed-sheet": (count: number) =>
        `removes ${formatCounted(count, "triangle that encloses nothing", "triangles that enclose nothing")}`,
    },
    shared: (volume: string) =>
      `Parts that intersect become one: the volume that they share, ${volume}, counts once.`,
    done: "Repaired",
    log: (body: string, changes: readonly string[]) => `${body}, repaired: ${changes.join(", ")}`,
    made: {
      "welded-node": (count: number) => `${formatCounted(count, "node")} welded`,
      "removed-node": (count: number) => `${formatCounted(count, "unused node")} removed`,
      "removed-triangle": (count: number) => `${formatCounted(count, "degenerate triangle")} removed`,
      "removed-duplicate": (count: number) => `${formatCounted(count, "duplicate triangle")} removed`,
      "split-triangle": (count: number) => `${formatCounted(count, "triangle")} split`,
      "filled-hole": (count: number) => `${formatCounted(count, "hole")} filled`,
      "flipped-triangle": (count: number) => `${formatCounted(count, "triangle")} flipped`,
      "resolved-intersection": (count: number) => `${formatCounted(count, "intersecting triangle")} cut`,
      "removed-sheet": (count: number) =>
        `${formatCounted(count, "triangle that enclosed nothing", "triangles that enclosed nothing")} removed`,
    },
    /** One of the changes. */
    nouns: {
      "welded-node": (index: number) => `Node ${index}`,
      "removed-node": (index: number) => `Unused node ${index}`,
      "removed-triangle": (index: number) => `Degenerate triangle ${index}`,
      "removed-duplicate": (index: number) => `Duplicate triangle ${index}`,
      "split-triangle": (index: number) => `Split triangle ${index}`,
      "filled-hole": (index: number) => `Hole ${index}`,
      "flipped-triangle": (index: number) => `Flipped triangle ${index}`,
      "resolved-intersection": (index: number) => `Cut triangle ${index}`,
      "removed-sheet": (index: number) => `Removed triangle ${index}`,
    },
    moves: (deviation: string) =>
      deviation === "0" ? "No node moves." : `Nodes move by at most ${deviation}.`,
    moved: (deviation: string) =>
      deviation === "0" ? "No node was moved." : `Nodes were moved by at most ${deviation}.`,
    solves: "Afterwards, the surface can be meshed.",
    remains: (count: number) => `Afterwards, ${formatCounted(count, "problem remains", "problems remain")}.`,
    comparison: {
      start: "Compare with exact repair",
      running: "Comparing with the exact repair",
      cancel: "Cancel the comparison",
      exact: (exact: string, welded: string) =>
        `The exact repair, which welds no nodes, is taken: remeshed, its smallest angle is ${exact} instead of ${welded}.`,
      welded: (welded: string, exact: string | null) =>
        exact === null
          ? `The repair that welds nodes is taken: remeshed, its smallest angle is ${welded}.`
          : `The repair that welds nodes is taken: remeshed, its smallest angle is ${welded}; that of the exact one is ${exact}.`,
    },
    weld: "Weld within",
    weldHint: "Nodes closer than this become one; 0 welds only equal positions.",
    holes: "Fill holes up to",
    holesHint: "Largest number of edges of a hole that is filled.",
    apply: "Repair",
    filledPatch: "filled holes",
    subjects: {
      "welded-node": ({ node, into }) => `Node ${node} to node ${into}`,
      "removed-node": ({ node }) => `Node ${node}`,
      "removed-triangle": ({ triangle }) => `Triangle ${triangle}`,
      "removed-duplicate": ({ triangle, sameAs }) => `Triangle ${triangle}, as triangle ${sameAs}`,
      "split-triangle": ({ beyond }) => `Triangle ${beyond}`,
      "filled-hole": ({ triangles }) => `Hole with ${formatCounted(triangles, "triangle")}`,
      "flipped-triangle": ({ triangle }) => `Triangle ${triangle}`,
      "resolved-intersection": ({ triangle, parts }) =>
        `Triangle ${triangle}, ${formatCounted(parts, "part")} left`,
      "removed-sheet": ({ triangle }) => `Triangle ${triangle}`,
    } satisfies { readonly [Kind in RepairChange["kind"]]: (change: ChangeOf<Kind>) => string },
  },
  treatment: {
    title: "Triangles",
    ofSolid: "Surface mesh",
    hintOfSolid:
      "Meshing makes triangles on the true faces of the solid, in sizes that follow their curvature.",
    label: "Treatment",
    values: { remesh: "Remesh", refine: "Refine", keep: "Keep" },
    hints: {
      remesh: "Replaces the triangles by new ones of good shape, near the given surface.",
      refine:
        "Keeps the triangles, and divides those that are larger than the target size, or than small ones near them permit. With a number of elements, they are replaced.",
      keep: "Meshes the given triangles as they are. Needles and slivers spoil the elements beside them.",
    },
    options: "Remeshing options",
    automatic: "automatic",
    fields: {
      size: "Size",
      minSize: "Smallest size",
      maxSize: "Largest size",
      tolerance: "Tolerance",
      featureAngle: "Feature angle",
      anglePerEdge: "Angle per edge",
      layers: "Layers",
      dropDetails: "Drop details below",
      growth: "Growth",
    },
    hintOf: {
      size: "Target edge length. Automatic sizes follow the shape.",
      minSize:
        "Smallest size that the shape may ask for. If it is empty, sizes near tiny details may be smaller than shown.",
      maxSize: "Largest automatic size.",
      tolerance: "Largest distance between the given and the new surface.",
      featureAngle: "Edges with a larger angle stay sharp, in degrees.",
      anglePerEdge: "Largest angle that an edge spans on a curved patch, in degrees.",
      layers: "Elements across thin walls; 0 ignores thickness.",
      dropDetails: "Sharp edges nearer to each other than this become one.",
      growth: "Growth of the size per unit of distance.",
    },
    reset: (field: string) => `Make ${field.toLowerCase()} automatic`,
    invalidLayers: "Must be from 0 to 100",
  },
  preview: {
    make: "Preview triangles",
    update: "Update preview",
    making: "Making the triangles…",
    cancel: "Cancel preview",
    stale: "The preview is out of date.",
    shown: "Show",
    views: { given: "Given", new: "New", mesh: "Mesh" },
    size: "Largest size",
    minSize: "Smallest size",
    tolerance: "Tolerance",
    deviation: "Deviation, at most",
    smallestAngle: "Smallest angle",
    meanRatio: "Mean 2r/R",
    deviationLegend: "deviation / tolerance",
    details: (count: number) => formatCounted(count, "detail dropped", "details dropped"),
    detail: (index: number) => `Detail ${index}`,
  },
  plan: {
    /** What a run does first. */
    repair: "“Generate mesh” repairs the surface first.",
    join: "“Generate mesh” first joins it to the bodies that it touches, whose triangles change there.",
    /** What a run makes of the triangles, then. */
    surface: {
      remesh: "Its triangles are replaced by new ones.",
      refine: "Its triangles are kept, and divided where they are too large.",
      keep: "Its triangles are kept as they are.",
    },
    cut: "Its triangles are replaced by new ones, because cuts leave needles.",
  },
  split: {
    title: "Patches",
    hint: "Splits patches along edges with a larger angle.",
    named: "Click a patch in the view to name it. Files of the mesh contain the names.",
    angle: "Angle (°)",
    preview: "Preview split",
    result: (patches: number) => `Gives ${formatCounted(patches, "patch", "patches")}.`,
    apply: "Split",
    cancel: "Cancel",
    merge: "Merge patches",
  },
  preparing: {
    inspect: "Inspecting bodies",
    repair: "Repairing bodies",
    join: "Joining bodies that touch",
    preview: "Preparing bodies",
  },
  touching: {
    message: (names: readonly string[]) => `${listed(names)} touch or intersect`,
    remedy:
      "“Generate mesh” joins them into one body with common triangles where they touch. To keep them apart, move one under Placement.",
    joined: (names: readonly string[], regions: number) =>
      `${listed(names)} touch or intersect: they became one body with ${formatCounted(regions, "region")}.`,
    /** `shared`: the volume that several bodies enclose; `percent`: its share of the smallest body. */
    overlap: (names: readonly string[], shared: string, percent: string) =>
      `${listed(names)} overlap by a volume of ${shared}, ${percent} % of the smallest of them, which counts once`,
    overlapRemedy:
      "It became a part of the first of them. If they are meant to touch only, undo, and subtract one from the other or move them apart.",
  },
  conflict: "Move the body under Placement, or change the patches, so that they neither touch nor intersect.",
  generate: "Generate mesh",
  brush: {
    title: "Paint size",
    size: "Size",
    radius: "Radius",
    hint: "Drag over the surface: the stroke becomes sources that limit the size within the radius. They move with the body. Paint or Esc ends it.",
    paint: "Paint",
  },
  placement: {
    title: "Placement",
    position: "Position",
    rotation: "Rotation",
    scale: "Scale",
    hint: "Scales, then rotates about x, y and z (degrees), then moves the given points.",
    reset: "Reset placement",
    handles: "Handles",
    modes: { off: "None", translate: "Move", rotate: "Rotate" },
  },
  patchOf: "Body",
  given: "Given triangles",
  normal: "Normal",
  notPlanar: "not planar",
  cardList: "Bodies",
} as const;

const short = (value: number): string => String(Number(value.toPrecision(3)));

/** What is known, before a run, of what it will do with a body. */
export interface BodyPlan {
  readonly isRepaired: boolean;
  readonly isJoined: boolean;
  /** What becomes of the triangles by the choice of the user, and after the repair. */
  readonly chosen: "remesh" | "refine" | "keep";
  readonly repaired: "remesh" | "refine" | "keep";
}

/** Returns what a run will do with a body, in sentences. */
export function planText({ isRepaired, isJoined, chosen, repaired }: BodyPlan): string {
  const { plan } = bodyStrings;
  const first = [isRepaired && plan.repair, isJoined && plan.join].filter((text) => text !== false);
  return [...first, chosen === repaired ? plan.surface[repaired] : plan.cut].join(" ");
}

/** Returns what became of the triangles of a body: how many there are, their sizes and shapes, and how near they are. */
export const preparedText = (body: string, prepared: PreparedBody): string =>
  `${body}: ${preparedFacts(prepared)}`;

function preparedFacts(prepared: PreparedBody): string {
  const { triangles, origin, size, minSize, tolerance, deviation, smallestAngle, meanRadiusRatio } = prepared;
  const { mergedDetails = [] } = prepared;
  const isDivided = origin.some((given, triangle) => given !== triangle);
  const verb = deviation !== undefined ? "remeshed to" : isDivided ? "divided to" : "kept";
  const parts = [
    `${verb} ${formatCounted(triangles.length / 3, "triangle")}`,
    ...(size === undefined
      ? []
      : [minSize === undefined ? `size ${short(size)}` : `sizes ${short(minSize)} to ${short(size)}`]),
    ...(smallestAngle === undefined ? [] : [`smallest angle ${smallestAngle.toFixed(1)}°`]),
    ...(meanRadiusRatio === undefined ? [] : [`mean 2r/R ${meanRadiusRatio.toFixed(3)}`]),
    ...(deviation === undefined
      ? []
      : [
          `deviation at most ${short(deviation)}${tolerance === undefined ? "" : ` (tolerance ${short(tolerance)})`}`,
        ]),
    ...(mergedDetails.length > 0 ? [`${formatCounted(mergedDetails.length, "detail")} dropped`] : []),
  ];
  return parts.join(", ");
}
