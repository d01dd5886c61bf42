/** Options of the calls of a mesher. */
import type { BackgroundArrays } from "../project/background-arrays.js";

/** What `repairSurface` may change. Without options nothing is moved or added. */
export interface RepairOptions {
  /**
   * Nodes no further apart than this become one, in model units. 0, the default, takes those at the very
   * same place, `false` none.
   */
  readonly weld?: number | false | undefined;
  /** Triangles without area, and all but one of those with the same nodes. Default true. */
  readonly removeTriangles?: boolean | undefined;
  /** Holes of up to so many edges are filled, at most 200. Default 0: none. */
  readonly fillHoles?: number | undefined;
  /** Triangles are turned to agree with each other, and outward where that is known. Default true. */
  readonly orient?: boolean | undefined;
  /** As a run is to take closed parts within others: cavities face the other way. Default "cavities". */
  readonly innerShells?: InnerShells | undefined;
}

/** How a surface is refined: by the sizes that it will be filled with. */
export interface RefineOptions extends MeshOptions {
  /**
   * What the surface encloses, as `inspectSurface` tells it, in cubed model units: then sizes by which the inside would
   * have more tetrahedra than a run makes are refused before anything is divided. Without it only the triangles count.
   */
  readonly volume?: number | undefined;
}

/** How a project is previewed. */
export interface PreviewOptions {
  /** The uniform size that the project will be meshed with: then its grid is not checked. */
  readonly size?: number | undefined;
  /** As among the `MeshOptions`, for what is said about regions and cavities. */
  readonly innerShells?: InnerShells | undefined;
  /** As among the `MeshOptions`: the grid that the project will be meshed with, in place of its own. */
  readonly background?: BackgroundArrays | undefined;
}

/** How a given surface is judged. */
export interface InspectionOptions {
  /**
   * As among the `MeshOptions` it will be filled with: closed parts within a body bound cavities and must be turned so,
   * or regions, which either way will do. Default `cavities`.
   */
  readonly innerShells?: InnerShells | undefined;
  /**
   * Of each code so many findings are listed, and the others counted: a whole number from 1 to a million. Default
   * 1000. Each takes about 0.8 kB of memory and 10 µs.
   */
  readonly maxDiagnostics?: number | undefined;
}

/** How a covering grid is built. */
export interface CoverOptions {
  /** At every node, in model units. Default: a twentieth of the model's diagonal. */
  readonly size?: number | undefined;
  /** Five tetrahedra that fill a box, or a single one. Default `box`. */
  readonly shape?: "box" | "tetrahedron" | undefined;
}

/** What `proposeSizes` looks at. */
export interface ProposalOptions {
  /** The largest size. Default: a twentieth of the model's diagonal. */
  readonly uniform?: number | undefined;
  /** No proposal below this. Default: a fiftieth of the largest. */
  readonly smallest?: number | undefined;
  /** Around a full turn of a curved line or patch; 0 leaves curvature out. Default 24. */
  readonly elementsPerCircle?: number | undefined;
  /** Between opposite patches, across the inside; 0 leaves nearness out. Default 3. */
  readonly elementsPerGap?: number | undefined;
  /** Of the proposed sources, per unit of distance. Default 0.3. */
  readonly growth?: number | undefined;
}

/** What a closed part of the boundary bounds that lies within a body and shares no line with it. */
export type InnerShells = "cavities" | "regions";
/** In which order faces leave the front. */
export type FrontOrder = "layered" | "smallest-first";
/** How much work goes into the shape of the elements after the front. */
export type Optimization = "none" | "fast" | "default" | "thorough";

/** How a project or a surface is meshed. */
export interface MeshOptions {
  /**
   * Element size in model units, from 1e-30 to 1e30. Replaces the nodes and tetrahedra of a project's background grid,
   * not its sources; within a given surface it is the largest. Not together with `background`, unless that has
   * sources only.
   *
   * A given surface is kept: where its triangles are larger than wanted, by this or by a grid or sources, so are
   * the elements beside them (`coarse-surface`), and sizes fall inwards by `growth`, at most 0.5, per unit of
   * distance. `refineSurface` divides them first.
   */
  readonly size?: number | undefined;
  /**
   * Sizes from these nodes and tetrahedra, which must cover the model: in place of those of a project
   * (its sources stay), or of a given surface's own edges, if there are any.
   */
  readonly background?: BackgroundArrays | undefined;
  /** Growth of the size per unit of distance from a given surface's edges, 0 to 10. Default 0.3. */
  readonly growth?: number | undefined;
  /**
   * The most by which sizes of the background grid may grow from one element to the next, above 1 and up to 10;
   * nodes that ask for more are given less. Default 1.3; 0 takes all grids as they are.
   */
  readonly gradation?: number | undefined;
  /**
   * Default `cavities`: parts of the boundary within a body bound empty spaces. With `regions` every
   * space is filled, as a region of its own that fits what is around it.
   */
  readonly innerShells?: InnerShells | undefined;
  /** In which order faces leave the front. Default `layered`; `smallest-first` is the paper's. */
  readonly order?: FrontOrder | undefined;
  /**
   * Whether faces that cannot cross a new element are told from the others cheaply, as the paper does,
   * before the analysis of the rest. Default true; false gives the same mesh, slower, to show what the
   * filters are worth.
   */
  readonly filters?: boolean | undefined;
  /** Default `default`; `none` leaves the mesh as the front made it. */
  readonly optimization?: Optimization | undefined;
  /** For tests: no front; the whole inside goes to the exact fill that otherwise comes last. */
  readonly exactFillOnly?: boolean | undefined;
}
