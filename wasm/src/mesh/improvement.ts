/** Result of the improvement of a given mesh. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { Mesh } from "./mesh.js";

/** Number and shapes of the elements of a mesh. */
export interface MeshShapes {
  /** Number of nodes used by an element. */
  readonly nodes: number;
  readonly tetrahedra: number;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** In cubed model units. */
  readonly volume: number;
  /** Number of elements with a dihedral angle outside 30 to 135 degrees. */
  readonly outOfRange: number;
  /** Number of these elements that cannot improve because of a boundary or an interface; see `LimitedByBoundary`. */
  readonly limitedByBoundary: number;
}

/** Result of `improveMesh`. */
export interface MeshImprovement {
  /** False if no better mesh was found: the elements are then the given ones, in their order. */
  readonly isImproved: boolean;
  /** Whether the call was stopped early. */
  readonly isPartial: boolean;
  /**
   * The improved elements with the triangles, patches and regions of the given mesh; without values at the nodes, which have
   * moved.
   */
  readonly mesh: Mesh;
  /** Per node: its index in the given mesh; `NO_ORIGIN` if it may have moved or is new. */
  readonly nodeOrigin: Uint32Array;
  /** Number of elements that were given with negative volume; two of their nodes were exchanged. */
  readonly orientedTetrahedra: number;
  /** Whether `maxGrowth` has prevented changes that would have added elements. */
  readonly isGrowthLimited: boolean;
  readonly before: MeshShapes;
  readonly after: MeshShapes;
  /** Notes: elements that were inverted, whether no better mesh was found, and whether more elements could help. */
  readonly diagnostics: readonly Diagnostic[];
}
