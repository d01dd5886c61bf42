/** A surface on its way to a mesh, and what was done to it. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { RepairChange, SurfaceRemesh } from "../mesh/inspection.js";
import type { MeshResult } from "../mesh/report.js";

/** A surface, and what its repair and the split of its patches have changed. */
export interface ChangedSurface {
  readonly surface: SurfaceFile;
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
  "surface" | "origin" | "triangleDeviation" | "diagnostics"
> {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
}

/** A mesh, and what was done to the surface before. */
export interface MeshedSurface extends ChangedSurface {
  readonly result: MeshResult;
  readonly refinement?: RefinementCounts | undefined;
  readonly remesh?: RemeshReport | undefined;
  /** Whether the mesh is that of an exact repair, which replaced the one that was made ready. */
  readonly isExact: boolean;
}
