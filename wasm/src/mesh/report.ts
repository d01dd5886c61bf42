/** Result of a run: the mesh, its statistics, and the diagnostics. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { SurfaceMesh, VolumeMesh } from "./mesh.js";
import type { PatchQuality, QualityReport } from "./quality.js";

/** How a run ended. Only `done` is a complete mesh; `stalled` and `cancelled` may hold a part. */
export type MeshStatus = "done" | "stalled" | "cancelled" | "invalid-input";

/** Wall-clock seconds. `check` includes the verification of the result; `total` includes copying it,
 * and is all that is known of a run that had to be ended by force: the phases are 0 then. */
export interface Seconds {
  readonly total: number;
  readonly check: number;
  readonly sides: number;
  readonly surface: number;
  readonly volume: number;
  readonly optimize: number;
}

/** The figures of a run, and all it has to say. */
export interface MeshReport {
  readonly status: MeshStatus;
  readonly nodes: number;
  readonly tetrahedra: number;
  readonly triangles: number;
  readonly seconds: Seconds;
  /** Degrees, over all tetrahedra as they lie in space, stretched or not; 0 without any. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron, in space too; 0 without any. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** Sum over the tetrahedra, in cubed model units. */
  readonly volume: number;
  /** Empty unless the mesh is finished. */
  readonly quality: QualityReport;
  /** By position of the patch; of a given surface none. */
  readonly patches: readonly PatchQuality[];
  /** How the front was brought to an end. */
  readonly recovery: {
    /** Elements accepted by a relaxed rule. */
    readonly relaxed: number;
    /** Pockets filled from one interior point. */
    readonly starred: number;
    /** Pockets filled after elements around them were removed. */
    readonly remeshed: number;
    /** Pockets given to the exact fill, which comes last. */
    readonly filled: number;
    /** Interior points that the exact fill has made. */
    readonly steinerPoints: number;
  };
  /** How hard the front worked. */
  readonly front: {
    readonly pops: number;
    readonly gatheredFaces: number;
    readonly candidatesTried: number;
    readonly facesTested: number;
    readonly facesAnalysed: number;
    readonly exactPredicates: number;
  };
  /**
   * 16 hexadecimal digits: a hash over coordinates and indices, equal on every platform for the same
   * input and options. Empty where the run was cancelled or never began.
   */
  readonly fingerprint: string;
  readonly diagnostics: readonly Diagnostic[];
}

/** A mesh with its boundary and its report; after a run that ended early, what exists. */
export interface MeshResult {
  readonly surface: SurfaceMesh;
  readonly volume: VolumeMesh;
  readonly report: MeshReport;
}
