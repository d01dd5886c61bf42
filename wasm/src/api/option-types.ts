/** Options of the calls of a mesher. */
import type {
  CoverShape,
  ErrorNorm,
  FrontOrder,
  InnerShells,
  Interior,
  Optimization,
} from "../generated/constants.js";
import type { PatchLayers } from "../mesh/layered-mesh.js";
import type { ElementOrder, Mesh, VolumeInput } from "../mesh/mesh.js";
import type { PreparedBody } from "../mesh/prepared-body.js";
import type { BackgroundArrays } from "../project/background-arrays.js";

/** What the sizes of a call are, and what is meshed: the same words in all calls. */
export interface SizeOptions {
  /**
   * Target edge length in model units, from 1e-30 to 1e30, wherever nothing asks for smaller elements: sources, small triangles of
   * a surface, or its shape if it is remeshed. In a project, it replaces the nodes and tetrahedra of the background grid. It
   * cannot be combined with a `background` that has nodes.
   */
  readonly size?: number | undefined;
  /**
   * Growth of the size per unit of distance, 0 to 10: from the edges of a surface, from node to node of a background grid, and from
   * where the shape asks for small sizes. Neighbouring elements then differ by a factor of at most 1 + growth. Default 0.3;
   * `Infinity` takes the sizes of a grid as they are.
   */
  readonly growth?: number | undefined;
  /**
   * Largest volume of a tetrahedron, in cubed model units, above 0. Default: no limit. It caps all sizes, and larger
   * tetrahedra are split without changes of the boundary. If rounding prevents that, `large-tetrahedra` warns;
   * if too many tetrahedra would be required, `too-many-elements` is an error.
   */
  readonly maxVolume?: number | undefined;
  /**
   * Background grid, which must cover the model. It replaces the grid of a project, but not its sources; for a given
   * surface, it replaces the sizes of the surface's own edges and automatic sizes. Without nodes, it adds its sources only.
   */
  readonly background?: BackgroundArrays | undefined;
  /**
   * What closed shells inside a region bound. Default `by-orientation`: a region if their triangles face the same way as
   * those of the shell around them (outward), else a cavity, so that shells of cavities must have the opposite orientation. With
   * `cavities`, they stay empty; with `regions`, each is meshed as a region that conforms to the surrounding one, and may have
   * either orientation.
   */
  readonly innerShells?: InnerShells | undefined;
}

/** Options of `repairSurface`. By default, nothing is moved or added. */
export interface RepairOptions extends Pick<SizeOptions, "innerShells"> {
  /**
   * Distance up to which nodes are welded, in model units. 0, the default, welds nodes with equal coordinates; `false`
   * welds none.
   */
  readonly weld?: number | false | undefined;
  /** Remove degenerate triangles, and all but one of duplicate triangles. Default true. */
  readonly removeTriangles?: boolean | undefined;
  /** Fill holes with up to this number of edges, at most 200. Default 0: none. */
  readonly fillHoles?: number | undefined;
  /** Flip triangles so that they are oriented consistently, and outward if that is known. Default true. */
  readonly orient?: boolean | undefined;
  /**
   * If nothing else makes the surface valid, replace it by the boundary of what it encloses: triangles are cut where they
   * intersect, cracks and holes of any size are closed, and triangles that enclose nothing are removed. The surface is
   * changed only if the result can be meshed. Default true.
   */
  readonly resolveIntersections?: boolean | undefined;
  /**
   * Distance up to which nodes of intersecting triangles are welded when these are resolved, in model units. Faces that
   * nearly coincide then leave no low steps, which a remeshing would have to follow with triangles of poor shape. A weld
   * that changes the volume by more than 0.1 % is not made; a quarter and a sixteenth of the distance are tried then. Default 0: none.
   */
  readonly weldIntersections?: number | undefined;
}

/** Options of `refineSurface`: those with which the surface will be filled. */
export interface RefineOptions extends Omit<MeshOptions, "elements" | "threads"> {
  /**
   * Enclosed volume, as returned by `inspectSurface`, in cubed model units. If given, sizes that require more tetrahedra
   * than a run permits are rejected before anything is split; otherwise only the number of triangles is limited.
   */
  readonly volume?: number | undefined;
}

/**
 * Options of `remeshSurface`. Without `size`, and without nodes of a `background`, the sizes are automatic: they follow from
 * curvature, thin walls, and gaps between feature lines.
 */
export interface RemeshOptions extends SizeOptions {
  /**
   * Smallest size that the shape may ask for, in model units. Default: a tenth of `size`, or 1/150 of the diagonal; and
   * smaller near sharp edges and gaps that are smaller themselves.
   */
  readonly minSize?: number | undefined;
  /** Largest automatic size, in model units. Default: 1/15 of the diagonal. Not together with other sizes. */
  readonly maxSize?: number | undefined;
  /**
   * Largest distance between the given and the new surface, in both directions, in model units. Default: 1/250 of the
   * diagonal, of several regions of that of the smallest, but at most half of the mean thickness 2 V / A of the thinnest region; with
   * `size` or the nodes of a `background` 1/700, but at most 1/20 of `size`.
   */
  readonly tolerance?: number | undefined;
  /**
   * Edges with a larger angle between their triangles stay sharp: 1 to 180 degrees. Default 40. The angle is 0 in a plane
   * and 90 at the edge of a cube.
   */
  readonly featureAngle?: number | undefined;
  /**
   * Largest angle that an edge may span on a curved patch, 1 to 180 degrees; 36 gives 10 edges around a circle. Default 36,
   * or 60 with `size` or the nodes of a `background`.
   */
  readonly anglePerEdge?: number | undefined;
  /**
   * Number of elements across thin walls, 0 to 100; 0 ignores thickness. Default 1, or 0 with `size` or the nodes of a
   * `background`.
   */
  readonly layers?: number | undefined;
  /**
   * Drops details below this length first, in model units, above 0: where sharp edges are nearer to each other, they become
   * one, so narrow strips, low steps and the ends of cusps disappear, and so do shorter edges. The changes are listed in
   * `mergedDetails`. 0 keeps all details. Default: details below a fifth of the tolerance are dropped, unless a background grid
   * is given or the smallest size is less than six times as large; and if an angle is below 10° all the same, more details across which triangles are poor, within the tolerance,
   * provided that the triangles get better.
   */
  readonly dropDetails?: number | undefined;
  /**
   * Factor on all sizes that follow from the shape, 0.001 to 1000. Default 1. Below 1, all shrink by it; above 1, flat faces
   * get coarser first, then curved ones, for which the automatic tolerance grows, then thin walls and gaps.
   */
  readonly sizeFactor?: number | undefined;
}

/** Options of a remeshing that a run without a remeshing does not have. */
export type RemeshSettings = Pick<
  RemeshOptions,
  "minSize" | "maxSize" | "tolerance" | "featureAngle" | "anglePerEdge" | "layers" | "dropDetails"
>;

/** Options of `proposeSurfaceSizes`: those with which the surface will be remeshed. */
export type SurfaceProposalOptions = Omit<RemeshOptions, "background" | "dropDetails">;

/** Options of `improveMesh`. */
export interface ImproveOptions {
  /** Effort: `fast` moves nodes and removes edges; `default` also splits and collapses edges; `thorough` goes on longer. */
  readonly optimization?: Exclude<Optimization, "none"> | undefined;
  /**
   * Number of elements that may be added, as a fraction of those given: 0 to 100. Default 0.05. Up to 0.05, elements are
   * added only where that makes an element with a dihedral angle outside 30 to 135 degrees better; above that, also where
   * edges are long for their surroundings. Meshes with few nodes inside need more to become good.
   */
  readonly maxGrowth?: number | undefined;
}

/** Options of `adaptMesh`. */
export interface AdaptOptions {
  /** Quality in the metric that every element should reach, 0 to 1. Default 0.5; few meshes reach more than 0.6. */
  readonly leastQuality?: number | undefined;
  /** Number of sweeps over all edges and elements at most, 0 to 100. Default 12; 4 are faster and nearly as good. */
  readonly sweeps?: number | undefined;
}

/** Options of `addLayers`. */
export interface LayerOptions extends AdaptOptions {
  /** A mesh with the sizes along the walls and elsewhere, as for `adaptMesh`. Default: the sizes of the mesh. */
  readonly background?: VolumeInput | undefined;
  /** Largest size along a wall / size across it, 1 to 1e6. Default 1000. Single elements may have a larger aspect. */
  readonly maxAspect?: number | undefined;
  /** Growth of the sizes per unit of distance, beyond the layers and along the walls, 0.01 to 10. Default 0.5. */
  readonly growth?: number | undefined;
  /** Number of adaptations at most, 1 to 100. Default 8; fewer are made if the number of elements settles. */
  readonly cycles?: number | undefined;
}

/** Options of `splitPatches`. */
export interface SplitOptions {
  /**
   * Edges with a larger angle between their triangles separate patches: 1 to 180 degrees. Default 40. The angle is 0 in a
   * plane and 90 at the edge of a cube.
   */
  readonly angle?: number | undefined;
  /**
   * Indices of the patches to split. Default all. The others keep their triangles, names and tags, also if they consist
   * of several components. An index that the surface does not have is ignored.
   */
  readonly patches?: readonly number[] | undefined;
}

/** Options of `previewProject`: the sizes are those with which the project will be meshed. */
export interface PreviewOptions extends Pick<SizeOptions, "size" | "innerShells" | "background"> {
  /**
   * Whether lines and patches are only sampled, which is faster: the diagnostics are those of points, lines and patches by
   * themselves. Default false.
   */
  readonly samplesOnly?: boolean | undefined;
}

/** Options of `inspectSurface`: inner shells as in the run that will fill the surface. */
export interface InspectionOptions extends Pick<SizeOptions, "innerShells"> {
  /**
   * Number of diagnostics listed per code, from 1 to a million; the others are counted. Default 1000. Each takes about
   * 0.8 kB of memory and 10 µs.
   */
  readonly maxDiagnostics?: number | undefined;
}

/**
 * Options of `sizeFromSolution`: either `elements` or `error`, and limits. Sizes are edge lengths in model units.
 */
export interface SolutionSizeOptions {
  /** Target number of elements, 1 to 1e9; the metric asks for it within 5 % if the limits permit. */
  readonly elements?: number | undefined;
  /**
   * Target interpolation error of each field, in the unit of the field and the norm: for `l2`, times the square root of volume.
   * With an indicator: its target in every element.
   */
  readonly error?: number | undefined;
  /** Norm of the interpolation error: `l1`, `l2`, `l4`, or `max` for the largest error. Default `l2`. */
  readonly norm?: ErrorNorm | undefined;
  /** One size at each node, the smallest. Default false. */
  readonly isotropic?: boolean | undefined;
  /** Smallest size. Default: no limit. */
  readonly minSize?: number | undefined;
  /** Largest size. Default: the diagonal of the mesh's bounding box. */
  readonly maxSize?: number | undefined;
  /** Largest ratio of two sizes at a node, 1 to 1e6. Default 10000. */
  readonly maxAspect?: number | undefined;
  /**
   * Growth of the sizes per unit of distance, 0 to 10: the metric at a node may grow by one factor in all directions, by which the size
   * along an edge grows by `growth` times its length, so thin layers stay thin along themselves. Default 0.5; `Infinity` for no
   * limit.
   */
  readonly growth?: number | undefined;
  /**
   * Name of a field that is your own indicator of the error, for example a residual: one number >= 0 per node or element. The size
   * of each element is multiplied by (target / indicator)^(1 / order), so that all get the same indicator: `error`, or the one
   * with which there are `elements`. Elements are as wide in all directions; with other fields, they have the shape that these
   * ask for. Default: the interpolation error of the fields.
   */
  readonly indicator?: string | undefined;
  /**
   * Power of the size with which the indicator of an element falls, 0.1 to 20. Default 2: the error of linear elements, as a value
   * per volume. 3.5 for its L2 norm over the element.
   */
  readonly indicatorOrder?: number | undefined;
}

/** Options of `transferSolution`. */
export interface TransferOptions {
  /** Keep the integrals of the fields, by the exact intersections of the elements. Default false: interpolate. */
  readonly conservative?: boolean | undefined;
}

/** Options of `adapt`: those of the sizes, of the adaptation and of the transfer, and what the cycles do. */
export interface CycleOptions extends SolutionSizeOptions, AdaptOptions, TransferOptions {
  /** Number of cycles, 1 to 1000. Default 3. */
  readonly cycles?: number | undefined;
  /** Names of the fields that decide the sizes. Default: all fields of the solution; with an `indicator`, it alone. */
  readonly fields?: readonly string[] | undefined;
  /**
   * Layers along patches of every mesh that is made, as by `addLayers`, with `maxAspect` and `growth` (0.01 to 10) as their limits.
   * Beyond them, sizes follow from the solution. Default: none.
   */
  readonly layers?: readonly PatchLayers[] | undefined;
  /**
   * Last cycle that is done, and the mesh that it made, with fields as `nodeData`: the next cycle begins with it. The model is then
   * the mesh of the first cycle, whose boundary all others follow. `asked`: the number of elements that the sizes of that cycle have
   * asked for (`sizes.elements`); what its mesh has in excess corrects the next number.
   */
  readonly resume?:
    | { readonly cycle: number; readonly mesh: Mesh; readonly asked?: number | undefined }
    | undefined;
}

/** Options of `coverProject`. The size is that of every node; by default 1/20 of the model's diagonal. */
export interface CoverOptions extends Pick<SizeOptions, "size"> {
  /** Five tetrahedra that fill a box, or a single tetrahedron. Default `box`. */
  readonly shape?: CoverShape | undefined;
}

/**
 * Options of `proposeSizes`, with the meaning that they have for `remeshSurface`. Defaults: `maxSize` 1/20 of the model's diagonal,
 * `minSize` 1/50 of `maxSize`, `anglePerEdge` 15, which gives 24 elements around a circle, `layers` 3. 0 for `anglePerEdge` ignores
 * curvature, 0 for `layers` gaps between opposite patches. `growth` is that of the proposed sources.
 */
export type ProposalOptions = Pick<
  RemeshOptions,
  "maxSize" | "minSize" | "anglePerEdge" | "layers" | "growth"
>;

/**
 * Options of `meshProject` and `fillSurface`. The triangles of a given surface are kept. Where they are larger than the target size,
 * the elements next to them are as large (`coarse-surface`), and sizes decrease inwards by `growth`, at most 0.5, per unit of
 * distance. `refineSurface` splits such triangles first.
 */
export interface MeshOptions extends SizeOptions {
  /**
   * Number of elements that the mesh is to have, a whole number from 1 to 20 million; it is reached within 5 % where the shape
   * permits. All sizes are multiplied by one factor, found by a few runs: given ones, and automatic ones too. Of a surface
   * whose triangles are kept, only the sizes inside change. If the number cannot be reached, the mesh has the nearest one, and
   * `element-count` warns. It cannot be combined with `size`; in a project, it scales that of the project.
   */
  readonly elements?: number | undefined;
  /**
   * Order in which faces leave the front. Default `layered`; `smallest-first` is that of the paper. `first-in` and
   * `random` ignore the sizes; they are for comparison and make poorer meshes.
   */
  readonly order?: FrontOrder | undefined;
  /**
   * Whether cheap filters exclude faces that cannot cross a new element, as in the paper, before the others are
   * analysed. Default true; false gives the same mesh more slowly, to measure the effect of the filters.
   */
  readonly filters?: boolean | undefined;
  /** Default `default`; `none` keeps the mesh that the front made. */
  readonly optimization?: Optimization | undefined;
  /**
   * What fills the deep inside of regions. `front`: the front, as everywhere. `lattice`: lattices with dihedral angles of 60 and 90
   * degrees, where sizes are nearly constant over some elements and not stretched; only the rest is left to the front, so that the
   * time grows with the surface rather than with the volume. Default `auto`: `lattice` for meshes that are expected to have 10 000
   * elements or more, else `front`. A recorded run makes no lattice.
   */
  readonly interior?: Interior | undefined;
  /**
   * Number of threads that optimize the mesh, a whole number from 1 to 64. Meshes of 60 000 elements or more, without those deep inside
   * lattices, are optimized in tiles of at most 24 000; the mesh is the same, bit for bit, for any number of threads. Each thread beyond
   * the first is a worker with an engine, which starts with the first tile that waits, has one tile at a time, and ends with the
   * optimization. Default: the threads of the machine, at most 8; 1 where workers cannot start workers.
   */
  readonly threads?: number | undefined;
  /** For tests: no front; the exact fill, otherwise the last resort, fills the whole region. */
  readonly exactFillOnly?: boolean | undefined;
}

/** Order of the elements of a mesh. */
export interface OrderOptions {
  /**
   * 2 for second-order elements: `curvedEdges` of the mesh then has the middle nodes of edges that follow curved faces of CAD files,
   * and `secondOrder` of the report the shapes of the elements. Edges of triangles without such faces stay straight. `writeMesh` has an
   * option of the same name. Default 1.
   */
  readonly elementOrder?: ElementOrder | undefined;
}

/** Options of `meshProject`. */
export interface ProjectMeshOptions extends MeshOptions, OrderOptions {
  /**
   * Results of `prepareBody` for bodies that have not changed since, with the same sizes. The others are prepared by the
   * run.
   */
  readonly preparedBodies?: readonly PreparedBody[] | undefined;
}

/** What becomes of the triangles of a surface before it is filled. */
export const SURFACE_TREATMENTS = ["auto", "keep", "refine", "remesh"] as const;
/** One of `SURFACE_TREATMENTS`. */
export type SurfaceTreatment = (typeof SURFACE_TREATMENTS)[number];

/** Options of `meshSurface`. */
export interface SurfaceMeshOptions extends MeshOptions, OrderOptions, RemeshSettings {
  /**
   * What becomes of the triangles. Default `auto`, for CAD files `remesh`.
   *
   * - `auto`: fit triangles are kept, and split if they are far larger than the sizes, or than small ones near them permit; fine cracks between them are welded. If
   *   too many are needles, closed shells touch or intersect, an option of the remeshing is given, or elements beside them
   *   are poor because they are large for the thickness of the body, all are replaced, and
   *   the surface is repaired before if that changes nothing visible.
   * - `keep`: all are kept.
   * - `refine`: those larger than the target size are split; without sizes, those larger than small ones near them permit.
   * - `remesh`: all are replaced by well-shaped ones; the surface is repaired before if it cannot be filled.
   */
  readonly surface?: SurfaceTreatment | undefined;
  /**
   * Repair the surface first: weld nodes with the same position, remove degenerate and duplicate triangles, flip triangles
   * outward, and resolve the rest as `resolveIntersections` of `repairSurface` does.
   */
  readonly repair?: boolean | undefined;
  /** Repair the surface, and weld nodes within this distance. */
  readonly weld?: number | undefined;
  /** Repair the surface, and fill holes of at most this many edges, no others. */
  readonly fillHoles?: number | undefined;
  /** Split patches at edges that are sharper than this angle in degrees; `true` for 40. Default: patches stay. */
  readonly splitPatches?: boolean | number | undefined;
}

/** Options of `sampleCurvature`. */
export interface CurvatureOptions {
  /** Rows and columns of the lattice of a curved patch, 1 to 384, by default 24: the time grows with their square. */
  readonly cells?: number | undefined;
}
