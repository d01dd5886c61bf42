/** The mesh of a run, with the names of its patches and regions. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import type { EngineMesh } from "../engine/engine-mesh.js";
import { countOf, hasGenericName, numbered } from "../formats/groups.js";
import { carriedRegions, type NamedRegions } from "../formats/region-names.js";
import { namesOfSolids } from "../formats/solid-names.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import { type Project, patchesOf } from "../project/project-types.js";
import { NO_REGION } from "../generated/constants.js";
import { bodyRegions } from "./body-regions.js";
import { patchesIn } from "./carried-mesh.js";

/** What was meshed; it names the mesh. */
export interface NameSource {
  readonly project?: Project | undefined;
  readonly surface?: SurfaceInput | undefined;
}

/** A mesh of a run, and per region of the run the index of its region. */
export interface NamedMesh extends Pick<NamedRegions, "indices"> {
  readonly mesh: Mesh;
}

/**
 * Returns the mesh of a run with the names of its patches and regions, as `MeshResult` says. `count`: number of the regions of
 * the run.
 */
export function namedMesh(
  { surface, volume }: EngineMesh,
  { project, surface: given }: NameSource,
  count: number = countOf(volume.regions),
): NamedMesh {
  const { triangles } = surface;
  const isSame = given !== undefined && given.triangles.length === triangles.length;
  const own = isSame ? patchesIn(given) : undefined;
  const kept = own !== undefined && hasNamedPatches(own) ? own : undefined;
  const { surfaceRegions, trueEdges, trueFaces, unit } = (isSame ? given : undefined) ?? {};
  const word = project === undefined ? "shell" : "patch";
  const { trianglePatch, patches } = kept ?? {
    trianglePatch: surface.trianglePatch,
    patches: numbered(word, countOf(surface.trianglePatch), project && patchNames(project)),
  };
  const stated =
    surfaceRegions === undefined
      ? project && bodyRegions(surface, project, count)
      : carriedRegions(surface.triangleRegions, surfaceRegions, count);
  const names = () => kept && namesOfSolids(surface, kept.trianglePatch, kept.patches, count);
  const regions = stated?.regions ?? numbered("region", count, names());
  const indices = stated?.indices ?? regions.map((_, region) => region);
  const isMoved = indices.some((index, region) => index !== region);
  const indicesOf = (all: Uint32Array, none: number) =>
    isMoved ? all.map((region) => indices[region] ?? none) : all;
  const mesh = {
    points: volume.points.length > 0 ? volume.points : surface.points,
    triangles,
    trianglePatch,
    patches,
    tetrahedra: volume.tetrahedra,
    tetrahedronRegion: indicesOf(volume.regions, 0),
    regions,
    triangleRegions: indicesOf(surface.triangleRegions, NO_REGION),
    nodeData: new Map(),
    ...(trueEdges && { trueEdges }),
    ...(trueFaces && { trueFaces }),
    ...(unit && { unit }),
  };
  return { mesh, indices };
}

/** Returns whether the patches of a surface carry information. */
export function hasNamedPatches({ patches }: Pick<Mesh, "patches">): boolean {
  return patches.length > 1 || !patches.every(hasGenericName);
}

const patchList = v.array(v.object({ id: v.number(), name: v.optional(v.string()) }));
const projectPatches = v.object({
  patches: patchList,
  bodies: v.optional(v.array(v.object({ patches: patchList }))),
});

/**
 * Returns the name of each patch in a file, first those drawn, then those of the bodies: its own, or one made of its id.
 * Throws a `MesherError` if `project` is invalid.
 */
export function patchNames(project: Project): string[] {
  checkArgument("project", project, projectPatches);
  return patchesOf(project).map(({ id, name }) => (name === undefined || name === "" ? `patch ${id}` : name));
}
