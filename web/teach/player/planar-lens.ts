import type { EdgeCandidate, EdgeStep, PlanarFront, SurfaceStep } from "tetrafront/trace";
import type { Beat } from "../strings/film";
import {
  clearance,
  crossedEdges,
  distanceToEdge,
  isBehindEdge,
  newTriangle,
  partInside,
  planeOf,
  targetLength,
  touching,
} from "./planar-judge";

/** A candidate for a triangle under the lens: the engine's verdict, and the numbers of our own check. */
export interface PlanarLensCandidate {
  readonly candidate: EdgeCandidate;
  /** Twice the signed area of the triangle in the plane; positive on the unmeshed side. */
  readonly doubleArea: number;
  readonly isBehind: boolean;
  /** Edges of the front that the triangle would cross, by our own check. */
  readonly crossed: readonly number[];
  /** Part of the culprit that lies in the triangle, as shares of its length; null if it does not cross. */
  readonly inside: readonly [number, number] | null;
  /** Distance of a new node from the culprit, in target sizes; null for other verdicts. */
  readonly distance: number | null;
  /** The least distance that is accepted, in target sizes. */
  readonly leastDistance: number;
}

/** Returns the candidate that decides a step: the accepted one, or the last one. */
export function decisiveCandidate({ candidates }: EdgeStep): number | null {
  return candidates.length === 0 ? null : candidates.length - 1;
}

/** Returns the rank of the candidate that a beat examines: in the test, the first one that was refused. */
export function candidateInBeat(step: EdgeStep, rank: number | null, beat: Beat | null): number | null {
  const refused = step.candidates.findIndex(({ verdict }) => verdict !== "accepted");
  return rank ?? (beat === "test" && refused >= 0 ? refused : decisiveCandidate(step));
}

/** Returns the candidate of a rank; null stands for the one that decides the step. */
export function examinedCandidate(step: EdgeStep, rank: number | null): EdgeCandidate | null {
  return step.candidates[rank ?? decisiveCandidate(step) ?? -1] ?? null;
}

/**
 * Returns the candidate with which the view and the plane show the front as it would be: the user has chosen one that was refused,
 * whose triangle would have an area. Null if they show what the step has made.
 */
export function supposedCandidate(step: SurfaceStep | undefined, rank: number | null): EdgeCandidate | null {
  const chosen = step?.kind === "edge" && rank !== null ? step.candidates[rank] : undefined;
  return chosen && (chosen.verdict === "crosses" || chosen.verdict === "too-close") ? chosen : null;
}

/** Checks a candidate against the front before the step. O(edges of the patch). */
export function examineCandidate(
  front: PlanarFront,
  step: EdgeStep,
  candidate: EdgeCandidate,
): PlanarLensCandidate {
  const triangle = newTriangle(front, step.nodes, candidate.plane, candidate.isNew ? null : candidate.node);
  const isBehind = isBehindEdge(front, triangle);
  const { culprit, verdict } = candidate;
  const [a, b] = step.nodes.map((node) => planeOf(front, node));
  const [ax = 0, ay = 0] = a ?? [];
  const [bx = 0, by = 0] = b ?? [];
  const [x, y] = candidate.plane;
  return {
    candidate,
    doubleArea: (bx - ax) * (y - ay) - (by - ay) * (x - ax),
    isBehind,
    crossed: isBehind ? [] : crossedEdges(front, step.step - 1, triangle, touching),
    inside: verdict === "crosses" && culprit !== null ? partInside(front, triangle, culprit) : null,
    distance:
      verdict === "too-close" && culprit !== null
        ? distanceToEdge(front, step.metric, candidate.plane, culprit)
        : null,
    leastDistance: clearance * targetLength(front, step),
  };
}
