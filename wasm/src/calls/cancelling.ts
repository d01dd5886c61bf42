/** Hearing an AbortSignal: whatever is given one rejects with a `MesherError` of the code `cancelled`. */
import { cancelledError } from "../diagnostics/mesher-error.js";

/** Throws where the signal is aborted. */
export function throwIfCancelled(signal: AbortSignal | undefined): void {
  if (signal?.aborted === true) throw cancelledError(signal);
}

/** What a promise gives, unless the signal is aborted before; then the promise is left to itself. */
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
