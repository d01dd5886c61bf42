/** Results of the inspection, repair and refinement of given surfaces and meshes. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { Mesh } from "./mesh.js";
import type { QualityReport } from "./quality.js";

/** Position in model units. */
export type Position = readonly [x: number, y: number, z: number];

/** Lengths of edges in model units. */
export interface EdgeLengths {
  readonly shortest: number;
  readonly mean: number;
  readonly longest: number;
}

/** One shell of a surface. An interface between regions belongs to a shell on either side. */
export interface ShellInfo {
  readonly firstTriangle: number;
  readonly triangles: number;
  /** Region on its inner side, as in `tetrahedronRegion`. */
  readonly region: number;
  /** Whether it bounds a cavity of that region. */
  readonly isCavity: boolean;
  /** In squared model units. */
  readonly area: number;
  /** Volume enclosed by this shell alone, in cubed model units, above 0. */
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
 * Result of `inspectSurface`. If coordinates or indices are invalid, only `diagnostics` has content. Triangles with a
 * repeated node have no edges; of duplicate triangles only the first has.
 */
export interface SurfaceInspection {
  /** Whether `fillSurface` would accept the surface: the diagnostics contain no error. */
  readonly isFillable: boolean;
  /** Whether no edge has only one triangle. */
  readonly isClosed: boolean;
  /** Whether no edge has more than two triangles, and the triangles at every node form one fan. */
  readonly isManifold: boolean;
  /** Whether triangles have only shared nodes and edges in common. */
  readonly isEmbedded: boolean;
  /** Number of nodes used by a triangle. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly triangles: number;
  readonly edges: number;
  /** Number of edges with one triangle. */
  readonly openEdges: number;
  /** Number of edges with more than two triangles. */
  readonly nonManifoldEdges: number;
  /** Number of nodes at which the surface touches itself. */
  readonly nonManifoldNodes: number;
  /**
   * Number of triangles that face inward. If all triangles of a component do, `fillSurface` flips them and reports it;
   * single ones are errors. Known if nothing else prevents the surface from being filled.
   */
  readonly flippedTriangles: number;
  /** Number of regions; known if `isFillable`. */
  readonly regions: number;
  /** Number of cavities; known if `isFillable`. */
  readonly cavities: number;
  /** Bounding box of the used nodes; null if there are none. */
  readonly box: { readonly low: Position; readonly high: Position } | null;
  /** In squared model units. */
  readonly area: number;
  /** Volume of all regions without their cavities, in cubed model units; known if `isFillable`. */
  readonly volume: number;
  readonly edgeLengths: EdgeLengths;
  /** In the order of their first triangles; known if `isFillable`. */
  readonly shells: readonly ShellInfo[];
  /** Up to ten triangles, those with the smallest radius ratio first. */
  readonly worst: readonly TriangleQuality[];
  /**
   * All problems, as a run would report them: the first 1000 of each code, or as many as
   * `InspectionOptions.maxDiagnostics`; the `count` in the data of an error counts all.
   */
  readonly diagnostics: readonly Diagnostic[];
}

/** One change. Indices are those of the given surface, except for the triangles of filled holes. */
export type RepairChange = { readonly position: Position } & (
  | { readonly kind: "welded-node"; readonly node: number; readonly into: number }
  | { readonly kind: "removed-node"; readonly node: number }
  | { readonly kind: "removed-triangle"; readonly triangle: number }
  | { readonly kind: "removed-duplicate"; readonly triangle: number; readonly sameAs: number }
  /** Its corners were collinear; the triangle `beyond` was split at the middle corner. */
  | { readonly kind: "split-triangle"; readonly triangle: number; readonly beyond: number }
  /** Indices in the result. */
  | { readonly kind: "filled-hole"; readonly firstTriangle: number; readonly triangles: number }
  | { readonly kind: "flipped-triangle"; readonly triangle: number }
  /** It intersected others; this many triangles of the result are parts of it. */
  | { readonly kind: "resolved-intersection"; readonly triangle: number; readonly parts: number }
  /** It enclosed nothing, or was inside. */
  | { readonly kind: "removed-sheet"; readonly triangle: number }
);

/** Volume that two given regions shared. */
export interface SharedVolume {
  /** Numbers of the regions: the one that got the volume, and the other one. */
  readonly regions: readonly [first: number, second: number];
  /** Whether the first one lies inside the other as a whole. */
  readonly isNested: boolean;
  readonly volume: number;
  /** Mean width of its largest part, in model units. */
  readonly depth: number;
  /** A position on the boundary of this part. */
  readonly position: Position;
}

/** Repaired surface. Inspect it: it may still have problems. */
export interface SurfaceRepair {
  /**
   * The repaired surface, with the patches and regions of the given one. Triangles that fill holes form one more patch, the
   * last, named "filled holes".
   */
  readonly mesh: Mesh;
  /** Whether the given regions shared volumes, and were separated. */
  readonly isSeparated: boolean;
  /** Per triangle: its index in the given surface; `NO_ORIGIN` if it fills a hole. */
  readonly origin: Uint32Array;
  /** All changes. */
  readonly changes: readonly RepairChange[];
  /** What regions shared, if the surface has regions: each volume belongs to one of them now. */
  readonly sharedVolumes: readonly SharedVolume[];
  /** Largest distance by which a node was moved, in model units; without the rounding of new nodes. */
  readonly deviation: number;
  /** A warning `unresolved-surface` if triangles that intersect, sheets or open edges were to be resolved, and could not be: why and where. */
  readonly diagnostics: readonly Diagnostic[];
}

/** Surface whose large triangles are split; its shape is the same. */
export interface SurfaceRefinement {
  /** The given points, followed by the midpoints of the split edges; with the patches and regions of the given surface. */
  readonly mesh: Mesh;
  /** Per triangle: index of the given triangle that contains it. */
  readonly origin: Uint32Array;
  /** Number of split edges, including halves that were split again; equals the number of new points. */
  readonly splitEdges: number;
  /** Longest given edge / target length. Above 2, with sizes, `fillSurface` would warn with `coarse-surface`. */
  readonly lengthRatio: number;
}

/** A node of a sharp edge that was moved onto another sharp edge. */
export interface MergedDetail {
  readonly from: readonly [number, number, number];
  readonly onto: readonly [number, number, number];
}

/** Surface with new triangles near the given one. */
export interface SurfaceRemesh {
  /** The new surface, with the patches and regions of the given one. */
  readonly mesh: Mesh;
  /** Per triangle: index of a given triangle near it, in the same patch. */
  readonly origin: Uint32Array;
  /**
   * Per triangle: its distance from the given surface, the largest of seven samples, in model units. For display; `deviation`
   * is the bound.
   */
  readonly triangleDeviation: Float32Array;
  /** Largest target size used, in model units. */
  readonly size: number;
  /** Smallest target size that the shape could ask for, in model units. */
  readonly minSize: number;
  /** Tolerance used, in model units. */
  readonly tolerance: number;
  /**
   * Upper bound of the distance between the two surfaces in both directions, in model units: the tolerance, or more if no
   * smaller bound could be proved. With `onFaces`, the largest distance of the middle of an edge from the faces.
   */
  readonly deviation: number;
  /**
   * Whether the faces of a CAD file were triangulated on their own surfaces. Otherwise the given triangles were changed, and
   * their nodes placed on the faces, if there are any.
   */
  readonly onFaces: boolean;
  /**
   * Numbers of faces that could not be triangulated on their surfaces, counted from 0 over all solids of the file. With `onFaces`,
   * the given triangles were changed only on these faces and beside them.
   */
  readonly failedFaces: readonly number[];
  /**
   * What `dropDetails` changed: each node of a sharp edge that was moved onto another one, from where to where. `deviation`
   * includes these changes.
   */
  readonly mergedDetails: readonly MergedDetail[];
  /** Number of smooth patches of the given surface: feature lines and given patches bound them. */
  readonly patches: number;
  /** Number of feature lines of the given surface, from corner to corner or closed. */
  readonly featureLines: number;
  /** What the given surface encloses, by all of its regions together, in cubed model units. */
  readonly givenVolume: number;
  /** What the new surface encloses, likewise. */
  readonly volume: number;
  /** Smallest angle of all new triangles, in degrees. */
  readonly smallestAngle: number;
  /** Mean of 2 × inradius / circumradius over all new triangles, 1 for equilateral ones. */
  readonly meanRadiusRatio: number;
  /** Whether the call was stopped before all triangles were improved; see `PartialControl`. */
  readonly isPartial: boolean;
  /** How the nodes were placed on the true faces of a CAD file. `tolerance` and `deviation` do not include these moves. */
  readonly placement?: NodePlacement | undefined;
  /** A warning if `deviation` exceeds `tolerance`. */
  readonly diagnostics: readonly Diagnostic[];
}

/** How the nodes of a surface were placed on the faces, edges and vertices of a CAD file. */
export interface NodePlacement {
  /** Number of nodes on them. */
  readonly placed: number;
  /** Number of nodes that stayed near them, because triangles would have folded over, or nothing was near. */
  readonly unplaced: number;
  /** Largest distance by which a node was moved, in model units. */
  readonly largestMove: number;
}

/** Result of `inspectMesh`. */
export interface MeshInspection {
  /** Whether all counts of defects below are 0. */
  readonly isValid: boolean;
  /** Number of nodes used by an element. */
  readonly nodes: number;
  readonly unusedNodes: number;
  readonly tetrahedra: number;
  /** Number of elements with negative volume, or inverted in their file; measured with two of their nodes exchanged. */
  readonly invertedTetrahedra: number;
  /** Number of elements whose volume is exactly 0. */
  readonly degenerateTetrahedra: number;
  /** Number of elements with the same nodes as another. */
  readonly duplicateTetrahedra: number;
  /** Number of faces of more than two elements. */
  readonly nonManifoldFaces: number;
  /** Number of faces whose two elements lie on the same side. */
  readonly overlappingFaces: number;
  /** Number of nodes at the position of another. */
  readonly coincidentNodes: number;
  /** Edge lengths over all elements: an edge counts once for each of its elements. */
  readonly edgeLengths: EdgeLengths;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** In cubed model units. */
  readonly volume: number;
  /** Quality statistics; the target length is the mean of `edgeLengths`. */
  readonly quality: QualityReport;
  /** Faces of one element: three nodes per face, counter-clockwise seen from outside, and its region. */
  readonly boundary: { readonly triangles: Uint32Array; readonly region: Uint32Array };
}
