/** A mesher for one command, with a progress bar and signals that cancel. */
import type { Mesher } from "../api/mesher-interface.js";
import type { CallProgress } from "../base/progress.js";
import { createMesher } from "../api/mesher.js";
import type { RunControl } from "../engine/control.js";
import { ProgressBar } from "./progress-bar.js";
import { Interruption } from "./signals.js";
import { type Step, WholeProgress } from "../api/whole-progress.js";
import { enterPhase, setBarShown } from "./stages.js";

/** Returns the control of the next call of a step, by default of a run; `share` as in `WholeProgress`. */
export type ControlOf = (step?: Step, share?: number) => RunControl & { readonly signal: AbortSignal };

/** Waits for work that ends if the signal is aborted. */
export type During = <T>(work: () => Promise<T>) => Promise<T>;

/**
 * Calls `use` with a mesher. SIGINT, SIGTERM and SIGHUP cancel its calls that have a control of `controlOf`. If stderr is a
 * terminal, a progress bar shows how far they are. Other work is cancelled in the same way within `during`.
 */
export async function withRun<T>(
  isQuiet: boolean,
  use: (mesher: Mesher, controlOf: ControlOf, during: During) => Promise<T>,
): Promise<T> {
  const interruption = new Interruption();
  // Load before the progress bar appears: a failure must not leave a bar or a hidden cursor behind.
  const mesher = await createMesher();
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  setBarShown(bar !== undefined);
  const { signal } = interruption;
  let current: Step | undefined;
  const whole = new WholeProgress({
    onProgress: (progress) => {
      interruption.hear();
      const timeLeft = enterPhase(progress, current);
      bar?.update(progress, timeLeft);
    },
  });
  const controlOf: ControlOf = (step, share) => {
    const { onProgress } = whole.controlOf(step, share);
    const ofStep = (progress: CallProgress): void => {
      current = step;
      onProgress?.(progress);
    };
    return { signal, onProgress: ofStep };
  };
  try {
    const during: During = (work) => interruption.during(work);
    return await use(interruptible(mesher, interruption), controlOf, during);
  } finally {
    bar?.stop();
    setBarShown(false);
    mesher.dispose();
  }
}

/** Returns a mesher whose calls with the signal of the interruption are under its care. */
function interruptible(mesher: Mesher, interruption: Interruption): Mesher {
  const isCancellable = (args: readonly unknown[]) => {
    const control = args.at(-1) as Partial<RunControl> | undefined;
    return typeof control === "object" && control.signal === interruption.signal;
  };
  return new Proxy(mesher, {
    get(target, name): unknown {
      const member: unknown = Reflect.get(target, name, target);
      if (typeof member !== "function") return member;
      return (...args: unknown[]): unknown => {
        const call = () => Reflect.apply(member, target, args) as unknown;
        return isCancellable(args) ? interruption.during(() => Promise.resolve(call())) : call();
      };
    },
  });
}
