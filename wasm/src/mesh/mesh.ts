/**
 * Surfaces and volume meshes as flat arrays. They survive `structuredClone`; between threads, typed arrays are
 * transferred and not copied.
 */

/** A closed triangle surface: x y z per node, three node positions per triangle, any turning. */
export interface SurfaceInput {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /**
   * Per triangle the number by which messages name it, where the surface was made of another, as by `repairSurface` and
   * `refineSurface`: its number there, `NO_ORIGIN` for none. Default: its position.
   */
  readonly origin?: Uint32Array | undefined;
  /** Per node the same. */
  readonly nodeOrigin?: Uint32Array | undefined;
}

/** A mesh from anywhere: as `VolumeMesh`, but elements may be turned either way. */
export interface MeshInput {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Four node positions per element. */
  readonly tetrahedra: Uint32Array;
  /** One per element; without, all are in region 0. */
  readonly regions?: Uint32Array | undefined;
  /** Elements that were inverted in the file they are from, as `FileMesh` tells; they count as turned. */
  readonly invertedTetrahedra?: Uint32Array | undefined;
}

/**
 * The boundary. Node i is at points[3i..3i+2] of the mesh; triangle t has the nodes
 * triangles[3t..3t+2], counter-clockwise seen from outside. A wall between two regions is there once,
 * turned either way.
 */
export interface SurfaceMesh {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /** Per triangle: position of its patch in the project; for a given surface, its shell. */
  readonly trianglePatch: Uint32Array;
  /**
   * Two per triangle: the region from which its nodes are seen clockwise, and the one from which they
   * are seen counter-clockwise, `NO_REGION` but for walls. Empty until the boundary is known to
   * close.
   */
  readonly triangleRegions: Uint32Array;
  /** Two nodes per side of a divided line; empty for a given surface. */
  readonly sides: Uint32Array;
  /** Per side: position of its line in the project. */
  readonly sideLine: Uint32Array;
}

/** Tetrahedron t has the nodes tetrahedra[4t..4t+3] = a b c d, (b-a)×(c-a)·(d-a) > 0. */
export interface VolumeMesh {
  /** The first nodes are those of the surface, in its order. */
  readonly points: Float64Array;
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: the region it fills, from 0. */
  readonly regions: Uint32Array;
  /** What is left of the front where the mesh is not complete: three nodes per face. */
  readonly front: Uint32Array;
}
