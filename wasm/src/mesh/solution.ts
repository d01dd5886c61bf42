/** Fields on a mesh, and what is made of them. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { Mesh, NodeData } from "./mesh.js";

/** A scalar or vector field: all components of the first node or element, then those of the next. */
export interface FieldValues extends NodeData {
  /** Name in messages. Default: its number. */
  readonly name?: string | undefined;
  /** Whether the values belong to the elements, at their centroids, and not to the nodes. Default false. */
  readonly isPerElement?: boolean | undefined;
}

/** Result of `sizeFromSolution`. */
export interface SolutionSizes {
  /**
   * The given mesh as a background grid: its `nodeData` are `metric`, six numbers per node, and the same as sizes of the front:
   * `size`, `stretching` with `direction` and, if two sizes do not suffice, `secondStretching` with `secondDirection`.
   */
  readonly mesh: Mesh;
  /** Per node xx, xy, xz, yy, yz, zz: an edge e with eᵀ M e = 1 has the target length. */
  readonly metrics: Float64Array;
  /** About how many elements a mesh that follows the metric has. */
  readonly elements: number;
  /**
   * Per field: its interpolation error on regular elements that follow the metric, in the norm that was asked for; for an indicator, its
   * largest value on them.
   */
  readonly expectedErrors: readonly number[];
  /** Warnings: fields that do not vary, limits that exclude the number of elements. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Integral of one component of a field. */
export interface FieldIntegral {
  readonly before: number;
  readonly after: number;
}

/** Result of `transferSolution`. */
export interface TransferredFields {
  /** The fields on the other mesh. */
  readonly fields: readonly FieldValues[];
  /** Per field: the integral of each component over both meshes. */
  readonly integrals: readonly (readonly FieldIntegral[])[];
  /** Number of nodes, or centroids, that lie outside the given mesh; they have the value of the nearest point. */
  readonly outside: number;
  /** Largest distance of these from the given mesh. */
  readonly farthest: number;
}
