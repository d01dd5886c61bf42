/** Divides a surface with several solids into bodies. */
import * as v from "valibot";
import { connectedGroups } from "../base/connected-groups.js";
import { checkArgument } from "../calls/argument-checks.js";
import { integers } from "../calls/schemas.js";
import { NO_REGION } from "../generated/constants.js";
import { partOfSolids, partOfTriangles, sharedPairs, type SolidsSurface } from "../formats/solid-units.js";
import { type Mesh, type MeshGroup, isNumberedSolid, type SurfaceRegions } from "../mesh/mesh.js";
import { createBody, type GivenTriangles, newBodySchema, type NewBody, surfaceSchema } from "./bodies.js";
import type { ProjectBody } from "./project-types.js";

/** A surface with patches, and with regions if its file defines them. */
export interface SolidSurface extends GivenTriangles {
  readonly trianglePatch: Uint32Array;
  readonly patches: readonly Pick<MeshGroup, "name" | "color">[];
  readonly surfaceRegions?: SurfaceRegions | undefined;
}

const regionsSchema = v.object({
  surfaceRegions: v.optional(
    v.object({ regions: v.array(v.object({ name: v.string() })), triangleRegions: integers(2) }),
  ),
});

/**
 * Returns one body per solid of a surface, with the solid's name; solids that share a face are one body, because only then
 * the mesh is the same on both sides. A surface without regions is one body. Ids continue from those of `body`. O(n).
 * Throws a `MesherError` if an argument is invalid.
 */
export function createBodies(surface: SolidSurface, body: NewBody): ProjectBody[] {
  checkArgument("surface", surface, regionsSchema);
  checkArgument("surface", surface, surfaceSchema);
  checkArgument("body", body, newBodySchema);
  const { surfaceRegions } = surface;
  if (surfaceRegions === undefined) return [createBody(surface, body)];
  const { regions, triangleRegions } = surfaceRegions;
  const groups = connectedGroups(regions.length, sharedPairs(triangleRegions));
  if (groups.length <= 1) {
    const only = withSolids(createBody(surface, body), surface, surfaceRegions);
    return [withName(only, groups[0] ?? [], regions)];
  }
  let [id, firstPatchId] = [body.id, body.firstPatchId];
  return trianglesOfGroups(groups, surface.triangles.length / 3, triangleRegions).flatMap((owned, g) => {
    if (owned.length === 0) return [];
    const own = partOfTriangles(surface, owned);
    const sides = Uint32Array.from({ length: 2 * owned.length }, (_, side) => {
      return triangleRegions[2 * (owned[side >>> 1] ?? 0) + (side % 2)] ?? NO_REGION;
    });
    const ofPart = { regions, triangleRegions: sides };
    const trueFaces = surface.trueFaces && facesOf(groups[g] ?? [], surface.trueFaces);
    const part = withSolids(createBody({ ...own, trueFaces }, { ...body, id, firstPatchId }), own, ofPart);
    id++;
    firstPatchId += part.patches.length;
    return [withName(part, groups[g] ?? [], regions)];
  });
}

/** Returns one body per unit of solids, which `solidUnits` finds; ids continue from those of `body`. O(n). */
export function createUnitBodies(
  given: SolidsSurface,
  units: readonly (readonly number[])[],
  body: NewBody,
): ProjectBody[] {
  let [id, firstPatchId] = [body.id, body.firstPatchId];
  return units.map((unit) => {
    const part = partOfSolids(given, unit);
    const made = withSolids(createBody(part, { ...body, id, firstPatchId }), part, part.surfaceRegions);
    id++;
    firstPatchId += made.patches.length;
    return withName(made, unit, given.surfaceRegions.regions);
  });
}

/** Returns the true faces of some solids; undefined if there are none. */
function facesOf(solids: readonly number[], all: NonNullable<Mesh["trueFaces"]>): Mesh["trueFaces"] {
  const faces = solids.flatMap((solid) => all[solid] ?? []);
  return faces.length > 0 ? faces : undefined;
}

/** Returns the triangles of each group of regions; triangles without a region belong to the first. */
function trianglesOfGroups(
  groups: readonly (readonly number[])[],
  count: number,
  triangleRegions: Uint32Array,
): number[][] {
  const groupOf = new Map(groups.flatMap((group, g) => group.map((region) => [region, g] as const)));
  const owned = groups.map((): number[] => []);
  for (let t = 0; t < count; t++) {
    const [one = NO_REGION, other = NO_REGION] = triangleRegions.subarray(2 * t, 2 * t + 2);
    owned[groupOf.get(one === NO_REGION ? other : one) ?? 0]?.push(t);
  }
  return owned;
}

/**
 * Returns a body whose patches state their solids, if it has several. A patch between two solids belongs to either, one around
 * several to none.
 */
function withSolids(
  body: ProjectBody,
  { trianglePatch }: Pick<SolidSurface, "trianglePatch">,
  { regions, triangleRegions }: SurfaceRegions,
): ProjectBody {
  const used = new Set(triangleRegions);
  used.delete(NO_REGION);
  if (used.size < 2) return body;
  const around = body.patches.map(() => new Set<number>());
  const between = new Map<number, number>();
  trianglePatch.forEach((patch, t) => {
    const [one = NO_REGION, other = NO_REGION] = triangleRegions.subarray(2 * t, 2 * t + 2);
    const region = Math.min(one, other);
    if (region === NO_REGION) return;
    if (one === NO_REGION || other === NO_REGION) around[patch]?.add(region);
    else if (!between.has(patch)) between.set(patch, region);
  });
  const patches = body.patches.map((patch, p) => {
    const [region = between.get(p) ?? NO_REGION, ...others] = around[p] ?? [];
    const solid = others.length > 0 ? "" : (regions[region]?.name ?? "");
    return solid === "" ? patch : { ...patch, solid };
  });
  return { ...body, patches };
}

/** Largest number of solids in the name of a body. */
const MAX_NAMED = 3;

function withName(
  body: ProjectBody,
  group: readonly number[],
  regions: SurfaceRegions["regions"],
): ProjectBody {
  const names = group.map((region) => regions[region]?.name ?? "").filter((name) => name !== "");
  const isNamed = names.length > 0 && !(regions.length === 1 && names.every(isNumberedSolid));
  if (!isNamed) return body;
  const more = names.length - MAX_NAMED;
  return { ...body, name: names.slice(0, MAX_NAMED).join(" + ") + (more > 0 ? ` + ${more} more` : "") };
}
