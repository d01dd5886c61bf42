/**
 * A project, as the app edits and saves it (docs/FORMAT.md). `schema.ts` checks files against these types.
 */
import type { FeatureFailure } from "../cad/features/feature.js";
import type { SolidFeature } from "./feature-schema.js";
import type { Placement } from "../base/placement.js";
import type {
  FrontOrder,
  InnerShells,
  LineType,
  Interior,
  Optimization,
  PatchType,
  REPAIR_KINDS,
  SourceType,
} from "../generated/constants.js";

/** In the field `format` of every project file. */
export const PROJECT_FORMAT = "tetrafront-project";
/** What is done to the triangles of a body before it is filled. */
export const BODY_SURFACES = ["remesh", "refine", "keep"] as const;
/** Kinds of entities that a group may hold. A patch may be drawn or belong to a body. */
export const GROUP_KINDS = ["point", "line", "patch", "body", "source"] as const;
/** Kinds of entities whose numbers may have expressions. */
export const EXPRESSION_KINDS = ["point", "body", "background-node", "source"] as const;

/** Kinds of problems: heat conduction, linear elasticity, advection with diffusion. */
export const PROBLEM_KINDS = ["heat", "elasticity", "advection"] as const;
/** Conditions on a patch: two of heat and advection, two of elasticity. */
export const CONDITION_KINDS = ["value", "flux", "fixed", "traction"] as const;

/** The id of a point; positive, unique among points. */
export type PointId = number;
/** The id of a line; positive, unique among lines. */
export type LineId = number;
/** The id of a patch; positive, unique among drawn patches and those of bodies. */
export type PatchId = number;
/** The id of a body; positive, unique among bodies. */
export type BodyId = number;
/** The id of a source; positive, unique among sources. */
export type SourceId = number;

/** A point and its position in model units. */
export interface ProjectPoint {
  readonly id: PointId;
  readonly name?: string | undefined;
  readonly position: readonly [number, number, number];
}

/** A line and its points. */
export interface ProjectLine {
  readonly id: LineId;
  readonly name?: string | undefined;
  readonly type: LineType;
  /**
   * Points along the line: two for a straight line; start, middle and end of a parabola; start, a point between and end of an
   * arc; three points of a circle and the first again; three or more for a spline, or four or more if the last equals the
   * first, which closes it; two or more for a Hermite line, which closes in the same way.
   */
  readonly points: readonly PointId[];
  /** Tangent at the start of a spline or Hermite line, in the line's direction, of any length but zero. */
  readonly startTangent?: readonly [number, number, number] | undefined;
  /** Tangent at its end, in the line's direction. */
  readonly endTangent?: readonly [number, number, number] | undefined;
}

/** A patch and the loops of lines that bound it. */
export interface ProjectPatch {
  readonly id: PatchId;
  readonly name?: string | undefined;
  readonly type: PatchType;
  /**
   * Outer loop first, then holes; of a tube, its two rims; of a loft, its outer loop, then its sections, one line each. Lines are in
   * order; a negative id traverses its line from the last point to the first.
   */
  readonly loops: readonly (readonly LineId[])[];
}

/** A patch of a body; its id differs from those of drawn patches. */
export interface ProjectBodyPatch {
  readonly id: PatchId;
  readonly name?: string | undefined;
  /** Red, green and blue from 0 to 1, in sRGB, as in the file of the body. */
  readonly color?: readonly [number, number, number] | undefined;
  /** Name of the solid that the patch bounds, in a body of several solids. */
  readonly solid?: string | undefined;
  /** The face of a feature from which the patch comes: `3/top` is the top of feature 3. */
  readonly origin?: string | undefined;
}

/** What is done to the triangles of a body before it is filled. */
export type BodySurface = (typeof BODY_SURFACES)[number];

/** How the triangles of a body are remeshed, as in `RemeshOptions`. */
export interface BodyRemeshing {
  readonly size?: number | undefined;
  readonly minSize?: number | undefined;
  readonly maxSize?: number | undefined;
  readonly tolerance?: number | undefined;
  readonly featureAngle?: number | undefined;
  readonly anglePerEdge?: number | undefined;
  readonly layers?: number | undefined;
  readonly dropDetails?: number | undefined;
  readonly growth?: number | undefined;
}

/** Where a body is: its points are scaled, then rotated, then moved. */
export type BodyPlacement = Placement;

/** Changes of one kind that were made to the given surface of a body. */
export interface BodyRepair {
  readonly kind: (typeof REPAIR_KINDS)[number];
  readonly count: number;
  /** Positions of the first changes, in the coordinates of the given points. */
  readonly positions: readonly (readonly [number, number, number])[];
}

/** A closed triangulated surface beside what is drawn; see `createBody` and `bodySurface`. */
export interface ProjectBody {
  readonly id: BodyId;
  readonly name?: string | undefined;
  /** Nodes of the given triangles: base64 of x y z per node, as little-endian doubles. */
  readonly points: string;
  /** Given triangles: base64 of three node indices each, as little-endian 32-bit integers. */
  readonly triangles: string;
  /** Base64 of the index in `patches` of each triangle; may be omitted if there is one patch. */
  readonly trianglePatch?: string | undefined;
  readonly patches: readonly ProjectBodyPatch[];
  /** Default: remesh. */
  readonly surface?: BodySurface | undefined;
  readonly remeshing?: BodyRemeshing | undefined;
  readonly placement?: BodyPlacement | undefined;
  /** The features from which the solid is made; its triangles and faces are what they have given. */
  readonly features?: readonly SolidFeature[] | undefined;
  /** The features that were left out, and why. */
  readonly failures?: readonly FeatureFailure[] | undefined;
  /** Whether the features were changed after the triangles were made of them. */
  readonly isOutdated?: boolean | undefined;
  /** Base64 of the faces of the CAD file of the body, on which a remeshed surface gets its nodes. */
  readonly trueFaces?: string | undefined;
  /** What repairs have changed in the given surface; for information. */
  readonly repairs?: readonly BodyRepair[] | undefined;
  /** Largest distance by which the repairs moved a node, summed over repairs, in the coordinates of the given points. */
  readonly repairDeviation?: number | undefined;
}

/** A node of the background grid, with the target size there. */
export interface ProjectBackgroundNode {
  readonly id: number;
  readonly position: readonly [number, number, number];
  /** Target edge length in model units. */
  readonly size: number;
  /** Target edge length along `direction`, divided by `size`. */
  readonly stretching?: number | undefined;
  /** Direction of stretching; any length except 0. */
  readonly direction?: readonly [number, number, number] | undefined;
  /** Target edge length along `secondDirection`, divided by `size`: elements may be thin in one direction and wide in two. */
  readonly secondStretching?: number | undefined;
  /** Direction of the second stretching, orthogonal to `direction`; any length except 0. */
  readonly secondDirection?: readonly [number, number, number] | undefined;
}

/** A source: at distance r from it, the target size is at most size + growth · max(0, r - distance). */
export interface ProjectSource {
  readonly id: SourceId;
  readonly name?: string | undefined;
  readonly type: SourceType;
  /** One for a point, two for a segment, three for a triangle. */
  readonly positions: readonly (readonly [number, number, number])[];
  /** Target edge length at the source, in model units. */
  readonly size: number;
  /** Default 0. */
  readonly distance?: number | undefined;
  readonly growth?: number | undefined;
  /** The body that the source was painted on. */
  readonly body?: BodyId | undefined;
}

/** The background grid of a project, with its sources. */
export interface ProjectBackground {
  readonly nodes: readonly ProjectBackgroundNode[];
  /** Four node ids per tetrahedron, in either orientation. */
  readonly tetrahedra: readonly (readonly [number, number, number, number])[];
  readonly sources?: readonly ProjectSource[] | undefined;
  /** Positions up to this distance outside the grid count as covered; a fraction of the longest edge of the nearest tetrahedron. */
  readonly coverageMargin?: number | undefined;
}

/** The default mesh settings of a project; options of the caller take precedence. */
export interface ProjectMeshing {
  readonly size?: number | undefined;
  readonly elements?: number | undefined;
  readonly gradation?: number | undefined;
  readonly innerShells?: InnerShells | undefined;
  readonly order?: FrontOrder | undefined;
  readonly optimization?: Optimization | undefined;
  readonly interior?: Interior | undefined;
}

/** A named set of entities; see `GROUP_KINDS`. */
export interface ProjectGroup {
  readonly id: number;
  readonly name: string;
  /** Red, green and blue from 0 to 1, in sRGB. */
  readonly color?: readonly [number, number, number] | undefined;
  readonly members: readonly { readonly kind: (typeof GROUP_KINDS)[number]; readonly id: number }[];
}

/** A named number that expressions use. */
export interface ProjectParameter {
  readonly name: string;
  readonly expression: string;
}

/**
 * What a number of an entity or of the mesh settings is computed from. The value is there, so that only editors evaluate
 * expressions.
 */
export type ProjectExpression =
  | {
      readonly kind: (typeof EXPRESSION_KINDS)[number];
      readonly id: number;
      /** Path of the number in the entity, such as `position.0` or `size`. */
      readonly field: string;
      readonly expression: string;
    }
  | { readonly kind: "meshing"; readonly field: "size"; readonly expression: string };

/** What happens on a patch, drawn or of a body. */
export interface ProjectCondition {
  readonly patch: PatchId;
  readonly kind: (typeof CONDITION_KINDS)[number];
  /** Temperature or concentration (`value`), or inward flux per unit of area (`flux`). Default 0. */
  readonly value?: number | undefined;
  /** Force per unit of area (`traction`). Default 0 0 0. */
  readonly traction?: readonly [number, number, number] | undefined;
}

/**
 * A problem that a solver solves on the mesh, in units that fit together. Meshing ignores it. A patch has at most one condition of heat
 * and advection and one of elasticity; only those of `kind` have an effect.
 */
export interface ProjectProblem {
  readonly kind: (typeof PROBLEM_KINDS)[number];
  /** Of heat. Default 1. */
  readonly conductivity?: number | undefined;
  /** Of advection. Default 0.01. */
  readonly diffusivity?: number | undefined;
  /** Of advection. Default 1 0 0. */
  readonly velocity?: readonly [number, number, number] | undefined;
  /** Of heat or concentration, per unit of volume. Default 0. */
  readonly source?: number | undefined;
  /** Default 210000. */
  readonly youngsModulus?: number | undefined;
  /** Above -1 and below 0.5. Default 0.3. */
  readonly poissonRatio?: number | undefined;
  readonly conditions: readonly ProjectCondition[];
}

/** A model as the app edits and saves it: points, lines, patches, bodies, sizes. */
export interface Project {
  readonly $schema?: string | undefined;
  readonly format: typeof PROJECT_FORMAT;
  readonly version: 2;
  readonly name: string;
  readonly description?: string | undefined;
  /** Label such as "mm"; nothing is converted. */
  readonly units?: string | undefined;
  readonly meshing?: ProjectMeshing | undefined;
  readonly points: readonly ProjectPoint[];
  readonly lines: readonly ProjectLine[];
  readonly patches: readonly ProjectPatch[];
  readonly bodies?: readonly ProjectBody[] | undefined;
  readonly background: ProjectBackground;
  readonly groups?: readonly ProjectGroup[] | undefined;
  readonly parameters?: readonly ProjectParameter[] | undefined;
  readonly expressions?: readonly ProjectExpression[] | undefined;
  readonly problem?: ProjectProblem | undefined;
}

/** Returns all patches in the order of `trianglePatch`: first those drawn, then those of the bodies. */
export function patchesOf({
  patches,
  bodies = [],
}: Pick<Project, "patches" | "bodies">): readonly ProjectBodyPatch[] {
  return bodies.length === 0 ? patches : [...patches, ...bodies.flatMap((body) => body.patches)];
}
