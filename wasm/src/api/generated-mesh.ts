/** Converts a generated mesh to the mesh of a file, with the names of its patches and regions. */
import * as v from "valibot";
import { plural } from "../base/plural.js";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, integers } from "../calls/schemas.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { countOf, hasGenericName, numbered } from "../formats/groups.js";
import { carriedRegions } from "../formats/region-names.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import { namesOfSolids } from "../formats/solid-names.js";
import type { FileMesh } from "../mesh/file-mesh.js";
import { withPatches } from "../mesh/mesh-checks.js";
import type { MeshResult } from "../mesh/report.js";
import { NO_REGION } from "../generated/constants.js";
import { bodyRegions } from "./body-regions.js";
import { type PatchedRegions, withInterfacePatches } from "./interface-patches.js";
import { type Project, patchesOf } from "../project/project-types.js";

/** Source of the names of a generated mesh. */
export interface NameSource {
  /** Project that was meshed. */
  readonly project?: Project | undefined;
  /**
   * Surface that was meshed, as returned by `readSurface`. If its only patch has no name, the shells are used
   * instead.
   */
  readonly surface?: Pick<FileMesh, "trianglePatch" | "patches" | "surfaceRegions"> | undefined;
  /**
   * Whether triangles between two regions of the surface form patches of their own, "base / post". A repair cuts such interfaces
   * out of the faces of solids. Default false.
   */
  readonly interfacePatches?: boolean | undefined;
}

/**
 * Returns a generated mesh, ready to be written. Its patches are those of the project and its bodies (named, else
 * "patch 12" by id), those of the given surface, or its shells. Its regions are those of the surface's file or the bodies of the
 * project, else those of its solids, else numbered. A partial mesh yields a partial file. Throws a `MesherError` if an argument is invalid or the surface has a
 * different number of triangles than the mesh.
 */
export function fileMeshOf(mesh: Pick<MeshResult, "surface" | "volume">, names: NameSource = {}): FileMesh {
  checkArgument("mesh", mesh, meshResult);
  checkArgument("names", names, nameSource);
  const { surface, volume } = mesh;
  const { project, surface: given } = names;
  const patchLimit = Math.max(surface.trianglePatch.length, project ? patchesOf(project).length : 0);
  checkArgument("mesh.surface.trianglePatch", surface.trianglePatch, indicesBelow(patchLimit));
  // A partial mesh may contain elements of the last of many regions only.
  const regionLimit = Math.max(volume.regions.length, surface.trianglePatch.length);
  checkArgument("mesh.volume.regions", volume.regions, indicesBelow(regionLimit));
  checkSameSurface(surface.trianglePatch.length, given);
  const isSame = given !== undefined && given.trianglePatch.length === surface.trianglePatch.length;
  const isKept = isSame && (given.patches.length > 1 || !given.patches.every(hasGenericName));
  const regionCount = countOf(volume.regions);
  const carried =
    isSame && given.surfaceRegions !== undefined
      ? carriedRegions(mesh, given.surfaceRegions, regionCount)
      : project && bodyRegions(mesh, project, regionCount);
  const kept =
    isKept && carried !== undefined && names.interfacePatches === true
      ? withInterfacePatches({ ...given, ...regionsBeside(mesh, carried) })
      : given;
  const trianglePatch = isKept && kept ? kept.trianglePatch : surface.trianglePatch;
  const word = project === undefined ? "shell" : "patch";
  return {
    points: volume.points.length > 0 ? volume.points : surface.points,
    triangles: surface.triangles,
    trianglePatch,
    patches:
      isKept && kept ? kept.patches : numbered(word, countOf(trianglePatch), project && patchNames(project)),
    tetrahedra: volume.tetrahedra,
    tetrahedronRegion: carried?.tetrahedronRegion ?? volume.regions,
    regions:
      carried?.regions ?? numbered("region", regionCount, namesFor(surface, regionCount, kept, isKept)),
    nodeData: new Map(),
  };
}

/** Returns the names of regions that the file does not state: those of its solids. */
function namesFor(
  surface: MeshResult["surface"],
  count: number,
  given: NameSource["surface"],
  isKept: boolean,
): (string | undefined)[] {
  if (!isKept || given === undefined) return [];
  return namesOfSolids(surface, given.trianglePatch, given.patches, count);
}

/** What a region of a mesh consists of. */
export interface RegionSummary {
  readonly name: string;
  readonly tetrahedra: number;
  /** In cubed model units. */
  readonly volume: number;
}

/** Returns name, number of tetrahedra and volume of each region of a mesh, in their order. O(n). */
export function regionSummaries({
  points,
  tetrahedra,
  tetrahedronRegion,
  regions,
}: Pick<FileMesh, "points" | "tetrahedra" | "tetrahedronRegion" | "regions">): RegionSummary[] {
  const counts = regions.map(() => 0);
  const sixfold = regions.map(() => 0);
  tetrahedronRegion.forEach((region, t) => {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
    counts[region] = (counts[region] ?? 0) + 1;
    sixfold[region] = (sixfold[region] ?? 0) + Math.abs(sixfoldVolume(points, d, a, b, c).volume);
  });
  return regions.map(({ name }, r) => ({
    name,
    tetrahedra: counts[r] ?? 0,
    volume: (sixfold[r] ?? 0) / 6,
  }));
}

/** Returns the regions of a file on both sides of the triangles of a mesh. */
function regionsBeside(
  { surface, volume }: Pick<MeshResult, "surface" | "volume">,
  { tetrahedronRegion, regions }: Pick<FileMesh, "tetrahedronRegion" | "regions">,
): Pick<PatchedRegions, "regions" | "triangleRegions"> {
  const carriedOf = new Map<number, number>();
  volume.regions.forEach((region, t) => carriedOf.set(region, tetrahedronRegion[t] ?? 0));
  const triangleRegions = surface.triangleRegions.map((region) => carriedOf.get(region) ?? NO_REGION);
  return { regions, triangleRegions };
}

/** Rejects a surface with other triangles: its patches would be lost or assigned to the wrong triangles. */
function checkSameSurface(triangles: number, given: NameSource["surface"]): void {
  if (given === undefined || triangles === 0 || given.trianglePatch.length === triangles) return;
  if (given.patches.length <= 1 && given.patches.every(hasGenericName) && given.surfaceRegions === undefined)
    return;
  const message = `the surface has ${plural(given.trianglePatch.length, "triangle")}, the surface of the mesh ${triangles}`;
  const remedy =
    "Pass the surface that was meshed; if it was repaired or refined, pass the result of repairedSurface.";
  refuse([packageDiagnostic("invalid-arrays", message, remedy)]);
}

const patchList = v.array(v.object({ id: v.number(), name: v.optional(v.string()) }));
const projectPatches = v.object({
  patches: patchList,
  bodies: v.optional(v.array(v.object({ patches: patchList }))),
});
const nameSource = v.object({
  project: v.optional(projectPatches),
  surface: v.optional(withPatches),
  interfacePatches: v.optional(v.boolean()),
});
const meshResult = v.object({
  surface: v.object({
    points: doubles(3),
    triangles: integers(3),
    trianglePatch: integers(),
    triangleRegions: integers(2),
  }),
  volume: v.object({ points: doubles(3), tetrahedra: integers(4), regions: integers() }),
});

/** A valid mesh has no more groups than elements, triangles, or patches of its project. */
const indicesBelow = (limit: number) =>
  v.pipe(
    integers(),
    v.check((indices) => countOf(indices) <= limit, `it has an index beyond ${limit}`),
  );

/**
 * Returns the name of each patch in a file, first those drawn, then those of the bodies: its own, or one made of its id.
 * Throws a `MesherError` if `project` is invalid.
 */
export function patchNames(project: Project): string[] {
  checkArgument("project", project, projectPatches);
  return patchesOf(project).map(({ id, name }) => (name === undefined || name === "" ? `patch ${id}` : name));
}
