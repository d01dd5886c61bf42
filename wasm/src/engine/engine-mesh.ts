/** The mesh of a run as the engine and the worker hold it: flat arrays, without names. */

/** Boundary of a mesh, its triangles counter-clockwise seen from outside. An interface between two regions exists once. */
export interface EngineSurface {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /**
   * Per triangle: index of its patch in the project, first those drawn, then those of the bodies; for a given surface, its
   * shell.
   */
  readonly trianglePatch: Uint32Array;
  /** As in `Mesh`; empty until the boundary is known to be closed. */
  readonly triangleRegions: Uint32Array;
  readonly sides: Uint32Array;
  readonly sideLine: Uint32Array;
}

export interface EngineVolume {
  /** x y z per node; the nodes of the surface come first, in its order. */
  readonly points: Float64Array;
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: its region, from 0. */
  readonly regions: Uint32Array;
  readonly front: Uint32Array;
}

export interface EngineMesh {
  readonly surface: EngineSurface;
  readonly volume: EngineVolume;
}
