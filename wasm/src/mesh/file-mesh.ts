/** Mesh of a file: the result of every reader and the input of every writer. */
import type { GivenRegions, RegionPoints } from "./mesh.js";
import type { Unit } from "./units.js";

/** Triangles or tetrahedra of one kind: a patch with its boundary condition, or a region with its material. */
export interface FileGroup {
  readonly name: string;
  /** Number in the file; meshes made by this program count from 1. */
  readonly tag: number;
  /** Red, green and blue from 0 to 1. */
  readonly color?: readonly [number, number, number] | undefined;
  /** Whether the tag was chosen while reading, because the file has no numbers: nothing refers to it. */
  readonly isTagChosen?: true | undefined;
}

/**
 * Returns whether readers have named a patch after its colour or attribute. Such a name distinguishes patches; that of the
 * only patch carries no information.
 */
export function isColorName(name: string): boolean {
  return /^(#[0-9a-f]{6}|color \d+|attribute \d+)$/.test(name);
}

/** Values at the nodes, such as sizes. */
export interface NodeData {
  /** Number of values per node. */
  readonly components: number;
  readonly values: Float64Array;
}

/** Regions on the sides of a file's triangles. */
export interface SurfaceRegions {
  readonly regions: readonly FileGroup[];
  /** Two per triangle, in either order: index in `regions` of the region on that side, `NO_REGION` if there is none. */
  readonly triangleRegions: Uint32Array;
}

/** Order of the elements of a written file: 2 adds a node at the middle of every edge. */
export type ElementOrder = 1 | 2;

/** Triangles and tetrahedra of a file, with their groups and the values at their nodes. */
export interface FileMesh {
  /** Format and version as stated by the file, if the file's name does not decide: "Gmsh 2.2". */
  readonly format?: string | undefined;
  /** Unit of the coordinates, if the file or the options of reading define one; they are converted to it. */
  readonly unit?: Unit | undefined;
  /** x y z per node. */
  readonly points: Float64Array;
  /** Whether all points differ, so that exact welding changes nothing. Default false. */
  readonly isWelded?: boolean | undefined;
  /** Whether the format lists each triangle by its positions, as STL does: nodes are shared because they are equal. */
  readonly isSoup?: true | undefined;
  /** Three node indices per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: index in `patches`. */
  readonly trianglePatch: Uint32Array;
  readonly patches: readonly FileGroup[];
  /** Four node indices per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: index in `regions`. */
  readonly tetrahedronRegion: Uint32Array;
  /**
   * Number of tetrahedra whose nodes the reader reordered to make the volume positive. If it is all of them, the
   * file uses the opposite node order.
   */
  readonly reversedTetrahedra?: number | undefined;
  /**
   * Tetrahedra whose node order in the file is opposite to that of most others: inverted elements, which a valid
   * mesh does not have. Here their order is corrected; `inspectMesh` counts them as they are in the file.
   */
  readonly invertedTetrahedra?: Uint32Array | undefined;
  /** Number of repeated listings of a tetrahedron, for another group. It is kept once, in its first group. */
  readonly duplicateTetrahedra?: number | undefined;
  /** Number of repeated listings of a triangle. It is kept once, in its first group. */
  readonly duplicateTriangles?: number | undefined;
  readonly regions: readonly FileGroup[];
  /** Regions between the triangles, if the file defines them without tetrahedra. */
  readonly surfaceRegions?: SurfaceRegions | undefined;
  /** Regions on the sides of the triangles, if what is meshed follows from them alone. */
  readonly givenRegions?: GivenRegions | undefined;
  /** Names of regions whose location the file does not define; they are lost. */
  readonly unlocatedRegions?: readonly string[] | undefined;
  /** Points that mark the regions and holes of a surface, if the format has them. */
  readonly regionPoints?: RegionPoints | undefined;
  /** Sentences about other content of the file that was ignored and may matter. */
  readonly notes?: readonly string[] | undefined;
  /** By name, as in the file. */
  readonly nodeData: ReadonlyMap<string, NodeData>;
}

/** Returns whether a reader gave the name to a solid or a region without one. */
export const isNumberedSolid = (name: string): boolean => /^(solid|region) \d+$/.test(name);
