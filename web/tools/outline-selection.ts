import type { Project } from "tetrafront";
import { entityKey, type Entity } from "../document/entities";
import type { LinePath } from "../document/line-paths";
import { isInside, type Flat } from "../document/planar-loops";
import type { Position } from "../document/position";
import type { ViewState } from "../document/selection";
import type { ScreenPoint } from "../viewer/screen";

/** A box or lasso on the screen. */
export interface Outline {
  readonly points: readonly ScreenPoint[];
  /** Select what the outline touches, instead of what lies inside it. */
  readonly touching: boolean;
}

/**
 * Returns the outline of a drag: the box between two corners, or a lasso through more. A drag to the right selects what
 * lies inside, a drag to the left also what is touched.
 */
export function outlineOf(corners: readonly ScreenPoint[]): Outline {
  const [a = { x: 0, y: 0 }, b = a] = corners;
  const last = corners.at(-1) ?? a;
  const touching = last.x < a.x;
  if (corners.length > 2) return { points: corners, touching };
  return { points: [a, { x: b.x, y: a.y }, b, { x: a.x, y: b.y }], touching };
}

/** An entity with the polylines that it consists of; a point has one position. */
export interface ShownEntity {
  readonly entity: Entity;
  readonly paths: readonly (readonly Position[])[];
}

/** Returns the points, lines, patches, background nodes and sources that are shown; a patch with the lines around it. */
export function shownEntities(
  project: Project,
  paths: readonly LinePath[],
  { layers, hidden }: Pick<ViewState, "layers" | "hidden">,
): readonly ShownEntity[] {
  const byLine = new Map(paths.map(({ line, positions }) => [line.id, positions]));
  const points = project.points.map(({ id, position }): ShownEntity => ({
    entity: { kind: "point", id },
    paths: [[position]],
  }));
  const lines = paths.map(({ line: { id }, positions }): ShownEntity => ({
    entity: { kind: "line", id },
    paths: [positions],
  }));
  const patches = project.patches.map(({ id, loops }): ShownEntity => ({
    entity: { kind: "patch", id },
    paths: loops.flat().map((step) => byLine.get(Math.abs(step)) ?? []),
  }));
  const { nodes, sources = [] } = project.background;
  const gridNodes = nodes.map(({ id, position }): ShownEntity => ({
    entity: { kind: "background-node", id },
    paths: [[position]],
  }));
  const sourcePaths = sources.map(({ id, positions }): ShownEntity => ({
    entity: { kind: "source", id },
    paths: [positions.length > 2 ? [...positions, ...positions.slice(0, 1)] : positions],
  }));
  const shown = [
    ...(layers.points ? points : []),
    ...(layers.lines ? lines : []),
    ...(layers.patches ? patches : []),
    ...(layers.background ? gridNodes : []),
    ...(layers.sources ? sourcePaths : []),
  ];
  return hidden.size === 0 ? shown : shown.filter(({ entity }) => !hidden.has(entityKey(entity)));
}

/** Returns the entities inside an outline, or also those that it touches. O(positions). */
export function entitiesWithin(
  { points, touching }: Outline,
  shown: readonly ShownEntity[],
  toScreen: (position: Position) => ScreenPoint | null,
): Entity[] {
  const polygon = points.map(({ x, y }): Flat => [x, y]);
  return shown.flatMap(({ entity, paths }) => {
    const seen = paths.map((path) => path.map(toScreen));
    const isIn = (at: ScreenPoint | null): boolean => at !== null && isInside([at.x, at.y], polygon);
    const all = seen.flat();
    if (all.length === 0) return [];
    const isFound = touching ? all.some(isIn) || seen.some((path) => crosses(path, points)) : all.every(isIn);
    return isFound ? [entity] : [];
  });
}

/** Returns whether a polyline crosses a closed polygon. */
function crosses(path: readonly (ScreenPoint | null)[], polygon: readonly ScreenPoint[]): boolean {
  return path.slice(1).some((b, i) => {
    const a = path[i];
    if (!a || !b) return false;
    return polygon.some((c, k) => segmentsCross(a, b, c, polygon[(k + 1) % polygon.length] ?? c));
  });
}

function segmentsCross(a: ScreenPoint, b: ScreenPoint, c: ScreenPoint, d: ScreenPoint): boolean {
  return side(a, b, c) !== side(a, b, d) && side(c, d, a) !== side(c, d, b);
}

/** Returns whether c lies to the left of the way from a to b. */
const side = (a: ScreenPoint, b: ScreenPoint, c: ScreenPoint): boolean =>
  (b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x);
