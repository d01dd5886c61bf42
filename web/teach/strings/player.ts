/** Texts about the recorded fronts. */
import { formatCount } from "../../strings/format";
import type { FrontOrder } from "tetrafront";
import type { Refusal } from "tetrafront/trace";
import { conditionStrings } from "./condition";
import { crossingTestStrings } from "./crossing-test";
import { frontStrings } from "./front";
import { recoverySentence } from "./recovery";
import { otherwise, surfaceLensStrings } from "./surface-lens";

/** Words for what was tried: an existing node by its number. */
const candidateName = (node: number | null): string =>
  node === null ? "A new node" : `Node ${formatCount(node)}`;

/** Kinds of steps, in a front of faces or of edges. */
const stopsOf = (unit: "face" | "edge", one: string) =>
  ({
    postponed: `postponed ${unit}`,
    behind: `candidate behind the base ${unit}`,
    crosses: `candidate that crosses ${one}`,
    "too-close": `new node too close to ${one}`,
    recovery: "step of recovery",
    "new-node": "new node",
    line: "line",
    patch: "patch",
    condition: "condition…",
  }) as const;
const stops = {
  lines: stopsOf("edge", "an edge"),
  patches: stopsOf("edge", "an edge"),
  volume: stopsOf("face", "a face"),
} as const;

const stopName = (phase: keyof typeof stops, kind: keyof (typeof stops)["volume"]): string =>
  kind === "condition" ? "step that meets the condition" : stops[phase][kind];

const verdicts: Readonly<Record<Refusal | "accepted", string>> = {
  accepted: "accepted",
  behind: "behind the base face",
  crosses: "crosses a face",
  "too-close": "too close to a face",
};

const phaseNames = { lines: "Lines", patches: "Patches", volume: "Volume" } as const;
/** What the fronts are made of. */
const faceNames = { lines: "faces", patches: "edges", volume: "faces" } as const;

const joinedFaces = (count: number): string =>
  count === 0 ? "no faces" : count === 1 ? "1 face" : `${count} faces`;

const facesOf = (faces: readonly number[]): string =>
  `${faces.length === 1 ? "face" : "faces"} ${faces.slice(0, 6).map(formatCount).join(", ")}${faces.length > 6 ? " …" : ""}`;

export const playerStrings = {
  tab: frontStrings.tab,
  intro:
    "Record how lines are divided, and how the fronts of the patches and of the volume advance. Then play it forwards and backwards, stop at any step, and see why each node was chosen or refused.",
  record: "Record the front",
  recordAgain: "Record again",
  recording: "Recording the front",
  recorded: (tetrahedra: number) => `${formatCount(tetrahedra)} tetrahedra`,
  stop: "Stop recording",
  stopping: "Stopping…",
  reading: "Reading the trace",
  stopReading: "Cancel",
  open: "Open trace…",
  save: "Save trace",
  close: "Show the model",
  transport: "Player",
  start: "First state of the phase",
  back: "Step back",
  play: "Play",
  pause: "Pause",
  forward: "Step forward",
  end: "Last state of the phase",
  stills: "Reduced motion: one picture per second",
  speed: "Speed",
  speedOf: (speed: number) =>
    speed < 1
      ? `1 step in ${formatCount(1 / speed)} s`
      : speed === 1
        ? "1 step/s"
        : `${formatCount(speed)} steps/s`,
  scrub: "Step of the front",
  phases: phaseNames,
  phaseSteps: (phase: keyof typeof phaseNames, steps: number) =>
    `${phaseNames[phase]}: ${formatCount(steps)} ${steps === 1 ? "step" : "steps"}`,
  counter: (step: number, steps: number) => `${formatCount(step)} / ${formatCount(steps)}`,
  scrubText: (phase: keyof typeof faceNames, step: number, steps: number, faces: number) =>
    `${phaseNames[phase]}: step ${formatCount(step)} of ${formatCount(steps)}, ${formatCount(faces)} ${faceNames[phase]}`,
  /** After the last step. */
  noFaces: (elements: number) =>
    `The front has no faces left: ${formatCount(elements)} elements fill the volume.`,
  recentElements:
    "The view shows the elements made last. Choose “All, cut open” in the list “Elements” to see all of them.",
  faces: (phase: keyof typeof faceNames, faces: number) =>
    phase === "lines" ? "" : `${formatCount(faces)} ${faceNames[phase]}`,
  stops,
  jumpTo: "Jump to",
  next: (...stop: Parameters<typeof stopName>) => `Next ${stopName(...stop)}`,
  before: (...stop: Parameters<typeof stopName>) => `Previous ${stopName(...stop)}`,
  noFurther: "No further step",
  condition: conditionStrings,
  pauseThere: "Pause there",
  loopSteps: "Steps to repeat",
  loopEnds: { from: "First step to repeat", to: "Last step to repeat" },
  loopShort: { from: "from", to: "to" },
  loopRange: (from: number, to: number) =>
    `Type a whole number from ${formatCount(from)} to ${formatCount(to)}.`,
  loopHint: (from: number, to: number) => `Repeat steps ${formatCount(from)} to ${formatCount(to)}`,
  coloring: "Colour",
  colorings: { age: "Age", size: "Size", layer: "Layer" },
  legend: { age: "age (cube root)", size: "size of the face", layer: "layer of the face" },
  sweptLegend: "smallest angle",
  /** What the lower and the upper end of the colour scale mean. */
  legendEnds: (coloring: "age" | "size" | "layer", from: number, to: number): readonly [string, string] => {
    if (coloring === "age") return ["old", "new"];
    const digits = coloring === "size" ? 3 : 2;
    return [Number(from.toPrecision(digits)).toString(), Number(to.toPrecision(digits)).toString()];
  },
  shownFaces: "Faces",
  faceChoices: { inside: "Seen from inside", all: "All" },
  elements: "Elements",
  elementChoices: { none: "None", last: "Last", recent: "Last 60", all: "All", cut: "All, cut open" },
  searchRegion: "Search region",
  regionHint: "The nodes in it are candidates for the base face. It lies around the ideal point.",
  regionInPlane: "In a patch, the dashed ellipse in its plane is always shown instead.",
  /** Labels of what the lens shows in the view, beside it and in the legend. */
  marks: {
    base: (face: number) => `base ${formatCount(face)}`,
    face: (face: number) => `face ${formatCount(face)}`,
    edge: (edge: number) => `edge ${formatCount(edge)}`,
    node: (node: number | null) => (node === null ? "new node" : `node ${formatCount(node)}`),
    normal: "normal",
    ideal: "ideal",
    crossing: "crossing",
    tooClose: "too close",
    legend: {
      base: "base face, normal",
      ideal: "ideal point",
      candidate: "candidate",
      failing: "why refused",
    },
    /** What a step of recovery is about. */
    recovery: {
      star: "pocket",
      reopened: "pocket, opened",
      closed: "pocket",
      undone: "attempt, undone",
      "exact-fill": "pocket",
    },
    /** The same, in the beats before the step has done anything. */
    unrecovered: { pocket: "pocket", attempt: "attempt" },
    recoveryLegend: { base: "faces that leave", joined: "faces that join", candidate: "new node" },
  },
  fade: "Fade the rest",
  fadeHint: "While the lens shows a step, the front is faded.",
  follow: "Follow",
  followHint: "The view moves to the base face of each step, until you move it yourself.",
  moreControls: "Jumps, colours and what is drawn",

  lens: frontStrings.lens,
  beforeFirst: "The front before the first step: the triangles of the boundary.",
  playing: "Pause to look into a step.",
  recovery: recoverySentence,
  sentence: {
    accepted: (node: number | null, isNew: boolean, element: number) =>
      `${isNew ? "New node" : "Node"} ${formatCount(node ?? 0)} was accepted: it makes element ${formatCount(element)} over the base face.`,
    behind: (node: number | null) =>
      `${candidateName(node)} was refused: it is behind the base face, or in its plane.`,
    crosses: (node: number | null, face: number, isNewSide: boolean | null) =>
      isNewSide === null
        ? `${candidateName(node)} was refused: the new element would cross face ${formatCount(face)}.`
        : isNewSide
          ? `${candidateName(node)} was refused: a side of the new element would cut face ${formatCount(face)}.`
          : `${candidateName(node)} was refused: a side of face ${formatCount(face)} would cut the new element.`,
    tooClose: (face: number) => `A new node was refused: it would be too close to face ${formatCount(face)}.`,
  },
  whatIf: {
    behind: "Without this rule, the element would have no volume, or would be inside out.",
    crosses: (faces: readonly number[]) =>
      `Accepted, its element would overlap what the front encloses: it would cross ${facesOf(faces)}.`,
    tooClose: "Its element would cross nothing, but would leave a gap for poor elements.",
  },
  /** What a step does to the front: which faces leave it, and how many join. */
  frontChange: {
    accepted: (left: readonly number[], joined: number) =>
      `The front: ${facesOf(left)} ${left.length === 1 ? "leaves" : "leave"}, ${joinedFaces(joined)} ${joined === 1 ? "joins" : "join"} (steps F6 and F8).`,
    supposed: (left: readonly number[], joined: number) =>
      `The view shows the front with it: ${facesOf(left)} ${left.length === 1 ? "has" : "have"} left, ${joinedFaces(joined)} ${joined === 1 ? "has" : "have"} joined.`,
  },
  /** The recorded verdict stays; our own check works in doubles, the engine with exact signs. */
  disagreement: {
    behind: otherwise("it finds the node behind the base face"),
    inFront: otherwise("it finds the node in front of the base face"),
    clear: otherwise("it finds nothing that the element would cross"),
    crosses: (faces: readonly number[]) => otherwise(`it finds that the element crosses ${facesOf(faces)}`),
  },
  postponed: (ruleClass: number | null) =>
    ruleClass === null
      ? "No candidate was accepted. The face is set aside for recovery."
      : `No candidate was accepted. The face comes again under rule class ${ruleClass}.`,
  base: (face: number) => `Base face ${formatCount(face)}`,
  meaningsTitle: "What these values mean",
  formulaMeaning: "What the formulas mean",
  bucket: {
    name: "Size bucket",
    meaning:
      "Faces whose sizes differ by less than about a factor of four are in one bucket. A bucket of smaller faces has a lower number.",
  },
  layers: {
    name: "Layers",
    meaning:
      "Sum of the layers of the three nodes: 0 on the boundary; a new node has 1 more than the lowest layer in its base face.",
  },
  ruleClass: {
    name: "Rule class",
    meaning:
      "How strict the rules are for this face: class 0 is the strictest. Each time the face is postponed, the class grows by 1, up to 4.",
  },
  strict: "0 (strict)",
  targetEdge: {
    name: "Target edge",
    meaning:
      "Edge length that the background grid asks for at the base face. With stretching it is 1, measured in unit space.",
  },
  nearby: {
    name: "Faces near",
    meaning: "Number of faces of the front in the search region, which the new element could cross.",
  },
  ranked: {
    name: "Candidates",
    meaning:
      "Number of nodes that could complete the element. They are tried by score until one is accepted.",
  },
  region: "Part of local remeshing, which fills a pocket again after a stall.",
  whyNow: {
    layered: "Smaller buckets come first, then lower layers (step F4).",
    "smallest-first": "The smallest face comes first (step F4).",
    "first-in": "The face that joined the front first comes first.",
    random: "The faces come in random order.",
  } satisfies Readonly<Record<FrontOrder, string>>,
  candidates: "Candidates tried",
  candidate: "Node",
  candidateName: (rank: number, node: number | null) =>
    `${rank}: ${node === null ? "new node" : formatCount(node)}`,
  score: "Score",
  scoreHint:
    "The highest score is tried first (step F5.2). It grows with the quality of the element, and with the faces of the front that the element closes.",
  verdict: "Verdict",
  verdicts,
  verdictAt: (verdict: string, face: number | null) =>
    face === null ? verdict : `${verdict}: ${formatCount(face)}`,
  test: crossingTestStrings,
  ideal: {
    title: "Ideal point",
    hint: "Step F5.1 of the paper. δ is the target edge, b the size of the base face (root mean square of its edges), R the radius of the circle through its corners. The ideal point is this high above the centroid.",
    stretchedHint:
      "Step F5.1 of the paper, in unit space: δ is the target edge, b the size of the base face (root mean square of its edges), R the radius of the circle through its corners. The ideal point is this high above the centroid.",
  },
  refusal: {
    tooClose: "Distance from the face",
    tooCloseHint:
      "h is the element size of the ideal point. The factor is that of the rule class. An experiment with another distance multiplies it.",
    behind: "Volume of the element",
    behindHint:
      "The volume must be positive. If it is 0 within rounding errors, exact numbers decide its sign.",
  },
  ...surfaceLensStrings,
} as const;
