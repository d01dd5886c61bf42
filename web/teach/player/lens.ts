import type { AdvanceStep, Trace, TracedCandidate } from "tetrafront/trace";
import type { SideAndFace } from "./crossing";
import {
  crossedFaces,
  frontChange,
  frontFace,
  isBehind,
  newElement,
  touching,
  type FrontChange,
} from "./judge";
import { testByLayers, type LayeredTest } from "./layered-test";

/** A candidate under the lens: the engine's verdict, and the numbers of our own check. */
export interface LensCandidate {
  readonly candidate: TracedCandidate;
  /** Whether our own check finds the candidate behind the base face. */
  readonly isBehind: boolean;
  /** Faces of the front that the element would cross, by our own check. */
  readonly crossed: readonly number[];
  /** The side and the face that decide a crossing; null if nothing crosses. */
  readonly pair: SideAndFace | null;
  /** The paper's test of the face that the element would cross; null if there is none. */
  readonly test: { readonly face: number; readonly layers: LayeredTest } | null;
  /** How the front changes with the element, or would change if it were made. */
  readonly change: FrontChange;
}

/** Returns the candidate that decides a step: the accepted one, or the last one. */
export function decisive({ candidates }: AdvanceStep): number | null {
  return candidates.length === 0 ? null : candidates.length - 1;
}

/** Checks a candidate of a step against the front before the step. O(faces of the front). */
export function examine(trace: Trace, step: AdvanceStep, candidate: TracedCandidate): LensCandidate {
  const before = step.step - 1;
  const element = newElement(trace, step.face, candidate.position, candidate.isNew ? null : candidate.node);
  const behind = isBehind(element);
  const crossed = behind ? [] : crossedFaces(trace, before, element, touching);
  const culprit = candidate.verdict === "crosses" ? candidate.culprit : (crossed[0] ?? null);
  const test =
    behind || culprit === null
      ? null
      : { face: culprit, layers: testByLayers(element, frontFace(trace, culprit)) };
  const pair = test?.layers.finds === true ? test.layers.pair : null;
  const change = frontChange(trace, before, step.face, element);
  return { candidate, isBehind: behind, crossed, pair, test, change };
}
