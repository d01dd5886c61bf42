/** The record of the engine's front in the plane as a film: state 0 is the divided boundary, and step k leads to state k + 1. */
import type { EdgeRefusal, FilledPlane } from "tetrafront/trace";
import type { Film } from "../../kit/film-player";
import type { PlanePoint } from "../../kit/plane-view";

export interface FilmSide {
  readonly ends: readonly [number, number];
  /** First state with the side in the front, and first state without it. */
  readonly born: number;
  readonly died: number;
}

export interface FilmTriangle {
  readonly corners: readonly [number, number, number];
  /** First state with the triangle. */
  readonly born: number;
}

export interface FilmCandidate {
  readonly at: PlanePoint;
  readonly isNew: boolean;
  /** Null if the candidate is accepted. */
  readonly refusal: EdgeRefusal | null;
  /** Index of the side in the way; null if there is none. */
  readonly culprit: number | null;
}

export interface FilmStep {
  readonly base: number;
  readonly ideal: PlanePoint;
  readonly candidates: readonly FilmCandidate[];
}

export interface FrontFilm extends Film {
  readonly nodes: readonly PlanePoint[];
  readonly sides: readonly FilmSide[];
  readonly triangles: readonly FilmTriangle[];
  readonly boundaryNodes: number;
  /** Number of refused candidates of all steps. */
  readonly refusedCount: number;
  /** Number of refused candidates before each state. */
  readonly refusedBefore: readonly number[];
  /** The triangle with the smallest angle, and this angle in degrees. */
  readonly worst: { readonly triangle: number; readonly angle: number };
  /** Decodes step k, from 0; undefined for another number. */
  readonly stepAt: (k: number) => FilmStep | undefined;
}

type Filled = Extract<FilledPlane, { readonly success: true }>;

/** Returns the film of a filled polygon. */
export function filmOf({ trace, front }: Filled): FrontFilm {
  const first = front.firstStep;
  const isEdgeStep = (step: number): boolean => ["accepted", "postponed"].includes(trace.kindAt(step) ?? "");
  let stepCount = 0;
  while (isEdgeStep(first + 1 + stepCount)) stepCount++;
  const stateOf = (step: number): number => Math.max(0, step - first);
  const nodes = pairsIn(front.plane);
  const triangles = Array.from({ length: front.trianglesBorn.length }, (_none, i): FilmTriangle => {
    const [a = 0, b = 0, c = 0] = front.triangles.subarray(3 * i, 3 * i + 3);
    return { corners: [a, b, c], born: stateOf(front.trianglesBorn[i] ?? 0) };
  });
  const refusedIn = Array.from({ length: stepCount }, (_none, k) => {
    const verdicts = trace.refusalsAt(first + 1 + k);
    return verdicts.filter((verdict) => verdict !== undefined).length;
  });
  const refusedBefore = [0];
  for (const count of refusedIn) refusedBefore.push((refusedBefore.at(-1) ?? 0) + count);
  return {
    stepCount,
    sizes: Array.from({ length: stepCount + 1 }, (_none, k) => trace.frontSizeAt(first + k)),
    refusals: refusedIn.flatMap((count, k) => (count > 0 ? [k] : [])),
    nodes,
    sides: Array.from({ length: front.edgesBorn.length }, (_none, i): FilmSide => ({
      ends: [front.edges[2 * i] ?? 0, front.edges[2 * i + 1] ?? 0],
      born: stateOf(front.edgesBorn[i] ?? 0),
      died: stateOf(front.edgesDied[i] ?? 0),
    })),
    triangles,
    boundaryNodes: front.boundaryNodes,
    refusedCount: refusedBefore.at(-1) ?? 0,
    refusedBefore,
    worst: worstOf(nodes, triangles),
    stepAt: (k) => {
      const step = k >= 0 && k < stepCount ? trace.stepAt(first + 1 + k) : undefined;
      if (step?.kind !== "edge") return undefined;
      const candidates = step.candidates.map(({ plane, isNew, verdict, culprit }) => ({
        at: plane,
        isNew,
        refusal: verdict === "accepted" ? null : verdict,
        culprit,
      }));
      return { base: step.edge, ideal: step.ideal, candidates };
    },
  };
}

function pairsIn(values: Float64Array): readonly PlanePoint[] {
  return Array.from({ length: values.length / 2 }, (_none, i): PlanePoint => [
    values[2 * i] ?? 0,
    values[2 * i + 1] ?? 0,
  ]);
}

function worstOf(nodes: readonly PlanePoint[], triangles: readonly FilmTriangle[]): FrontFilm["worst"] {
  const angles = triangles.map(({ corners }) => smallestAngle(corners.map((node) => nodes[node] ?? [0, 0])));
  const angle = Math.min(180, ...angles);
  return { triangle: angles.indexOf(angle), angle: angles.length > 0 ? angle : 0 };
}

/** Returns the smallest angle of a triangle, in degrees. */
export function smallestAngle(corners: readonly PlanePoint[]): number {
  const angles = corners.map((at, i) => {
    const [u, v] = [1, 2].map((by) => {
      const to = corners[(i + by) % 3] ?? at;
      return [to[0] - at[0], to[1] - at[1]] as const;
    }) as [PlanePoint, PlanePoint];
    return Math.abs(Math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]));
  });
  return (Math.min(...angles) * 180) / Math.PI;
}
