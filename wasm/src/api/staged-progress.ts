/** Progress of a call that consists of several others. */
import type { CallProgress } from "../base/progress.js";
import type { RunControl } from "../engine/control.js";

/** Fractions of the whole call at which each stage begins and ends: estimates. */
const STAGES = { check: [0, 0.1], remesh: [0.1, 0.5], run: [0.5, 1] } as const;
export type Stage = keyof typeof STAGES;

/** Returns the control of each stage: its progress is a part of the whole, which never decreases. */
export function stagedControl(control: RunControl): (stage: Stage) => RunControl {
  const { onProgress } = control;
  const began = performance.now();
  let reached = 0;
  return (stage) => {
    if (onProgress === undefined) return control;
    const [from, to] = STAGES[stage];
    const shared = (progress: CallProgress): void => {
      reached = Math.max(reached, from + (to - from) * progress.fraction);
      const elapsedSeconds = (performance.now() - began) / 1000;
      const phase = stage === "remesh" ? stage : progress.phase;
      return onProgress({ ...progress, phase, fraction: reached, elapsedSeconds });
    };
    return { ...control, onProgress: shared };
  };
}
