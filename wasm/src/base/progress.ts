/** Progress of a call. */
import type { Phase } from "../generated/constants.js";

/**
 * Phase of a call: one of the engine's, `bodies` while the surfaces of a project's bodies are prepared, or `remesh` while the
 * given surface is remeshed before a run.
 */
export type ProgressPhase = Phase | "bodies" | "remesh";

/** Progress of a run or another call. For other calls the phase is `check` or `bodies`, and the counts are 0. */
export interface CallProgress {
  readonly phase: ProgressPhase;
  /** Id of the body that is being prepared, in the phase `bodies`. */
  readonly body?: number | undefined;
  /** Estimated fraction of the whole call, 0 to 1; never decreases. */
  readonly fraction: number;
  readonly nodes: number;
  readonly triangles: number;
  readonly tetrahedra: number;
  readonly frontFaces: number;
  /** Number of tetrahedra that the sizes ask for, estimated before the front starts; 0 until then. */
  readonly expectedTetrahedra: number;
  /** Estimated progress of the exact fill, 0 to 1; 0 while it is not running. */
  readonly exactFillFraction: number;
  readonly elapsedSeconds: number;
  /** While a number of elements is sought: which mesh is being made, counted from 1. */
  readonly meshNumber?: number | undefined;
}
