import type { RecoveryStep, Trace } from "tetrafront/trace";
import type { RecoveryCounts } from "../strings/recovery";
import { frontSizeAt } from "./phases";

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
