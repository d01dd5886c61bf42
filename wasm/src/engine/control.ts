/** How a caller follows and cancels a call. */
import type { CallProgress } from "../base/progress.js";
import type { FrontExperiment } from "../trace/experiment.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { Mesh } from "../mesh/mesh.js";

/** Callbacks and signal of a call. */
export interface RunControl {
  /**
   * Called at most ten times a second, and once at the end. If it throws, or its promise rejects, the call rejects with
   * the same reason.
   */
  readonly onProgress?: ((progress: CallProgress) => void) | undefined;
  /**
   * Called by `meshProject` and `fillSurface` at most four times a second while the front advances, with x y z of the
   * three corners of each of its faces. The caller owns the array. Costs at most 2 % of the run's time. A failure of
   * this function has the same effect as one of `onProgress`.
   */
  readonly onFront?: ((corners: Float64Array) => void) | undefined;
  /**
   * Called by `meshProject` and `fillSurface` with the events of the front (docs/TRACE.md) as they are recorded; joined,
   * they are the events of a trace. A module of the engine that records is loaded first. The mesh is the same, bit for
   * bit. A failure of this function has the same effect as one of `onProgress`. `recordTrace` makes a file of them.
   */
  readonly onTrace?: ((events: Uint8Array) => void) | undefined;
  /** Changes to the rules of the front, for a run with `onTrace`; `recordTrace` checks and sets them. */
  readonly experiment?: FrontExperiment | undefined;
  /**
   * Called by `meshProject` and `fillSurface` at most once, with the mesh before or during optimization:
   * about 0.25 s after the front has closed, unless the run has ended by then. The caller owns the arrays.
   * Costs a copy of the mesh. A failure of this function has the same effect as one of `onProgress`.
   */
  readonly onUnoptimized?: ((mesh: Mesh) => void) | undefined;
  /**
   * Called by `meshProject` with each body that it has prepared, before the front begins. The caller must not change its
   * arrays. If it returns a promise, the run goes on when that is settled. A failure of this function has the same effect as
   * one of `onProgress`.
   */
  readonly onBody?: ((prepared: PreparedBody) => void) | undefined;
  /**
   * If true, the elements of a finished mesh of `meshProject` or `fillSurface` stay in the engine: the result hands them out in `blocks`, so
   * that a mesh may be larger than the memory for its arrays. Call `blocks.release()` when you have read them. A mesh that is not
   * finished has arrays, and so has one of second-order elements, or with a number of `elements`. Default false.
   */
  readonly inBlocks?: boolean | undefined;
  /**
   * Aborting it ends `meshProject` and `fillSurface` with status `cancelled`, usually within 100 ms; the result holds the
   * mesh made so far. If the engine does not answer within 0.5 s, its worker is terminated and the mesh is empty. Other
   * calls reject with a `MesherError` of code `cancelled`.
   */
  readonly signal?: AbortSignal | undefined;
}

/** Control of a call whose result is valid at any moment. */
export interface PartialControl extends RunControl {
  /**
   * If true, aborting the signal ends the work early, and the call resolves with what it has made so far; `isPartial` of the
   * result is then true. Default false: the call rejects.
   */
  readonly partial?: boolean | undefined;
}

/** Signal of `createMesher`. */
export interface AbortControl {
  /** Aborting it rejects the call with a `MesherError` of code `cancelled`. */
  readonly signal?: AbortSignal | undefined;
}
