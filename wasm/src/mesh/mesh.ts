/**
 * Surfaces and volume meshes as flat arrays. They survive `structuredClone`; between threads, typed arrays are
 * transferred and not copied.
 */

/** Regions of a surface that are known before it is meshed. */
export interface GivenRegions {
  /**
   * Two per triangle: the region from which its nodes are seen clockwise, and the region from which they are seen
   * counter-clockwise; `NO_REGION` where nothing is meshed. Numbers may have gaps.
   */
  readonly triangleRegions: Uint32Array;
  /** Per number: largest volume of a tetrahedron, in cubed model units; 0 for no limit. May be shorter. */
  readonly maxVolumes: Float64Array;
}

/** Point that marks a region of a model. */
export interface RegionPoint {
  /** Its number in the file. */
  readonly number: number;
  readonly position: readonly [x: number, y: number, z: number];
  /** Tag of the region: TetGen's attribute. */
  readonly tag: number;
  readonly name?: string | undefined;
  /** Largest volume of a tetrahedron in the region, in cubed model units. */
  readonly maxVolume?: number | undefined;
}

/**
 * Points of a file that mark the regions and holes of a model: every volume that its triangles enclose is a region or a
 * hole.
 */
export interface RegionPoints {
  readonly holes: readonly Pick<RegionPoint, "number" | "position">[];
  readonly regions: readonly RegionPoint[];
}

/** Closed triangle surface: x y z per node, three node indices per triangle, in any orientation. */
export interface SurfaceInput {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /**
   * Per triangle, if the surface was made from another one (`repairSurface`, `refineSurface`, `remeshSurface`): its index
   * there, by which messages name it, or `NO_ORIGIN`. Default: its own index.
   */
  readonly origin?: Uint32Array | undefined;
  /** The same per node. */
  readonly nodeOrigin?: Uint32Array | undefined;
  /** What is meshed, as `locateRegions` finds it; replaces `innerShells`. */
  readonly givenRegions?: GivenRegions | undefined;
  /**
   * Points of its file that mark regions and holes. Such a surface is not meshed until `locateRegions` has used them. If
   * the file's format has such points, but the file has none, both lists are empty, and closed shells inside a region are
   * regions unless `innerShells` says otherwise.
   */
  readonly regionPoints?: RegionPoints | undefined;
}

/** Surface whose triangles belong to patches, for example a `SurfaceFile`. */
export interface PatchedSurface extends SurfaceInput {
  /** Per triangle: index of its patch. If omitted, all triangles are in one patch. */
  readonly trianglePatch?: Uint32Array | undefined;
}

/** Mesh from any source: as `VolumeMesh`, but elements may have either orientation. */
export interface MeshInput {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Four node indices per element. */
  readonly tetrahedra: Uint32Array;
  /** One per element; if omitted, all are in region 0. */
  readonly regions?: Uint32Array | undefined;
  /** Elements that were inverted in their file (see `FileMesh`); they count as inverted. */
  readonly invertedTetrahedra?: Uint32Array | undefined;
}

/**
 * Boundary of a mesh. Node i has the position points[3i..3i+2]; triangle t has the nodes triangles[3t..3t+2],
 * counter-clockwise seen from outside. An interface between two regions exists once, in either orientation.
 */
export interface SurfaceMesh {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /**
   * Per triangle: index of its patch in the project, first those drawn, then those of the bodies; for a given surface, its
   * shell.
   */
  readonly trianglePatch: Uint32Array;
  /**
   * Two per triangle: the region from which its nodes are seen clockwise, and the region from which they are seen
   * counter-clockwise (`NO_REGION` except for interfaces). Empty until the boundary is known to be closed.
   */
  readonly triangleRegions: Uint32Array;
  /** Two nodes per side of a divided line; empty for a given surface. */
  readonly sides: Uint32Array;
  /** Per side: index of its line in the project. */
  readonly sideLine: Uint32Array;
}

/** Volume mesh. Tetrahedron t has the nodes tetrahedra[4t..4t+3] = a b c d with (b-a)×(c-a)·(d-a) > 0. */
export interface VolumeMesh {
  /** x y z per node; the nodes of the surface come first, in its order. */
  readonly points: Float64Array;
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: its region, from 0. */
  readonly regions: Uint32Array;
  /** Faces of the front that remain if the mesh is partial: three nodes per face. */
  readonly front: Uint32Array;
}
