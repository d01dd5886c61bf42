/** A mesher for one command, with a progress bar and signals that cancel. */
import type { Mesher } from "../api/mesher-interface.js";
import { createMesher } from "../api/mesher.js";
import type { RunControl } from "../engine/control.js";
import { ProgressBar } from "./progress-bar.js";

/** Returns the control of a call. `step`: word for the progress bar; by default, the phase of a run. */
export type ControlOf = (step?: string) => RunControl & { readonly signal: AbortSignal };

/**
 * Calls `use` with a mesher. SIGINT and SIGTERM cancel its calls. If stderr is a terminal, a progress bar shows how far
 * they are.
 */
export async function withRun<T>(
  isQuiet: boolean,
  use: (mesher: Mesher, controlOf: ControlOf) => Promise<T>,
): Promise<T> {
  const stop = new AbortController();
  // Listen once: a second signal takes the default action and ends the process immediately.
  const onSignal = () => stop.abort();
  process.once("SIGINT", onSignal).once("SIGTERM", onSignal);
  // Load before the progress bar appears: a failure must not leave a bar or a hidden cursor behind.
  const mesher = await createMesher().catch((failure: unknown) => {
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
    throw failure;
  });
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  const controlOf: ControlOf = (step) => ({
    signal: stop.signal,
    onProgress: (progress) => bar?.update(progress, step),
  });
  try {
    return await use(mesher, controlOf);
  } finally {
    bar?.stop();
    mesher.dispose();
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
  }
}
