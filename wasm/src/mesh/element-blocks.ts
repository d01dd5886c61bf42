/** The nodes and tetrahedra of a mesh that stays in the engine, handed out in blocks. */

/** Consecutive tetrahedra of one region. */
export interface RegionRun {
  /** Index in the regions of the mesh. */
  readonly region: number;
  /** Number of tetrahedra. */
  readonly count: number;
}

/**
 * Nodes and tetrahedra of a finished mesh in the engine of its mesher. Lattices inside are made when they are read, so that a mesh
 * may be much larger than the memory. Use it before the mesher is disposed of; a call rejects if the engine is lost.
 */
export interface ElementBlocks {
  /** Number of nodes; those of the boundary come first. */
  readonly nodes: number;
  readonly tetrahedra: number;
  /** The regions of all tetrahedra in order. */
  readonly regionRuns: readonly RegionRun[];
  /** Resolves with x y z of `count` nodes from `first` on, or of those that are left. */
  readonly readPoints: (first: number, count: number) => Promise<Float64Array>;
  /** The same with four node indices per tetrahedron, in the orientation of `Mesh.tetrahedra`. */
  readonly readTetrahedra: (first: number, count: number) => Promise<Uint32Array>;
  /** Frees the memory of the engine; nothing can be read afterwards. */
  readonly release: () => void;
}
