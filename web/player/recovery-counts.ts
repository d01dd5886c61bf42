import type { RecoveryStep, Trace } from "tetrafront";
import { frontSizeAt } from "./phases";

/** What a step of recovery does to the front and the mesh, in numbers. */
export interface RecoveryCounts {
  readonly removedFaces: number;
  readonly addedFaces: number;
  readonly removedElements: number;
  readonly addedElements: number;
  /** New nodes, ascending. */
  readonly nodes: readonly number[];
  /** Faces of the front before the step and after it. */
  readonly before: number;
  readonly after: number;
}

/** Counts what a step of recovery changes. O(changes). */
export function recoveryCounts(trace: Trace, step: RecoveryStep): RecoveryCounts {
  const [removedFaces, addedFaces] = [step.removedFaces.length, step.addedFaces.length];
  const before = frontSizeAt(trace, step.step - 1);
  return {
    removedFaces,
    addedFaces,
    removedElements: step.removedElements.length,
    addedElements: step.addedElements.length,
    nodes: step.addedNodes,
    before,
    // Without the first faces of a front that begins in the same state.
    after: before - removedFaces + addedFaces,
  };
}
