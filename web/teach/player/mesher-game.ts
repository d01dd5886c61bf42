/** "Be the mesher": the reader chooses the third node of the next triangle of a patch, and the choice is judged. */
import type { EdgeRefusal, EdgeStep, PlanarFront, PlanePosition, SurfaceTrace } from "tetrafront/trace";
import {
  clearance,
  crossedEdges,
  distanceToEdge,
  edgesAt,
  endsOf,
  isBehindEdge,
  metricLength,
  newTriangle,
  planeOf,
  targetLength,
  touching,
} from "./planar-judge";

/** How much help there is, and which base edges are asked. */
export const levels = ["easy", "medium", "hard"] as const;
export type GameLevel = (typeof levels)[number];

/** Nodes to choose from besides a new one. */
export const maxChoices: Readonly<Record<GameLevel, number>> = { easy: 4, medium: 8, hard: 16 };
/** Points for the program's own choice, and for another one that breaks nothing. */
export const bestPoints = 2;
export const possiblePoints = 1;

export interface GameQuestion {
  readonly front: PlanarFront;
  readonly step: EdgeStep;
  /** Nodes of the front near the ideal point, ascending, with the one that the program chose. */
  readonly nodes: readonly number[];
  /** The program's choice; null: a new node. */
  readonly program: number | null;
  /** Candidates that the program tried before its choice, and refused. */
  readonly refused: number;
}

export interface GameVerdict {
  readonly kind: "best" | "possible" | EdgeRefusal;
  /** Edges of the front that the choice would cross, or is too close to. */
  readonly edges: readonly number[];
  readonly points: number;
  /** Whether the verdict was recorded, and our own check finds something else. */
  readonly isDisputed: boolean;
}

/** What the view shows of the game. */
export interface EdgeTask {
  readonly question: GameQuestion;
  /** The choice and its verdict; null before the choice. */
  readonly answer: { readonly node: number | null; readonly verdict: GameVerdict } | null;
}

/**
 * Returns the next base edge after a state of lines and patches that suits a level: an easy one has no refused candidate, a
 * hard one has at least one. With direction -1, returns the last one whose step begins in that state or before. Null if there is
 * none. O(steps between).
 */
export function nextQuestion(
  surface: SurfaceTrace,
  state: number,
  level: GameLevel,
  direction: 1 | -1 = 1,
): GameQuestion | null {
  for (let at = state + 1; at >= 1 && at <= surface.stepCount; at += direction) {
    if (surface.kindAt(at) !== "accepted") continue;
    const hasRefused = surface.refusalsAt(at).some((refusal) => refusal !== undefined);
    if ((level === "easy" && hasRefused) || (level === "hard" && !hasRefused)) continue;
    const step = surface.stepAt(at);
    const front = step?.kind === "edge" ? surface.fronts[step.front] : undefined;
    if (step?.kind === "edge" && front) return questionOf(front, step, level);
  }
  return null;
}

function questionOf(front: PlanarFront, step: EdgeStep, level: GameLevel): GameQuestion {
  const accepted = step.candidates.find(({ verdict }) => verdict === "accepted");
  const program = accepted && !accepted.isNew ? accepted.node : null;
  const refused = step.candidates.filter(({ verdict }) => verdict !== "accepted").length;
  const near = [...new Set(edgesAt(front, step.step - 1).flatMap((edge) => endsOf(front, edge)))]
    .filter((node) => !step.nodes.includes(node) && node !== program)
    .map((node) => ({ node, far: metricLength(step.metric, minus(planeOf(front, node), step.ideal)) }))
    .sort((a, b) => a.far - b.far || a.node - b.node)
    .map(({ node }) => node);
  const others = near.slice(0, maxChoices[level] - (program === null ? 0 : 1));
  const nodes = program === null ? others : [...others, program];
  return { front, step, nodes: nodes.sort((a, b) => a - b), program, refused };
}

/**
 * Judges a choice: by the recorded verdict if the program tried the node, else by our own check. `node` is null for a new node at
 * the ideal point. O(edges of the patch).
 */
export function judgeChoice(question: GameQuestion, node: number | null): GameVerdict {
  const { step, program } = question;
  if (node === program) return { kind: "best", edges: [], points: bestPoints, isDisputed: false };
  const own = checkChoice(question, node);
  const tried = step.candidates.find((candidate) => (candidate.isNew ? null : candidate.node) === node);
  if (!tried || tried.verdict === "accepted") return own;
  const { verdict: kind, culprit } = tried;
  // Our own check names all edges that are crossed, the record only the one found first.
  const edges = own.kind === kind && own.edges.length > 0 ? own.edges : culprit === null ? [] : [culprit];
  const isChecked = kind !== "same-node" && kind !== "outside";
  return { kind, edges, points: 0, isDisputed: isChecked && own.kind !== kind };
}

/** Judges a choice by our own check in doubles alone. O(edges of the patch). */
export function checkChoice({ front, step }: GameQuestion, node: number | null): GameVerdict {
  const position = node === null ? step.ideal : planeOf(front, node);
  const triangle = newTriangle(front, step.nodes, position, node);
  if (isBehindEdge(front, triangle)) return { kind: "behind", edges: [], points: 0, isDisputed: false };
  const edges = crossedEdges(front, step.step - 1, triangle, touching);
  if (edges.length > 0) return { kind: "crosses", edges, points: 0, isDisputed: false };
  const close = node === null ? closeEdges(front, step) : [];
  return close.length > 0
    ? { kind: "too-close", edges: close, points: 0, isDisputed: false }
    : { kind: "possible", edges: [], points: possiblePoints, isDisputed: false };
}

/** Edges of the front that are too close to a new node at the ideal point. */
function closeEdges(front: PlanarFront, step: EdgeStep): number[] {
  const least = clearance * targetLength(front, step);
  return edgesAt(front, step.step - 1).filter(
    (edge) => edge !== step.edge && distanceToEdge(front, step.metric, step.ideal, edge) < least,
  );
}

const minus = (a: PlanePosition, b: PlanePosition): PlanePosition => [a[0] - b[0], a[1] - b[1]];
