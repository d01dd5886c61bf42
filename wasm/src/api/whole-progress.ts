/** Progress of work that consists of several calls, one after the other. */
import type { CallProgress } from "../base/progress.js";
import type { RunControl } from "../engine/control.js";

/** Step of the work; `attempt` is a mesh after which another one may be tried. */
export type Step =
  | "check"
  | "bodies"
  | "remesh"
  | "attempt"
  | "run"
  | "curve"
  | "improve"
  | "solution"
  | "adapt";

/** Work of a step / work that is left when it begins: estimates. What follows a run is short, and often nothing. */
const SHARES: Readonly<Record<Step, number>> = {
  check: 0.03,
  bodies: 0.65,
  remesh: 0.65,
  attempt: 0.7,
  run: 0.98,
  curve: 0.9,
  improve: 1,
  solution: 1,
  adapt: 1,
};

/**
 * One fraction over all calls. Each call takes a share of the work that is left, so that the fraction never decreases or jumps,
 * whatever the number of calls. A call that consists of calls has a progress of its own within its share.
 */
export class WholeProgress {
  readonly #control: RunControl;
  readonly #began = performance.now();
  #last: CallProgress | undefined;

  constructor(control: RunControl) {
    this.#control = control;
  }

  get seconds(): number {
    return (performance.now() - this.#began) / 1000;
  }

  /** Returns the control of the next call. */
  next(share: number, change: Partial<CallProgress> = {}): RunControl {
    if (this.#control.onProgress === undefined) return this.#control;
    let from: number | undefined;
    const onProgress = (progress: CallProgress): void => {
      const reached = this.#last?.fraction ?? 0;
      from ??= reached;
      const fraction = Math.max(reached, from + (1 - from) * share * progress.fraction);
      return this.#report({ ...progress, ...change, fraction });
    };
    return { ...this.#control, onProgress };
  }

  /** Returns the control of the next call of a step, which takes a share of the work that is left. */
  readonly controlOf = (step: Step = "run", share = SHARES[step]): RunControl =>
    this.next(share, step === "remesh" ? { phase: step } : {});

  /** Reports that nothing is left. */
  end(): void {
    if (this.#last !== undefined) this.#report({ ...this.#last, fraction: 1 });
  }

  #report(progress: CallProgress): void {
    this.#last = { ...progress, elapsedSeconds: this.seconds };
    return this.#control.onProgress?.(this.#last);
  }
}
