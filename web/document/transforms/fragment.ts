import { readProject, type Project } from "tetrafront";
import { operationStrings } from "../../strings";
import { emptyProject } from "../create";
import type { Entity } from "../entities";
import { coincidenceLength } from "../insert-shape";
import { PointIndex } from "../point-index";
import { hasParts, selectedParts } from "./selected-parts";

/**
 * The selected records on the clipboard: a project file with nothing else, so that it can be pasted in another tab, or
 * saved as a project.
 */

/** Returns the selected points, lines, patches, bodies and sources as the text of a project; null without any. */
export function fragmentText(project: Project, selection: readonly Entity[]): string | null {
  const parts = selectedParts(project, selection);
  if (!hasParts({ ...parts, nodes: new Set() })) return null;
  const { points, lines, patches } = parts;
  const bodies = (project.bodies ?? []).filter(({ id }) => parts.bodies.has(id));
  const sources = (project.background.sources ?? []).filter(({ id }) => parts.sources.has(id));
  const fragment: Project = {
    ...emptyProject(project.name),
    ...(project.units !== undefined && { units: project.units }),
    points,
    lines,
    patches,
    ...(bodies.length > 0 && { bodies }),
    background: { nodes: [], tetrahedra: [], ...(sources.length > 0 && { sources }) },
  };
  return JSON.stringify(fragment, null, 1);
}

/** Returns the project in a text from the clipboard, or why it has none. */
export function readFragment(text: string): { readonly fragment: Project } | { readonly reason: string } {
  const read = readProject(text);
  return read.success ? { fragment: read.value } : { reason: operationStrings.refusals.noFragment };
}

/** Returns whether a point of a fragment lies at one of the project: pasted there, it would hide the original. */
export function coincides(project: Project, { points }: Project): boolean {
  const positions = points.map(({ position }) => position);
  const index = new PointIndex<number>(coincidenceLength(project, positions));
  for (const { id, position } of project.points) index.add(position, id);
  return positions.some((position) => index.find(position) !== undefined);
}

/** Returns the entities of a fragment that nothing else in it is built on. */
export function fragmentEntities({ points, lines, patches, bodies = [], background }: Project): Entity[] {
  const usedLines = new Set(patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
  const usedPoints = new Set(lines.flatMap((line) => line.points));
  const entities = (kind: Entity["kind"], list: readonly { readonly id: number }[]): Entity[] =>
    list.map(({ id }) => ({ kind, id }));
  return [
    ...entities("patch", patches),
    ...entities(
      "line",
      lines.filter(({ id }) => !usedLines.has(id)),
    ),
    ...entities(
      "point",
      points.filter(({ id }) => !usedPoints.has(id)),
    ),
    ...entities("body", bodies),
    ...entities("source", background.sources ?? []),
  ];
}
