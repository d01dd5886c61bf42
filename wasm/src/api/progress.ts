/** Reports the progress of a call to the caller's function, which may fail. */
import type { Progress, RunControl } from "./types.js";

/** A call in progress. */
export interface ProgressListener {
  /** Rejects the call: with whatever the caller's function has thrown, or with a `MesherError`. */
  readonly reject: (failure: unknown) => void;
  /** Undefined after it has failed. */
  onProgress: RunControl["onProgress"];
}

/** Calls the listener. If it throws or its promise rejects, reports the failure once and never calls the listener again. */
export function reportProgress(
  listener: ProgressListener,
  progress: Progress,
  onFailure: (failure: unknown) => void,
): void {
  const fail = (failure: unknown) => {
    if (listener.onProgress === undefined) return;
    listener.onProgress = undefined;
    onFailure(failure);
  };
  try {
    const returned: unknown = listener.onProgress?.(progress);
    if (returned instanceof Promise) returned.catch(fail);
  } catch (failure) {
    fail(failure);
  }
}
