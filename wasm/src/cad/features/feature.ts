/**
 * The features of a solid, as a project file stores them: plain data without classes. Lengths are in the unit of the
 * project, angles in degrees, positions and directions are [x, y, z]. Directions need not be unit vectors.
 */
import type { Vector } from "../../base/vectors.js";

/**
 * What a piece does to the solid of the features before it:
 * - `new`: stands beside it, as a solid of its own
 * - `join`: united with it
 * - `cut`: removed from it
 * - `intersect`: only the common volume remains
 */
export type Operation = "new" | "join" | "cut" | "intersect";

/** A position and the direction z; x is made perpendicular to it, and chosen if it is not given. */
export interface Placement {
  readonly position: Vector;
  readonly axis: Vector;
  readonly x?: Vector | undefined;
}

/**
 * A piece of a loop. An arc runs through its second point; a closed spline returns to its first point, which is given
 * once. The points of a spline with `isEven` are even in its parameter: it is the edge of a face through the same positions. A circle runs counter-clockwise about its axis, or from its first point over the second to the third.
 */
export type LoopCurve =
  | { readonly kind: "line"; readonly points: readonly [Vector, Vector] }
  | { readonly kind: "arc"; readonly points: readonly [Vector, Vector, Vector] }
  | {
      readonly kind: "spline";
      readonly points: readonly Vector[];
      readonly isClosed?: boolean | undefined;
      readonly isEven?: boolean | undefined;
    }
  | { readonly kind: "circle"; readonly center: Vector; readonly axis: Vector; readonly radius: number }
  | { readonly kind: "three-point-circle"; readonly points: readonly [Vector, Vector, Vector] };

/** Curves one after the other: each begins where the one before it ends. */
export type Loop = readonly LoopCurve[];

/** A plane surface within a closed loop, in either direction, with holes. */
export interface Profile {
  readonly outer: Loop;
  readonly holes?: readonly Loop[] | undefined;
}

interface Rotation {
  readonly position: Vector;
  readonly axis: Vector;
  readonly angle: number;
}

/** A curve that is turned about an axis: faces of cylinders, cones, spheres and tori, exactly. */
export type TurnedFace = { readonly curve: LoopCurve } & Rotation;

/**
 * A smooth surface through positions of a patch at equal steps of its parameters. A square has as many rows as columns; in a triangle, each
 * row is one position shorter than the row before.
 */
export interface GridFace {
  readonly grid: "square" | "triangle";
  /** x y z of each position as doubles, little-endian, in base64. */
  readonly positions: string;
}

/** A face of a sewn solid: plane within loops, turned, or through positions. */
export type SewnFace = Profile | TurnedFace | GridFace;

/** What a CAD file or a drawn patch says about a face. */
export interface FaceLook {
  readonly name?: string | undefined;
  /** Red, green and blue from 0 to 1. */
  readonly color?: Vector | undefined;
}

/** The kinds of features that have a piece, which an operation combines with the solid. */
export interface PieceKinds {
  /** The position is the centre of the bottom. */
  readonly box: Placement & { readonly size: Vector };
  /** The position is the centre of the bottom. */
  readonly cylinder: Placement & { readonly radius: number; readonly height: number };
  /** One of the radii may be 0. */
  readonly cone: Placement & {
    readonly radius: number;
    readonly topRadius: number;
    readonly height: number;
  };
  readonly sphere: Placement & { readonly radius: number };
  /** The angle is 360 if it is not given. */
  readonly torus: Placement & {
    readonly majorRadius: number;
    readonly minorRadius: number;
    readonly angle?: number | undefined;
  };
  /** A regular polygon, extruded; its first corner is at the radius in the direction x. */
  readonly prism: Placement & { readonly sides: number; readonly radius: number; readonly height: number };
  /** A box whose top has another length in the direction x, from the low end on; 0 makes it an edge. */
  readonly wedge: Placement & { readonly size: Vector; readonly topLength: number };
  /** The vector is direction and length. */
  readonly extrude: { readonly profile: Profile; readonly vector: Vector };
  readonly revolve: { readonly profile: Profile } & Rotation;
  /** All sections have equally many holes. */
  readonly loft: { readonly sections: readonly Profile[]; readonly isRuled?: boolean | undefined };
  /** The path begins at the profile, and is open. */
  readonly sweep: { readonly profile: Profile; readonly path: Loop };
  /** The solid that faces enclose, which meet along equal curves; and the names and colours of the faces, if any has one. */
  readonly sew: { readonly faces: readonly SewnFace[]; readonly looks?: readonly FaceLook[] | undefined };
  /** The text of a BREP file; and the names and colours of its faces in their order, if the file had any. */
  readonly import: { readonly brep: string; readonly looks?: readonly FaceLook[] | undefined };
  /** The solid of another list of features. */
  readonly boolean: { readonly tool: readonly Feature[] };
}

export type EdgeName = string;
export type FaceName = string;

/** The kinds of features that change the solid. */
export interface ChangeKinds {
  /** The axis points into the material. Without a depth, the hole goes through all. */
  readonly hole: {
    readonly position: Vector;
    readonly axis: Vector;
    readonly diameter: number;
    readonly depth?: number | undefined;
    readonly counterbore?: { readonly diameter: number; readonly depth: number } | undefined;
    readonly countersink?: { readonly diameter: number; readonly angle: number } | undefined;
  };
  readonly fillet: { readonly edges: readonly EdgeName[]; readonly radius: number };
  readonly chamfer: { readonly edges: readonly EdgeName[]; readonly distance: number };
  /** The wall is inside of the faces; without open faces, the solid becomes hollow. */
  readonly shell: { readonly openFaces: readonly FaceName[]; readonly thickness: number };
  /** First turned, then moved. */
  readonly move: { readonly translation?: Vector | undefined; readonly rotation?: Rotation | undefined };
  readonly mirror: {
    readonly position: Vector;
    readonly normal: Vector;
    readonly keepOriginal?: boolean | undefined;
  };
  /** The count includes the original; without features, the whole solid is repeated. */
  readonly "linear-array": {
    readonly step: Vector;
    readonly count: number;
    readonly features?: readonly number[] | undefined;
  };
  /** The angle is that between two neighbours. */
  readonly "circular-array": Rotation & {
    readonly count: number;
    readonly features?: readonly number[] | undefined;
  };
}

interface Common {
  /** A positive integer, unique in its list: the names of faces begin with it. */
  readonly id: number;
  readonly name?: string | undefined;
  /** Whether the feature is left out. */
  readonly isOff?: boolean | undefined;
}

export type Piece = {
  [Type in keyof PieceKinds]: Common & {
    readonly type: Type;
    readonly operation: Operation;
  } & PieceKinds[Type];
}[keyof PieceKinds];

export type Change = {
  [Type in keyof ChangeKinds]: Common & { readonly type: Type } & ChangeKinds[Type];
}[keyof ChangeKinds];

export type Feature = Piece | Change;

export type FeatureOf<Type extends Feature["type"]> = Extract<Feature, { readonly type: Type }>;

/** Why a feature was left out. */
export interface FeatureFailure {
  /** The id of the feature. */
  readonly feature: number;
  readonly message: string;
  readonly remedy: string;
}
