/**
 * The mesh: triangles, tetrahedra, or both, with the names of their patches and regions. Every reader returns one, every call
 * takes it or a part of it. Its arrays survive `structuredClone`; between threads, typed arrays are transferred and not
 * copied.
 */
import type { Placement } from "../base/placement.js";
import type { LengthUnit } from "./units.js";

/** Triangles or tetrahedra of one kind: a patch with its boundary condition, or a region with its material. */
export interface MeshGroup {
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

/** Values at the nodes, such as sizes, or of the tetrahedra. */
export interface NodeData {
  /** Number of values per node or tetrahedron. */
  readonly components: number;
  readonly values: Float64Array;
}

/** Regions on the sides of the triangles of a surface. */
export interface SurfaceRegions {
  readonly regions: readonly MeshGroup[];
  /**
   * Two per triangle: index in `regions` of the region from which its nodes are seen clockwise, and of that from which they are
   * seen counter-clockwise; `NO_REGION` where nothing is meshed. In either order, unless they are `areMeshed`.
   */
  readonly triangleRegions: Uint32Array;
  /** Whether these regions are what is meshed, whatever `innerShells` is. Default false: they only name what is found. */
  readonly areMeshed?: boolean | undefined;
  /** Per region that is meshed: largest volume of a tetrahedron, in cubed model units; 0 for no limit. May be shorter. */
  readonly maxVolumes?: Float64Array | undefined;
}

/** Order of the elements of a written file: 2 adds a node at the middle of every edge. */
export type ElementOrder = 1 | 2;

/** Edges whose middle nodes are not halfway between their ends. */
export interface CurvedEdges {
  /** Two node indices per edge, in either order; each edge once. */
  readonly edges: Uint32Array;
  /** x y z of the middle node per edge. */
  readonly middles: Float64Array;
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

/**
 * The faces of a solid of a CAD file as surfaces with loops of edges, and triangles near them. A mesh of the file gets its nodes on them.
 */
export interface TrueFaces {
  /** Surfaces, curves and faces, in the form that the engine reads. Opaque. */
  readonly numbers: Float64Array;
  /** x y z per node of the triangles. */
  readonly points: Float64Array;
  /** u v per node. */
  readonly parameters: Float64Array;
  /** Three nodes each. */
  readonly triangles: Uint32Array;
  /** Per triangle: index of its face. */
  readonly faces: Uint32Array;
  /** Number of faces. */
  readonly faceCount: number;
  /** Where the faces are in the mesh, if it was converted to another unit or moved. */
  readonly placement?: Placement | undefined;
}

/**
 * Triangles and tetrahedra with their patches and regions, and the values at their nodes. A surface has no tetrahedra; it is
 * ready to be meshed if its nodes are welded, as those of `readSurface` are.
 */
export interface Mesh {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Three node indices per triangle. On the boundary of tetrahedra made here, they are counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
  /** Per triangle: index in `patches`. */
  readonly trianglePatch: Uint32Array;
  /** Tags, colours, solids or groups of a file; one patch if it has none. */
  readonly patches: readonly MeshGroup[];
  /** Four node indices per tetrahedron, a b c d with (b-a)×(c-a)·(d-a) > 0. */
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: index in `regions`. */
  readonly tetrahedronRegion: Uint32Array;
  readonly regions: readonly MeshGroup[];
  /** By name, as in the file. */
  readonly nodeData: ReadonlyMap<string, NodeData>;
  /**
   * Values of the tetrahedra by name, as in the file (VTU, VTK, MSH), without the tags of regions. In a written file, triangles have the
   * values of the tetrahedra behind them.
   */
  readonly elementData?: ReadonlyMap<string, NodeData> | undefined;
  /**
   * In the result of a run, two per triangle: index in `regions` of the region from which its nodes are seen clockwise, and of
   * that from which they are seen counter-clockwise (`NO_REGION` except for interfaces). Empty until the boundary is known to be
   * closed.
   */
  readonly triangleRegions?: Uint32Array | undefined;
  /** Edges of second-order elements that are not straight (`curveMesh`); files of order 2 get their middle nodes. */
  readonly curvedEdges?: CurvedEdges | undefined;
  /** Regions between the triangles, if they are known without tetrahedra. */
  readonly surfaceRegions?: SurfaceRegions | undefined;
  /**
   * Per triangle, if the mesh was made from another one (`repairSurface`, `refineSurface`, `remeshSurface`): its index there,
   * by which messages name it, or `NO_ORIGIN`. Default: its own index.
   */
  readonly origin?: Uint32Array | undefined;
  /** The same per node. */
  readonly nodeOrigin?: Uint32Array | undefined;
  /**
   * Points of its file that mark regions and holes of a surface. It is not meshed until `locateRegions` has used them. If
   * the file's format has such points, but the file has none, both lists are empty, and closed shells inside a region are
   * regions unless `innerShells` says otherwise.
   */
  readonly regionPoints?: RegionPoints | undefined;
  /** The faces of each solid of the CAD file from which a surface was read, in the order of `surfaceRegions`. */
  readonly trueFaces?: readonly TrueFaces[] | undefined;
  /** Edges of triangles that bend, if the nodes were placed on true faces: `curveMesh` makes second-order elements follow them. */
  readonly trueEdges?: CurvedEdges | undefined;
  /** Unit of the coordinates, if the file or the options of reading define one; they are converted to it. */
  readonly unit?: LengthUnit | undefined;
  /** Format and version as stated by the file, if the file's name does not decide: "Gmsh 2.2". */
  readonly format?: string | undefined;
  /** Whether all points differ, so that exact welding changes nothing. Default false. */
  readonly isWelded?: boolean | undefined;
  /** Whether the format lists each triangle by its positions, as STL does: nodes are shared because they are equal. */
  readonly isSoup?: true | undefined;
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
  /** Names of regions whose location the file does not define; they are lost. */
  readonly unlocatedRegions?: readonly string[] | undefined;
  /** Sentences about other content of the file that was ignored and may matter. */
  readonly notes?: readonly string[] | undefined;
}

/** The part of a mesh that a call about its triangles needs, and whatever else is known of it. */
export type SurfaceInput = Pick<Mesh, "points" | "triangles"> & PartialMesh;

/** The part of a mesh that a call about its tetrahedra needs, and whatever else is known of it. */
export type VolumeInput = Pick<Mesh, "points" | "tetrahedra"> & PartialMesh;

/** Mesh whose parts may all be missing: without groups, its triangles are in one patch, its tetrahedra in one region. */
export type PartialMesh = { readonly [Part in keyof Mesh]?: Mesh[Part] | undefined };

/** Returns whether a reader gave the name to a solid or a region without one. */
export const isNumberedSolid = (name: string): boolean => /^(solid|region) \d+$/.test(name);
