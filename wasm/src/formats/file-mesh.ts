/** A mesh as files hold it: what every reader makes and every writer takes. */
import type { Project } from "../project-schema.js";
import type { MeshResult } from "../types.js";
import { isPlain } from "./groups.js";
import { carriedRegions, type SurfaceRegions } from "./region-names.js";

/** Triangles or tetrahedra of one kind: a patch with its boundary condition, a region with its material. */
export interface FileGroup {
  readonly name: string;
  /** The number that the format has for it; written from 1 in order where this program made the mesh. */
  readonly tag: number;
  /** Red, green and blue from 0 to 1. */
  readonly color?: readonly [number, number, number] | undefined;
}

/** Numbers at the nodes, such as sizes. */
export interface NodeData {
  /** Numbers per node. */
  readonly components: number;
  readonly values: Float64Array;
}

/** Triangles and tetrahedra as a file holds them, with their groups and the numbers at their nodes. */
export interface FileMesh {
  /** The format and version that the file itself tells, where its name leaves that open: "Gmsh 2.2". */
  readonly format?: string | undefined;
  /** x y z per node. */
  readonly points: Float64Array;
  /** No two points are equal, so that nothing is left to be welded exactly. Default false. */
  readonly isWelded?: boolean | undefined;
  /** Three node positions per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: position in `patches`. */
  readonly trianglePatch: Uint32Array;
  readonly patches: readonly FileGroup[];
  /** Four node positions per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: position in `regions`. */
  readonly tetrahedronRegion: Uint32Array;
  /**
   * So many tetrahedra a reader has turned to make their volumes positive. All of them: the file counts nodes the
   * other way round; some of them: it mixes both ways, as no sound mesh does.
   */
  readonly turnedTetrahedra?: number | undefined;
  readonly regions: readonly FileGroup[];
  /** Where the file tells of spaces between its triangles without tetrahedra in them. */
  readonly surfaceRegions?: SurfaceRegions | undefined;
  /** By name, as in the file. */
  readonly nodeData: ReadonlyMap<string, NodeData>;
}

/** Where the names of a generated mesh come from. */
export interface NameSource {
  /** The project that was meshed. */
  readonly project?: Project | undefined;
  /** The surface that was filled, as `readSurface` gave it; one patch without a name says no more than the shells do. */
  readonly surface?: Pick<FileMesh, "trianglePatch" | "patches" | "surfaceRegions"> | undefined;
}

/**
 * A generated mesh, ready to be written. Its patches are those of the project by name (else "patch 12", by
 * id), those of the given surface, or its shells; its regions those that the surface's file tells of, else numbered.
 * A partial mesh goes as far as it goes.
 */
export function fileMeshOf(
  mesh: Pick<MeshResult, "surface" | "volume">,
  { project, surface: given }: NameSource = {},
): FileMesh {
  const { surface, volume } = mesh;
  const isSame = given !== undefined && given.trianglePatch.length === surface.trianglePatch.length;
  const isKept = isSame && (given.patches.length > 1 || !given.patches.every(isPlain));
  const regionCount = countOf(volume.regions);
  const carried =
    isSame && given.surfaceRegions !== undefined
      ? carriedRegions(mesh, given.surfaceRegions, regionCount)
      : undefined;
  const trianglePatch = isKept ? given.trianglePatch : surface.trianglePatch;
  const names = project === undefined ? [] : patchNames(project);
  const word = project === undefined ? "shell" : "patch";
  return {
    points: volume.points.length > 0 ? volume.points : surface.points,
    triangles: surface.triangles,
    trianglePatch,
    patches: isKept ? given.patches : numbered(word, countOf(trianglePatch), names),
    tetrahedra: volume.tetrahedra,
    tetrahedronRegion: carried?.tetrahedronRegion ?? volume.regions,
    regions: carried?.regions ?? numbered("region", regionCount),
    nodeData: new Map(),
  };
}

/** What to call each patch in a file: its name, else its id. */
export function patchNames(project: Project): string[] {
  return project.patches.map(({ id, name }) => (name === undefined || name === "" ? `patch ${id}` : name));
}

/** Groups "word 1", "word 2", … or with the names given, tagged from 1. */
export function numbered(word: string, count: number, names: readonly string[] = []): FileGroup[] {
  return Array.from({ length: count }, (_, i) => ({ name: names[i] ?? `${word} ${i + 1}`, tag: i + 1 }));
}

/** The number of groups among which these positions point. */
export function countOf(positions: Uint32Array): number {
  return positions.reduce((most, position) => Math.max(most, position + 1), 0);
}
