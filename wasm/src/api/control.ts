/** How a caller follows and cancels a call. */
import type { Progress } from "../base/progress.js";

/** How a run is followed and stopped. */
export interface RunControl {
  /**
   * Called at most ten times a second, and once at the end. What it throws, or its promise is rejected with, ends
   * the call, which is rejected with just that.
   */
  readonly onProgress?: ((progress: Progress) => void) | undefined;
  /**
   * Called by `meshProject` and `fillSurface` at most four times a second while the front advances, with x y z of the
   * three corners of each of its faces. The caller owns the array. Costs at most 2 % of the run's time. A failure of
   * this function has the same effect as one of `onProgress`.
   */
  readonly onFront?: ((corners: Float64Array) => void) | undefined;
  /**
   * Aborting ends `meshProject` and `fillSurface` with status `cancelled`, as a rule within 100 ms, and what exists is
   * returned. Where the engine does not answer within half a second it is ended by force, and the mesh is empty. All other calls have no result of that kind, and
   * are rejected with a `MesherError` of code `cancelled`.
   */
  readonly signal?: AbortSignal | undefined;
}

/** How `createMesher` is stopped. */
export interface AbortControl {
  /** Aborting rejects the call with a `MesherError` of code `cancelled`. */
  readonly signal?: AbortSignal | undefined;
}
