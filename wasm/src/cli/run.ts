/** A mesher for one command, with a progress bar and signals that cancel. */
import type { Mesher } from "../api/mesher-interface.js";
import { createMesher } from "../api/mesher.js";
import type { RunControl } from "../engine/control.js";
import { ProgressBar } from "./progress-bar.js";
import { Interruption } from "./signals.js";
import { enterPhase, setBarShown } from "./stages.js";

/** Returns the control of a call. `step`: word for the progress bar; by default, the phase of a run. */
export type ControlOf = (step?: string) => RunControl & { readonly signal: AbortSignal };

/**
 * Calls `use` with a mesher. SIGINT, SIGTERM and SIGHUP cancel its calls that have a control of `controlOf`. If stderr is a
 * terminal, a progress bar shows how far they are.
 */
export async function withRun<T>(
  isQuiet: boolean,
  use: (mesher: Mesher, controlOf: ControlOf) => Promise<T>,
): Promise<T> {
  const interruption = new Interruption();
  // Load before the progress bar appears: a failure must not leave a bar or a hidden cursor behind.
  const mesher = await createMesher();
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  setBarShown(bar !== undefined);
  const controlOf: ControlOf = (step) => ({
    signal: interruption.signal,
    onProgress: (progress) => {
      interruption.hear();
      enterPhase(progress, step);
      bar?.update(progress, step);
    },
  });
  try {
    return await use(interruptible(mesher, interruption), controlOf);
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
