/** Texts about the lines and patches of a recording, which are called by name or number: `label`s of player/entity-labels.ts. */
import { formatCount, formatCounted } from "../../strings/format";
import type { EdgeRefusal } from "tetrafront/trace";

const short = (value: number): string => Number(value.toPrecision(3)).toString();
/** Sides count from 1 where the user reads them. */
const ordinal = (index: number): string => formatCount(index + 1);

/** Words for what was tried: an existing node by its number. */
const candidateName = (node: number | null): string =>
  node === null ? "A new node" : `Node ${formatCount(node)}`;

const edgeVerdicts: Readonly<Record<EdgeRefusal | "accepted", string>> = {
  accepted: "accepted",
  behind: "behind the base edge",
  crosses: "crosses an edge",
  "too-close": "too close to an edge",
  "same-node": "end of the base edge",
  outside: "outside the patch",
};

const edgesOf = (edges: readonly number[]): string =>
  `${edges.length === 1 ? "edge" : "edges"} ${edges.slice(0, 6).map(formatCount).join(", ")}${edges.length > 6 ? " …" : ""}`;
/** The recorded verdict stays; our own check works in doubles. */
export const otherwise = (finding: string): string =>
  `Our own check, in doubles, disagrees: ${finding}. The engine decides by exact signs.`;

export const surfaceLensStrings = {
  beforeLines: "Before the first step: the lines are not divided yet.",
  beforePatches: "All lines are divided. The patches come next.",
  line: {
    title: (line: string) => `Line ${line}`,
    settled: (start: number, length: number, rounds: number) =>
      rounds === 0
        ? `The target size is ${short(start)} here (S1), and also at the middle of a side of this length (S2): the next side is ${short(length)} long.`
        : `The target size is ${short(start)} here (S1), but differs at the middle of a side of this length (S2). After ${formatCounted(rounds, "averaging")} (S3), the next side is ${short(length)} long.`,
    capped: (start: number) =>
      `The target size is ${short(start)} here (S1). The step ends at a sixteenth of the line, so that its bends are seen.`,
    knot: "The step ends at a knot of the line.",
    measured: (sides: number) =>
      `Up to here the line is ${short(sides)} target sizes long. The steps only measure it; the sides follow at its end.`,
    divided: (line: string, length: number, sides: number) =>
      `Line ${line} is ${short(length)} target sizes long. It is divided into ${formatCounted(sides, "side")} that are equally long in target sizes (S4), so that the last one is as good as the others.`,
    undivided: (line: string) => `Line ${line} cannot be divided.`,
    halved: (line: string, side: number) =>
      `Side ${ordinal(side)} of line ${line} is halved: sides of a patch would intersect.`,
  },
  patch: {
    begins: (patch: string, edges: number, isCurved: boolean) =>
      `Patch ${patch} begins: its ${formatCounted(edges, "side")} are the first front in ${isCurved ? "the plane that is mapped to its surface (T1)" : "its plane"}.`,
    improved: (patch: string, before: number, after: number) =>
      `The front has covered patch ${patch} with ${formatCounted(before, "triangle")}. They are improved: edges are flipped, nodes move, are added and removed. ${formatCounted(after, "triangle")} remain, and take their places in space (T3).`,
    accepted: (node: number, isNew: boolean) =>
      `${isNew ? "New node" : "Node"} ${formatCount(node)} was accepted: it makes a triangle over the base edge.`,
    behind: (node: number | null) =>
      `${candidateName(node)} was refused: it is behind the base edge, or in line with it.`,
    crosses: (node: number | null, edge: number) =>
      `${candidateName(node)} was refused: the new triangle would cross edge ${formatCount(edge)} of the front.`,
    "too-close": (_: number | null, edge: number) =>
      `A new node was refused: it would be too close to edge ${formatCount(edge)} of the front.`,
    "same-node": (node: number | null) =>
      `${candidateName(node)} was refused: in space it is an end of the base edge, on the other side of the seam.`,
    outside: () => "A new node was refused: it would be outside the patch.",
    whatIf: (edges: readonly number[]) =>
      `Accepted, its triangle would overlap what is meshed: it would cross ${edgesOf(edges)}.`,
    supposed: (isNew: boolean) =>
      isNew
        ? "The view shows the front before the step, without the triangle: the new node was given no position on the patch."
        : "The view shows the front before the step, with the triangle in red.",
    disagreement: {
      behind: otherwise("it finds the node behind the base edge"),
      inFront: otherwise("it finds the node in front of the base edge"),
      clear: otherwise("it finds nothing that the triangle would cross"),
      crosses: (edges: readonly number[]) =>
        otherwise(`it finds that the triangle crosses ${edgesOf(edges)}`),
    },
    postponed: (pass: number | null) =>
      pass === null
        ? "No candidate was accepted, in the whole front: the patch folds over itself."
        : `No candidate was accepted. The edge comes again in pass ${pass}, with ${pass === 1 ? "a larger neighbourhood" : "the whole front"} to choose from.`,
    base: (edge: number) => `Base edge ${formatCount(edge)}`,
    size: { name: "Target size", meaning: "Edge length in space that the background grid asks for here." },
    metric: {
      name: "Metric G",
      meaning:
        "Matrix that gives the length in space, in target sizes, of a short step in the plane: its terms G₁₁, G₁₂ and G₂₂.",
    },
    sizeClass: {
      name: "Size class",
      meaning:
        "Edges whose sizes differ by less than about a factor of √2 are in one class. A class of smaller edges has a lower number.",
    },
    layer: {
      name: "Layer",
      meaning: "0 on the boundary of the patch. The edges of a new triangle have 1 more than its base edge.",
    },
    pass: {
      name: "Pass",
      meaning:
        "How often the edge was postponed: each time, candidates are looked for in a larger neighbourhood.",
    },
    nearby: {
      name: "Edges near",
      meaning: "Number of edges of the front that the new triangle could cross.",
    },
    ranked: {
      name: "Candidates",
      meaning:
        "Number of nodes that could complete the triangle. They are tried by rank until one is accepted.",
    },
    whyNow: "Lower size classes come first, then lower layers (step F4).",
    candidates: "Candidates tried",
    scoreHint:
      "The highest score is tried first (step F5.2). Nodes near the ideal point have 2 less their distance from it, in target lengths; a new node has 1.45; other nodes have the shape of their triangle, at most 1.",
    verdicts: edgeVerdicts,
    test: "Test in the plane",
    testHints: {
      accepted: "Lengths in the plane are measured by G, so they are target sizes of space (T2).",
      behind: "Twice the signed area of the triangle: the engine takes its sign exactly.",
      crosses:
        "The part of the edge from a to b that lies in the triangle, or touches it. The engine decides by exact signs.",
      "too-close": "Lengths in the plane are measured by G, so they are target sizes of space (T2).",
    },
  },
  plane: {
    label: "Plane of the patch",
    title: (patch: string) => `Plane of patch ${patch}`,
    zoom: "Part of the plane",
    zooms: { patch: "Patch", edge: "Base edge" },
    curved: "This plane is mapped to the curved patch; letters are the corners of equation 16.",
    flat: "The patch is flat.",
    ellipse:
      "The dashed ellipse is a circle in space: it shows how the plane is stretched and sheared, and how large triangles should be. Nodes in it are tried before a new node.",
    size: "The dashed ellipse shows how large triangles should be, and in which direction. Nodes in it are tried before a new node.",
    picture: (triangles: number, edges: number) =>
      `${formatCounted(triangles, "triangle")}, ${formatCounted(edges, "edge")} of the front`,
  },
} as const;
