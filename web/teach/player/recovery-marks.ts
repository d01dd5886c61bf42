/** What a step of recovery is about, in the view and in drawings: the faces of the front that it changes, and its new nodes. */
import type { RecoveryStep, Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { mean } from "../../document/vectors";
import { playerStrings } from "../strings/player";
import { beatAt, isFleeting } from "./film-state";
import type { Beat } from "../strings/film";
import { cornersOf, positionOf } from "./judge";
import { edgesOf, type DrawnMark, type LensLabel } from "./lens-marks";
import type { PlayerState } from "./player";

/** Faces are triangles, three positions each. */
export interface RecoveryMarks {
  /** Faces that leave the front: those of the pocket. */
  readonly left: readonly Position[];
  readonly joined: readonly Position[];
  readonly nodes: readonly Position[];
  /** Edges of the new elements at the new nodes, two ends each: the star. */
  readonly star: readonly Position[];
  readonly labels: readonly LensLabel[];
}

/** More nodes have no labels: they would hide the pocket. */
const maxLabels = 8;
const texts = playerStrings.marks;

type Shown = Pick<
  PlayerState,
  "trace" | "step" | "lensStep" | "isPlaying" | "speed" | "sweep" | "film" | "beat" | "apart"
>;

/** What was shown last of each trace: the view and its labels ask for the same. */
const known = new WeakMap<
  Trace,
  { readonly step: number; readonly beat: Beat | null; readonly marks: RecoveryMarks | null }
>();

/**
 * Returns the marks of the step of recovery that a state shows; null while the front is played or scrubbed, and for other
 * steps. It is the same object as long as the step is the same. O(changes) for a new one.
 */
export function recoveryMarksOf(state: Shown): RecoveryMarks | null {
  const { trace, step, sweep, apart } = state;
  if (!trace || isFleeting(state) || sweep !== null || apart > 0) return null;
  const before = known.get(trace);
  const beat = beatAt(state);
  if (before?.step === step && before.beat === beat) return before.marks;
  const shown = trace.stepAt(step);
  const marks = shown?.kind === "recovery" ? recoveryMarks(trace, shown, beat) : null;
  known.set(trace, { step, beat, marks });
  return marks;
}

/** Returns the marks of a step, as far as its beat; null for the step as a whole. O(changes). */
export function recoveryMarks(trace: Trace, step: RecoveryStep, beat: Beat | null = null): RecoveryMarks {
  const triangles = (faces: readonly number[]): Position[] => faces.flatMap((face) => cornersOf(trace, face));
  const isPocket = beat === "pocket" || beat === "attempt";
  // What an opened or restored place has lost would hide it.
  const isReplaced = beat === "opened" || beat === "undone";
  const left = isReplaced ? [] : triangles(step.removedFaces);
  const joined = isPocket ? [] : triangles(step.addedFaces);
  const nodes = isPocket ? [] : step.addedNodes.map((node) => positionOf(trace, node));
  const pocket = left.length > 0 ? left : joined;
  const label = (kind: LensLabel["kind"], position: Position, text: string): LensLabel => ({
    kind,
    position,
    text,
  });
  return {
    left,
    joined,
    nodes,
    star: beat === "star" || beat === "filled" ? newSides(trace, step) : [],
    labels: [
      ...(pocket.length > 0
        ? [label("base", mean(pocket), isPocket ? texts.unrecovered[beat] : texts.recovery[step.change])]
        : []),
      ...nodes
        .slice(0, maxLabels)
        .map((position, i) => label("candidate", position, texts.node(step.addedNodes[i] ?? null))),
    ],
  };
}

/** Returns the edges from the new nodes to the corners of the elements that a step makes, each once. */
function newSides(trace: Trace, { addedElements, addedNodes }: RecoveryStep): Position[] {
  const isNew = new Set(addedNodes);
  const drawn = new Set<string>();
  return addedElements.flatMap((element) => {
    const corners = [...trace.elements.nodes.subarray(4 * element, 4 * element + 4)];
    return corners.flatMap((from) =>
      corners.flatMap((to) => {
        const key = `${Math.min(from, to)} ${Math.max(from, to)}`;
        if (from === to || !isNew.has(from) || drawn.has(key)) return [];
        drawn.add(key);
        return [positionOf(trace, from), positionOf(trace, to)];
      }),
    );
  });
}

/** Returns the names of the kinds of marks that are drawn. */
export function recoveryLegendOf({ left, joined, nodes }: RecoveryMarks): Readonly<Record<string, string>> {
  const { base, joined: joining, candidate } = texts.recoveryLegend;
  return {
    ...(left.length > 0 && { base }),
    ...(joined.length > 0 && { joined: joining }),
    ...(nodes.length > 0 && { candidate }),
  };
}

/** Edges of more faces than this are thin: wide ones would cover all. */
const maxWideFaces = 30;
const isWide = ({ left }: RecoveryMarks): boolean => left.length <= 3 * maxWideFaces;

/** All parts of the marks, in the order in which they are drawn. */
export const drawnRecovery: readonly DrawnMark<RecoveryMarks>[] = [
  { form: "faces", of: ({ joined }) => joined, color: "front", opacity: 0.12 },
  { form: "faces", of: ({ left }) => left, color: "selection", opacity: 0.3 },
  { form: "segments", of: ({ joined }) => edgesOf(joined), color: "front", width: 1.2 },
  {
    form: "segments",
    of: (marks) => (isWide(marks) ? edgesOf(marks.left) : []),
    color: "selection",
    width: 2.5,
  },
  {
    form: "segments",
    of: (marks) => (isWide(marks) ? [] : edgesOf(marks.left)),
    color: "selection",
    width: 1.2,
  },
  { form: "segments", of: ({ star }) => star, color: "front", width: 2 },
  { form: "dots", of: ({ nodes }) => nodes, color: "point", size: 11 },
];
