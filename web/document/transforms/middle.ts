import type { Project, ProjectBody } from "tetrafront/project";
import type { Entity } from "../entities";
import { rangeAlong } from "../extent";
import type { Position } from "../position";
import { selectedParts } from "./selected-parts";

type Range = readonly [low: number, high: number];
type CentreOf = (body: ProjectBody) => Position | null;

/**
 * Returns the middle of the box around the selected points, nodes, sources and bodies; the origin without any. `centreOf`
 * returns the middle of the triangles of a body; if they are not known, its placement counts.
 */
export function middleOf(project: Project, selection: readonly Entity[], centreOf?: CentreOf): Position {
  const box = boxOf(project, selection, centreOf);
  const [x, y, z] = (box ?? []).map(([low, high]) => (low + high) / 2);
  return [x ?? 0, y ?? 0, z ?? 0];
}

/** Returns the box as `middleOf` takes it, as a range along each axis; null without any. */
export function boxOf(
  project: Project,
  selection: readonly Entity[],
  centreOf: CentreOf = () => null,
): readonly [Range, Range, Range] | null {
  const { points, bodies, nodes, sources } = selectedParts(project, selection);
  const { background } = project;
  const positioned: { readonly position: Position }[] = [
    ...points,
    ...background.nodes.filter(({ id }) => nodes.has(id)),
    ...(background.sources ?? [])
      .filter(({ id }) => sources.has(id))
      .flatMap(({ positions }) => positions.map((position) => ({ position }))),
    ...(project.bodies ?? [])
      .filter(({ id }) => bodies.has(id))
      .map((body) => ({ position: centreOf(body) ?? body.placement?.position ?? ([0, 0, 0] as const) })),
  ];
  if (positioned.length === 0) return null;
  return [rangeAlong(positioned, 0), rangeAlong(positioned, 1), rangeAlong(positioned, 2)];
}
