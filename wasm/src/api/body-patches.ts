/** Other patches for the triangles of a body: split, or merged. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { index, integers } from "../calls/schemas.js";
import { hasGenericName } from "../formats/groups.js";
import type { MeshGroup } from "../mesh/mesh.js";
import { bodyArrays, textOfArray } from "../project/body-arrays.js";
import { bodySchema } from "../project/schema.js";
import type { PatchId, ProjectBody } from "../project/project-types.js";

/**
 * Returns a body with other patches of the same triangles, as `splitPatches` makes them. A patch that has triangles of a
 * given patch keeps its id, the first one if there are several; the others get ids from `nextPatchId` on. A given patch of
 * which there is only one piece keeps its colour, and its name unless the piece has one. O(n). Throws a `MesherError`
 * if an argument is invalid.
 *
 *     const split = await mesher.splitPatches({ ...bodySurface(body), patches: bodyPatchGroups(body) });
 */
export function bodyWithPatches(
  body: ProjectBody,
  surface: { readonly trianglePatch: Uint32Array; readonly patches: readonly Pick<MeshGroup, "name">[] },
  nextPatchId: PatchId,
): ProjectBody {
  checkArgument("body", body, bodySchema);
  checkArgument("surface", surface, newPatchesSchema(bodyArrays(body).trianglePatch.length));
  checkArgument("nextPatchId", nextPatchId, index);
  const before = bodyArrays(body).trianglePatch;
  const from = new Map<number, number>();
  surface.trianglePatch.forEach((patch, t) => from.has(patch) || from.set(patch, before[t] ?? 0));
  const pieces = new Map<number, number>();
  for (const given of from.values()) pieces.set(given, (pieces.get(given) ?? 0) + 1);
  const kept = new Set<number>();
  let nextId = nextPatchId;
  const patches = surface.patches.map(({ name }, p) => {
    const source = from.get(p);
    const given = source === undefined ? undefined : body.patches[source];
    const id = source === undefined || kept.has(source) ? undefined : given?.id;
    if (source !== undefined) kept.add(source);
    // Names such as "patch 3" would not be unique among bodies; without a name, the id is shown.
    const isWhole = source !== undefined && pieces.get(source) === 1;
    const own = hasGenericName({ name, tag: 0 }) ? (isWhole ? given?.name : undefined) : name;
    // Pieces in the colour of the whole could not be told apart.
    const color = isWhole ? given?.color : undefined;
    const solid = given?.solid;
    return {
      id: id ?? nextId++,
      ...(own !== undefined && { name: own }),
      ...(color && { color }),
      ...(solid !== undefined && { solid }),
    };
  });
  return withOwners(body, surface.trianglePatch, patches);
}

const newPatchesSchema = (triangles: number) =>
  v.pipe(
    v.object({
      trianglePatch: integers(),
      patches: v.pipe(v.array(v.object({ name: v.string() })), v.minLength(1)),
    }),
    v.check(
      ({ trianglePatch }) => trianglePatch.length === triangles,
      "trianglePatch must have one index per triangle",
    ),
    v.check(
      ({ trianglePatch, patches }) => trianglePatch.every((patch) => patch < patches.length),
      "trianglePatch has an index beyond its patches",
    ),
  );

/**
 * Returns a body in which some of its patches are one: the first of them in the body, with its id and name. Ids that the
 * body does not have are ignored. O(n). Throws a `MesherError` if an argument is invalid.
 */
export function mergePatches(body: ProjectBody, ids: readonly PatchId[]): ProjectBody {
  checkArgument("body", body, bodySchema);
  checkArgument("ids", ids, v.array(v.number()));
  const merged = new Set(ids);
  const first = body.patches.findIndex(({ id }) => merged.has(id));
  const patches = body.patches.filter(({ id }, p) => p === first || !merged.has(id));
  let count = 0;
  const newIndex = body.patches.map(({ id }, p) => (p !== first && merged.has(id) ? first : count++));
  return withOwners(
    body,
    bodyArrays(body).trianglePatch.map((patch) => newIndex[patch] ?? 0),
    patches,
  );
}

function withOwners(
  { trianglePatch: _, ...body }: ProjectBody,
  trianglePatch: Uint32Array,
  patches: ProjectBody["patches"],
): ProjectBody {
  return { ...body, ...(patches.length > 1 && { trianglePatch: textOfArray(trianglePatch) }), patches };
}

/**
 * Returns the patches of a body as those of a surface for `splitPatches`, with their ids as numbers. A single patch with the
 * name of the body counts as unnamed. Throws a `MesherError` if the body is invalid.
 */
export function bodyPatchGroups(body: Pick<ProjectBody, "name" | "patches">): MeshGroup[] {
  checkArgument("body", body, namedPatches);
  const { name: ofBody, patches } = body;
  return patches.map(({ id, name = "" }) => {
    const isOwn = name !== "" && !(patches.length === 1 && name === ofBody);
    return { name: isOwn ? name : `patch ${id}`, tag: id };
  });
}

const namedPatches = v.object({
  name: v.optional(v.string()),
  patches: v.array(v.object({ id: v.number(), name: v.optional(v.string()) })),
});
