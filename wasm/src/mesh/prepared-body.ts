/** Surface of a body, ready to be filled. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { SurfaceRemesh } from "./inspection.js";
import type { CurvedEdges } from "./mesh.js";

/**
 * Placed surface of a body with the triangles that will be meshed. It becomes out of date with every change of the body
 * and of the sizes. The figures of a `SurfaceRemesh` are present if the surface was remeshed.
 */
export interface PreparedBody extends Partial<Omit<SurfaceRemesh, "mesh" | "origin" | "diagnostics">> {
  /** Id of the body. */
  readonly body: number;
  /** x y z per node. */
  readonly points: Float64Array;
  /** Three node indices per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: index in the patches of the body. */
  readonly trianglePatch: Uint32Array;
  /** Per triangle: index of a given triangle of the same patch, near it. */
  readonly origin: Uint32Array;
  /** Edges of triangles that bend, if the nodes were placed on true faces: as `trueEdges` of a `Mesh`. */
  readonly trueEdges?: CurvedEdges | undefined;
  /** Factor on all sizes, if a number of elements was reached with it; the run of another number cannot use the body. */
  readonly sizeFactor?: number | undefined;
  /** Warnings; a surface with errors cannot be prepared. */
  readonly diagnostics: readonly Diagnostic[];
}
