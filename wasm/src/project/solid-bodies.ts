/** Divides a surface with several solids into bodies. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { integers } from "../calls/schemas.js";
import { NO_REGION } from "../generated/constants.js";
import { partOfSolids, type SolidsSurface } from "../formats/solid-units.js";
import { type MeshGroup, isNumberedSolid, type SurfaceRegions } from "../mesh/mesh.js";
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
  const groups = joinedRegions(regions.length, triangleRegions);
  if (groups.length <= 1) {
    const only = withSolids(createBody(surface, body), surface, surfaceRegions);
    return [withName(only, groups[0] ?? [], regions)];
  }
  let [id, firstPatchId] = [body.id, body.firstPatchId];
  return trianglesOfGroups(groups, surface.triangles.length / 3, triangleRegions).flatMap((owned, g) => {
    if (owned.length === 0) return [];
    const own = partOf(surface, owned);
    const sides = Uint32Array.from({ length: 2 * owned.length }, (_, side) => {
      return triangleRegions[2 * (owned[side >>> 1] ?? 0) + (side % 2)] ?? NO_REGION;
    });
    const ofPart = { regions, triangleRegions: sides };
    const part = withSolids(createBody(own, { ...body, id, firstPatchId }), own, ofPart);
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

/** Returns the regions in groups that are connected through common triangles, in order. */
function joinedRegions(count: number, triangleRegions: Uint32Array): number[][] {
  const parent = Array.from({ length: count }, (_, region) => region);
  const rootOf = (region: number): number => {
    let root = region;
    while (parent[root] !== undefined && parent[root] !== root) {
      // Halves the path for later calls.
      parent[root] = parent[parent[root] ?? root] ?? root;
      root = parent[root] ?? root;
    }
    return root;
  };
  for (let side = 0; side < triangleRegions.length; side += 2) {
    const [a = NO_REGION, b = NO_REGION] = triangleRegions.subarray(side, side + 2);
    if (a >= count || b >= count || a === b) continue;
    const [low, high] = [rootOf(a), rootOf(b)].sort((x, y) => x - y) as [number, number];
    parent[high] = low;
  }
  const groups = new Map<number, number[]>();
  parent.forEach((_, region) => {
    const root = rootOf(region);
    const group = groups.get(root);
    if (group === undefined) groups.set(root, [region]);
    else group.push(region);
  });
  return [...groups.values()];
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

/** Returns these triangles with the nodes and patches that they use. */
function partOf(
  { points, triangles, trianglePatch, patches }: SolidSurface,
  owned: readonly number[],
): Pick<SolidSurface, "points" | "triangles" | "trianglePatch" | "patches"> {
  const nodes = new Numbering();
  const usedPatches = new Numbering();
  const corners: number[] = [];
  const owners: number[] = [];
  owned.forEach((t) => {
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) corners.push(nodes.of(node));
    owners.push(usedPatches.of(trianglePatch[t] ?? 0));
  });
  const kept = nodes.given;
  return {
    points: Float64Array.from({ length: 3 * kept.length }, (_, i) => {
      return points[3 * (kept[Math.floor(i / 3)] ?? 0) + (i % 3)] ?? 0;
    }),
    triangles: Uint32Array.from(corners),
    trianglePatch: Uint32Array.from(owners),
    patches: usedPatches.given.flatMap((patch) => patches[patch] ?? []),
  };
}

/** Numbers indices in the order in which they first appear. */
class Numbering {
  readonly given: number[] = [];
  readonly #indices = new Map<number, number>();

  of(index: number): number {
    const known = this.#indices.get(index);
    if (known !== undefined) return known;
    this.#indices.set(index, this.given.length);
    return this.given.push(index) - 1;
  }
}
