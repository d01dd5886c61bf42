import type { BodyRemeshing, Project, ProjectBody, ProjectBodyPatch } from "tetrafront/project";
import type { PatchArrays } from "./patch-arrays";
import { nextBodyIds } from "./body-edits";
import type { ProjectEdit } from "./edit";
import { bodiesOf, bodyLabel } from "./entities";
import { placed } from "./placement";
import type { Position } from "./position";

/**
 * Bodies that touch or intersect, which a run refuses: each has its own triangles where they touch. They are joined into one
 * body with common triangles there.
 */

/** A box that contains a body. */
export interface Box {
  readonly low: Position;
  readonly high: Position;
}

/** Returns the pairs of boxes that are not apart, as indices, the smaller first. */
export function nearPairs(boxes: readonly Box[]): (readonly [number, number])[] {
  return boxes.flatMap(({ low, high }, i) =>
    boxes.slice(i + 1).flatMap((other, k) => {
      const isApart = low.some((x, axis) => {
        const [from = x, to = x] = [other.low[axis], other.high[axis]];
        return x > to || (high[axis] ?? x) < from;
      });
      return isApart ? [] : [[i, i + 1 + k] as const];
    }),
  );
}

/** Returns whether a box lies inside another one and touches none of its sides. */
export function isWithin(inner: Box, outer: Box): boolean {
  return inner.low.every((x, k) => x > (outer.low[k] ?? x) && (inner.high[k] ?? x) < (outer.high[k] ?? x));
}

/** Returns whether bodies in some of the boxes may touch: two are not apart, and neither lies within the other. */
export function mayTouch(boxes: readonly Box[]): boolean {
  return nearPairs(boxes).some(([a, b]) => {
    const [one, other] = [boxes[a], boxes[b]];
    return one !== undefined && other !== undefined && !isWithin(one, other) && !isWithin(other, one);
  });
}

/** Returns the indices below `count` in groups that are connected by pairs; without those that are in no pair. */
export function connectedGroups(count: number, pairs: readonly (readonly [number, number])[]): number[][] {
  const groupOf = Array.from({ length: count }, (_, index) => [index]);
  for (const [one, other] of pairs) {
    const [into = [], from = []] = [groupOf[one], groupOf[other]];
    if (into === from) continue;
    into.push(...from);
    for (const index of from) groupOf[index] = into;
  }
  const groups = [...new Set(groupOf)].filter(({ length }) => length > 1);
  return groups.map((group) => group.toSorted((a, b) => a - b));
}

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

/** Returns the patches of joined bodies. An only patch without a name gets that of its body. */
export function joinedPatches(bodies: readonly ProjectBody[]): ProjectBodyPatch[] {
  return bodies.flatMap(({ name: bodyName, patches }) =>
    patches.map((patch) => {
      const name = patch.name ?? (patches.length === 1 ? bodyName : undefined);
      return { ...patch, ...(name !== undefined && { name }) };
    }),
  );
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
