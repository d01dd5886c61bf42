/** The sweeps of the optimizer as a film: state 0 is the mesh of the front, and sweep k leads to state k. */
import type { SweepMeasures, SweptMesh, Trace, TracedSweep } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { cross, dot, subtract } from "../../../../document/vectors";
import type { Film } from "../../kit/film-player";
import { measureFour, poorAngles, type Four } from "../sliver/sliver-rules";

/** Width of a bar of the histogram, and its last angle, in degrees. */
export const barWidth = 3;
const lastAngle = 72;
export const barCount = lastAngle / barWidth;

export interface SweepState {
  /** Elements with an angle below 30° or above 135°, the worst first. */
  readonly poor: readonly Four[];
  /** Elements by their smallest dihedral angle. */
  readonly bars: readonly number[];
  /** Where the sweep has moved nodes, or made elements. */
  readonly changed: readonly Position[];
}

export class SweepFilm implements Film {
  readonly stepCount: number;
  readonly sizes: readonly number[];
  readonly refusals: readonly number[] = [];
  readonly #trace: Trace;
  readonly #measures: readonly SweepMeasures[];
  readonly #states = new Map<number, SweepState>();
  readonly #holders = new Map<number, Four>();

  /** Throws if the trace has no sweeps. */
  constructor(trace: Trace) {
    const optimization = trace.optimization;
    if (!optimization?.hasMeshes) throw new Error("The trace has no sweeps of the optimizer.");
    this.#trace = trace;
    const { before, sweeps } = optimization.summary;
    this.#measures = [before, ...sweeps];
    this.stepCount = sweeps.length;
    // As in the chart, so that a single poor element is visible.
    this.sizes = this.#measures.map(({ outOfRange }) => Math.sqrt(outOfRange));
  }

  measuresAt(state: number): SweepMeasures {
    return this.#measures[state] ?? (this.#measures[0] as SweepMeasures);
  }

  /** Returns the sweep that led to a state; null for the first one. */
  sweepOf(state: number): TracedSweep | null {
    return this.#trace.optimization?.summary.sweeps[state - 1] ?? null;
  }

  /** Returns whether a sweep left more poor elements, or a smaller least angle, than there were before. */
  isWorse(state: number): boolean {
    if (state === 0) return false;
    const [before, after] = [this.measuresAt(state - 1), this.measuresAt(state)];
    return after.outOfRange > before.outOfRange || after.dihedral.min < before.dihedral.min - 1e-3;
  }

  /** Returns the worst element of the first state. */
  get sliver(): Four {
    return this.stateAt(0).poor[0] ?? this.elementAt(0, [0, 0, 0]);
  }

  /** Returns the element of a state that holds a position, or comes nearest to holding it. O(elements) once per state. */
  elementAt(state: number, position: Position): Four {
    let known = this.#holders.get(state);
    if (!known) {
      const mesh = this.#trace.optimization?.meshAfter(state);
      if (!mesh) throw new Error(`There is no mesh after sweep ${state}.`);
      const all = Array.from(mesh.tetrahedronRegion, (_region, element) => cornersOf(mesh, element));
      const outside = all.map((four) => outsideBy(four, position));
      const nearest = all[outside.indexOf(Math.min(...outside))];
      if (!nearest) throw new Error(`There is no element after sweep ${state}.`);
      known = nearest;
      this.#holders.set(state, known);
    }
    return known;
  }

  /** O(elements) the first time that a state is asked for. */
  stateAt(state: number): SweepState {
    let known = this.#states.get(state);
    if (!known) {
      const [before, after] = [state - 1, state].map((each) => this.#trace.optimization?.meshAfter(each));
      if (!after) throw new Error(`There is no mesh after sweep ${state}.`);
      known = stateOf(after, before);
      this.#states.set(state, known);
    }
    return known;
  }
}

function stateOf(mesh: SweptMesh, before: SweptMesh | undefined): SweepState {
  const bars = Array.from({ length: barCount }, () => 0);
  const poor: { readonly four: Four; readonly least: number }[] = [];
  for (let element = 0; element < mesh.tetrahedronRegion.length; element++) {
    const four = cornersOf(mesh, element);
    const { angles } = measureFour(four);
    const [least, most] = [Math.min(...angles), Math.max(...angles)];
    const bar = Math.min(barCount - 1, Math.floor(least / barWidth));
    bars[bar] = (bars[bar] ?? 0) + 1;
    if (least < poorAngles.min || most > poorAngles.max) poor.push({ four, least });
  }
  poor.sort((a, b) => a.least - b.least);
  return { poor: poor.map(({ four }) => four), bars, changed: before ? changesOf(mesh, before) : [] };
}

/** Returns how far a position is outside of an element, by its most negative coordinate in it; not above 0 if it is inside. */
function outsideBy([a, b, c, d]: Four, position: Position): number {
  const volume = (p: Position, q: Position, r: Position, s: Position): number =>
    dot(subtract(q, p), cross(subtract(r, p), subtract(s, p)));
  const whole = volume(a, b, c, d) || Number.MIN_VALUE;
  const parts = [
    volume(position, b, c, d),
    volume(a, position, c, d),
    volume(a, b, position, d),
    volume(a, b, c, position),
  ];
  return Math.max(...parts.map((part) => -part / whole));
}

const nodeAt = ({ points }: SweptMesh, node: number): Position => [
  points[3 * node] ?? 0,
  points[3 * node + 1] ?? 0,
  points[3 * node + 2] ?? 0,
];

function cornersOf(mesh: SweptMesh, element: number): Four {
  const [a = 0, b = 0, c = 0, d = 0] = mesh.tetrahedra.subarray(4 * element, 4 * element + 4);
  return [nodeAt(mesh, a), nodeAt(mesh, b), nodeAt(mesh, c), nodeAt(mesh, d)];
}

/** Returns the new places of moved and new nodes; if there are none, the middles of elements that were not there before. */
function changesOf(mesh: SweptMesh, before: SweptMesh): readonly Position[] {
  const count = mesh.points.length / 3;
  const nodes = Array.from({ length: count }, (_none, node) => node).filter((node) =>
    [0, 1, 2].some((axis) => mesh.points[3 * node + axis] !== before.points[3 * node + axis]),
  );
  if (nodes.length > 0) return nodes.map((node) => nodeAt(mesh, node));
  const key = ({ tetrahedra }: SweptMesh, element: number): string =>
    [...tetrahedra.subarray(4 * element, 4 * element + 4)].sort((a, b) => a - b).join(" ");
  const known = new Set(Array.from(before.tetrahedronRegion, (_region, element) => key(before, element)));
  return Array.from(mesh.tetrahedronRegion, (_region, element) => element)
    .filter((element) => !known.has(key(mesh, element)))
    .map((element) => {
      const four = cornersOf(mesh, element);
      return [0, 1, 2].map((axis) =>
        four.reduce((sum, corner) => sum + (corner[axis] ?? 0) / 4, 0),
      ) as unknown as Position;
    });
}
