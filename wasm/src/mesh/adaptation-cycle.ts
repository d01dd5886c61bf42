/** Cycles of an adaptation with a solver: what the solver gets and returns, and what each cycle makes. */
import type { MeshAdaptation } from "./adaptation.js";
import type { LayeredMesh } from "./layered-mesh.js";
import type { Mesh, VolumeInput } from "./mesh.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "./solution.js";

/** What a solver needs besides the mesh. */
export interface SolveContext {
  /** Number of the cycle, from 1. */
  readonly cycle: number;
  /** Fields of the previous cycle at the nodes or elements of the mesh; none in the first cycle. */
  readonly start: readonly FieldValues[];
  /** Aborted if the adaptation is cancelled. Its result is then not awaited. */
  readonly signal: AbortSignal | undefined;
}

/** Fields on a mesh of the solver's own. */
export interface Solution {
  readonly fields: readonly FieldValues[];
  /** The mesh of the fields. Default: the one that the solver was given. */
  readonly mesh?: VolumeInput | undefined;
}

/** Fields and the mesh that they belong to. */
export interface SolvedFields extends Solution {
  readonly mesh: VolumeInput;
}

/**
 * Computes fields on a mesh, whose `nodeData` are the fields of the previous cycle at its nodes. Returns them in the order of the
 * mesh's nodes or elements, or with a mesh of their own.
 */
export type Solve = (
  mesh: Mesh,
  context: SolveContext,
) => readonly FieldValues[] | Solution | PromiseLike<readonly FieldValues[] | Solution>;

/** A mesh with its solution, and the next mesh, which follows it. */
export interface AdaptationCycle {
  /** Number of the cycle, from 1. */
  readonly cycle: number;
  /** The mesh that the solver was given. */
  readonly mesh: Mesh;
  readonly solution: SolvedFields;
  /**
   * Per field that decides the sizes: its interpolation error on the elements of the solution's mesh, estimated from its second
   * derivatives, in the norm of the options; of an indicator, its largest value. The indicator is the last one.
   */
  readonly estimatedErrors: readonly number[];
  /** The metric of the next mesh, and the errors to expect on it. */
  readonly sizes: SolutionSizes;
  /** Lengths and qualities in the metric, before and after, and the next mesh; its `nodeData` are the fields at its nodes. With `layers`, also what was made of them. */
  readonly next: MeshAdaptation | LayeredMesh;
  /** The fields on the next mesh. */
  readonly transferred: TransferredFields;
}
