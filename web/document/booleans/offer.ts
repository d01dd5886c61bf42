import type { ManifoldToplevel } from "manifold-3d";
import { MESH_DEFAULTS } from "tetrafront";
import { createBody, type Project } from "tetrafront/project";
import { operationStrings } from "../../strings";
import { nextBodyIds } from "../body-edits";
import type { Offer } from "../create";
import { bodiesOf, type Entity } from "../entities";
import { freeName, insertion, mainEntities, withInsertion } from "../insert-shape";
import { combine, type Combined } from "./combine";
import type { BooleanKind } from "./kinds";
import { planarShape } from "./planar-result";
import type { Solid } from "./solids";

const texts = operationStrings.booleans;

/**
 * Offers to replace two solids by their combination. If both are planar, the result is points, lines and planar patches;
 * otherwise it is a body with the names of the patches. Inner shells are cavities: it is refused if they are regions.
 */
export function offerBoolean(
  library: ManifoldToplevel,
  project: Project,
  [first, second]: readonly [Solid, Solid],
  kind: BooleanKind,
): Offer {
  const innerShells = project.meshing?.innerShells ?? MESH_DEFAULTS.innerShells;
  const hasInnerRegions = [first, second].some(({ hasInnerShells, hasInnerBodies }) =>
    innerShells === "by-orientation" ? hasInnerBodies : innerShells === "regions" && hasInnerShells,
  );
  if (hasInnerRegions) return { possible: false, reason: texts.innerRegions };
  const combined = combine(library, first, second, kind);
  if (!combined) return { possible: false, reason: texts.nothing };
  const rest = withoutSolids(project, [...first.entities, ...second.entities]);
  const label = texts.steps[kind];
  if (!isTriangulated([first, second])) {
    const shape = planarShape(combined, [first, second]);
    if (!shape) return { possible: false, reason: texts.nothing };
    const made = insertion(rest, shape, { join: true });
    return {
      possible: true,
      creation: { entities: mainEntities(made), edit: { label, replace: withInsertion(rest, made) } },
    };
  }
  const body = bodyOf(rest, combined, [first, second]);
  return {
    possible: true,
    creation: {
      entities: [{ kind: "body", id: body.id }],
      edit: { label, replace: { ...rest, bodies: [...bodiesOf(rest), body] } },
    },
  };
}

/** Returns whether the result of combining two solids is a triangulated body. */
export const isTriangulated = (solids: readonly Solid[]): boolean => solids.some(({ isPlanar }) => !isPlanar);

/** Returns the project without patches and bodies, and without the lines and points that only they use. */
function withoutSolids(project: Project, entities: readonly Entity[]): Project {
  const patches = new Set(entities.flatMap(({ kind, id }) => (kind === "patch" ? [id] : [])));
  const bodies = new Set(entities.flatMap(({ kind, id }) => (kind === "body" ? [id] : [])));
  const own = { lines: new Set<number>(), points: new Set<number>() };
  const kept = { lines: new Set<number>(), points: new Set<number>() };
  for (const { id, loops } of project.patches) {
    for (const step of loops.flat()) (patches.has(id) ? own : kept).lines.add(Math.abs(step));
  }
  const goes = (line: number): boolean => own.lines.has(line) && !kept.lines.has(line);
  for (const { id, points } of project.lines) {
    for (const point of points) (goes(id) ? own : kept).points.add(point);
  }
  return {
    ...project,
    points: project.points.filter(({ id }) => !own.points.has(id) || kept.points.has(id)),
    lines: project.lines.filter(({ id }) => !goes(id)),
    patches: project.patches.filter(({ id }) => !patches.has(id)),
    ...(project.bodies && { bodies: project.bodies.filter(({ id }) => !bodies.has(id)) }),
  };
}

/** Returns a body with the triangles of a combination, and a patch for each patch of the solids of which something is left. */
function bodyOf(project: Project, { points, triangles, solid, patch }: Combined, solids: readonly Solid[]) {
  const indices = new Map<string, number>();
  const patches: { name: string }[] = [];
  const names = new Set<string>();
  const trianglePatch = Uint32Array.from(patch, (index, triangle) => {
    const which = solid[triangle] ?? 0;
    const key = `${which} ${index}`;
    let known = indices.get(key);
    if (known === undefined) {
      known = patches.length;
      indices.set(key, known);
      const name = freeName(solids[which]?.patches[index]?.name ?? texts.patch(known + 1), names);
      patches.push({ name });
    }
    return known;
  });
  const surface = { ...usedNodes(points, triangles), trianglePatch, patches };
  return createBody(surface, { ...nextBodyIds(project), name: texts.body });
}

/** Returns the nodes that triangles use, in their order, and the triangles with new indices. */
function usedNodes(points: Float64Array, triangles: Uint32Array) {
  const indices = new Map<number, number>();
  const renumbered = triangles.map((node) => {
    const known = indices.get(node) ?? indices.size;
    indices.set(node, known);
    return known;
  });
  const used = new Float64Array(3 * indices.size);
  for (const [node, index] of indices) used.set(points.subarray(3 * node, 3 * node + 3), 3 * index);
  return { points: used, triangles: renumbered };
}
