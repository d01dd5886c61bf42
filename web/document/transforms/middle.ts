import type { Project, ProjectBody } from "tetrafront";
import type { Entity } from "../entities";
import { rangeAlong } from "../extent";
import type { Position } from "../position";
import { selectedParts } from "./selected-parts";

/**
 * Returns the middle of the box around the selected points, nodes, sources and bodies; the origin without any. `centreOf`
 * returns the middle of the triangles of a body; if they are not known, its placement counts.
 */
export function middleOf(
  project: Project,
  selection: readonly Entity[],
  centreOf: (body: ProjectBody) => Position | null = () => null,
): Position {
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
  if (positioned.length === 0) return [0, 0, 0];
  const middle = (axis: number): number => {
    const [low, high] = rangeAlong(positioned, axis);
    return (low + high) / 2;
  };
  return [middle(0), middle(1), middle(2)];
}
