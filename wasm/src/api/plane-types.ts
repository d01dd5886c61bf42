/** What `fillPlane` takes and returns. */
import type { FrontOrder } from "../generated/constants.js";
import type { FrontExperiment } from "../trace/experiment.js";
import type { PlanarFront, PlanePosition } from "../trace/surface-steps.js";
import type { SurfaceTrace } from "../trace/surface-trace.js";

/** The corners of a closed polygon, in either orientation: x y x y …, or pairs. The last corner is joined to the first. */
export type PlaneLoop = Float64Array | readonly PlanePosition[];

/** A point near which triangles are small: at the distance r from it, at most size + growth max(0, r - distance). */
export interface PlaneSource {
  readonly position: PlanePosition;
  readonly size: number;
  /** Distance up to which `size` applies. Default 0. */
  readonly distance?: number | undefined;
  /** Growth of the size per unit of distance beyond. Default 0.3. */
  readonly growth?: number | undefined;
}

/** A point at which the target triangle is known. Between such points, it is interpolated; far from all, it is that of the nearest. */
export interface PlaneNode {
  readonly position: PlanePosition;
  /** Target edge length across `direction`. */
  readonly size: number;
  /** Target edge length along `direction` / `size`, at least 1. Default 1. */
  readonly stretching?: number | undefined;
  /** Direction of the stretching, of any length but 0. Default [1, 0]. */
  readonly direction?: PlanePosition | undefined;
}

/** Target sizes: one size, or what background grids and sources are in a project. */
export type PlaneSizes =
  | number
  | { readonly size: number; readonly sources?: readonly PlaneSource[] | undefined }
  | { readonly nodes: readonly PlaneNode[]; readonly sources?: readonly PlaneSource[] | undefined };

/** Options of `fillPlane`. By default, the polygon is filled as a drawn planar patch is. */
export interface FillPlaneOptions {
  /**
   * Order in which edges become base edges. Default `layered`, that of every patch: the smallest first, in classes of a factor of
   * √2, and within a class layer by layer. `smallest-first`: the shortest, as in the paper; `first-in`: the oldest; `random`.
   */
  readonly order?: FrontOrder | undefined;
  /** A whole number from 0 to 2³² − 1, of the order `random`. Default 0. */
  readonly seed?: number | undefined;
  /** Whether segments are `divided` into sides by the sizes, or are sides as they are `given`. Default `divided`. */
  readonly boundary?: "divided" | "given" | undefined;
  /** Whether the triangulation is improved after the front. Default true. */
  readonly improve?: boolean | undefined;
  /** Factor of the height of the ideal point over its base edge, from 0.1 to 10. Default 1. */
  readonly height?: number | undefined;
  /** Number of base edges after which the front is stopped; 0 only divides the boundary. Default 100 000. */
  readonly maxSteps?: number | undefined;
  /** Changes to the rules of the front. */
  readonly experiment?: PlaneExperiment | undefined;
}

/** Changes to the rules of the front; those of `FrontExperiment` for edges instead of faces. */
export type PlaneExperiment = Pick<FrontExperiment, "relaxation" | "tolerance">;

/** A polygon that was filled. */
export interface FilledPlane {
  readonly success: true;
  /** `stalled`: the front has left a part of the polygon empty. `stopped`: it has made `maxSteps` steps. */
  readonly status: "done" | "stalled" | "stopped";
  /** The steps of the sides and of the front, as a trace has them; line i is segment i, and the only patch is the polygon. */
  readonly trace: SurfaceTrace;
  /** The only front of the trace. Its plane has the coordinates of the polygon. */
  readonly front: PlanarFront;
  /** The triangulation, improved if the options say so; nodes of the boundary come first. */
  readonly mesh: PlaneMesh;
  /** 16 hexadecimal digits: hash of the mesh, the same on every machine. */
  readonly fingerprint: string;
}

/** Triangles in the plane. */
export interface PlaneMesh {
  /** x y per node. */
  readonly points: Float64Array;
  /** Three nodes per triangle, counter-clockwise. */
  readonly triangles: Uint32Array;
}

/** A segment runs from a corner to the next one; both count from 0. */
export interface PlaneSegment {
  readonly loop: number;
  readonly segment: number;
}

/**
 * - `no-polygon`: there is no loop, or one has fewer than three corners, or an odd number of coordinates.
 * - `invalid-position`: a coordinate is not finite or too large.
 * - `same-corner`: two neighbouring corners are the same; `segments` has the segment between them.
 * - `crossing`: the two `segments` have more in common than a corner of their loop between them; loops must not touch.
 * - `hole-outside`: the second of the `loops` is not inside the first one.
 * - `nested-holes`: the first of the `loops` is inside the second.
 * - `invalid-size`: sizes are missing, or a size, stretching, direction, distance or growth is out of range.
 * - `too-many-sides`: the sizes ask for more than 10 000 sides; `segments` has the segment on which they became too many.
 */
export type PlaneErrorCode =
  | "no-polygon"
  | "invalid-position"
  | "same-corner"
  | "crossing"
  | "hole-outside"
  | "nested-holes"
  | "invalid-size"
  | "too-many-sides";

/** A polygon that cannot be filled. */
export interface UnfilledPlane {
  readonly success: false;
  readonly code: PlaneErrorCode;
  /** One sentence: what is wrong, and where. */
  readonly message: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;
  /** Indices of the loops that the problem is about, the outer one is 0. */
  readonly loops: readonly number[];
  readonly segments: readonly PlaneSegment[];
}

/** Result of `fillPlane`. Shapes that cannot be filled are expected, and not an exception. */
export type FillPlaneResult = FilledPlane | UnfilledPlane;
