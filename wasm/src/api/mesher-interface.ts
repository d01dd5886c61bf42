/** The mesher: the engine in a worker, as callers see it. */
import type {
  MeshInspection,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { MeshInput, SurfaceInput, VolumeMesh } from "../mesh/mesh.js";
import type { MeshResult } from "../mesh/report.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import type { ProjectPreview } from "../project/preview.js";
import type { Project, ProjectBackground, ProjectSource } from "../project/schema.js";
import type { RunControl } from "./control.js";
import type {
  CoverOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProposalOptions,
  RefineOptions,
  RepairOptions,
} from "./option-types.js";

/** Sizes that a model seems to ask for. */
export interface SizeProposal {
  /** Uniform, to be refined by the sources; 0 where there is nothing to see. */
  readonly size: number;
  /** The smallest first, with ids from 1. */
  readonly sources: readonly ProjectSource[];
}

/** One mesher: an engine in a worker of its own (browser and Node). Runs are queued. */
export interface Mesher {
  /**
   * Meshes a drawn project: lines, patches, closed boundary, volume. Bad input is a result with status
   * `invalid-input` and diagnostics. Rejects with a `MesherError` when memory runs out, when the
   * mesher is disposed of, or when the engine itself fails.
   */
  meshProject(project: Project, options?: MeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Fills a closed surface, kept triangle for triangle: nothing is repaired, which is for `repairSurface`. Only in
   * what is returned all triangles face outward, also where a whole part of the surface was given inside out, which is
   * said. Without `size` the sizes come from the surface's own edges. Ends and rejects as `meshProject` does.
   */
  fillSurface(surface: SurfaceInput, options?: MeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Samples lines and patches for display and checks the project; tolerates broken input. Answered
   * between the slices of a run, so that editing goes on while a mesh is made. Options that make no
   * sense are among the diagnostics.
   */
  previewProject(project: Project, options?: PreviewOptions, control?: RunControl): Promise<ProjectPreview>;
  /**
   * A background grid of one size around the points, lines and patches, which keeps the project's
   * sources. Answered as `previewProject`. Rejects with `invalid-input` where there is nothing to cover.
   */
  coverProject(project: Project, options?: CoverOptions, control?: RunControl): Promise<ProjectBackground>;
  /**
   * Sizes from the model's shape: a uniform one, and sources where lines and patches bend or come near
   * each other. A proposal, not a promise. Answered as `previewProject`.
   */
  proposeSizes(project: Project, options?: ProposalOptions, control?: RunControl): Promise<SizeProposal>;
  /**
   * A generated mesh as background grid: with one size per node, else with sizes from its own edges,
   * which ask for about as many elements as it has. Nodes of no tetrahedron are left out. Rejects with
   * `invalid-input` where the arrays do not fit together.
   */
  backgroundFromMesh(
    mesh: Pick<VolumeMesh, "points" | "tetrahedra">,
    options?: { readonly sizes?: Float64Array | undefined },
    control?: RunControl,
  ): Promise<BackgroundArrays>;
  /**
   * Everything about a given surface, by the checks that filling begins with: whether it is closed,
   * manifold and free of crossings, its bodies and cavities, its figures, and all that is wrong with ids
   * and places. Rejects with `invalid-input` only where the arrays are none. O(n log n); about a
   * microsecond per triangle. Works in slices beside a run.
   */
  inspectSurface(
    surface: SurfaceInput,
    options?: InspectionOptions,
    control?: RunControl,
  ): Promise<SurfaceInspection>;
  /**
   * Makes the repairs that are asked for, in a copy, and lists every one; `inspectSurface` then tells what
   * they were good for. Rejects with `invalid-input` where coordinates or indices are broken. Works in steps
   * beside a run.
   */
  repairSurface(surface: SurfaceInput, options?: RepairOptions, control?: RunControl): Promise<SurfaceRepair>;
  /**
   * Divides the triangles of a surface that are larger than the elements wanted there, so that `fillSurface`
   * with the same options can have these (otherwise it warns with `coarse-surface`). Edges longer than 1.41
   * wanted lengths are halved in all their triangles, the longest of a triangle first: no angle falls below
   * half of what it was, and the shape stays the same up to the rounding of middles. Patches follow by
   * `repairedSurface(file, refinement)`. Rejects with `invalid-input` where numbers are broken, no sizes are
   * given, or the triangles would be too many; with the enclosed `volume`, also where the inside would have more
   * tetrahedra than a run makes, before anything is divided. O(n log n) for n triangles of the result; about 2 µs for each.
   * Works in slices beside a run.
   */
  refineSurface(
    surface: SurfaceInput,
    options: RefineOptions,
    control?: RunControl,
  ): Promise<SurfaceRefinement>;
  /**
   * Whether a mesh is sound, how good its elements are, and its boundary. Rejects with `invalid-input`
   * where coordinates or indices are broken. O(n log n); about a microsecond per element. Works in slices beside
   * a run.
   */
  inspectMesh(mesh: MeshInput, control?: RunControl): Promise<MeshInspection>;
  /** Ends the worker; runs under way are rejected. */
  dispose(): void;
}
