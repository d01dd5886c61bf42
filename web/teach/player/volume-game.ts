/** "Be the mesher" in the volume: the reader chooses the fourth node of the next element, and the choice is judged. */
import type { AdvanceStep, Refusal, Trace, TracedCandidate } from "tetrafront/trace";
import { refusals } from "./refusals";
import { distance } from "../../document/vectors";
import { crossedFaces, isBehind, newElement, nodesOf, positionOf, touching } from "./judge";
import { bestPoints, maxChoices, possiblePoints, type GameLevel } from "./mesher-game";

export interface VolumeQuestion {
  readonly step: AdvanceStep;
  /** Nodes of the front near the ideal point, ascending, with the one that the program chose. */
  readonly nodes: readonly number[];
  /** The program's choice; null: a new node. */
  readonly program: number | null;
  /** Candidates that the program tried before its choice, and refused. */
  readonly refused: number;
}

export interface VolumeVerdict {
  readonly kind: "best" | "possible" | Refusal;
  /** Faces of the front that the choice would cross, or is too close to. */
  readonly faces: readonly number[];
  readonly points: number;
  /** Whether the verdict was recorded, and our own check finds something else. */
  readonly isDisputed: boolean;
}

/** What the view shows of the game. */
export interface VolumeTask {
  readonly question: VolumeQuestion;
  /** The choice and its verdict; null before the choice. */
  readonly answer: { readonly node: number | null; readonly verdict: VolumeVerdict } | null;
  readonly showsIdeal: boolean;
  readonly choose: (node: number | null) => void;
}

/**
 * Returns the next base face after a state that suits a level, as `nextQuestion` of the patches; with direction -1 the last
 * one whose step begins in that state or before. Local remeshing, which fills a pocket again, is left out. O(steps between).
 */
export function nextVolumeQuestion(
  trace: Trace,
  state: number,
  level: GameLevel,
  direction: 1 | -1 = 1,
): VolumeQuestion | null {
  const { outcomes, firstCandidates, candidateVerdicts } = trace.steps;
  for (let at = Math.max(0, state) + 1; at >= 1 && at <= trace.stepCount; at += direction) {
    if (outcomes[at] !== 0) continue;
    const verdicts = candidateVerdicts.subarray(firstCandidates[at], firstCandidates[at + 1]);
    const hasRefused = verdicts.some((verdict) => verdict < refusals.length);
    if ((level === "easy" && hasRefused) || (level === "hard" && !hasRefused)) continue;
    const step = trace.stepAt(at);
    if (step?.kind === "advance" && !step.isRemeshing) return questionOf(trace, step, level);
  }
  return null;
}

function questionOf(trace: Trace, step: AdvanceStep, level: GameLevel): VolumeQuestion {
  const accepted = step.candidates.find(({ verdict }) => verdict === "accepted");
  const program = accepted && !accepted.isNew ? accepted.node : null;
  const refused = step.candidates.filter(({ verdict }) => verdict !== "accepted").length;
  const base = nodesOf(trace, step.face);
  const front = new Set(Array.from(trace.frontAt(step.step - 1)).flatMap((face) => nodesOf(trace, face)));
  const near = [...front]
    .filter((node) => !base.includes(node) && node !== program)
    .map((node) => ({ node, far: distance(positionOf(trace, node), step.idealPoint) }))
    .sort((a, b) => a.far - b.far || a.node - b.node)
    .map(({ node }) => node);
  const others = near.slice(0, maxChoices[level] - (program === null ? 0 : 1));
  const nodes = program === null ? others : [...others, program];
  return { step, nodes: nodes.sort((a, b) => a - b), program, refused };
}

/**
 * Judges a choice: by the recorded verdict if the program tried the node, else by our own check in doubles. `node` is null
 * for a new node at the ideal point. O(faces of the front).
 */
export function judgeVolumeChoice(
  trace: Trace,
  question: VolumeQuestion,
  node: number | null,
): VolumeVerdict {
  const { step, program } = question;
  if (node === program) return { kind: "best", faces: [], points: bestPoints, isDisputed: false };
  const own = checkVolumeChoice(trace, question, node);
  const tried = step.candidates.find((candidate) => (candidate.isNew ? null : candidate.node) === node);
  if (!tried || tried.verdict === "accepted") return own;
  const { verdict: kind, culprit } = tried;
  const faces = own.kind === kind && own.faces.length > 0 ? own.faces : culprit === null ? [] : [culprit];
  // Our own check does not measure how close a new node is.
  return { kind, faces, points: 0, isDisputed: kind !== "too-close" && own.kind !== kind };
}

/** Judges a choice by our own check alone, which does not measure how close a new node is to the front. O(faces of the front). */
export function checkVolumeChoice(
  trace: Trace,
  { step }: VolumeQuestion,
  node: number | null,
): VolumeVerdict {
  const apex = node === null ? step.idealPoint : positionOf(trace, node);
  const element = newElement(trace, step.face, apex, node);
  if (isBehind(element)) return { kind: "behind", faces: [], points: 0, isDisputed: false };
  const faces = crossedFaces(trace, step.step - 1, element, touching);
  return faces.length > 0
    ? { kind: "crosses", faces, points: 0, isDisputed: false }
    : { kind: "possible", faces: [], points: possiblePoints, isDisputed: false };
}

/** Returns a choice as a candidate, which the lens can draw; null before the choice. */
export function chosenCandidate(trace: Trace, { question, answer }: VolumeTask): TracedCandidate | null {
  if (!answer) return null;
  const { node, verdict } = answer;
  const { kind, faces } = verdict;
  return {
    node,
    isNew: node === null,
    position: node === null ? question.step.idealPoint : positionOf(trace, node),
    score: 0,
    parts: null,
    verdict: kind === "best" || kind === "possible" ? "accepted" : kind,
    culprit: faces[0] ?? null,
  };
}
