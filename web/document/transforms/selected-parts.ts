import type { Project, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront/project";
import type { DrawnKind, Entity } from "../entities";
import type { Shape } from "../shape";

/**
 * The records of a selection, with all that they are built on: the lines of patches, the points of lines, and the sizes
 * painted on bodies.
 */
export interface SelectedParts {
  readonly points: readonly ProjectPoint[];
  readonly lines: readonly ProjectLine[];
  readonly patches: readonly ProjectPatch[];
  readonly bodies: ReadonlySet<number>;
  readonly nodes: ReadonlySet<number>;
  readonly sources: ReadonlySet<number>;
}

/** Returns the records of a selection and those that they are built on, each once, in the order of the project. */
export function selectedParts(project: Project, selection: readonly Entity[]): SelectedParts {
  const idsOf = (of: DrawnKind): Set<number> =>
    new Set(selection.flatMap(({ kind, id }) => (kind === of ? [id] : [])));
  const [pointIds, lineIds, patchIds] = [idsOf("point"), idsOf("line"), idsOf("patch")];
  const patches = project.patches.filter(({ id }) => patchIds.has(id));
  for (const step of patches.flatMap(({ loops }) => loops.flat())) lineIds.add(Math.abs(step));
  const lines = project.lines.filter(({ id }) => lineIds.has(id));
  for (const point of lines.flatMap((line) => line.points)) pointIds.add(point);
  const points = project.points.filter(({ id }) => pointIds.has(id));
  const bodies = idsOf("body");
  const sources = idsOf("source");
  for (const { id, body } of project.background.sources ?? []) {
    if (body !== undefined && bodies.has(body)) sources.add(id);
  }
  return { points, lines, patches, bodies, nodes: idsOf("background-node"), sources };
}

/** Returns whether there is something to transform. */
export function hasParts({ points, bodies, nodes, sources }: SelectedParts): boolean {
  return points.length + bodies.size + nodes.size + sources.size > 0;
}

/** Returns drawn records as a shape. */
export function shapeOf({
  points,
  lines,
  patches,
}: Pick<SelectedParts, "points" | "lines" | "patches">): Shape {
  const pointAt = new Map(points.map(({ id }, index) => [id, index]));
  const lineAt = new Map(lines.map(({ id }, index) => [id, index + 1]));
  return {
    points: points.map(({ position }) => position),
    lines: lines.map(({ type, points: own, startTangent, endTangent }) => ({
      type,
      points: own.map((id) => pointAt.get(id) ?? 0),
      ...(startTangent && { startTangent }),
      ...(endTangent && { endTangent }),
    })),
    patches: patches.map(({ type, loops, name }) => ({
      type,
      loops: loops.map((loop) => loop.map((step) => Math.sign(step) * (lineAt.get(Math.abs(step)) ?? 0))),
      ...(name !== undefined && { name }),
    })),
  };
}
