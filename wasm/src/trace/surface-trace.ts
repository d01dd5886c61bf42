/** The lines and patches of a trace: every step on demand, decoded from the file. */
import { EDGE_REFUSALS, type EdgeRefusal, NONE, SURFACE_EVENT, SURFACE_KIND_BITS } from "./layout.js";
import {
  type IdealEvent,
  readAcceptedEdge,
  readBaseEdge,
  readDivided,
  readHalved,
  readPostponedEdge,
  readRefusedEdge,
  readStation,
} from "./surface-events.js";
import { planeScore, planeScoreParts, type PlaneBase } from "./score.js";
import {
  newNodePosition,
  type ReplayedSurface,
  SURFACE_STEPS,
  type SurfaceColumns,
} from "./surface-replay.js";
import type {
  DivideStep,
  EdgeCandidate,
  EdgeStep,
  HalveStep,
  ImproveStep,
  PlanarFront,
  StationStep,
  SurfaceStep,
  TracedDivision,
} from "./surface-steps.js";
import { ACCEPTED } from "./trace-columns.js";
import { TraceCursor } from "./trace-cursor.js";
import type { TracePosition } from "./trace-step.js";

/** Counts over the lines. */
export interface LinesSummary {
  readonly steps: number;
  /** Number of lines. */
  readonly lines: number;
  /** Number of sides of all lines, after their last division. */
  readonly sides: number;
}

/** Counts over the patches. */
export interface PatchesSummary {
  readonly steps: number;
  /** Number of patches. */
  readonly patches: number;
  /** Number of base edges that were completed, and so of triangles of the fronts. */
  readonly accepted: number;
  readonly refused: Readonly<Record<EdgeRefusal, number>>;
  /** Number of base edges for which no candidate was accepted. */
  readonly postponed: number;
  /** Number of triangles after the improvement. */
  readonly triangles: number;
}

/** A base edge and its candidates, by their numbers in the patch. */
export interface TriedCandidates {
  /** Index of the base edge; null for other steps. */
  readonly base: number | null;
  /** Per candidate: its node; 0xffffffff for a new node that was refused. */
  readonly nodes: Uint32Array;
  /** Per candidate: the edge that it crosses or is too close to, or 0xffffffff. */
  readonly culprits: Uint32Array;
}

/** The recorded division of lines and the recorded 2-D fronts of patches, read from a trace. */
export class SurfaceTrace {
  /** The divisions of lines, in the order of the steps. */
  readonly divisions: readonly TracedDivision[];
  /** The 2-D fronts of patches, in the order of the steps. */
  readonly fronts: readonly PlanarFront[];
  /** Number of the nodes of all lines, which come first in the surface. */
  readonly lineNodes: number;
  readonly #bytes: Uint8Array;
  readonly #columns: SurfaceColumns;
  readonly #samples: ReplayedSurface["samples"];
  /** x y z of the surface's nodes. */
  readonly #positions: Float64Array;

  constructor(bytes: Uint8Array, replayed: ReplayedSurface, positions: Float64Array) {
    this.#bytes = bytes;
    this.divisions = replayed.divisions;
    this.fronts = replayed.fronts;
    this.lineNodes = replayed.lineNodes;
    this.#columns = replayed.columns;
    this.#samples = replayed.samples;
    this.#positions = positions;
  }

  /** Number of steps; the states are 0 to this number. */
  get stepCount(): number {
    return this.#columns.offsets.length - 1;
  }

  /** Last step of the lines; the steps of the patches follow. */
  get lastLineStep(): number {
    return (this.fronts[0]?.firstStep ?? this.stepCount + 1) - 1;
  }

  /** Index of the planar front whose step this is; undefined for steps of lines. */
  frontAt(step: number): number | undefined {
    return step > this.lastLineStep && step <= this.stepCount ? this.#columns.owners[step] : undefined;
  }

  /** Index of the division whose step this is; undefined for other steps. */
  divisionAt(step: number): number | undefined {
    const owner = step >= 1 && step <= this.lastLineStep ? this.#columns.owners[step] : undefined;
    return owner === NONE ? undefined : owner;
  }

  /** Number of edges of the planar front after a step; 0 in steps of lines. */
  frontSizeAt(step: number): number {
    return step > this.lastLineStep ? (this.#columns.sizes[step] ?? 0) : 0;
  }

  /** Kind of a step, from 1: that of `stepAt`, or the outcome of a base edge. */
  kindAt(step: number): (typeof SURFACE_STEPS)[number] | undefined {
    return step < 1 ? undefined : SURFACE_STEPS[this.#columns.kinds[step] ?? NONE];
  }

  /** Whether a step makes a new node. */
  makesNode(step: number): boolean {
    const front = this.fronts[this.frontAt(step) ?? NONE];
    if (front === undefined || this.kindAt(step) !== "accepted") return false;
    return front.nodesBorn[firstFrom(front.nodesBorn, step)] === step;
  }

  /** Verdicts of the candidates of a step, in their order; undefined for the one that is accepted. */
  refusalsAt(step: number): readonly (EdgeRefusal | undefined)[] {
    const { firstCandidates, candidateVerdicts } = this.#columns;
    const verdicts = candidateVerdicts.subarray(firstCandidates[step], firstCandidates[step + 1]);
    return Array.from(verdicts, (verdict) => EDGE_REFUSALS[verdict]);
  }

  /**
   * Returns the base edge of a step and its candidates without decoding the step; no base edge and no candidates for steps
   * without one. O(1): the arrays are views.
   */
  triedAt(step: number): TriedCandidates {
    const { bases, firstCandidates, candidateNodes, candidateCulprits } = this.#columns;
    const base = bases[step] ?? NONE;
    const range = [firstCandidates[step] ?? 0, firstCandidates[step + 1] ?? 0] as const;
    return {
      base: base === NONE ? null : base,
      nodes: candidateNodes.subarray(...range),
      culprits: candidateCulprits.subarray(...range),
    };
  }

  /** Returns the layer of the base edge of a step; null for steps without a base edge. O(1). */
  layerAt(step: number): number | null {
    const kind = this.kindAt(step);
    if (kind !== "accepted" && kind !== "postponed") return null;
    const { detail, cursor } = this.#event(step);
    return readBaseEdge(cursor, detail).layer;
  }

  /** Returns step `step`, from 1 to `stepCount`; undefined for other numbers. */
  stepAt(step: number): SurfaceStep | undefined {
    const kind = this.kindAt(step);
    const owner = this.#columns.owners[step] ?? NONE;
    switch (kind) {
      case undefined:
        return undefined;
      case "station":
        return this.#station(step, owner);
      case "divided":
        return this.#divided(step, owner);
      case "halved":
        return this.#halved(step);
      case "patch":
        return { kind, step, front: owner, patch: this.#front(owner).patch };
      case "accepted":
      case "postponed":
        return this.#edge(step, owner, kind);
      case "improved":
        return this.#improved(step, owner);
    }
  }

  /**
   * Indices in the surface of the nodes of an improved patch, those of the boundary first; null if the patch is
   * triangulated again later, or has not been improved.
   */
  surfaceNodesOf(front: number): Uint32Array | null {
    const { patch, improved, surfaceNodes, seamNodes, boundaryNodes } = this.#front(front);
    if (improved === null || this.#lastFrontOf(patch) !== front) return null;
    const firstOwn = this.#firstOwnNode(patch);
    const nodes = new Uint32Array(improved.plane.length / 2);
    surfaceNodes.forEach((node, i) => {
      nodes[i] = node < this.lineNodes ? node : firstOwn + node - this.lineNodes;
    });
    for (let i = boundaryNodes; i < nodes.length; i++) nodes[i] = firstOwn + seamNodes + i - boundaryNodes;
    return nodes;
  }

  /** x y z of the nodes of an improved patch in space; null if they are not known, as `surfaceNodesOf`. */
  improvedPositions(front: number): Float64Array | null {
    const nodes = this.surfaceNodesOf(front);
    if (nodes === null || nodes.some((node) => 3 * node >= this.#positions.length)) return null;
    const positions = new Float64Array(3 * nodes.length);
    nodes.forEach((node, i) => {
      positions.set(this.#positions.subarray(3 * node, 3 * node + 3), 3 * i);
    });
    return positions;
  }

  /** Returns the counts over lines and patches. O(steps + candidates). */
  summary(): { readonly lines: LinesSummary; readonly patches: PatchesSummary } {
    const { kinds, candidateVerdicts } = this.#columns;
    const counts = SURFACE_STEPS.map(() => 0);
    for (const kind of kinds.subarray(1)) counts[kind] = (counts[kind] ?? 0) + 1;
    const [station = 0, divided = 0, halved = 0, , accepted = 0, postponed = 0] = counts;
    const verdicts = EDGE_REFUSALS.map(() => 0);
    for (const verdict of candidateVerdicts)
      if (verdict !== ACCEPTED) verdicts[verdict] = (verdicts[verdict] ?? 0) + 1;
    const [behind = 0, crosses = 0, tooClose = 0, sameNode = 0, outside = 0] = verdicts;
    const last = new Map(this.divisions.map((division) => [division.line, division]));
    const sides = [...last.values()].map(({ nodes }) => Math.max(0, nodes.length / 3 - 1));
    const patches = new Map(this.fronts.map((front) => [front.patch, front]));
    const triangles = [...patches.values()].map(({ improved }) => (improved?.triangles.length ?? 0) / 3);
    const lineSteps = station + divided + halved;
    return {
      lines: { steps: lineSteps, lines: last.size, sides: total(sides) + halved },
      patches: {
        steps: this.stepCount - lineSteps,
        patches: patches.size,
        accepted,
        refused: { behind, crosses, "too-close": tooClose, "same-node": sameNode, outside },
        postponed,
        triangles: total(triangles),
      },
    };
  }

  #station(step: number, owner: number): StationStep {
    const { detail, cursor } = this.#event(step);
    const { end, parameter, start, length, rounds, sides } = readStation(cursor, detail);
    const { line, begin, stations, firstStep } = this.#division(owner);
    const at = 3 * (step - firstStep);
    return {
      kind: "station",
      step,
      division: owner,
      line,
      startSize: start,
      length,
      rounds,
      end,
      parameter,
      sides,
      from: at === 0 ? begin : tripleAt(stations, at - 3),
      to: tripleAt(stations, at),
    };
  }

  #divided(step: number, owner: number): DivideStep {
    const { length, nodes } = readDivided(this.#event(step).cursor);
    const sideCount = Math.max(0, nodes.length / 3 - 1);
    return { kind: "divided", step, division: owner, line: this.#division(owner).line, length, sideCount };
  }

  #halved(step: number): HalveStep {
    return { kind: "halved", step, ...readHalved(this.#event(step).cursor) };
  }

  #edge(step: number, owner: number, outcome: "accepted" | "postponed"): EdgeStep {
    const front = this.#front(owner);
    const { detail, cursor } = this.#event(step);
    const event = readBaseEdge(cursor, detail);
    const edge = this.#columns.bases[step] ?? 0;
    const nodes = [front.edges[2 * edge] ?? 0, front.edges[2 * edge + 1] ?? 0] as const;
    const sample = this.#samples[this.#columns.samples[step] ?? 0] ?? { size: 1, metric: [1, 0, 1] };
    const end = outcomeIn(cursor);
    const ideal = idealOf(end, pairAt(front.plane, nodes[0]));
    const ends = [pairAt(front.plane, nodes[0]), pairAt(front.plane, nodes[1])] as const;
    const candidates = this.#candidates(step, front, { ends, ideal, metric: sample.metric });
    const triangle = outcome === "accepted" ? firstFrom(front.trianglesBorn, step) : null;
    return {
      kind: "edge",
      step,
      front: owner,
      patch: front.patch,
      edge,
      nodes,
      pass: event.pass,
      sizeClass: this.#columns.sizeClasses[step] ?? 0,
      layer: event.layer,
      ...sample,
      ideal,
      nearbyEdges: event.nearbyEdges,
      rankedCandidates: event.rankedCandidates,
      candidates,
      outcome,
      nextPass: "nextPass" in end ? end.nextPass : null,
      removedEdges: indicesOf(front.edgesDied, step),
      addedEdges: indicesOf(front.edgesBorn, step),
      triangle,
    };
  }

  #candidates(step: number, front: PlanarFront, base: PlaneBase): readonly EdgeCandidate[] {
    const { firstCandidates, candidateNodes, candidateCulprits, candidateVerdicts } = this.#columns;
    const candidates: EdgeCandidate[] = [];
    let refusedNew = 0;
    for (let i = firstCandidates[step] ?? 0; i < (firstCandidates[step + 1] ?? 0); i++) {
      const known = candidateNodes[i] ?? NONE;
      const node = known === NONE ? null : known;
      const culprit = candidateCulprits[i] ?? NONE;
      const isNew = node === null || front.nodesBorn[node] === step;
      const plane =
        node === null ? newNodePosition(...base.ends, base.ideal, refusedNew++) : pairAt(front.plane, node);
      const parts = planeScoreParts(base, plane, isNew);
      candidates.push({
        node,
        isNew,
        plane,
        score: planeScore(parts),
        parts,
        verdict: EDGE_REFUSALS[candidateVerdicts[i] ?? ACCEPTED] ?? "accepted",
        culprit: culprit === NONE ? null : culprit,
      });
    }
    return candidates;
  }

  #improved(step: number, owner: number): ImproveStep {
    const { patch, improved, boundaryNodes, plane, triangles } = this.#front(owner);
    return {
      kind: "improved",
      step,
      front: owner,
      patch,
      trianglesBefore: triangles.length / 3,
      triangles: (improved?.triangles.length ?? 0) / 3,
      interiorNodesBefore: plane.length / 2 - boundaryNodes,
      interiorNodes: (improved?.plane.length ?? 0) / 2 - boundaryNodes,
    };
  }

  #event(step: number): { readonly detail: number; readonly cursor: TraceCursor } {
    const cursor = new TraceCursor(this.#bytes, this.#columns.offsets[step] ?? 0);
    return { detail: cursor.byte() >> SURFACE_KIND_BITS, cursor };
  }

  #division(index: number): TracedDivision {
    const division = this.divisions[index];
    if (division === undefined) throw new RangeError(`there is no division ${index}`);
    return division;
  }

  #front(index: number): PlanarFront {
    const front = this.fronts[index];
    if (front === undefined) throw new RangeError(`there is no front ${index}`);
    return front;
  }

  #lastFrontOf(patch: number): number {
    return this.fronts.findLastIndex((front) => front.patch === patch);
  }

  /** Patches number their own nodes in the order of the model. */
  #firstOwnNode(patch: number): number {
    const last = new Map(this.fronts.map((front) => [front.patch, front]));
    const before = [...last.values()].filter((front) => front.patch < patch);
    const own = before.map(
      ({ seamNodes, improved, boundaryNodes }) =>
        seamNodes + (improved === null ? 0 : improved.plane.length / 2 - boundaryNodes),
    );
    return this.lineNodes + total(own);
  }
}

/** Reads on to the outcome of a base edge. */
function outcomeIn(cursor: TraceCursor): IdealEvent & { readonly nextPass?: number | null } {
  for (;;) {
    const first = cursor.byte();
    const detail = first >> SURFACE_KIND_BITS;
    const kind = first % (1 << SURFACE_KIND_BITS);
    if (kind === SURFACE_EVENT.accepted) return readAcceptedEdge(cursor, detail);
    if (kind === SURFACE_EVENT.postponed) return readPostponedEdge(cursor, detail);
    readRefusedEdge(cursor, detail);
  }
}

const idealOf = ({ isExact, ideal: [x, y] }: IdealEvent, [ax, ay]: readonly [number, number]) =>
  isExact ? ([x, y] as const) : ([ax + x, ay + y] as const);

const total = (numbers: readonly number[]): number => numbers.reduce((sum, number) => sum + number, 0);

const pairAt = (numbers: Float64Array, index: number): readonly [number, number] => [
  numbers[2 * index] ?? 0,
  numbers[2 * index + 1] ?? 0,
];

const tripleAt = (numbers: Float64Array, at: number): TracePosition => [
  numbers[at] ?? 0,
  numbers[at + 1] ?? 0,
  numbers[at + 2] ?? 0,
];

/** Index of the first entry that is not less, of ascending ones. */
function firstFrom(ascending: Uint32Array, value: number): number {
  let begin = 0;
  let end = ascending.length;
  while (begin < end) {
    const middle = (begin + end) >> 1;
    if ((ascending[middle] ?? 0) < value) begin = middle + 1;
    else end = middle;
  }
  return begin;
}

function indicesOf(steps: Uint32Array, step: number): readonly number[] {
  const indices: number[] = [];
  for (let at = steps.indexOf(step); at >= 0; at = steps.indexOf(step, at + 1)) indices.push(at);
  return indices;
}
