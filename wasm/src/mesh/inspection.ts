/** Results of the inspection, repair and refinement of given surfaces and meshes. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { SurfaceInput } from "./mesh.js";
import type { QualityReport } from "./quality.js";

/** In model units. */
export type Position = readonly [x: number, y: number, z: number];

/** Lengths of edges in model units. */
export interface EdgeLengths {
  readonly shortest: number;
  readonly mean: number;
  readonly longest: number;
}

/** One closed, connected part of a surface. A wall between bodies belongs to one on either side. */
export interface ShellInfo {
  readonly firstTriangle: number;
  readonly triangles: number;
  /** The body on its inner side, as in `VolumeMesh.regions`. */
  readonly region: number;
  /** Whether it bounds a void within that body. */
  readonly isCavity: boolean;
  /** In squared model units. */
  readonly area: number;
  /** Enclosed by this shell alone, in cubed model units, above 0. */
  readonly volume: number;
}

/** One triangle of a surface. */
export interface TriangleQuality {
  readonly triangle: number;
  /** Its centroid. */
  readonly centroid: Position;
  readonly area: number;
  /** Degrees. */
  readonly smallestAngle: number;
  /** 2 × inradius / circumradius, 1 for the equilateral triangle. */
  readonly radiusRatio: number;
}

/**
 * What `inspectSurface` finds. Where coordinates or indices are broken only `diagnostics` tells. Triangles with a node
 * twice make no edges, and of those with the same nodes only the first does.
 */
export interface SurfaceInspection {
  /** Whether `fillSurface` would accept the surface: no error is among the diagnostics. */
  readonly isFillable: boolean;
  /** No edge has one triangle only. */
  readonly isClosed: boolean;
  /** No edge has more than two triangles, and at every node they form one fan. */
  readonly isManifold: boolean;
  /** No two triangles meet but in common corners and edges. */
  readonly isEmbedded: boolean;
  /** That triangles use. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly triangles: number;
  readonly edges: number;
  /** With one triangle. */
  readonly openEdges: number;
  /** With more than two. */
  readonly nonManifoldEdges: number;
  /** Where the surface touches itself in a point. */
  readonly nonManifoldNodes: number;
  /**
   * Triangles that do not face outward. Where a whole part of the surface is so, filling sets it right and says so;
   * single ones are errors. Known where nothing else keeps the surface from being filled.
   */
  readonly flippedTriangles: number;
  /** Known where `isFillable`. */
  readonly regions: number;
  /** Known where `isFillable`. */
  readonly cavities: number;
  /** Of all nodes in use; null without any. */
  readonly box: { readonly low: Position; readonly high: Position } | null;
  /** In squared model units. */
  readonly area: number;
  /** Of all bodies without their cavities, in cubed model units; known where `isFillable`. */
  readonly volume: number;
  readonly edgeLengths: EdgeLengths;
  /** By their first triangles; known where `isFillable`. */
  readonly shells: readonly ShellInfo[];
  /** Up to ten triangles, by radius ratio, the worst first. */
  readonly worst: readonly TriangleQuality[];
  /**
   * Everything that is wrong, as a run would tell it: of each code the first thousand, or as many as
   * `InspectionOptions.findings` asks for; the `count` of an error's data is of them all.
   */
  readonly diagnostics: readonly Diagnostic[];
}

/** One change. Numbers are positions in the given surface, but for the triangles of filled holes. */
export type RepairChange = { readonly position: Position } & (
  | { readonly kind: "welded-node"; readonly node: number; readonly into: number }
  | { readonly kind: "removed-node"; readonly node: number }
  | { readonly kind: "removed-triangle"; readonly triangle: number }
  | { readonly kind: "removed-duplicate"; readonly triangle: number; readonly sameAs: number }
  /** It had its corners on one line; the triangle beyond was split where the middle one lies. */
  | { readonly kind: "split-triangle"; readonly triangle: number; readonly beyond: number }
  /** Positions in the result. */
  | { readonly kind: "filled-hole"; readonly firstTriangle: number; readonly triangles: number }
  | { readonly kind: "flipped-triangle"; readonly triangle: number }
);

/** A surface after its repair, which is to be inspected: nothing is promised about it. */
export interface SurfaceRepair {
  readonly surface: SurfaceInput;
  /** Per triangle: its position in the given surface; `NO_ORIGIN` for one that fills a hole. */
  readonly origin: Uint32Array;
  /** Every one. */
  readonly changes: readonly RepairChange[];
}

/** A surface whose large triangles are divided: the same shape. */
export interface SurfaceRefinement {
  /** The given points, then the middles of the edges that were halved. */
  readonly surface: SurfaceInput;
  /** Per triangle: the position of the given triangle that it is a part of. */
  readonly origin: Uint32Array;
  /** How many edges were halved, halves of halves counted too; as many points are new. */
  readonly splitEdges: number;
}

/** What `inspectMesh` finds. */
export interface MeshInspection {
  /** None of the counts of defects below is above 0. */
  readonly isValid: boolean;
  /** That elements use. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly tetrahedra: number;
  /** With a negative volume, or inverted in their file; measured as if two of their nodes were exchanged. */
  readonly invertedTetrahedra: number;
  /** Without volume, exactly. */
  readonly degenerateTetrahedra: number;
  /** With the nodes of another. */
  readonly duplicateTetrahedra: number;
  /** Of more than two elements. */
  readonly nonManifoldFaces: number;
  /** Faces whose two elements lie on the same side. */
  readonly overlappingFaces: number;
  /** Nodes at the place of another. */
  readonly coincidentNodes: number;
  /** Over all elements: an edge counts once for each of its elements. */
  readonly edgeLengths: EdgeLengths;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** In cubed model units. */
  readonly volume: number;
  /** The mean of `edgeLengths` is the wanted length. */
  readonly quality: QualityReport;
  /** Faces of one element: three nodes each, counter-clockwise seen from outside, and a region each. */
  readonly boundary: { readonly triangles: Uint32Array; readonly region: Uint32Array };
}
