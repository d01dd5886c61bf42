/** A mesh as files hold it: what every reader makes and every writer takes. */
import {
  aNumber,
  arrayOf,
  aString,
  checkArgument,
  listOf,
  objectOf,
  orNothing,
  type Check,
} from "../base/argument-checks.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { plural } from "../base/plural.js";
import type { Project } from "../project/schema.js";
import type { MeshResult } from "../api/types.js";
import { hasPatches } from "./mesh-checks.js";
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
   * other way round.
   */
  readonly turnedTetrahedra?: number | undefined;
  /**
   * Those of which the file counts the nodes the other way round than of most: inverted elements, as no sound mesh has
   * them. Here they are turned; `inspectMesh`, given them, counts them as the file has them.
   */
  readonly invertedTetrahedra?: Uint32Array | undefined;
  /** So many times the file lists a tetrahedron again, for another group; it is held once, in the first. */
  readonly repeatedTetrahedra?: number | undefined;
  /** So many times it lists a triangle again; it is held once, in its first group. */
  readonly repeatedTriangles?: number | undefined;
  readonly regions: readonly FileGroup[];
  /** Where the file tells of spaces between its triangles without tetrahedra in them. */
  readonly surfaceRegions?: SurfaceRegions | undefined;
  /** Names of regions of which the file does not tell where they are, and which are lost therefore. */
  readonly unplacedRegions?: readonly string[] | undefined;
  /** What else of the file is passed over, and counts for something, in sentences. */
  readonly notes?: readonly string[] | undefined;
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
 * A partial mesh goes as far as it goes. Throws a `MesherError` where something is no result, project or surface, or
 * the surface has names for other triangles than were filled.
 */
export function fileMeshOf(mesh: Pick<MeshResult, "surface" | "volume">, names: NameSource = {}): FileMesh {
  checkArgument("mesh", mesh, aMeshResult);
  checkArgument("names", names, aNameSource);
  const { surface, volume } = mesh;
  const { project, surface: given } = names;
  const patchLimit = Math.max(surface.trianglePatch.length, project?.patches.length ?? 0);
  checkArgument("mesh.surface.trianglePatch", surface.trianglePatch, positionsBelow(patchLimit));
  // A partial mesh may have elements of the last of many regions alone.
  const regionLimit = Math.max(volume.regions.length, surface.trianglePatch.length);
  checkArgument("mesh.volume.regions", volume.regions, positionsBelow(regionLimit));
  checkSameSurface(surface.trianglePatch.length, given);
  const isSame = given !== undefined && given.trianglePatch.length === surface.trianglePatch.length;
  const isKept = isSame && (given.patches.length > 1 || !given.patches.every(isPlain));
  const regionCount = countOf(volume.regions);
  const carried =
    isSame && given.surfaceRegions !== undefined
      ? carriedRegions(mesh, given.surfaceRegions, regionCount)
      : undefined;
  const trianglePatch = isKept ? given.trianglePatch : surface.trianglePatch;
  const word = project === undefined ? "shell" : "patch";
  return {
    points: volume.points.length > 0 ? volume.points : surface.points,
    triangles: surface.triangles,
    trianglePatch,
    patches: isKept ? given.patches : numbered(word, countOf(trianglePatch), project && patchNames(project)),
    tetrahedra: volume.tetrahedra,
    tetrahedronRegion: carried?.tetrahedronRegion ?? volume.regions,
    regions: carried?.regions ?? numbered("region", regionCount),
    nodeData: new Map(),
  };
}

/** Patches of other triangles would be lost, or be on the wrong ones. */
function checkSameSurface(triangles: number, given: NameSource["surface"]): void {
  if (given === undefined || triangles === 0 || given.trianglePatch.length === triangles) return;
  if (given.patches.length <= 1 && given.patches.every(isPlain) && given.surfaceRegions === undefined) return;
  const message = `the surface has ${plural(given.trianglePatch.length, "triangle")}, and that of the mesh ${triangles}`;
  const remedy =
    "Give the surface that was filled: of a repaired or refined one, what repairedSurface makes of it.";
  refuse([packageDiagnostic("invalid-arrays", message, remedy)]);
}

const aProject = objectOf({ patches: listOf(objectOf({ id: aNumber, name: orNothing(aString) })) });
const aNameSource = objectOf({ project: orNothing(aProject), surface: orNothing(hasPatches) });
const aMeshResult = objectOf({
  surface: objectOf({
    points: arrayOf(Float64Array, 3),
    triangles: arrayOf(Uint32Array, 3),
    trianglePatch: arrayOf(Uint32Array),
    triangleRegions: arrayOf(Uint32Array, 2),
  }),
  volume: objectOf({
    points: arrayOf(Float64Array, 3),
    tetrahedra: arrayOf(Uint32Array, 4),
    regions: arrayOf(Uint32Array),
  }),
});

/** There are no more groups than elements, than triangles, or than a project names. */
function positionsBelow(limit: number): Check {
  return (positions) =>
    countOf(positions as Uint32Array) > limit ? ` has a position beyond ${limit}` : undefined;
}

/** What to call each patch in a file: its name, else its id. Throws a `MesherError` where it is no project. */
export function patchNames(project: Project): string[] {
  checkArgument("project", project, aProject);
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
