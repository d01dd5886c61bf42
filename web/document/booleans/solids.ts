import { bodySurface, type Project, type ProjectBody, type ProjectPreview } from "tetrafront/project";
import { bodiesOf, entityKey, type Entity } from "../entities";
import { coincidenceLength } from "../insert-shape";
import { PointIndex } from "../point-index";
import type { Position } from "../position";
import { orientedSurface } from "./orientation";

/** Closed bodies of a model as oriented triangles, for Boolean operations. */

/** One patch of a solid. */
export interface SolidPatch {
  readonly name: string | undefined;
}

/** A closed surface: drawn patches that share lines, or a body. */
export interface Solid {
  /** The patches, or the body, that it was made from. */
  readonly entities: readonly Entity[];
  /** x y z per node. */
  readonly points: Float64Array;
  /** Three nodes per triangle, counter-clockwise as seen from outside. */
  readonly triangles: Uint32Array;
  /** Whether a part of the surface lies within another, as the boundary of a cavity does. */
  readonly hasInnerShells: boolean;
  /** Whether such a part bounds a body of its own, by the orientation of its triangles. */
  readonly hasInnerBodies: boolean;
  /** Per triangle: index in `patches`. */
  readonly trianglePatch: Uint32Array;
  readonly patches: readonly SolidPatch[];
  /** Whether all patches are planar and all their lines straight. */
  readonly isPlanar: boolean;
}

/** Returns the ids of patches that are connected by common lines, in the order of the project. */
export function connectedPatches({ patches }: Pick<Project, "patches">): number[][] {
  const parent = new Map<number, number>();
  const root = (id: number): number => {
    let at = id;
    for (let next = parent.get(at); next !== undefined && next !== at; next = parent.get(at)) at = next;
    return at;
  };
  const patchOfLine = new Map<number, number>();
  for (const { id, loops } of patches) {
    parent.set(id, id);
    for (const line of loops.flat().map(Math.abs)) {
      const other = patchOfLine.get(line);
      if (other === undefined) patchOfLine.set(line, id);
      else if (root(other) !== root(id)) parent.set(root(id), root(other));
    }
  }
  const groups = new Map<number, number[]>();
  for (const { id } of patches) {
    const group = groups.get(root(id));
    if (group) group.push(id);
    else groups.set(root(id), [id]);
  }
  return [...groups.values()];
}

/**
 * Returns the bodies that a selection touches, each as its connected patches or as one body of triangles, in the order of the
 * selection; without a selection, all bodies in the order of the project. O(entities).
 */
export function touchedBodies(
  project: Project,
  selection: readonly Entity[],
): readonly (readonly Entity[])[] {
  const groups: (readonly Entity[])[] = [
    ...connectedPatches(project).map((ids) => ids.map((id): Entity => ({ kind: "patch", id }))),
    ...bodiesOf(project).map(({ id }): Entity[] => [{ kind: "body", id }]),
  ];
  if (selection.length === 0) return groups;
  const users = partsByKey(project);
  const groupOf = new Map(groups.flatMap((group, index) => group.map((own) => [entityKey(own), index])));
  const touched = selection.flatMap((entity) =>
    (users.get(entityKey(entity)) ?? [entity])
      .flatMap((user) => groupOf.get(entityKey(user)) ?? [])
      .toSorted((a, b) => a - b),
  );
  return [...new Set(touched)].map((index) => groups[index] ?? []);
}

/** Returns the patches or bodies that use points, lines and patches of bodies, by their keys. */
function partsByKey(project: Project): ReadonlyMap<string, readonly Entity[]> {
  const users = new Map<string, Entity[]>();
  const add = (part: Entity, user: Entity): void => {
    const known = users.get(entityKey(part));
    if (known) known.push(user);
    else users.set(entityKey(part), [user]);
  };
  const pointsOf = new Map(project.lines.map(({ id, points }) => [id, points]));
  for (const { id, loops } of project.patches) {
    for (const line of loops.flat().map(Math.abs)) {
      add({ kind: "line", id: line }, { kind: "patch", id });
      for (const point of pointsOf.get(line) ?? []) add({ kind: "point", id: point }, { kind: "patch", id });
    }
  }
  for (const body of bodiesOf(project)) {
    for (const { id } of body.patches) add({ kind: "body-patch", id }, { kind: "body", id: body.id });
  }
  return users;
}

/**
 * Returns the solid of the connected patches, or of the body, that `touchedBodies` has found; null if it is not closed.
 * `samples` are those of the project: along a line, all its patches have nodes at the same positions.
 */
export function solidOf(
  project: Project,
  entities: readonly Entity[],
  samples: ProjectPreview,
): Solid | null {
  const [first] = entities;
  const body = first?.kind === "body" ? bodiesOf(project).find(({ id }) => id === first.id) : undefined;
  return body ? solidOfBody(entities, body) : solidOfPatches(project, entities, samples);
}

function solidOfBody(entities: readonly Entity[], body: ProjectBody): Solid | null {
  const { points, triangles, trianglePatch } = bodySurface(body);
  const oriented = orientedSurface(points, triangles);
  if (!oriented) return null;
  const patches = body.patches.map(({ name }) => ({ name: name ?? body.name }));
  return { entities, points, ...oriented, trianglePatch, patches, isPlanar: false };
}

function solidOfPatches(
  project: Project,
  entities: readonly Entity[],
  { patchOffsets, patchTriangles, patchPoints }: ProjectPreview,
): Solid | null {
  const ids = new Set(entities.map(({ id }) => id));
  const lines = new Map(project.lines.map((line) => [line.id, line]));
  const nodes = new PointIndex<number>(coincidenceLength(project));
  const [points, triangles, trianglePatch]: [number[], number[], number[]] = [[], [], []];
  const patches: SolidPatch[] = [];
  let isPlanar = true;
  project.patches.forEach(({ id, type, name, loops }, index) => {
    if (!ids.has(id)) return;
    const areStraight = loops.flat().every((step) => lines.get(Math.abs(step))?.type === "straight");
    isPlanar &&= type === "planar" && areStraight;
    for (let corner = 3 * (patchOffsets[index] ?? 0); corner < 3 * (patchOffsets[index + 1] ?? 0); ++corner) {
      const sampled = 3 * (patchTriangles[corner] ?? 0);
      const position: Position = [
        patchPoints[sampled] ?? 0,
        patchPoints[sampled + 1] ?? 0,
        patchPoints[sampled + 2] ?? 0,
      ];
      let node = nodes.find(position);
      if (node === undefined) {
        node = points.length / 3;
        nodes.add(position, node);
        points.push(...position);
      }
      triangles.push(node);
      if (corner % 3 === 0) trianglePatch.push(patches.length);
    }
    patches.push({ name });
  });
  const flat = Float64Array.from(points);
  const oriented = orientedSurface(flat, Uint32Array.from(triangles));
  if (!oriented) return null;
  return {
    entities,
    points: flat,
    ...oriented,
    // Drawn patches may face any way.
    hasInnerBodies: false,
    trianglePatch: Uint32Array.from(trianglePatch),
    patches,
    isPlanar,
  };
}
