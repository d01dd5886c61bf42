/** Bodies of a project: closed triangulated surfaces with patches, and where they are. */
import * as v from "valibot";
import { placedPoints } from "../base/placement.js";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, index, integers } from "../calls/schemas.js";
import { type MeshGroup, isColorName, type Mesh } from "../mesh/mesh.js";
import type { Position } from "../mesh/inspection.js";
import { bodyArrays, textOfArray } from "./body-arrays.js";
import { bodySchema } from "./schema.js";
import type { BodyId, PatchId, ProjectBody } from "./project-types.js";
import { textOfTrueFaces } from "./true-faces-text.js";

/** Ids and name of a new body. */
export interface NewBody {
  readonly id: BodyId;
  /** Id of its first patch; the others follow. */
  readonly firstPatchId: PatchId;
  readonly name?: string | undefined;
}

export const surfaceSchema = v.pipe(
  v.object({
    points: doubles(3),
    triangles: integers(3),
    trianglePatch: v.optional(integers()),
    patches: v.optional(v.array(v.object({ name: v.string(), color: v.optional(v.array(v.number())) }))),
  }),
  v.check(
    ({ trianglePatch, triangles }) =>
      trianglePatch === undefined || 3 * trianglePatch.length === triangles.length,
    "trianglePatch must have one index per triangle",
  ),
);
export const newBodySchema = v.object({ id: index, firstPatchId: index, name: v.optional(v.string()) });

/** Triangles of a new body, and the names and colours of their patches. */
export interface GivenTriangles extends Pick<Mesh, "points" | "triangles"> {
  readonly trianglePatch?: Uint32Array | undefined;
  readonly patches?: readonly Pick<MeshGroup, "name" | "color">[] | undefined;
  /** The true faces of its solids, if it was read from a CAD file. */
  readonly trueFaces?: Mesh["trueFaces"];
}

/**
 * Returns a body with the triangles of a surface, and with its patches, if it has any. A surface without named patches
 * gets one patch with the name of the body; a colour is not a name. Its regions are not part of a body. O(n). Throws a
 * `MesherError` if an argument has another type.
 *
 *     const file = await readSurface("bracket.stl", bytes);
 *     const body = createBody(file, { id: 1, firstPatchId: 1, name: "bracket" });
 */
export function createBody(surface: GivenTriangles, body: NewBody): ProjectBody {
  checkArgument("surface", surface, surfaceSchema);
  checkArgument("body", body, newBodySchema);
  const { points, triangles, trianglePatch, trueFaces } = surface;
  const { id, firstPatchId, name } = body;
  const given = surface.patches?.map((patch) => (isUnnamed(patch.name) ? undefined : patch.name)) ?? [];
  const used = trianglePatch?.reduce((most, patch) => Math.max(most, patch + 1), 0) ?? 0;
  const count = Math.max(used, given.length);
  const [only = name] = given;
  const names = count > 1 ? given : [only !== undefined && isColorName(only) ? name : only];
  return {
    id,
    ...(name !== undefined && { name }),
    points: textOfArray(points),
    triangles: textOfArray(triangles),
    ...(count > 1 && trianglePatch && { trianglePatch: textOfArray(trianglePatch) }),
    ...(trueFaces && { trueFaces: textOfTrueFaces(trueFaces) }),
    patches: Array.from({ length: Math.max(count, 1) }, (_, p) => {
      const patchName = names[p];
      const color = surface.patches?.[p]?.color;
      return {
        id: firstPatchId + p,
        ...(patchName !== undefined && { name: patchName }),
        ...(color && { color }),
      };
    }),
  };
}

/** Readers call the only patch of a file without patches "surface". */
const isUnnamed = (name: string) => ["", "surface"].includes(name);

/** The triangles of a body at its placement; patches are indices in those of the body. */
export type PlacedSurface = Pick<Mesh, "points" | "triangles" | "trianglePatch">;

/**
 * Returns the given triangles of a body at its placement, in new arrays. Points are scaled, then rotated, then moved;
 * without a placement they are unchanged. O(n). Throws a `MesherError` if the body is invalid.
 */
export function bodySurface(body: ProjectBody): PlacedSurface {
  checkArgument("body", body, bodySchema);
  const { points, triangles, trianglePatch } = bodyArrays(body);
  return {
    points: placedPoints(points, body.placement),
    triangles: triangles.slice(),
    trianglePatch: trianglePatch.slice(),
  };
}

const boxes = new WeakMap<object, readonly [low: Position, high: Position]>();

/** Returns the box of a body at its placement. O(n) the first time. */
export function bodyBox(body: ProjectBody): readonly [low: Position, high: Position] {
  const known = boxes.get(body);
  if (known !== undefined) return known;
  const points = placedPoints(bodyArrays(body).points, body.placement);
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 3) {
    for (const axis of [0, 1, 2] as const) {
      const coordinate = points[i + axis] ?? 0;
      if (coordinate < low[axis]) low[axis] = coordinate;
      if (coordinate > high[axis]) high[axis] = coordinate;
    }
  }
  const box = [low, high] as const;
  boxes.set(body, box);
  return box;
}
