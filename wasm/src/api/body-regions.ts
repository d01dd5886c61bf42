/** Regions of a mesh of bodies, named after the solids that bound them. */
import type { EngineSurface } from "../engine/engine-mesh.js";
import { differentNames, numbered } from "../formats/groups.js";
import type { NamedRegions } from "../formats/region-names.js";
import { namesOfSolids } from "../formats/solid-names.js";
import { NO_REGION } from "../generated/constants.js";
import {
  type Project,
  patchesOf,
  type ProjectBody,
  type ProjectBodyPatch,
} from "../project/project-types.js";

/** The patch to which most triangles of a region belong, and its body. */
interface Owner {
  readonly body: ProjectBody;
  readonly patch: ProjectBodyPatch;
}

/** A solid that a region is, or is a part of. Regions with the same key are one. */
interface Solid {
  readonly key: string;
  readonly name: string | undefined;
  /** Index of its first patch in the project; regions are listed in this order. */
  readonly order: number;
}

/** The boundary of a mesh, with the regions on both sides of its triangles. */
type Boundary = Pick<EngineSurface, "points" | "triangles" | "trianglePatch" | "triangleRegions">;

/**
 * Returns the regions of a mesh of bodies; undefined if there are no bodies. A region has the name of its body, or that of its solid
 * in a body with several; parts of one solid are one region. `count`: number of regions of the run. O(n).
 */
export function bodyRegions(surface: Boundary, project: Project, count: number): NamedRegions | undefined {
  if ((project.bodies ?? []).length === 0) return undefined;
  const solids = solidsOf(surface, project, count);
  const different = new Map(solids.toReversed().map((solid) => [solid.key, solid]));
  const listed = [...different.values()].reverse().sort((a, b) => a.order - b.order);
  const names = differentNames(listed.map(({ name }) => name));
  const keys = listed.map(({ key }) => key);
  return {
    regions: numbered("region", names.length, names),
    indices: solids.map(({ key }) => keys.indexOf(key)),
  };
}

function solidsOf(surface: Boundary, project: Project, count: number): Solid[] {
  const owners = ownersOf(surface, project, count);
  const all = patchesOf(project);
  const patches = all.map(({ name = "" }, p) => ({ name, tag: p + 1 }));
  const ofShells = namesOfSolids(surface, surface.trianglePatch, patches, count);
  const regionsOf = new Map<ProjectBody, number>();
  for (const owner of owners) {
    if (owner !== undefined) regionsOf.set(owner.body, (regionsOf.get(owner.body) ?? 0) + 1);
  }
  return owners.map((owner, region) => {
    const key = `region ${region}`;
    if (owner === undefined) return { key, name: undefined, order: all.length };
    const { body, patch } = owner;
    const { solid } = patch;
    if (solid !== undefined) {
      const first = body.patches.find((one) => one.solid === solid) ?? patch;
      return { key: `body ${body.id} ${solid}`, name: solid, order: all.indexOf(first) };
    }
    const isOnly = regionsOf.get(body) === 1;
    const name = isOnly ? (body.name ?? patch.name) : (ofShells[region] ?? body.name);
    return { key, name, order: all.indexOf(patch) };
  });
}

/** Finds the patch of most triangles between each region and the outside; of all its triangles, if none is outside. */
function ownersOf(
  { trianglePatch, triangleRegions }: Boundary,
  project: Project,
  count: number,
): (Owner | undefined)[] {
  const drawn = project.patches.map(() => undefined);
  const bodies = project.bodies ?? [];
  const owners = [...drawn, ...bodies.flatMap((body) => body.patches.map((patch) => ({ body, patch })))];
  const outside = Array.from({ length: count }, () => new Map<number, number>());
  const all = Array.from({ length: count }, () => new Map<number, number>());
  triangleRegions.forEach((region, side) => {
    if (region === NO_REGION) return;
    const patch = trianglePatch[side >>> 1] ?? 0;
    const isOutside = triangleRegions[side ^ 1] === NO_REGION;
    for (const votes of isOutside ? [outside[region], all[region]] : [all[region]])
      votes?.set(patch, (votes.get(patch) ?? 0) + 1);
  });
  return all.map((votes, region) => {
    const counted = outside[region]?.size ? outside[region] : votes;
    const [patch] = [...counted].reduce((most, vote) => (vote[1] > most[1] ? vote : most), [-1, 0]);
    return owners[patch];
  });
}
