import { differentNames } from "tetrafront/internal";
import type { BodyRemeshing, Project, ProjectBody, ProjectBodyPatch } from "tetrafront/project";
import type { PatchArrays } from "./patch-arrays";
import { nextBodyIds } from "./body-edits";
import type { ProjectEdit } from "./edit";
import { bodiesOf, bodyLabel } from "./entities";
import { placed } from "./placement";

/**
 * Bodies that touch or intersect, which a run refuses: each has its own triangles where they touch. They are joined into one
 * body with common triangles there.
 */

/** Returns the given triangles of a body where its placement puts them. */
export function placedSurface(surface: PatchArrays, { placement }: ProjectBody): PatchArrays {
  if (!placement) return surface;
  const points = new Float64Array(surface.points.length);
  for (let i = 0; i < points.length; i += 3) {
    const [x = 0, y = 0, z = 0] = surface.points.subarray(i, i + 3);
    points.set(placed([x, y, z], placement), i);
  }
  return { ...surface, points };
}

/** Returns the triangles of several bodies as one surface; its patches are those of the first body, then of the next. */
export function joinedSurface(
  parts: readonly (readonly [surface: PatchArrays, patches: number])[],
): PatchArrays {
  const sum = (of: (surface: PatchArrays) => number): number =>
    parts.reduce((total, [surface]) => total + of(surface), 0);
  const points = new Float64Array(sum((surface) => surface.points.length));
  const triangles = new Uint32Array(sum((surface) => surface.triangles.length));
  const trianglePatch = new Uint32Array(sum((surface) => surface.trianglePatch.length));
  let [coordinates, corners, owners, firstPatch] = [0, 0, 0, 0];
  for (const [surface, patches] of parts) {
    const firstNode = coordinates / 3;
    points.set(surface.points, coordinates);
    triangles.set(
      surface.triangles.map((node) => firstNode + node),
      corners,
    );
    trianglePatch.set(
      surface.trianglePatch.map((patch) => firstPatch + patch),
      owners,
    );
    coordinates += surface.points.length;
    corners += surface.triangles.length;
    owners += surface.trianglePatch.length;
    firstPatch += patches;
  }
  return { points, triangles, trianglePatch };
}

/**
 * Returns the patches of joined bodies. An only patch without a name gets that of its body. The patches state the solids that the
 * bodies were, unless a body consists of several that it does not state; solids of different bodies have different names.
 */
export function joinedPatches(
  bodies: readonly { readonly body: ProjectBody; readonly regions: number }[],
): ProjectBodyPatch[] {
  const stated = bodies.map(({ body, regions }) =>
    body.patches.map((patch) => {
      const name = patch.name ?? (body.patches.length === 1 ? body.name : undefined);
      return { patch, name, solid: patch.solid ?? (regions === 1 ? bodyLabel(body) : name) };
    }),
  );
  const solids = stated.map((own) => [...new Set(own.flatMap(({ solid }) => solid ?? []))]);
  const names = differentNames(solids.flat());
  return stated.flatMap((own, b) => {
    const nameOf = new Map(solids[b]?.map((solid) => [solid, names.shift() ?? solid]));
    return own.map(({ patch, name, solid }) => ({
      ...patch,
      ...(name !== undefined && { name }),
      ...(solid !== undefined && { solid: nameOf.get(solid) ?? solid }),
    }));
  });
}

/** Returns what a joined body has apart from its triangles and patches. */
export function joinedHead(
  project: Project,
  bodies: readonly ProjectBody[],
): Pick<ProjectBody, "id" | "name" | "surface" | "remeshing"> {
  const { id } = nextBodyIds(project);
  const remeshing = finestRemeshing(bodies.map((body) => body.remeshing ?? {}));
  const treatments = new Set(bodies.map(({ surface = "remesh" }) => surface));
  const [surface] = treatments.size === 1 ? treatments : (["remesh"] as const);
  const names = bodies.map(bodyLabel);
  const [first = "", second = ""] = names;
  return {
    id,
    name: names.length > 2 ? `${first} + ${names.length - 1}` : `${first} + ${second}`,
    ...(surface !== undefined && surface !== "remesh" && { surface }),
    ...(Object.keys(remeshing).length > 0 && { remeshing }),
  };
}

/** Returns the finest of each option that all bodies have; the others stay automatic. */
function finestRemeshing(all: readonly BodyRemeshing[]): BodyRemeshing {
  const [first = {}] = all;
  const fields = Object.keys(first) as (keyof BodyRemeshing)[];
  return Object.fromEntries(
    fields.flatMap((field) => {
      const values = all.flatMap((one) => one[field] ?? []);
      const finest = field === "layers" ? Math.max(...values) : Math.min(...values);
      return values.length === all.length ? [[field, finest] as const] : [];
    }),
  );
}

/**
 * Puts a joined body in the place of the first body that it was made from. It takes over the painted sizes and the groups of
 * all of them.
 */
export function replaceByJoined(
  project: Project,
  label: string,
  joined: ProjectBody,
  ids: readonly number[],
): ProjectEdit {
  const isJoined = (id: number | undefined): boolean => id !== undefined && ids.includes(id);
  const bodies = bodiesOf(project).flatMap((body) =>
    body.id === ids[0] ? [joined] : isJoined(body.id) ? [] : [body],
  );
  const { sources } = project.background;
  const painted = sources?.map((source) => (isJoined(source.body) ? { ...source, body: joined.id } : source));
  const groups = project.groups?.map((group) => {
    const others = group.members.filter(({ kind, id }) => kind !== "body" || !isJoined(id));
    if (others.length === group.members.length) return group;
    return { ...group, members: [...others, { kind: "body", id: joined.id } as const] };
  });
  return {
    label,
    replace: {
      bodies,
      ...(groups && { groups }),
      ...(painted && { background: { ...project.background, sources: painted } }),
    },
  };
}
