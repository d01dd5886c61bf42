/** What one front is compared by with another. */
import type { Trace } from "tetrafront/trace";
import { refusals } from "../player/refusals";
import type { Position } from "../../document/position";
import { cross, dot, subtract } from "../../document/vectors";
import { faceSize } from "../player/front-values";

export interface RunMeasures {
  /** Elements when the front has closed. */
  readonly elements: number;
  /** Candidates refused because their element would cross a face. */
  readonly crossings: number;
  /** Those of them whose face is less than half as large as the base face: a large element would cross small ones. */
  readonly smallCrossings: number;
  /** Steps in which no candidate was accepted. */
  readonly postponed: number;
  /** Steps of recovery. */
  readonly recoveries: number;
  /** Elements with a dihedral angle below `flatAngle`. */
  readonly flat: number;
}

/** Dihedral angle in degrees below which an element counts as flat. */
export const flatAngle = 5;

const crosses = refusals.indexOf("crosses");

/** O(steps + elements). */
export function runMeasures(trace: Trace): RunMeasures {
  const { refused, postponed, changes } = trace.summary();
  const elements = trace.elementsAt(trace.stepCount);
  return {
    elements: elements.length,
    crossings: refused.crosses,
    smallCrossings: smallCrossings(trace),
    postponed,
    recoveries: Object.values(changes).reduce((sum, count) => sum + count, 0),
    flat: elements.reduce((count, element) => count + Number(minDihedral(trace, element) < flatAngle), 0),
  };
}

function smallCrossings(trace: Trace): number {
  const { candidateVerdicts, candidateCulprits, firstCandidates, bases } = trace.steps;
  let count = 0;
  for (let step = 1; step <= trace.stepCount; step++) {
    for (let i = firstCandidates[step] ?? 0; i < (firstCandidates[step + 1] ?? 0); i++) {
      if (candidateVerdicts[i] !== crosses) continue;
      const [base, crossed] = [bases[step] ?? 0, candidateCulprits[i] ?? 0];
      count += Number(faceSize(trace, crossed) < faceSize(trace, base) / 2);
    }
  }
  return count;
}

/** Pairs of corners, each followed by the other pair: their edge and the one opposite it. */
const edges = [
  [0, 1, 2, 3],
  [0, 2, 1, 3],
  [0, 3, 1, 2],
  [1, 2, 0, 3],
  [1, 3, 0, 2],
  [2, 3, 0, 1],
] as const;

/** Returns the smallest dihedral angle of an element, in degrees. */
function minDihedral({ elements, nodes }: Trace, element: number): number {
  const corners = Array.from(elements.nodes.subarray(4 * element, 4 * element + 4), (node): Position => {
    const [x = 0, y = 0, z = 0] = nodes.positions.subarray(3 * node, 3 * node + 3);
    return [x, y, z];
  });
  return Math.min(
    ...edges.map(([a, b, c, d]) => {
      const [from, to, left, right] = [corners[a], corners[b], corners[c], corners[d]];
      if (!from || !to || !left || !right) return Infinity;
      const edge = subtract(to, from);
      const [m, n] = [cross(edge, subtract(left, from)), cross(edge, subtract(right, from))];
      return (Math.acos(Math.min(1, dot(m, n) / (Math.hypot(...m) * Math.hypot(...n)))) * 180) / Math.PI;
    }),
  );
}
