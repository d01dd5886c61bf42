/** The mesher: the engine in a worker, as callers see it. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { PartialControl, RunControl } from "../engine/control.js";
import type { CurvedEdges, Mesh, SurfaceInput, VolumeInput } from "../mesh/mesh.js";
import type {
  MeshInspection,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { MeshAdaptation } from "../mesh/adaptation.js";
import type { LayeredMesh, PatchLayers } from "../mesh/layered-mesh.js";
import type { AdaptationCycle, Solve } from "../mesh/adaptation-cycle.js";
import type { MeshImprovement } from "../mesh/improvement.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { MeshResult } from "../mesh/report.js";
import type { CurvedMesh } from "../mesh/second-order.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "../mesh/solution.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import type { ProjectPreview } from "../project/preview.js";
import type { BodyId, Project, ProjectBackground, ProjectSource } from "../project/project-types.js";
import type {
  CoverOptions,
  CurvatureOptions,
  CycleOptions,
  AdaptOptions,
  LayerOptions,
  ImproveOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProjectMeshOptions,
  ProposalOptions,
  RefineOptions,
  RemeshOptions,
  RepairOptions,
  SolutionSizeOptions,
  SplitOptions,
  SurfaceMeshOptions,
  SurfaceProposalOptions,
  TransferOptions,
} from "./option-types.js";
import type { RegionLocation } from "./region-location.js";
import type { MeshedSurface } from "./meshed-surface.js";

/** Result of `proposeSizes`. */
export interface SizeProposal {
  /** Uniform size, which the sources refine; 0 if nothing can be evaluated. */
  readonly size: number;
  /** Sources, those with the smallest size first, with ids from 1. */
  readonly sources: readonly ProjectSource[];
}

/** Result of `sampleSizes`. */
export interface SizeSamples {
  /**
   * Target edge length per position; where the sizes are stretched, that of a regular element with the same volume. Empty
   * if the project has no valid sizes.
   */
  readonly sizes: Float64Array;
  /**
   * Expected number of tetrahedra of the mesh, within about a third, with bodies within a factor of two; null if the
   * project encloses no volume or has no valid sizes, and if a body is not among `preparedBodies`.
   */
  readonly tetrahedra: number | null;
}

/**
 * Result of `sampleCurvature`: triangles of all drawn patches, which share no vertices. The vertices of a curved patch without holes
 * are a lattice, even in its parameters: row after row, as many as columns, or with one vertex less than the row before in a
 * triangle. Those of a tube are several lattices around it. The first triangle has the first two vertices of the first row, and the first one
 * of the second row.
 */
export interface CurvatureSamples {
  /** x y z per vertex. */
  readonly points: Float64Array;
  /** Normal of the patch at each vertex, x y z, of length 1; within a patch on one side. */
  readonly normals: Float64Array;
  /** Product of the principal curvatures per vertex. */
  readonly gaussian: Float64Array;
  /** Larger magnitude of the principal curvatures per vertex: 1 / the smallest radius. */
  readonly largest: Float64Array;
  /** Triangles of patch p: triangles[3t..3t+2], patchOffsets[p] <= t < patchOffsets[p+1]. */
  readonly triangles: Uint32Array;
  readonly patchOffsets: Uint32Array;
}

/** Result of `proposeSurfaceSizes`. Lengths are in model units. */
export interface SurfaceSizeProposal {
  /** Largest and smallest target size on the surface. */
  readonly size: number;
  readonly minSize: number;
  /** Tolerance of the remeshing. */
  readonly tolerance: number;
  /** Expected numbers: triangles within about a third, tetrahedra within a factor of two. */
  readonly triangles: number;
  readonly tetrahedra: number;
}

/** Result of `splitPatches`. */
export interface PatchSplit {
  /** The surface with its new patches. */
  readonly mesh: Mesh;
}

/** Result of `checkProject`. */
export interface ProjectCheck {
  /** Whether the front would start. */
  readonly isFillable: boolean;
  /** Expected number of tetrahedra, also of a model that is refused because they are too many; null if it is not known. */
  readonly expectedTetrahedra: number | null;
  readonly diagnostics: readonly Diagnostic[];
}

/** One mesher: an engine in its own worker, in browsers and in Node. Runs are queued. */
export interface Mesher {
  /**
   * Meshes a project: bodies, lines, patches, boundary, volume. Bodies that are not among `preparedBodies` are prepared
   * first, in the phase `bodies`. Invalid input gives a result with status `invalid-input` and diagnostics. Rejects with a
   * `MesherError` if memory runs out, the mesher is disposed of, or the engine fails.
   */
  meshProject(project: Project, options?: ProjectMeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Returns what `meshProject` with the same options would find before its front starts: all errors, and the number of
   * tetrahedra that the sizes ask for. Rejects with `cancelled`, and otherwise as `meshProject` does. Works in slices beside a
   * run.
   */
  checkProject(project: Project, options?: ProjectMeshOptions, control?: RunControl): Promise<ProjectCheck>;
  /**
   * Makes the surface of a body as `meshProject` with the same options will mesh it: placed, and remeshed, refined or kept.
   * Its sizes are its own `remeshing.size`, else those of the project, else automatic, as they are with a `maxSize`; sources
   * cap them. Rejects with `invalid-input` if the body does not exist or its surface cannot be filled. Works in slices
   * beside a run.
   */
  prepareBody(
    project: Project,
    body: BodyId,
    options?: MeshOptions,
    control?: RunControl,
  ): Promise<PreparedBody>;
  /**
   * Fills a closed surface and keeps every triangle. Nothing is repaired; see `repairSurface`. In the result, all
   * triangles face outward: components that were given inside out are flipped and reported. Without `size`, the sizes
   * follow the surface's own edges. Ends and rejects as `meshProject` does.
   */
  fillSurface(surface: SurfaceInput, options?: MeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Meshes the surface of a file with fit elements, as `meshFile` does after reading: joins solids that touch, locates region
   * points, decides what becomes of the triangles (`surface`), and repairs before if that is asked for or implied. Ends and
   * rejects as `meshProject` does.
   *
   *     const { mesh, report } = await mesher.meshSurface(surface);
   */
  meshSurface(
    surface: SurfaceInput,
    options?: SurfaceMeshOptions,
    control?: RunControl,
  ): Promise<MeshedSurface>;
  /**
   * Samples lines and patches for display and checks the project, which may be invalid. Answered between the slices of a
   * run, so that a user can edit during a run. Invalid options are reported among the diagnostics.
   */
  previewProject(project: Project, options?: PreviewOptions, control?: RunControl): Promise<ProjectPreview>;
  /**
   * Returns a background grid with one size around the points, lines and patches; it keeps the project's sources.
   * Answered as `previewProject`. Rejects with `invalid-input` if there is nothing to cover.
   */
  coverProject(project: Project, options?: CoverOptions, control?: RunControl): Promise<ProjectBackground>;
  /**
   * Proposes a uniform size, and sources on lines and patches that are curved or close to each other. Fine detail may be
   * missed. Answered as `previewProject`.
   */
  proposeSizes(project: Project, options?: ProposalOptions, control?: RunControl): Promise<SizeProposal>;
  /**
   * Returns the target sizes at positions, x y z each, before the project is meshed, and the number of tetrahedra to expect.
   * Outside the background grid, the size is that of the nearest tetrahedron. Answered as `previewProject`, and takes about
   * as long; invalid sizes are no error.
   *
   *     const { sizes, tetrahedra } = await mesher.sampleSizes(project, Float64Array.of(0, 0, 0));
   */
  sampleSizes(
    project: Project,
    positions: Float64Array,
    options?: ProjectMeshOptions,
    control?: RunControl,
  ): Promise<SizeSamples>;
  /**
   * Samples the normals and curvatures of the drawn patches themselves, to display how smooth they are. Patches that cannot be
   * evaluated have no triangles. Answered as `previewProject`; takes about a millisecond per patch.
   *
   *     const { normals, largest } = await mesher.sampleCurvature(project);
   */
  sampleCurvature(
    project: Project,
    options?: CurvatureOptions,
    control?: RunControl,
  ): Promise<CurvatureSamples>;
  /**
   * Converts a mesh to a background grid, with the given sizes (one per node), else with the node values `size` of its file,
   * and with `stretching` and `direction`, `secondStretching` and `secondDirection` if it has them, else with those of its node
   * values `metric`, else with sizes from its own edges, which ask for about as many elements as it has. A name may differ in case if no other name then matches. Omits nodes without a tetrahedron. Rejects with
   * `invalid-input` if the arrays are inconsistent.
   */
  backgroundFromMesh(
    mesh: VolumeInput,
    options?: { readonly sizes?: Float64Array | undefined },
    control?: RunControl,
  ): Promise<BackgroundArrays>;
  /**
   * Inspects a given surface by the checks with which filling begins: whether it is closed, manifold and free of
   * self-intersections, its regions and cavities, its statistics, and all problems with indices and positions. Rejects
   * with `invalid-input` only if the arrays are inconsistent. O(n log n) for n triangles; about 1 µs each. Works in
   * slices beside a run.
   */
  inspectSurface(
    surface: SurfaceInput,
    options?: InspectionOptions,
    control?: RunControl,
  ): Promise<SurfaceInspection>;
  /**
   * Finds the volumes that the surface encloses, and which of them its `regionPoints` mark as regions and holes; exact.
   * Every volume without a hole point is a region, also inside another one. Returns the surface without triangles that no
   * region touches; its `surfaceRegions` state what is meshed, with the names, tags and largest volumes
   * of the region points. Warns with `region-point` about points without effect. Rejects with `region-point` if a point lies
   * on the surface or every volume is a hole, and as `fillSurface` if the surface cannot be meshed. Repair a surface
   * before this call. O(n log n). Works in slices beside a run.
   *
   *     const { mesh } = await mesher.locateRegions(surface);
   *     const result = await mesher.fillSurface(mesh);
   */
  locateRegions(surface: SurfaceInput, control?: RunControl): Promise<RegionLocation>;
  /**
   * Returns the sizes that `remeshSurface` would use, and about how many triangles and tetrahedra they lead to. `background`
   * is not permitted. Rejects as `remeshSurface`. Works in slices beside a run.
   */
  proposeSurfaceSizes(
    surface: SurfaceInput,
    options?: SurfaceProposalOptions,
    control?: RunControl,
  ): Promise<SurfaceSizeProposal>;
  /**
   * Makes the requested repairs in a copy and lists every change; use `inspectSurface` to check the result. If the surface
   * has `surfaceRegions` that are meshed and share volumes, each keeps the rest as its own when intersections are resolved. Rejects with
   * `invalid-input` if coordinates or indices are invalid. Works in slices beside a run.
   */
  repairSurface(surface: SurfaceInput, options?: RepairOptions, control?: RunControl): Promise<SurfaceRepair>;
  /**
   * Splits triangles that are larger than the target size, so that `fillSurface` with the same options can reach it
   * (otherwise it warns with `coarse-surface`). Edges longer than 1.41 target lengths are halved in all their triangles,
   * the longest edge of a triangle first: no angle falls below half of its former value, and the shape is kept up to the
   * rounding of midpoints. Rejects with `invalid-input` if
   * numbers are invalid, or there would be too many triangles; with the enclosed `volume`, also if there would be more
   * tetrahedra than a run permits, before anything is split. Without sizes, the triangles' own edges are the sizes, limited by
   * growth: a large triangle beside small ones is split. O(n log n) for n triangles of the result; about 2 µs
   * each. Works in slices beside a run.
   */
  refineSurface(
    surface: SurfaceInput,
    options?: RefineOptions,
    control?: RunControl,
  ): Promise<SurfaceRefinement>;
  /**
   * Replaces the triangles of a surface by new ones of the target size and good shape, near the given surface everywhere:
   * `deviation` is an upper bound. Sharp edges, corners and the lines between patches stay. The result is closed and free
   * of self-intersections, as the given surface must be. By default, the sizes follow from the shape.
   * Rejects with `invalid-input` if the surface cannot
   * be filled, numbers are invalid, or there would be too many triangles. About linear in the number of given and new
   * triangles; 0.1 to 2 ms each. Works in slices beside a run. The surface is valid at any moment: with `partial: true`,
   * aborting the signal returns it as it is.
   *
   *     const { mesh } = await mesher.remeshSurface(surface);
   *     const result = await mesher.fillSurface(mesh);
   */
  remeshSurface(
    surface: SurfaceInput,
    options?: RemeshOptions,
    control?: PartialControl,
  ): Promise<SurfaceRemesh>;
  /**
   * Splits a surface into patches at its edges that are sharper than `angle`; given patches stay separate. Returns the
   * surface with its new patches in the order of their positions, the lowest first: this order belongs to the shape and
   * not to the triangles. Pieces of a named patch are called "wing", "wing 2", …, all others "patch 1", "patch 2", ….
   * `patches` limits the split to some of the patches. The surface may be open. Rejects with `invalid-input` if numbers
   * are invalid. O(n log n) for n triangles; about 1 µs each.
   *
   *     const { mesh } = await mesher.splitPatches(surface, { angle: 30 });
   */
  splitPatches(surface: SurfaceInput, options?: SplitOptions, control?: RunControl): Promise<PatchSplit>;
  /**
   * Reports whether a mesh is valid, the quality of its elements, and its boundary. Rejects with `invalid-input` if
   * coordinates or indices are invalid. O(n log n) for n elements; about 1 µs each. Works in slices beside a run.
   */
  inspectMesh(mesh: VolumeInput, control?: RunControl): Promise<MeshInspection>;
  /**
   * Improves the elements of a mesh from any program by swaps, moves, splits and collapses, as after a run. Its boundary,
   * its interfaces and the given `triangles` stay, triangle for triangle; the sizes are those of its own edges. The result
   * is never worse: neither in its smallest or largest dihedral angle, nor in its least or mean radius ratio, nor in the share
   * of elements outside 30 to 135 degrees, whose number may grow with that of all elements. It has at most 5 % more elements,
   * or as many more as `maxGrowth` permits.
   * Rejects with `invalid-input` if
   * elements have no volume or overlap, or if more than two share a face; the diagnostic names them. About 50 µs per
   * element. Works in slices beside a run. With `partial: true`, aborting the signal returns the mesh as it is.
   *
   *     const { mesh } = await mesher.improveMesh(given);
   */
  improveMesh(
    mesh: VolumeInput,
    options?: ImproveOptions,
    control?: PartialControl,
  ): Promise<MeshImprovement>;
  /**
   * Adapts a mesh to a metric: afterwards, nearly all edges have about unit length in it. `background` is a mesh with the metric
   * as node values: `metric` (xx, xy, xz, yy, yz, zz), or `size` and optionally `stretching` and
   * `direction`, `secondStretching` and `secondDirection`. New nodes of the boundary are on the faces and edges of the CAD file that
   * the mesh was made of (`trueFaces`, unless they were moved or scaled), and else on its `triangles`; patches, sharp edges and
   * corners stay; interfaces between regions stay triangle for triangle. The result has the metric as node values. Rejects with `invalid-input` if the mesh is invalid, as
   * `improveMesh` does, and with `invalid-arrays` if a metric is not positive definite. About 0.2 ms per element of the result. Works in
   * slices beside a run. With `partial: true`, aborting the signal returns the mesh as it is.
   *
   *     const { mesh: adapted } = await mesher.adaptMesh(mesh, background);
   */
  adaptMesh(
    mesh: VolumeInput,
    background: VolumeInput,
    options?: AdaptOptions,
    control?: PartialControl,
  ): Promise<MeshAdaptation>;
  /**
   * Makes layers of stretched elements along patches, thin across them and as long as the mesh is coarse along them, by
   * adaptations to a metric that is computed at the nodes of the mesh again in each cycle. Sizes along a patch are those of
   * `background`, or of the mesh; they are smaller where the patch is curved. Where the layers of several patches meet, in concave
   * corners and narrow gaps, elements are small in the directions of all of them. Patches inside, between regions, get no
   * layers. Rejects as `adaptMesh`, and with `invalid-option` if there is no such patch. 0.2 to 0.4 ms per element of the result
   * and cycle. Works in slices beside a run. With `partial: true`, aborting the signal returns the mesh as it is.
   *
   *     const { mesh: layered } = await mesher.addLayers(mesh, [{ patch: "wall", firstHeight: 1e-3, growth: 1.2, count: 10 }]);
   */
  addLayers(
    mesh: VolumeInput,
    layers: readonly PatchLayers[],
    options?: LayerOptions,
    control?: PartialControl,
  ): Promise<LayeredMesh>;
  /**
   * Curves the edges of a mesh for second-order elements. `curvedEdges` has edges of the boundary and of interfaces, with the
   * positions of their middle nodes, by default those of the CAD file of the mesh (`trueEdges`); all others are straight. Where an element would be invalid or nearly so, middles of edges inside
   * are moved; then nodes inside; at last given edges are straightened, which the result lists. That det J is positive in every
   * element is proven. `triangles` of the mesh must contain the whole boundary and all interfaces: their nodes and straight edges stay. Returns
   * the mesh with `curvedEdges`. Rejects with `invalid-input` if arrays are invalid, or if elements have no positive volume with straight
   * edges. O(n) for n elements; about 1 µs per curved element. Works in slices beside a run.
   *
   *     const { mesh, secondOrder } = await mesher.curveMesh(result.mesh);
   *     const files = await writeMesh(mesh, "part.vtu", { elementOrder: 2 });
   */
  curveMesh(mesh: Mesh, curvedEdges?: CurvedEdges, control?: RunControl): Promise<CurvedMesh>;
  /**
   * Returns a metric for the interpolation error of fields of a solver: elements become small where the fields bend, and thin across
   * their layers. The second derivatives are recovered at the nodes, exactly for quadratic fields; the metrics of several fields are
   * intersected. A field that does not vary, or is linear, has no effect, with a warning `constant-field`. Rejects with
   * `invalid-arrays` about wrong numbers of values and values that are not finite, and with `invalid-mesh` if an element
   * has no positive volume. O(n log n) for n nodes. Works in slices beside a run.
   *
   *     const { mesh: background } = await mesher.sizeFromSolution(mesh, [{ components: 1, values }], { elements: 50_000 });
   *     await mesher.meshProject(project, { background: await mesher.backgroundFromMesh(background) });
   */
  sizeFromSolution(
    mesh: VolumeInput,
    fields: readonly FieldValues[],
    options: SolutionSizeOptions,
    control?: RunControl,
  ): Promise<SolutionSizes>;
  /**
   * Transfers fields from one mesh to another, by interpolation or, with `conservative`, so that their integrals are kept where both
   * meshes fill the same domain. Nodes outside the given mesh take the value of its nearest point. Conservative fields at
   * nodes are projected in the sense of least squares and may leave the range of the given values beside jumps; those at
   * elements do not. Rejects as `sizeFromSolution`. Works in slices beside a run.
   */
  transferSolution(
    from: VolumeInput,
    to: VolumeInput,
    fields: readonly FieldValues[],
    options?: TransferOptions,
    control?: RunControl,
  ): Promise<TransferredFields>;
  /**
   * Adapts the mesh of a model to the solution of a solver, cycle by cycle: a mesh is solved, and the next mesh follows the
   * sizes of the solution, which is transferred to it. The model is a project, a surface, whose triangles
   * are replaced, or a mesh. The boundary of all meshes follows that of the first one. Yields after each cycle; leave the loop to end early. The
   * iterator rejects as the calls that it makes do, with what the solver throws, and with `cancelled`.
   *
   *     for await (const { cycle, next, estimatedErrors } of mesher.adapt(surface, solve, { cycles: 5, elements: 20_000 })) {
   *       show(cycle, next.mesh, estimatedErrors);
   *     }
   */
  adapt(
    model: Project | SurfaceInput | VolumeInput,
    solve: Solve,
    options: CycleOptions,
    control?: RunControl,
  ): AsyncGenerator<AdaptationCycle, void>;
  /** Terminates the worker; pending calls reject. */
  dispose(): void;
}
