/** Cancelling calls by an AbortSignal: they reject with a `MesherError` of code `cancelled`. */
import { cancelledError } from "../diagnostics/mesher-error.js";

/** Throws if the signal is aborted. */
export function throwIfCancelled(signal: AbortSignal | undefined): void {
  if (signal?.aborted === true) throw cancelledError(signal);
}

/** Resolves as the promise does, unless the signal is aborted first. The promise is then ignored, not stopped. */
export async function untilCancelled<T>(
  ask: () => T | PromiseLike<T>,
  signal: AbortSignal | undefined,
): Promise<T> {
  throwIfCancelled(signal);
  if (signal === undefined) return ask();
  let onAbort = () => undefined as void;
  try {
    return await new Promise<T>((resolve, reject) => {
      onAbort = () => reject(cancelledError(signal));
      signal.addEventListener("abort", onAbort, { once: true });
      Promise.resolve(ask()).then(resolve, reject);
    });
  } finally {
    signal.removeEventListener("abort", onAbort);
  }
}
