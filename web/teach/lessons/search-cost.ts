/**
 * How many faces a search looks at while a front advances (section 6 of the paper, data structures): a linear search, which
 * compares every face of the front in each step, against the faces near the base face, which a search in space returns.
 */
import type { Trace } from "tetrafront/trace";

export interface SearchCost {
  /** Elements made until each point of the curves; ascending from 0. */
  readonly elements: readonly number[];
  /** Faces that a linear search would have compared until then. */
  readonly linear: readonly number[];
  /** Faces that the search in space has returned until then. */
  readonly near: readonly number[];
}

/** Returns both counts over the steps in at most `maxPoints` parts. Steps of recovery do not count. O(steps). */
export function searchCost(trace: Trace, maxPoints = 120): SearchCost {
  const elements = [0];
  const linear = [0];
  const near = [0];
  let [linearSum, nearSum] = [0, 0];
  const { stepCount, steps } = trace;
  const points = Math.min(maxPoints, stepCount);
  for (let step = 1, point = 1; step <= stepCount; step++) {
    const decoded = trace.stepAt(step);
    if (decoded?.kind === "advance") {
      linearSum += steps.frontSizes[step - 1] ?? 0;
      nearSum += decoded.nearbyFaces;
    }
    if (step < Math.round((point * stepCount) / points)) continue;
    point++;
    elements.push(steps.elementsMade[step] ?? 0);
    linear.push(linearSum);
    near.push(nearSum);
  }
  return { elements, linear, near };
}
