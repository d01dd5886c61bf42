/** What a trace has of lines and patches: all that was ever made, and single steps, decoded when they are asked for. */
import type { EdgeRefusal, PlanarEnd, StationEnd } from "./layout.js";
import type { PlaneSample } from "./surface-events.js";
import type { TracePosition } from "./trace-step.js";

/** x y in the plane of a patch. */
export type PlanePosition = readonly [number, number];

/** One division of a line; a line can be divided again, with other sizes. */
export interface TracedDivision {
  /** Index of the line in the model. */
  readonly line: number;
  /** Position of its first end. */
  readonly begin: TracePosition;
  /** Its first step, and the one that divides the line. */
  readonly firstStep: number;
  readonly lastStep: number;
  /** x y z per station of the walk S1-S4; station i is made by step `firstStep + i`. */
  readonly stations: Float64Array;
  /** x y z per node, both ends included, before sides are halved; empty if the line cannot be divided. */
  readonly nodes: Float64Array;
  /** Length of the line in target sizes. */
  readonly length: number;
}

/** The 2-D front of a patch, in the plane and in space. Numbers of nodes are those of the patch: its boundary's come first. */
export interface PlanarFront {
  /** Index of the patch in the model. */
  readonly patch: number;
  /** Whether the plane is mapped to a curved surface. */
  readonly isCurved: boolean;
  /** Whether the patch is triangulated again, with more nodes of its own. */
  readonly isRepeated: boolean;
  /** The step that lays the boundary out in the plane, and the last step of the patch. */
  readonly firstStep: number;
  readonly lastStep: number;
  readonly boundaryNodes: number;
  /** Number of the surface's nodes on a seam, which belong to the patch alone. */
  readonly seamNodes: number;
  /** x y per node, in the plane. */
  readonly plane: Float64Array;
  /** x y z per node, in space. */
  readonly positions: Float64Array;
  /** Per node of the boundary: its index in the surface. */
  readonly surfaceNodes: Uint32Array;
  /** Two per node of the boundary: 0, or the number plus one of a line of the plane; three nodes of one line are collinear. */
  readonly carriers: Uint32Array;
  /** First and second node per edge ever made; the unmeshed part is on its left. Those of the boundary come first. */
  readonly edges: Uint32Array;
  /** Per edge: step from which on it is part of the front, and first step without it. */
  readonly edgesBorn: Uint32Array;
  readonly edgesDied: Uint32Array;
  /** Three nodes per triangle of the front, counter-clockwise. */
  readonly triangles: Uint32Array;
  /** Per triangle: the step that makes it. Ascending. */
  readonly trianglesBorn: Uint32Array;
  /** Per node: the step that makes it. Ascending. */
  readonly nodesBorn: Uint32Array;
  readonly end: PlanarEnd;
  /** The triangulation after its improvement; null if the run ended before. */
  readonly improved: ImprovedPatch | null;
}

/** The triangulation of a patch after its improvement. Nodes of the boundary have their numbers; the interior ones are new. */
export interface ImprovedPatch {
  /** x y per node, in the plane. */
  readonly plane: Float64Array;
  /** Three nodes per triangle, counter-clockwise. */
  readonly triangles: Uint32Array;
}

/** Steps S1 to S3: how long the next side is. */
export interface StationStep {
  readonly kind: "station";
  readonly step: number;
  /** Index among the divisions. */
  readonly division: number;
  readonly line: number;
  /** S1: target size where the side begins. */
  readonly startSize: number;
  /** S3: length of the side when it is about the target size at its middle. */
  readonly length: number;
  /** Number of averagings in S3. */
  readonly rounds: number;
  readonly end: StationEnd;
  /** Parameter of the line at the station, 0 to 1. */
  readonly parameter: number;
  /** Length of the line up to the station, in target sizes. */
  readonly sides: number;
  readonly from: TracePosition;
  readonly to: TracePosition;
}

/** Step S4: all sides of a line, of equal length in target sizes. */
export interface DivideStep {
  readonly kind: "divided";
  readonly step: number;
  readonly division: number;
  readonly line: number;
  /** Length of the line in target sizes. */
  readonly length: number;
  /** Number of sides; 0 if the line cannot be divided. */
  readonly sideCount: number;
}

/** A side is halved, because the sides of a patch would intersect. */
export interface HalveStep {
  readonly kind: "halved";
  readonly step: number;
  readonly line: number;
  readonly side: number;
  readonly position: TracePosition;
}

/** The boundary of a patch is laid out in its plane. */
export interface PatchStep {
  readonly kind: "patch";
  readonly step: number;
  /** Index among the planar fronts. */
  readonly front: number;
  readonly patch: number;
}

/** A candidate for the third node of a triangle, with the verdict on it. */
export interface EdgeCandidate {
  /** Number of the node; null for a new node that was refused. */
  readonly node: number | null;
  readonly isNew: boolean;
  readonly plane: PlanePosition;
  readonly verdict: "accepted" | EdgeRefusal;
  /** Index of the edge that the triangle would cross, or that the new node is too close to; else null. */
  readonly culprit: number | null;
}

/** A base edge and the candidates tried over it. */
export interface EdgeStep extends PlaneSample {
  readonly kind: "edge";
  readonly step: number;
  readonly front: number;
  readonly patch: number;
  /** Index of the base edge among the edges of the front. */
  readonly edge: number;
  readonly nodes: readonly [number, number];
  /** Number of failed attempts to complete the edge. */
  readonly pass: number;
  /** Classes of a factor of sqrt(2) of the size: lower ones come first. */
  readonly sizeClass: number;
  /** In a class, lower layers come first. */
  readonly layer: number;
  readonly ideal: PlanePosition;
  /** Number of the front's edges near the edge. */
  readonly nearbyEdges: number;
  /** Number of candidates that were ranked, the new node included; only those tried are listed. */
  readonly rankedCandidates: number;
  readonly candidates: readonly EdgeCandidate[];
  readonly outcome: "accepted" | "postponed";
  /** Pass in which a postponed edge comes again; null if it is set aside, or was completed. */
  readonly nextPass: number | null;
  /** Indices of the edges that leave and join the front, and of the triangle made. */
  readonly removedEdges: readonly number[];
  readonly addedEdges: readonly number[];
  readonly triangle: number | null;
}

/** The triangulation of a patch is improved. */
export interface ImproveStep {
  readonly kind: "improved";
  readonly step: number;
  readonly front: number;
  readonly patch: number;
  /** Number of triangles and of interior nodes before and after. */
  readonly trianglesBefore: number;
  readonly triangles: number;
  readonly interiorNodesBefore: number;
  readonly interiorNodes: number;
}

/** One step of the lines and patches. */
export type SurfaceStep = StationStep | DivideStep | HalveStep | PatchStep | EdgeStep | ImproveStep;
