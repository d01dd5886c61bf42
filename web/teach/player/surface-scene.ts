/** What a state of the lines and patches looks like in space. */
import type { EdgeStep, PlanarFront, SurfaceStep, SurfaceTrace, Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { isBeforeTest } from "./beats";
import type { Beat } from "../strings/film";
import { edgesAt, endsOf } from "./planar-judge";
import { candidateInBeat, examinedCandidate, supposedCandidate } from "./planar-lens";

/** Segments are lists of ends, two after two. */
export interface SurfaceScene {
  /** Sides of lines that are divided. */
  readonly sides: readonly Position[];
  /** The walk along a line, up to its last station. */
  readonly walk: readonly Position[];
  /** Edges of the 2-D front. */
  readonly front: readonly Position[];
  /** Ends of sides, or stations of the walk. */
  readonly nodes: readonly Position[];
  /** Number of planar fronts that are finished, and of triangles that the next one has made. */
  readonly finished: number;
  readonly made: number;
}

/**
 * Returns the scene of a state, from 0; with a refused candidate that is chosen, that of the state before. `candidate`: as for
 * `examinedCandidate`. O(sides + edges of the patch).
 */
export function surfaceScene(
  { surface }: Trace,
  after: number,
  candidate: number | null = null,
): SurfaceScene {
  const isSupposed = candidate !== null && supposedCandidate(surface?.stepAt(after), candidate) !== null;
  const state = isSupposed ? after - 1 : after;
  if (surface === null) return { sides: [], walk: [], front: [], nodes: [], finished: 0, made: 0 };
  const sides = sidesAt(surface, state);
  const walk = walkAt(surface, state);
  const index = surface.frontAt(state);
  const front = index === undefined ? undefined : surface.fronts[index];
  const isFinished = front !== undefined && state >= front.lastStep;
  const edges = front && !isFinished ? edgesAt(front, state) : [];
  return {
    sides,
    walk,
    front: edges.flatMap((edge) => (front ? endsOf(front, edge).map((node) => inSpace(front, node)) : [])),
    nodes: walk.length > 0 ? walk : sides,
    finished: (index ?? 0) + (isFinished ? 1 : 0),
    made: front && !isFinished ? trianglesMadeAt(front, state) : 0,
  };
}

/** What a step is about; empty in steps about a whole patch. */
export interface StepMarks {
  /**
   * Ends of the base edge; in steps of lines of the sides that the step has found, divided or halved. And of the edge that the
   * examined candidate crosses or is too close to.
   */
  readonly base: readonly Position[];
  readonly culprit: readonly Position[];
  /** Corners of the triangle that the step makes. */
  readonly triangle: readonly Position[];
  /** Corners of the triangle of a refused candidate, if the front is shown as it would be with it; none of a new node. */
  readonly supposed: readonly Position[];
}

/** Returns the marks of a state, from 0, as far as a beat. `candidate`: as for `examinedCandidate`. */
export function stepMarks(
  { surface }: Trace,
  state: number,
  candidate: number | null,
  beat: Beat | null = null,
): StepMarks {
  const step = surface?.stepAt(state);
  const hasSide = beat !== "station" && beat !== "averages";
  if (surface && step && step.kind !== "edge")
    return { base: hasSide ? sidesOf(surface, step) : [], culprit: [], triangle: [], supposed: [] };
  const front = step?.kind === "edge" ? surface?.fronts[step.front] : undefined;
  if (step?.kind !== "edge" || !front) return { base: [], culprit: [], triangle: [], supposed: [] };
  const positions = (nodes: Iterable<number>): Position[] => [...nodes].map((node) => inSpace(front, node));
  if (isBeforeTest(beat))
    return { base: positions(endsOf(front, step.edge)), culprit: [], triangle: [], supposed: [] };
  const culprit = examinedCandidate(step, candidateInBeat(step, candidate, beat))?.culprit ?? null;
  const chosen = supposedCandidate(step, candidate);
  const triangle = chosen || beat === "test" ? null : step.triangle;
  return {
    base: positions(endsOf(front, step.edge)),
    culprit: culprit === null ? [] : positions(endsOf(front, culprit)),
    triangle: triangle === null ? [] : positions(front.triangles.subarray(3 * triangle, 3 * triangle + 3)),
    supposed: chosen === null || chosen.node === null ? [] : positions([...step.nodes, chosen.node]),
  };
}

/** Returns the ends of the sides that a step of a line is about; of none for steps of patches. */
function sidesOf(surface: SurfaceTrace, step: Exclude<SurfaceStep, EdgeStep>): readonly Position[] {
  switch (step.kind) {
    case "station":
      return walkAt(surface, step.step).slice(-2);
    case "divided": {
      const { nodes } = surface.divisions[step.division] ?? { nodes: [] };
      return segmentsAlong(nodes, nodes.length / 3);
    }
    case "halved": {
      const { nodes = [] } = surface.divisions.findLast(({ line }) => line === step.line) ?? {};
      return segmentsAlong(nodes, nodes.length / 3).slice(2 * step.side, 2 * step.side + 2);
    }
    default:
      return [];
  }
}

/** Three nodes per triangle, and x y z per node. */
export interface PatchTriangles {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
}

/** Returns the triangles of each patch when it is finished, improved if they were. */
export function finishedPatches({ surface }: Trace): readonly PatchTriangles[] {
  return (surface?.fronts ?? []).map((front, index) => {
    const positions = surface?.improvedPositions(index);
    return positions && front.improved ? { positions, triangles: front.improved.triangles } : front;
  });
}

export const inSpace = ({ positions }: PlanarFront, node: number): Position => at(positions, node);

const at = (numbers: ArrayLike<number>, index: number): Position => [
  numbers[3 * index] ?? 0,
  numbers[3 * index + 1] ?? 0,
  numbers[3 * index + 2] ?? 0,
];

/** Number of triangles that a front has made until a step. */
export function trianglesMadeAt({ trianglesBorn }: PlanarFront, step: number): number {
  const next = trianglesBorn.findIndex((born) => born > step);
  return next < 0 ? trianglesBorn.length : next;
}

/** The sides of each line after its last division until a step. Halved sides are drawn as one until the patches. */
function sidesAt({ divisions }: SurfaceTrace, state: number): Position[] {
  const last = new Map<number, Float64Array>();
  for (const { line, lastStep, nodes } of divisions) if (lastStep <= state) last.set(line, nodes);
  return [...last.values()].flatMap((nodes) => segmentsAlong(nodes, nodes.length / 3));
}

function walkAt(surface: SurfaceTrace, state: number): Position[] {
  const division = surface.divisions[surface.divisionAt(state) ?? -1];
  if (!division || state >= division.lastStep) return [];
  const { begin, stations, firstStep } = division;
  return segmentsAlong([...begin, ...stations], state - firstStep + 2);
}

/** Segments between the first `count` positions. */
function segmentsAlong(positions: ArrayLike<number>, count: number): Position[] {
  return Array.from({ length: Math.max(0, count - 1) }, (_, i) => [
    at(positions, i),
    at(positions, i + 1),
  ]).flat();
}
