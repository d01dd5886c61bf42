/** A trace that has been read: every state of the front without replay, and every step on demand. */
import { readAccepted, readBase, readPostponed, readRefused, type ReadScore } from "./events.js";
import { type FinalLists, finalMesh, type TracedMesh } from "./final-mesh.js";
import type { TraceHeader } from "./header.js";
import { EVENT, type FrontChange, KIND_BITS, NONE, type Refusal, REFUSALS } from "./layout.js";
import type { TracedOptimization } from "./optimization.js";
import { OUTCOMES, type TracedFront } from "./replay.js";
import type { LinesSummary, PatchesSummary, SurfaceTrace } from "./surface-trace.js";
import {
  ACCEPTED,
  type TraceElements,
  type TraceFaces,
  type TraceNodes,
  type TraceSteps,
} from "./trace-columns.js";
import { TraceCursor } from "./trace-cursor.js";
import type { OptimizationSummary } from "./sweep-events.js";
import type { StepChanges, TracedCandidate, TracePosition, TraceStep } from "./trace-step.js";

/** Counts over the whole trace: of the volume, and of the lines and patches before it. */
export interface TraceSummary {
  readonly name: string;
  readonly steps: number;
  /** Null if the boundary was given. */
  readonly lines: LinesSummary | null;
  readonly patches: PatchesSummary | null;
  /** Number of steps that made an element over their base face. */
  readonly accepted: number;
  /** Number of refused candidates, by reason. */
  readonly refused: Readonly<Record<Refusal, number>>;
  /** Number of steps in which no candidate was accepted. */
  readonly postponed: number;
  /** Number of steps of recovery, by kind. */
  readonly changes: Readonly<Record<FrontChange, number>>;
  readonly status: TraceHeader["status"];
  /** The mesh before the sweeps of the optimizer, and each sweep; null if they were not recorded. */
  readonly optimization: OptimizationSummary | null;
  /** Fingerprint of the mesh when the front ended, as recorded. */
  readonly fingerprint: string;
}

/** Every state of a front and every step of it, as recorded. */
export class Trace {
  readonly #bytes: Uint8Array;
  readonly #lists: FinalLists;
  readonly #readScore: ReadScore;

  constructor(
    bytes: Uint8Array,
    readonly header: TraceHeader,
    readonly nodes: TraceNodes,
    readonly faces: TraceFaces,
    readonly elements: TraceElements,
    readonly steps: TraceSteps,
    /** The fronts, in their order. */
    readonly fronts: readonly TracedFront[],
    /** The lines and patches; null if the boundary was given, or the trace is one of version 1. */
    readonly surface: SurfaceTrace | null,
    /** The sweeps of the optimizer after the front; null if they were not recorded. */
    readonly optimization: TracedOptimization | null,
    lists: FinalLists,
    readScore: ReadScore,
  ) {
    this.#bytes = bytes;
    this.#lists = lists;
    this.#readScore = readScore;
  }

  /** Number of steps; the states are 0 to this number. */
  get stepCount(): number {
    return this.header.steps;
  }

  /** Indices of the faces of the front in state `state`, ascending. O(faces made until then). */
  frontAt(state: number): Uint32Array {
    return aliveAt(this.faces, this.steps.facesMade[state] ?? 0, state, this.steps.frontSizes[state] ?? 0);
  }

  /** Indices of the elements in state `state`, ascending. O(elements made until then). */
  elementsAt(state: number): Uint32Array {
    return aliveAt(this.elements, this.steps.elementsMade[state] ?? 0, state);
  }

  /** Returns step `step`, from 1 to `stepCount`; undefined for other numbers. */
  stepAt(step: number): TraceStep | undefined {
    const offset = this.steps.offsets[step];
    if (offset === undefined || step < 1) return undefined;
    const outcome = OUTCOMES[this.steps.outcomes[step] ?? 0] ?? "accepted";
    const changes = this.changesAt(step);
    return outcome === "accepted" || outcome === "postponed"
      ? this.#advanceStep(offset, outcome, changes)
      : { kind: "recovery", change: outcome, ...changes };
  }

  /** Returns what step `step` removes and adds. The first faces of a front that begins after it are not among them. */
  changesAt(step: number): StepChanges {
    const { facesMade, elementsMade, nodesMade } = this.steps;
    const nextFront = this.fronts.find(({ state }) => state === step);
    const before = step - 1;
    return {
      step,
      removedFaces: endedAt(this.faces, step),
      addedFaces: range(facesMade[before] ?? 0, nextFront?.firstFace ?? facesMade[step] ?? 0),
      removedElements: endedAt(this.elements, step),
      addedElements: range(elementsMade[before] ?? 0, elementsMade[step] ?? 0),
      addedNodes: range(nodesMade[before] ?? 0, nodesMade[step] ?? 0),
    };
  }

  /** Returns the counts. O(steps + candidates). */
  summary(): TraceSummary {
    const outcomes = OUTCOMES.map(() => 0);
    this.steps.outcomes.subarray(1).forEach((outcome) => {
      outcomes[outcome] = (outcomes[outcome] ?? 0) + 1;
    });
    const verdicts = REFUSALS.map(() => 0);
    for (const verdict of this.steps.candidateVerdicts)
      if (verdict !== ACCEPTED) verdicts[verdict] = (verdicts[verdict] ?? 0) + 1;
    const [accepted = 0, postponed = 0, star = 0, reopened = 0, closed = 0, undone = 0, exactFill = 0] =
      outcomes;
    const [behind = 0, crosses = 0, tooClose = 0] = verdicts;
    const surface = this.surface?.summary();
    return {
      name: this.header.name,
      steps: this.stepCount,
      lines: surface?.lines ?? null,
      patches: surface?.patches ?? null,
      accepted,
      refused: { behind, crosses, "too-close": tooClose },
      postponed,
      changes: { star, reopened, closed, undone, "exact-fill": exactFill },
      status: this.header.status,
      optimization: this.optimization?.summary ?? null,
      fingerprint: this.header.fingerprint,
    };
  }

  /**
   * Returns the mesh at the end of the front, before the optimization, in the engine's order. Its fingerprint equals that
   * of the header unless the file is damaged. O(elements).
   */
  finalMesh(): TracedMesh {
    return finalMesh(this.nodes.positions, this.elements, this.#lists);
  }

  #advanceStep(offset: number, outcome: "accepted" | "postponed", changes: StepChanges): TraceStep {
    const cursor = new TraceCursor(this.#bytes, offset);
    const { step } = changes;
    const base = readBase(cursor, cursor.byte() >> KIND_BITS);
    const face = this.steps.bases[step] ?? 0;
    const origin = this.#position(this.faces.nodes[3 * face] ?? 0);
    const candidates: TracedCandidate[] = [];
    const begin = this.steps.firstCandidates[step] ?? 0;
    const end = this.steps.firstCandidates[step + 1] ?? begin;
    for (let i = begin; i < end; i++) candidates.push(this.#candidate(cursor, i, origin));
    return {
      kind: "advance",
      ...changes,
      face,
      ruleClass: base.ruleClass,
      isRemeshing: base.isRemeshing,
      bucket: base.bucket,
      layers: base.layers,
      targetEdge: base.targetEdge,
      tensor: base.tensor,
      idealPoint: sum(origin, base.ideal),
      nearbyFaces: base.nearbyFaces,
      rankedCandidates: base.rankedCandidates,
      candidates,
      outcome,
      nextRuleClass: outcome === "postponed" ? readPostponed(cursor, cursor.byte() >> KIND_BITS) : null,
    };
  }

  #candidate(cursor: TraceCursor, index: number, origin: TracePosition): TracedCandidate {
    const first = cursor.byte();
    const detail = first >> KIND_BITS;
    const isAccepted = first % (1 << KIND_BITS) === EVENT.accepted;
    const read = isAccepted ? readAccepted : readRefused;
    const event = read(cursor, detail, this.#readScore);
    const node = noneAsNull(this.steps.candidateNodes[index]);
    const { score, parts, candidate } = event;
    const position =
      node === null && candidate.isNew ? sum(origin, candidate.position) : this.#position(node ?? 0);
    const culprit = noneAsNull(this.steps.candidateCulprits[index]);
    const verdict = "reason" in event ? event.reason : "accepted";
    return { node, isNew: candidate.isNew, position, score, parts, verdict, culprit };
  }

  #position(node: number): TracePosition {
    const [x = 0, y = 0, z = 0] = this.nodes.positions.subarray(3 * node, 3 * node + 3);
    return [x, y, z];
  }
}

const noneAsNull = (index: number | undefined): number | null =>
  index === undefined || index === NONE ? null : index;

const sum = (a: TracePosition, b: TracePosition): TracePosition => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

type Lived = Pick<TraceFaces, "born" | "died" | "ended">;

/** Returns those of the first `made` things that are part of a state; `expected` of them, if it is known. */
function aliveAt({ died }: Lived, made: number, state: number, expected = made): Uint32Array {
  const alive = new Uint32Array(expected);
  let count = 0;
  for (let i = 0; i < made; i++) if ((died[i] ?? 0) > state) alive[count++] = i;
  return alive.subarray(0, count);
}

/** Returns the things from `begin` to `end`. */
const range = (begin: number, end: number): readonly number[] =>
  Array.from({ length: Math.max(0, end - begin) }, (_, i) => begin + i);

/** Returns the things that die at a step, ascending. O(log n). */
function endedAt({ died, ended }: Lived, step: number): readonly number[] {
  let [begin, end] = [0, ended.length];
  while (begin < end) {
    const middle = (begin + end) >> 1;
    if ((died[ended[middle] ?? 0] ?? 0) < step) begin = middle + 1;
    else end = middle;
  }
  while (end < ended.length && died[ended[end] ?? 0] === step) ++end;
  return Array.from(ended.subarray(begin, end)).sort((a, b) => a - b);
}
