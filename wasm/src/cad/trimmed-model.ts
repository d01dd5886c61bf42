/**
 * Solids as CAD files describe them: faces as trimmed surfaces. The same records as in the engine's header
 * `trimmed_model.h`. All references are indices into the arrays of the same model. Parameters of curves and surfaces
 * are those of OpenCascade and of STEP. Angles are in radians, lengths in millimetres; BREP files have no unit.
 */
import type { Vector } from "../base/vectors.js";

/** Red, green and blue from 0 to 1, in sRGB. */
export type CadColor = readonly [number, number, number];

export type PlaneVector = readonly [number, number];

/** A position and three orthogonal unit axes, which may be left-handed. */
export interface Frame {
  readonly origin: Vector;
  readonly x: Vector;
  readonly y: Vector;
  readonly z: Vector;
}

/** A position of the parameter plane and two orthogonal unit axes, in either orientation. */
export interface PlaneFrame {
  readonly origin: PlaneVector;
  readonly x: PlaneVector;
  readonly y: PlaneVector;
}

/**
 * A B-spline, or a NURBS if it has weights. Knots are flat: one entry per multiplicity, ascending, degree + 1 more than
 * poles. A periodic spline is given over one period or more: poles are repeated.
 */
export interface SplineCurve {
  readonly degree: number;
  readonly knots: Float64Array;
  /** x y z, or u v, per pole. */
  readonly poles: Float64Array;
  /** Positive, one per pole; or empty. */
  readonly weights: Float64Array;
}

/**
 * - `line`: origin + t x
 * - `circle`: origin + radius (cos t x + sin t y)
 * - `ellipse`: origin + radius cos t x + minorRadius sin t y
 * - `spline`: t from knots[degree] to knots[number of poles]
 */
export type Curve<In> =
  | { readonly kind: "line"; readonly frame: In }
  | { readonly kind: "circle"; readonly frame: In; readonly radius: number }
  | { readonly kind: "ellipse"; readonly frame: In; readonly radius: number; readonly minorRadius: number }
  | { readonly kind: "spline"; readonly spline: SplineCurve };

export type SpaceCurve = Curve<Frame>;
/** A curve in the parameter plane (u, v) of a surface. */
export type PlaneCurve = Curve<PlaneFrame>;

/** As SplineCurve in both directions; pole (i, j), the i-th in the direction of u, is the i * vCount + j-th. */
export interface SplineSurface {
  readonly uDegree: number;
  readonly vDegree: number;
  readonly uKnots: Float64Array;
  readonly vKnots: Float64Array;
  readonly poles: Float64Array;
  readonly weights: Float64Array;
}

/**
 * A surface without boundary.
 * - `plane`: origin + u x + v y
 * - `cylinder`: origin + radius (cos u x + sin u y) + v z
 * - `cone`: origin + (radius + v sin halfAngle) (cos u x + sin u y) + v cos halfAngle z
 * - `sphere`: origin + radius cos v (cos u x + sin u y) + radius sin v z
 * - `torus`: origin + (radius + minorRadius cos v) (cos u x + sin u y) + minorRadius sin v z
 * - `extrusion`: profile(u) + v z
 * - `revolution`: profile(v), turned by u about the axis through the origin along z, from x to y
 */
export type FaceSurface =
  | { readonly kind: "plane"; readonly frame: Frame }
  | { readonly kind: "cylinder"; readonly frame: Frame; readonly radius: number }
  | { readonly kind: "cone"; readonly frame: Frame; readonly radius: number; readonly halfAngle: number }
  | { readonly kind: "sphere"; readonly frame: Frame; readonly radius: number }
  | { readonly kind: "torus"; readonly frame: Frame; readonly radius: number; readonly minorRadius: number }
  | { readonly kind: "spline"; readonly spline: SplineSurface }
  | { readonly kind: "extrusion"; readonly frame: Frame; readonly profile: SpaceCurve }
  | { readonly kind: "revolution"; readonly frame: Frame; readonly profile: SpaceCurve };

/** A part of a curve between two vertices, which are the same for a closed edge. Faces share an edge. */
export interface TrimmedEdge {
  /** Undefined for a degenerate edge, which is one vertex in space: a pole or an apex of its surface. */
  readonly curve: number | undefined;
  /** Parameter at the start vertex. */
  readonly first: number;
  /** Parameter at the end vertex, above `first`. */
  readonly last: number;
  readonly start: number;
  readonly end: number;
  /** Largest distance of the curve's ends from the vertices, and of the curve from the surfaces of its faces. */
  readonly tolerance: number;
}

/** An edge in a loop of a face. */
export interface Coedge {
  readonly edge: number;
  /** Whether the loop runs from the edge's end to its start. */
  readonly reversed: boolean;
  /** The edge in the plane (u, v), at the edge's parameter. */
  readonly inPlane: PlaneCurve;
}

/** A part of a surface between loops, in any order. Closed surfaces are cut along a seam: its edge occurs twice. */
export interface TrimmedFace {
  readonly surface: number;
  /** Whether dS/du × dS/dv points into the solid. */
  readonly reversed: boolean;
  readonly loops: readonly (readonly Coedge[])[];
  /** The solid behind the face. */
  readonly solid: number;
  /** The solid before it, if two solids share the face. */
  readonly otherSolid: number | undefined;
  /** Empty if the file has none. */
  readonly name: string;
  /** Its own, or that of its solid. */
  readonly color: CadColor | undefined;
}

/** A solid, or faces that bound none. */
export interface TrimmedSolid {
  readonly isSolid: boolean;
  /** Empty if the file has none. */
  readonly name: string;
  /** Number of its faces that are not among the faces of the model, because their surface cannot be described. */
  readonly missingFaces: number;
}

export interface TrimmedModel {
  /** x y z per vertex. */
  readonly vertices: Float64Array;
  readonly curves: readonly SpaceCurve[];
  readonly surfaces: readonly FaceSurface[];
  readonly edges: readonly TrimmedEdge[];
  /** In the order of the solids; a face that two solids share is among those of the first. */
  readonly faces: readonly TrimmedFace[];
  readonly solids: readonly TrimmedSolid[];
  /** Why faces are missing, and what else was left out: a sentence for each. */
  readonly notes: readonly string[];
}

/** Triangles near the faces of a model, made by the kernel: which face is near a position, and where on it. */
export interface ModelTriangles {
  /** x y z per node. */
  readonly points: Float64Array;
  /** u v per node, on the surface of the face of its triangles. */
  readonly parameters: Float64Array;
  /** Three nodes each, counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
  /** Per triangle: index of its face in the model. */
  readonly faces: Uint32Array;
}

/** Why a file cannot be read as a model. */
export class CadFileError extends Error {
  readonly fileName: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;

  constructor(fileName: string, message: string, remedy: string) {
    super(`${fileName}: ${message}`);
    this.fileName = fileName;
    this.remedy = remedy;
  }
}
