/** A surface on its way to a mesh, and what was done to it. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { RepairChange, SurfaceRemesh } from "../mesh/inspection.js";
import type { MeshResult } from "../mesh/report.js";
import type { Mesh } from "../mesh/mesh.js";

/** A surface, and what its repair and the split of its patches have changed. */
export interface ChangedSurface {
  /** The surface as it was meshed. */
  readonly surface: Mesh;
  /** Changes of its repair; undefined if it was not repaired. */
  readonly changes?: readonly RepairChange[] | undefined;
  /** Largest distance by which the repair moved a node, in model units; as `changes`. */
  readonly repairDeviation?: number | undefined;
  /** Number of patches before and after their split, if that was asked for. */
  readonly split?: { readonly before: number; readonly after: number } | undefined;
  /** Warnings and notes about solids, cracks and region points. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Result of a requested refinement of a surface. */
export interface RefinementCounts {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
  readonly splitEdges: number;
  /** Longest given edge / target length. */
  readonly lengthRatio: number;
}

/** Result of a requested remeshing of a surface. */
export interface RemeshReport extends Omit<
  SurfaceRemesh,
  "mesh" | "origin" | "triangleDeviation" | "diagnostics"
> {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
}

/** Result of `meshSurface`: a mesh, and what was done to the surface before. */
export interface MeshedSurface extends MeshResult, ChangedSurface {
  readonly refinement?: RefinementCounts | undefined;
  readonly remesh?: RemeshReport | undefined;
  /** Whether the mesh is that of an exact repair, which replaced the one that was made ready. */
  readonly isExact: boolean;
}
