import type { BodyPlacement, Project } from "tetrafront";
import type { DrawnSurface } from "../document/drawn-surface";
import { entityKey, type Entity } from "../document/entities";
import type { LinePath } from "../document/line-paths";
import { isInside, type Flat } from "../document/planar-loops";
import { placed } from "../document/placement";
import type { Position } from "../document/position";
import type { ViewState } from "../document/selection";
import { drawnOf, type ShownBody } from "../viewer/shown-bodies";
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
  readonly paths: Iterable<readonly Position[]>;
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
  const isIn = (at: ScreenPoint | null): boolean => at !== null && isInside([at.x, at.y], polygon);
  const isFound = (paths: Iterable<readonly Position[]>): boolean => {
    let isEmpty = true;
    for (const path of paths) {
      const seen = path.map(toScreen);
      if (touching ? seen.some(isIn) || crosses(seen, points) : !seen.every(isIn)) return touching;
      isEmpty &&= seen.length === 0;
    }
    return !touching && !isEmpty;
  };
  return shown.flatMap(({ entity, paths }) => (isFound(paths) ? [entity] : []));
}

/** Returns the bodies that are shown, each with the border of every triangle that is drawn. */
export function outlinedBodies(
  bodies: readonly ShownBody[],
  { layers, hidden, bodySurface }: Pick<ViewState, "layers" | "hidden" | "bodySurface">,
): readonly ShownEntity[] {
  if (!layers.bodies) return [];
  return bodies.flatMap((body): ShownEntity[] => {
    const entity = { kind: "body", id: body.id } as const;
    if (hidden.has(entityKey(entity))) return [];
    const { drawn, placement } = drawnOf(body, bodySurface);
    return drawn ? [{ entity, paths: { [Symbol.iterator]: () => borders(drawn, placement) } }] : [];
  });
}

/** Gives the corners of each triangle, the first one again at the end. */
function* borders(
  { centre, corners }: DrawnSurface,
  placement: BodyPlacement | undefined,
): Generator<readonly Position[]> {
  const cornerAt = (i: number): Position => {
    const at = centre.map((x, k) => x + (corners[i + k] ?? 0)) as [number, number, number];
    return placement ? placed(at, placement) : at;
  };
  for (let i = 0; i < corners.length; i += 9) {
    const [a, b, c] = [cornerAt(i), cornerAt(i + 3), cornerAt(i + 6)];
    yield [a, b, c, a];
  }
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
