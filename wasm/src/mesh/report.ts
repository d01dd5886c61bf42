/** Result of a run: the mesh, its statistics, and the diagnostics. */
import type { ElementBlocks } from "./element-blocks.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { EngineStatus } from "../generated/constants.js";
import type { Mesh } from "./mesh.js";
import type { MetricShapes, PatchQuality, QualityReport } from "./quality.js";
import type { SecondOrderQuality } from "./second-order.js";

/** How a run ended. Only `done` has a complete mesh; `stalled` and `cancelled` may have a partial one. */
export type MeshStatus = Exclude<EngineStatus, "running">;

/**
 * Wall-clock times in seconds. `check` includes the verification of the result; `total` includes copying it. If the
 * worker had to be terminated, only `total` is known; the others are 0. `surface` includes the preparation of bodies.
 */
export interface Seconds {
  readonly total: number;
  readonly check: number;
  readonly sides: number;
  readonly surface: number;
  readonly volume: number;
  readonly optimize: number;
}

/** The number of elements that was asked for by `elements`, and how it was reached. */
export interface ElementCount {
  readonly asked: number;
  readonly reached: number;
  /** Factor by which all sizes were multiplied. */
  readonly sizeFactor: number;
  /** Number of meshes that were made. */
  readonly runs: number;
}

/** What a region of a mesh consists of. */
export interface RegionSummary {
  readonly name: string;
  readonly tetrahedra: number;
  /** In cubed model units. */
  readonly volume: number;
}

/** Statistics and diagnostics of a run. */
export interface MeshReport {
  readonly status: MeshStatus;
  readonly nodes: number;
  readonly tetrahedra: number;
  readonly triangles: number;
  readonly seconds: Seconds;
  /** Degrees, over all tetrahedra, measured in space; 0 if there are none. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron, measured in space; 0 if there are none. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** Sum over the tetrahedra, in cubed model units. */
  readonly volume: number;
  /** The regions of the mesh, in their order. */
  readonly regions: readonly RegionSummary[];
  /** Empty unless the mesh is finished. */
  readonly quality: QualityReport;
  /** In the order of the patches, first those drawn, then those of the bodies; empty for a given surface. */
  readonly patches: readonly PatchQuality[];
  /** How the pockets were closed that the front left. */
  readonly recovery: {
    /** Number of elements accepted by a relaxed rule. */
    readonly relaxed: number;
    /** Number of pockets joined to one interior point. */
    readonly starred: number;
    /** Number of pockets filled after elements around them were removed. */
    readonly remeshed: number;
    /** Number of pockets filled by the exact fill, which comes last. */
    readonly filled: number;
    /** Number of interior points made by the exact fill. */
    readonly steinerPoints: number;
  };
  /** What fills the deep inside of regions. */
  readonly interior: {
    /** Number of elements from lattices; the optimizer may have changed those at their hulls. */
    readonly lattice: number;
  };
  /** Number of threads that could optimize tiles of the mesh at once; a mesh of fewer than 60 000 elements has none. */
  readonly threads: number;
  /** Counters of the work of the front. */
  readonly front: {
    readonly pops: number;
    readonly gatheredFaces: number;
    readonly candidatesTried: number;
    readonly facesTested: number;
    readonly facesAnalysed: number;
    readonly exactPredicates: number;
  };
  /**
   * Hash of coordinates and indices, 16 hexadecimal digits: equal on every platform for the same input and options.
   * Empty if the run was cancelled or never began.
   */
  readonly fingerprint: string;
  /** Present if a number of elements was asked for. `seconds.total` is then the time of all runs. */
  readonly elements?: ElementCount | undefined;
  /** Present if second-order elements were asked for and the mesh is finished. */
  readonly secondOrder?: SecondOrderQuality | undefined;
  readonly diagnostics: readonly Diagnostic[];
}

/** What is known of the steps of a recorded run. */
export interface FrontRecording {
  /** Number of steps: base faces, and changes by recovery. */
  readonly steps: number;
  /**
   * Hash of the mesh when the front and its recovery have ended, before the optimization; 16 hexadecimal digits, all 0
   * if they have not.
   */
  readonly fingerprint: string;
}

/** Result of a run. */
export interface MeshResult {
  /**
   * The mesh with its boundary, ready for `writeMesh`; after a run that ended early, what was made so far. The nodes of the
   * boundary come first. Its patches are those of the project and its bodies (named, else "patch 12" by id), those of the given
   * surface, or its shells. Its regions are those of the surface, else those of its solids, else numbered.
   */
  readonly mesh: Mesh;
  /** Number of nodes of the boundary. */
  readonly surfaceNodes: number;
  /** Faces of the front that remain if the mesh is partial: three nodes per face. */
  readonly front: Uint32Array;
  /** Two nodes per side of a divided line; empty for a given surface. */
  readonly sides: Uint32Array;
  /** Per side: index of its line in the project. */
  readonly sideLine: Uint32Array;
  /** Shapes of the elements of a finished mesh in the metric of its size field; absent if the field is not stretched. */
  readonly metricShapes?: MetricShapes | undefined;
  /**
   * Nodes and tetrahedra of a finished mesh, after a run with `inBlocks`. `mesh` then has the nodes and triangles of the boundary, and no
   * tetrahedra.
   */
  readonly blocks?: ElementBlocks | undefined;
  /** Present after a run with `onTrace`, unless its worker had to be terminated. */
  readonly recording?: FrontRecording | undefined;
  readonly report: MeshReport;
}
