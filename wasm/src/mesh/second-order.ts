/** Second-order elements: their curved edges, and what they are like. */
import type { Mesh } from "./mesh.js";

/** A curved edge that was straightened. */
export interface StraightenedEdge {
  readonly nodes: readonly [number, number];
  /** Its middle now, halfway between the nodes. */
  readonly position: readonly [x: number, y: number, z: number];
}

/**
 * Shapes of second-order elements. The scaled Jacobian of an element is the least value of det J in it divided by the largest,
 * where J belongs to the map from the reference tetrahedron: 1 if all edges are straight. The values are proven lower bounds,
 * about 0.001 too low at most.
 */
export interface SecondOrderQuality {
  readonly minScaledJacobian: number;
  /** Over all elements. */
  readonly meanScaledJacobian: number;
  /** Number of elements per class of 0.05, from 0 to 1. */
  readonly histogram: readonly number[];
  /** Up to ten curved elements with the least values, the least one first. */
  readonly worst: readonly { readonly tetrahedron: number; readonly scaledJacobian: number }[];
  /** Number of nodes inside that were moved, because an element would have been invalid. */
  readonly movedNodes: number;
  /** Edges that were straightened, because an element would have been invalid. */
  readonly straightened: readonly StraightenedEdge[];
}

/** A mesh for second-order elements. */
export interface CurvedMesh {
  /** With `curvedEdges`, which `writeMesh` uses for elements of order 2. */
  readonly mesh: Mesh;
  readonly secondOrder: SecondOrderQuality;
  /** Elements with a scaled Jacobian other than 1, ascending. */
  readonly curvedTetrahedra: Uint32Array;
  /** One per curved element. */
  readonly scaledJacobians: Float64Array;
}
