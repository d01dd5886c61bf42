/** What the page (or a Node program) and the worker say to each other. Types only. */
import type { Progress } from "../base/progress.js";
import type { EngineFailure } from "../diagnostics/mesher-error.js";
import type { SurfaceMesh, VolumeMesh } from "../mesh/mesh.js";
import type { MeshReport, MeshStatus } from "../mesh/report.js";
import type { ModelArrays } from "../project/arrays.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import type { GridArrays } from "../project/grid-arrays.js";
import type { ProjectPreview } from "../project/preview.js";
import type {
  CompiledEngine,
  DiagnosticArrays,
  EngineInspection,
  EngineRefinement,
  EngineRepair,
  EngineVolumeInspection,
} from "./loader.js";

/** Options as the engine takes them; 0 for a size that is not given. */
export interface EngineOptions {
  readonly size: number;
  readonly growth: number;
  readonly gradation: number;
  /** 0 cavities, 1 regions. */
  readonly innerShells: number;
  /** 0 layered, 1 smallest first. */
  readonly order: number;
  readonly filters: boolean;
  /** 0 none to 3 thorough. */
  readonly optimization: number;
  /** For tests: skips the front. */
  readonly exactFillOnly: boolean;
}

/** The engine's InspectionOptions. */
export interface EngineInspectionOptions {
  /** As among EngineOptions. */
  readonly innerShells: number;
  /** Of each code so many are listed. */
  readonly maxDiagnostics: number;
}

/** The engine's ProposalOptions; 0 for sizes that are not given. */
export interface EngineProposalOptions {
  readonly uniform: number;
  readonly smallest: number;
  readonly elementsPerCircle: number;
  readonly elementsPerGap: number;
  readonly growth: number;
}

/** The engine's RepairOptions; below 0 for no welding. */
export interface EngineRepairOptions {
  readonly weldDistance: number;
  readonly removeTriangles: boolean;
  readonly maxHoleEdges: number;
  readonly orient: boolean;
  readonly innerShells: number;
}

/**
 * Asked for at once and worked on in slices, also while a run is under way: any number of `progress`, then one `answer`
 * or `failure`; a `cancel` ends it without one.
 */
export type Question =
  /** `options`: those to mesh with. */
  | {
      readonly kind: "preview";
      readonly id: number;
      readonly model: ModelArrays;
      readonly options: EngineOptions;
    }
  /** `shape`: 0 box, 1 single tetrahedron. */
  | {
      readonly kind: "cover";
      readonly id: number;
      readonly model: ModelArrays;
      readonly size: number;
      readonly shape: number;
    }
  | {
      readonly kind: "propose";
      readonly id: number;
      readonly model: ModelArrays;
      readonly options: EngineProposalOptions;
    }
  /** No sizes: from the mesh's own edges. */
  | {
      readonly kind: "background-from-mesh";
      readonly id: number;
      readonly points: Float64Array;
      readonly tetrahedra: Uint32Array;
      readonly sizes: Float64Array;
    }
  | ({
      readonly kind: "inspect-surface";
      readonly id: number;
      readonly points: Float64Array;
      readonly triangles: Uint32Array;
    } & EngineInspectionOptions)
  | {
      readonly kind: "repair-surface";
      readonly id: number;
      readonly points: Float64Array;
      readonly triangles: Uint32Array;
      readonly options: EngineRepairOptions;
    }
  /** Grid and options as for `fill-surface`; `volume` is 0 where it is not known. */
  | {
      readonly kind: "refine-surface";
      readonly id: number;
      readonly points: Float64Array;
      readonly triangles: Uint32Array;
      readonly grid: GridArrays;
      readonly options: EngineOptions;
      readonly volume: number;
    }
  /** No regions: all elements in one. */
  | {
      readonly kind: "inspect-mesh";
      readonly id: number;
      readonly points: Float64Array;
      readonly tetrahedra: Uint32Array;
      readonly regions: Uint32Array;
    };

/** Every request about work carries an id of its own; replies repeat it, late ones are dropped by it. */
export type Request =
  /** The first of all, and sent once: load the engine, of this code or of what the worker fetches and compiles. */
  | { readonly kind: "load"; readonly module: CompiledEngine | undefined }
  /** Answered by any number of `progress` and `front`, then one `result` or `failure`. */
  | {
      readonly kind: "mesh-model";
      readonly id: number;
      /** True for `front` replies. */
      readonly showFront: boolean;
      readonly model: ModelArrays;
      readonly options: EngineOptions;
    }
  /** As `mesh-model`. */
  | {
      readonly kind: "fill-surface";
      readonly id: number;
      readonly showFront: boolean;
      readonly points: Float64Array;
      readonly triangles: Uint32Array;
      /** Without nodes and tetrahedra the sizes come from the surface's own edges. */
      readonly grid: GridArrays;
      readonly options: EngineOptions;
    }
  | Question
  /** About the run or the question of that id: a run answers by `stopping` and then its `result`, all else by nothing. */
  | { readonly kind: "cancel"; readonly id: number };

/** A result before its diagnostics are put into words, which only the sender of the request can do. */
export interface EngineResult {
  readonly status: MeshStatus;
  readonly surface: SurfaceMesh;
  readonly volume: VolumeMesh;
  readonly figures: Omit<MeshReport, "diagnostics" | "status">;
  /** Whether thorough optimization found no better mesh. */
  readonly hasFoundNothingBetter: boolean;
  readonly diagnostics: DiagnosticArrays;
}

export type EnginePreview = Omit<ProjectPreview, "diagnostics"> & {
  readonly diagnostics: DiagnosticArrays;
};

/** Sources as in GridArrays. */
export interface EngineProposal {
  readonly size: number;
  readonly sourceTypes: Uint8Array;
  readonly sourceValues: Float64Array;
}

/** What each question is answered with. */
export interface Answers {
  readonly preview: EnginePreview;
  readonly cover: BackgroundArrays;
  readonly propose: EngineProposal;
  readonly "background-from-mesh": BackgroundArrays;
  readonly "inspect-surface": EngineInspection;
  readonly "repair-surface": EngineRepair;
  readonly "refine-surface": EngineRefinement;
  readonly "inspect-mesh": EngineVolumeInspection;
}

/** The answer to a question, which names its kind. */
export type AnswerTo<Kind extends keyof Answers> = {
  readonly kind: "answer";
  readonly id: number;
  readonly question: Kind;
  readonly answer: Answers[Kind];
};
export type Answer = { [Kind in keyof Answers]: AnswerTo<Kind> }[keyof Answers];

export type Reply =
  /** Once, when the engine is loaded, with its code for other workers. Requests sent earlier wait for it. */
  | { readonly kind: "ready"; readonly module: CompiledEngine }
  | { readonly kind: "progress"; readonly id: number; readonly progress: Progress }
  /** The front as it stands: x y z of three corners per face. */
  | { readonly kind: "front"; readonly id: number; readonly corners: Float64Array }
  /** The run takes no further step; its result is being copied. */
  | { readonly kind: "stopping"; readonly id: number }
  | { readonly kind: "result"; readonly id: number; readonly result: EngineResult }
  | Answer
  /**
   * The call of that id failed. If somebody still waits for it, the sender replaces the worker, because a full heap never
   * shrinks. If nobody does, the other calls go on, unless the engine is lost.
   */
  | ({
      readonly kind: "failure";
      readonly id: number;
      /** The engine trapped instead of reporting its failure: its heap cannot be trusted any more. */
      readonly isEngineLost: boolean;
    } & EngineFailure)
  /** The engine could not be loaded at all: where it was looked for, and why it is not there. */
  | { readonly kind: "unusable"; readonly message: string };
