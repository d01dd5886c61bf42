import type { LineType, Project, ProjectLine, ProjectPoint } from "tetrafront/project";
import { entityNouns, stepNames } from "../strings";
import { nextId, type Creation } from "./create";
import { findRecord } from "./entities";
import { coordinatesOf, keepCoordinates } from "./expression-edits";
import { diagonalOf } from "./extent";
import { coincidenceLength } from "./insert-shape";
import { linePositions } from "./line-samples";
import type { Position } from "./position";
import { quantityPosition, type QuantityPosition } from "./quantity-positions";
import { expressionsOnLine } from "./splits/following";
import { crossingNear, lineCurve, nearestParameter } from "./splits/line-curve";
import { changedLists, splitLines, type Cut } from "./splits/split-line";
import { distance } from "./vectors";

/** A place that the user has picked: a point of the project, or a position at which to create one. */
export interface Place {
  /** Null for a position without a point. */
  readonly point: number | null;
  readonly position: Position;
  /** What the coordinates were typed as; null for plain numbers. */
  readonly expressions?: readonly (string | null)[];
  /** Ids of the lines on which it was found: a line that ends there splits them. */
  readonly lines?: readonly number[];
  /** Id of the patch on which it was found. */
  readonly patch?: number;
}

/** Returns the coordinates of a place with the expressions from which they are computed. */
export const quantitiesAt = (project: Project, { point, position, expressions }: Place): QuantityPosition =>
  quantityPosition(position, point === null ? expressions : coordinatesOf(project, point));

/** Positions closer than this are one point, relative to the extent of the model: as in the engine. */
const coincidence = 1e-9;

/** Returns the place at a position: an existing point if one lies there. */
export function placeAt(
  project: Project,
  position: Position,
  expressions: readonly (string | null)[] = [],
): Place {
  const tolerance = coincidence * (diagonalOf(project.points) || 1);
  const found = project.points.find((point) => distance(point.position, position) <= tolerance);
  return found ? { point: found.id, position: found.position } : { point: null, position, expressions };
}

export const samePlace = (a: Place, b: Place): boolean =>
  a.point === null
    ? a === b || (b.point === null && distance(a.position, b.position) === 0)
    : a.point === b.point;

/**
 * Returns the place on lines that is nearest to a position found on their samples: where two of them cross, if they do, or
 * else on the first one. A new point there follows the expressions of a line.
 */
export function placeOnLines(project: Project, lines: readonly number[], position: Position): Place {
  const courses = lines.flatMap((id) => {
    const line = findRecord(project, "line", id);
    const points = line ? linePositions(project, line) : [];
    const curve = line && lineCurve(line.type, points);
    return curve ? [{ line, points, curve }] : [];
  });
  const [a, b] = courses;
  if (!a) return { ...placeAt(project, position), lines };
  const crossing = b ? crossingNear(a.curve, b.curve, position, coincidenceLength(project)) : null;
  const exact = a.curve.at(crossing?.[0] ?? nearestParameter(a.curve, position));
  const through = crossing ? courses : [a];
  const [expressions] = through.flatMap(({ line, points }) =>
    expressionsOnLine(project, line, points, [exact]),
  );
  return { ...placeAt(project, exact, expressions), lines: through.map(({ line }) => line.id) };
}

/** Ids of the points at places; those of new points count up. Equal places share one point. */
function pointIds(project: Project, places: readonly Place[]) {
  const created: { id: number; position: Position; expressions: readonly (string | null)[] }[] = [];
  let next = nextId(project, "point");
  const ids = places.map(({ point, position, expressions = [] }) => {
    const known = point ?? created.find((other) => distance(other.position, position) === 0)?.id;
    if (known !== undefined) return known;
    created.push({ id: next, position, expressions });
    return next++;
  });
  return { ids, created };
}

/** A line that was drawn: the edit that adds it, and the ids of its points. */
export interface DrawnLine {
  /** Null if the project has the line already. */
  readonly creation: Creation | null;
  readonly line: number;
  readonly points: readonly number[];
}

/** Returns a line through places. Points are created with it, and an equal straight line is not repeated. */
export function drawLine(project: Project, type: LineType, places: readonly Place[]): DrawnLine {
  const { ids, created } = pointIds(project, places);
  const same = created.length === 0 ? project.lines.find((line) => isSame(line, type, ids)) : undefined;
  if (same) return { creation: null, line: same.id, points: ids };
  const id = nextId(project, "line");
  const points = created.map(({ id: point, position: [x, y, z] }): ProjectPoint => ({
    id: point,
    position: [x, y, z],
  }));
  const drawn: Project = {
    ...project,
    points: [...project.points, ...points],
    lines: [...project.lines, { id, type, points: ids }],
  };
  const divided = splitLines(drawn, cutsAtEnds(places, ids)).project;
  const creation: Creation = {
    entities: [{ kind: "line", id }],
    edit: {
      label: stepNames.add(`${entityNouns.line} ${id}`),
      change: ({ project: draft }) => {
        if (divided === drawn) {
          draft.points.push(
            ...points.map(({ position: [x, y, z], ...point }) => ({
              ...point,
              position: [x, y, z] as [number, number, number],
            })),
          );
          draft.lines.push({ id, type, points: [...ids] });
        } else Object.assign(draft, changedLists(project, divided));
        keepCoordinates(draft, created);
      },
    },
  };
  return { creation, line: id, points: ids };
}

/** Returns the splits of the lines on which a line ends. */
function cutsAtEnds(places: readonly Place[], ids: readonly number[]): readonly Cut[] {
  const ends = new Set([0, places.length - 1]);
  return [...ends].flatMap((index) => {
    const { lines = [], position } = places[index] ?? {};
    return position ? lines.map((line): Cut => ({ line, position, point: ids[index] })) : [];
  });
}

function isSame(line: ProjectLine, type: LineType, points: readonly number[]): boolean {
  if (line.type !== type || line.points.length !== points.length) return false;
  const key = points.join();
  return line.points.join() === key || line.points.toReversed().join() === key;
}
