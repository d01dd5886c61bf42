/** What a step of recovery is about, in the view and in drawings: the faces of the front that it changes, and its new nodes. */
import type { RecoveryStep, Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { mean } from "../../document/vectors";
import { playerStrings } from "../strings/player";
import { cornersOf, positionOf } from "./judge";
import { edgesOf, type DrawnMark, type LensLabel } from "./lens-marks";
import type { PlayerState } from "./player";

/** Faces are triangles, three positions each. */
export interface RecoveryMarks {
  /** Faces that leave the front: those of the pocket. */
  readonly left: readonly Position[];
  readonly joined: readonly Position[];
  readonly nodes: readonly Position[];
  readonly labels: readonly LensLabel[];
}

/** More nodes have no labels: they would hide the pocket. */
const maxLabels = 8;
const texts = playerStrings.marks;

type Shown = Pick<PlayerState, "trace" | "step" | "lensStep" | "isPlaying" | "sweep">;

/** What was shown last of each trace: the view and its labels ask for the same. */
const known = new WeakMap<Trace, { readonly step: number; readonly marks: RecoveryMarks | null }>();

/**
 * Returns the marks of the step of recovery that a state shows; null while the front is played or scrubbed, and for other
 * steps. It is the same object as long as the step is the same. O(changes) for a new one.
 */
export function recoveryMarksOf({ trace, step, lensStep, isPlaying, sweep }: Shown): RecoveryMarks | null {
  if (!trace || isPlaying || step !== lensStep || sweep !== null) return null;
  const before = known.get(trace);
  if (before?.step === step) return before.marks;
  const shown = trace.stepAt(step);
  const marks = shown?.kind === "recovery" ? recoveryMarks(trace, shown) : null;
  known.set(trace, { step, marks });
  return marks;
}

/** Returns the marks of a step. O(changes). */
export function recoveryMarks(trace: Trace, step: RecoveryStep): RecoveryMarks {
  const triangles = (faces: readonly number[]): Position[] => faces.flatMap((face) => cornersOf(trace, face));
  const [left, joined] = [triangles(step.removedFaces), triangles(step.addedFaces)];
  const nodes = step.addedNodes.map((node) => positionOf(trace, node));
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
    labels: [
      ...(pocket.length > 0 ? [label("base", mean(pocket), texts.recovery[step.change])] : []),
      ...nodes
        .slice(0, maxLabels)
        .map((position, i) => label("candidate", position, texts.node(step.addedNodes[i] ?? null))),
    ],
  };
}

/** All parts of the marks, in the order in which they are drawn. */
export const drawnRecovery: readonly DrawnMark<RecoveryMarks>[] = [
  { form: "faces", of: ({ joined }) => joined, color: "front", opacity: 0.12 },
  { form: "faces", of: ({ left }) => left, color: "selection", opacity: 0.3 },
  { form: "segments", of: ({ joined }) => edgesOf(joined), color: "front", width: 1.2 },
  { form: "segments", of: ({ left }) => edgesOf(left), color: "selection", width: 2.5 },
  { form: "dots", of: ({ nodes }) => nodes, color: "point", size: 11 },
];
