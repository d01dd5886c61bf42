import type { BodyPlacement, Project } from "tetrafront/project";
import type { DrawnSurface } from "../document/drawn-surface";
import { entityKey, type Entity } from "../document/entities";
import type { LinePath } from "../document/line-paths";
import { placed } from "../document/placement";
import type { Position } from "../document/position";
import type { ViewState } from "../document/selection";
import { drawnOf, type ShownBody } from "../viewer/shown-bodies";
import type { ScreenPoint } from "../viewer/screen";
import { boxAround, OutlineArea, type Place } from "./outline-area";

/** A box or lasso on the screen. */
export interface Outline {
  readonly points: readonly ScreenPoint[];
  /** Select what the outline touches, instead of what lies inside it. */
  readonly touching: boolean;
}

/**
 * Returns the outline of a drag: the box between two corners, or a lasso through more. A drag to the right, or a clockwise
 * lasso, selects what lies inside; a drag to the left, or a counter-clockwise lasso, also what is touched.
 */
export function outlineOf(corners: readonly ScreenPoint[]): Outline {
  const [a = { x: 0, y: 0 }, b = a] = corners;
  // Where a lasso ends says nothing: that is near its beginning.
  if (corners.length > 2) return { points: corners, touching: !isClockwise(corners) };
  return { points: [a, { x: b.x, y: a.y }, b, { x: a.x, y: b.y }], touching: b.x < a.x };
}

/** Returns whether a closed outline runs clockwise on the screen, where y points down. */
function isClockwise(points: readonly ScreenPoint[]): boolean {
  const doubleArea = points.reduce((sum, { x, y }, i) => {
    const next = points[(i + 1) % points.length] ?? { x, y };
    return sum + x * next.y - next.x * y;
  }, 0);
  return doubleArea >= 0;
}

/** An entity with the polylines that it consists of; a point has one position. */
export interface ShownEntity {
  readonly entity: Entity;
  readonly paths: Iterable<readonly Position[]>;
  /** Boxes around parts of it, and the polylines of each; without them, `paths` is its only part. */
  readonly parts?: Iterable<ShownPart>;
}

/** Polylines, and the corners of a box around them. */
interface ShownPart {
  readonly corners: readonly Position[];
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

/**
 * Returns the entities inside an outline, or also those that it touches. O(positions + points of the outline): parts of
 * bodies that appear wholly inside or outside are not looked at.
 */
export function entitiesWithin(
  { points, touching }: Outline,
  shown: readonly ShownEntity[],
  toScreen: (position: Position) => ScreenPoint | null,
  area = new OutlineArea(points),
): Entity[] {
  const isIn = (at: ScreenPoint | null): boolean => at !== null && area.contains(at);
  const isCrossed = (seen: readonly (ScreenPoint | null)[]): boolean =>
    seen.some((b, i) => {
      const a = seen[i - 1];
      return a != null && b !== null && area.crosses(a, b);
    });
  /** Returns whether paths decide the answer: one is touched, or one is not inside. */
  const isDecided = (paths: Iterable<readonly Position[]>): boolean => {
    for (const path of paths) {
      const seen = path.map(toScreen);
      if (touching ? seen.some(isIn) || isCrossed(seen) : !seen.every(isIn)) return true;
    }
    return false;
  };
  const placeOf = (corners: readonly Position[]): Place => {
    const seen = corners.map(toScreen);
    const isSeen = (at: ScreenPoint | null): at is ScreenPoint => at !== null;
    return seen.every(isSeen) ? area.placeOf(boxAround(seen)) : "mixed";
  };
  const isPartDecided = ({ corners, paths }: ShownPart): boolean => {
    const place = placeOf(corners);
    if (place === "mixed") return isDecided(paths);
    return (place === "inside") === touching;
  };
  const isFound = ({ paths, parts }: ShownEntity): boolean => {
    if (!parts) return isDecided(paths) ? touching : !touching && hasPositions(paths);
    let isEmpty = true;
    for (const part of parts) {
      if (isPartDecided(part)) return touching;
      isEmpty = false;
    }
    return !touching && !isEmpty;
  };
  return shown.flatMap((one) => (isFound(one) ? [one.entity] : []));
}

function hasPositions(paths: Iterable<readonly Position[]>): boolean {
  for (const path of paths) if (path.length > 0) return true;
  return false;
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
    if (!drawn) return [];
    const every = { [Symbol.iterator]: () => borders(drawn, placement, 0, drawn.corners.length) };
    const parts = { [Symbol.iterator]: () => partsOf(drawn, placement) };
    return [{ entity, paths: every, parts }];
  });
}

/** Number of triangles in a part of a body: those that follow each other are mostly near each other. */
const trianglesPerPart = 64;

/** Lowest and highest coordinates of the parts of surfaces, x y z x y z each, relative to their centre. */
const partBoxes = new WeakMap<DrawnSurface, Float32Array>();

function boxesOf(drawn: DrawnSurface): Float32Array {
  const known = partBoxes.get(drawn);
  if (known) return known;
  const { corners } = drawn;
  const perPart = 9 * trianglesPerPart;
  const boxes = new Float32Array(6 * Math.ceil(corners.length / perPart));
  for (let box = 0; box < boxes.length; box += 6) {
    boxes.fill(Infinity, box, box + 3).fill(-Infinity, box + 3, box + 6);
    const start = (box / 6) * perPart;
    for (let i = start; i < Math.min(start + perPart, corners.length); ++i) {
      const [low, high, x] = [box + (i % 3), box + 3 + (i % 3), corners[i] ?? 0];
      if (x < (boxes[low] ?? 0)) boxes[low] = x;
      if (x > (boxes[high] ?? 0)) boxes[high] = x;
    }
  }
  partBoxes.set(drawn, boxes);
  return boxes;
}

/** Gives the parts of a body. */
function* partsOf(drawn: DrawnSurface, placement: BodyPlacement | undefined): Generator<ShownPart> {
  const boxes = boxesOf(drawn);
  const toModel = placer(drawn, placement);
  const perPart = 9 * trianglesPerPart;
  for (let part = 0; 6 * part < boxes.length; ++part) {
    const end = (corner: number, axis: number): number =>
      boxes[6 * part + axis + 3 * ((corner >> axis) & 1)] ?? 0;
    const corners = Array.from({ length: 8 }, (_, corner) =>
      toModel(end(corner, 0), end(corner, 1), end(corner, 2)),
    );
    const last = Math.min((part + 1) * perPart, drawn.corners.length);
    yield { corners, paths: borders(drawn, placement, part * perPart, last) };
  }
}

/** Returns a function that gives the position of a corner of a drawn surface. */
function placer({ centre }: DrawnSurface, placement: BodyPlacement | undefined) {
  return (x: number, y: number, z: number): Position => {
    const at: Position = [centre[0] + x, centre[1] + y, centre[2] + z];
    return placement ? placed(at, placement) : at;
  };
}

/** Gives the corners of each triangle of a range of corners, the first one again at the end. */
function* borders(
  drawn: DrawnSurface,
  placement: BodyPlacement | undefined,
  start: number,
  end: number,
): Generator<readonly Position[]> {
  const { corners } = drawn;
  const toModel = placer(drawn, placement);
  const cornerAt = (i: number): Position =>
    toModel(corners[i] ?? 0, corners[i + 1] ?? 0, corners[i + 2] ?? 0);
  for (let i = start; i < end; i += 9) {
    const [a, b, c] = [cornerAt(i), cornerAt(i + 3), cornerAt(i + 6)];
    yield [a, b, c, a];
  }
}
