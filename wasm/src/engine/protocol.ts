/** Messages between the page (or a Node program) and the worker. */
import type { FrontExperiment } from "../trace/experiment.js";
import type { CallProgress } from "../base/progress.js";
import type { EngineFailure } from "../diagnostics/mesher-error.js";
import type { SurfaceRegions } from "../mesh/mesh.js";
import type { EngineMesh } from "./engine-mesh.js";
import type { MetricShapes } from "../mesh/quality.js";
import type { FrontRecording, MeshReport, MeshStatus } from "../mesh/report.js";
import type { BodySurfaceArrays, GridArrays, ModelArrays } from "../generated/constants.js";
import type { CallName } from "./calls.js";
import type { CompiledModule } from "./instantiated.js";
import type { EngineDiagnostics, EngineOptions } from "./loader.js";
import type { RegionStatistics } from "./region-statistics.js";

/** Regions that are meshed. */
export type MeshedRegions = {
  readonly [Part in "triangleRegions" | "maxVolumes"]: NonNullable<SurfaceRegions[Part]>;
};

/**
 * A module of the compiled engine: "engine" fills models and surfaces and improves meshes, "trace" fills them and records
 * the steps of the front, "tools" answers the other questions.
 */
export const MODULE_NAMES = ["engine", "tools", "trace"] as const;
export type ModuleName = (typeof MODULE_NAMES)[number];

/**
 * A question. The worker answers it in slices, also during a run: any number of `progress` replies, then one
 * `answer` or `failure`. After a `cancel` there is neither; after a `stop`, an `answer` soon.
 */
export interface Question {
  readonly kind: "question";
  readonly id: number;
  readonly call: CallName;
  /** `ArgumentsOf` the call. */
  readonly given: readonly unknown[];
}

/** A request for the nodes or tetrahedra [first, last) of a mesh that stays in the engine. Answered by one `answer` or `unanswerable`. */
export interface BlockRequest {
  readonly kind: "read";
  readonly id: number;
  /** Id of the run that has made the mesh. */
  readonly run: number;
  readonly part: "points" | "tetrahedra";
  readonly first: number;
  readonly last: number;
}

/**
 * Each request for work has its own id. Replies repeat it; replies to abandoned requests are recognized by it and
 * ignored.
 */
export type Request =
  /**
   * Load a module from this code, or fetch and compile it. The first request loads the engine; after that, each
   * `wanted` is answered by one.
   */
  | { readonly kind: "load"; readonly name: ModuleName; readonly module: CompiledModule | undefined }
  /** Answered by any number of `progress`, `front` and `trace`, at most one `unoptimized`, then one `result` or `failure`. */
  | {
      readonly kind: "mesh-model";
      readonly id: number;
      /** True for `front` replies. */
      readonly showFront: boolean;
      /** True for an `unoptimized` reply. */
      readonly showUnoptimized: boolean;
      /** Present for `trace` replies: the rules of the front. */
      readonly recordTrace: FrontExperiment | undefined;
      /** Number of threads that optimize tiles; undefined for as many as the machine has, up to a limit. */
      readonly threads: number | undefined;
      /** Whether a finished mesh stays in the engine until its `release`; `read` requests hand it out. */
      readonly inBlocks: boolean;
      readonly model: ModelArrays;
      /** Surfaces to mesh together with the model; undefined without any. */
      readonly bodies: BodySurfaceArrays | undefined;
      readonly grid: GridArrays;
      readonly options: EngineOptions;
    }
  /** As `mesh-model`. */
  | {
      readonly kind: "fill-surface";
      readonly id: number;
      readonly showFront: boolean;
      readonly showUnoptimized: boolean;
      readonly recordTrace: FrontExperiment | undefined;
      readonly threads: number | undefined;
      readonly inBlocks: boolean;
      readonly points: Float64Array;
      readonly triangles: Uint32Array;
      /** Empty arrays if nothing is known. */
      readonly regions: MeshedRegions;
      /** Without nodes and tetrahedra, sizes come from the surface's own edges. */
      readonly grid: GridArrays;
      readonly options: EngineOptions;
    }
  | Question
  | BlockRequest
  /** Ends the life of a mesh that stays in the engine: that of the run with this id. */
  | { readonly kind: "release"; readonly id: number }
  /**
   * Cancels the run or question with this id. A run replies `stopping` and then `result`; a question does not
   * reply.
   */
  | { readonly kind: "cancel"; readonly id: number }
  /** Ends the work on the question with this id early; its answer is what has been made so far. */
  | { readonly kind: "stop"; readonly id: number };

/** A result whose diagnostics are not yet described in words; only the sender of the request can do that. */
export interface EngineResult extends EngineMesh {
  readonly status: MeshStatus;
  /** Of a mesh that stays in the engine; `volume` is then empty. Twice a region and its number of tetrahedra. */
  readonly regionRuns?: Uint32Array;
  /** Absent without stretching. */
  readonly metricShapes?: MetricShapes;
  readonly statistics: Omit<MeshReport, "diagnostics" | "status" | "regions">;
  /** Per region of the run. */
  readonly regionStatistics: readonly RegionStatistics[];
  /** Of a run that records its steps. */
  readonly recording?: FrontRecording;
  /** Whether thorough optimization found no mesh that is better in one measure and worse in none. */
  readonly hasFoundNothingBetter: boolean;
  readonly diagnostics: EngineDiagnostics;
}

/** The answer to a question. */
export interface Answer {
  readonly kind: "answer";
  readonly id: number;
  /** `AnswerOf` the call. */
  readonly answer: unknown;
}

export type Reply =
  /** The worker needs the code of this module, which is loaded on first use. */
  | { readonly kind: "wanted"; readonly name: ModuleName }
  /** Sent once per module, when it is loaded, with its code for other workers. Requests that need it wait. */
  | { readonly kind: "ready"; readonly name: ModuleName; readonly module: CompiledModule }
  | { readonly kind: "progress"; readonly id: number; readonly progress: CallProgress }
  /** The current front: x y z of three corners per face. */
  | { readonly kind: "front"; readonly id: number; readonly corners: Float64Array }
  | { readonly kind: "unoptimized"; readonly id: number; readonly mesh: EngineMesh }
  /** The events of the front since the last reply (docs/TRACE.md). */
  | { readonly kind: "trace"; readonly id: number; readonly events: Uint8Array }
  /** The run takes no further step; its result is being copied. */
  | { readonly kind: "stopping"; readonly id: number }
  | { readonly kind: "result"; readonly id: number; readonly result: EngineResult }
  | Answer
  /**
   * The call with this id failed. If it was not abandoned, the sender replaces the worker, because a heap that is
   * full never shrinks. If it was, the other calls continue, unless the engine is lost.
   */
  | ({
      readonly kind: "failure";
      readonly id: number;
      /** The engine trapped instead of reporting a failure: its heap may be corrupt. */
      readonly isEngineLost: boolean;
    } & EngineFailure)
  /** A module could not be loaded: its address and the reason. */
  | { readonly kind: "unusable"; readonly name: ModuleName; readonly message: string }
  /** The call with this id needs a module that could not be loaded, or a mesh that is gone. The next such call tries again. */
  | { readonly kind: "unanswerable"; readonly id: number; readonly message: string };
