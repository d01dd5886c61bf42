/** Calls the caller's functions while a call is in progress, and handles their failures. */
import type { RunControl } from "./control.js";
import type { EngineMesh } from "./engine-mesh.js";

/** Callbacks and signal of a run, before its mesh has names. */
export interface RunListeners extends Omit<RunControl, "onUnoptimized"> {
  readonly onUnoptimized?: ((mesh: EngineMesh) => void) | undefined;
}

/** A call in progress. */
export interface ProgressListener {
  /** Rejects the call, with the value thrown by the caller's function or with a `MesherError`. */
  readonly reject: (failure: unknown) => void;
  /** Undefined after one of the functions has failed. */
  onProgress: RunControl["onProgress"];
  /** Like `onProgress`, but for runs only. */
  onFront?: RunControl["onFront"];
  onUnoptimized?: RunListeners["onUnoptimized"];
  onTrace?: RunControl["onTrace"];
}

/**
 * Calls one of the listener's functions. If it throws or its promise rejects, reports the failure once and never calls
 * the listener again.
 */
export function notify<Value>(
  listener: ProgressListener,
  callback: ((value: Value) => void) | undefined,
  value: Value,
  onFailure: (failure: unknown) => void,
): void {
  const fail = (failure: unknown): void => {
    const { onProgress, onFront, onUnoptimized, onTrace } = listener;
    if ((onProgress ?? onFront ?? onUnoptimized ?? onTrace) === undefined) return;
    listener.onProgress = undefined;
    listener.onFront = undefined;
    listener.onUnoptimized = undefined;
    listener.onTrace = undefined;
    onFailure(failure);
  };
  try {
    const returned: unknown = callback?.(value);
    if (returned instanceof Promise) returned.catch(fail);
  } catch (failure) {
    fail(failure);
  }
}
