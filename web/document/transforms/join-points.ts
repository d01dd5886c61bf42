import type { Project, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront/project";
import { coincidenceLength } from "../insert-shape";
import { closedDirection, isClosed, lineKey, loopsKey, sameCourse } from "../line-courses";
import { PointIndex } from "../point-index";
import type { Position } from "../position";
import { distance, zero } from "../vectors";

type Drawn = Pick<Project, "points" | "lines" | "patches">;

/** The drawn records of a project after points were joined. */
export interface Joined {
  readonly points: readonly ProjectPoint[];
  readonly lines: readonly ProjectLine[];
  readonly patches: readonly ProjectPatch[];
}

/**
 * Joins points at one position, then lines with the same course and patches within the same lines, into the first of each.
 * Returns the same lists if nothing coincides. O(size).
 */
export function joinPoints(project: Project): Joined {
  const tolerance = coincidenceLength(project);
  const index = new PointIndex<number>(tolerance);
  const pointIds = new Map<number, number>();
  for (const { id, position } of project.points) {
    const same = index.find(position);
    if (same === undefined) index.add(position, id);
    else pointIds.set(id, same);
  }
  return withPoints(project, pointIds);
}

/** Joins two points into the first of them, then lines and patches that coincide. */
export function joinPair(project: Project, keep: number, drop: number): Joined {
  const ids = new Set(project.points.map(({ id }) => id));
  return ids.has(keep) && ids.has(drop) ? withPoints(project, new Map([[drop, keep]])) : project;
}

/** Joins two lines with the same course into the first of them, then patches within the same lines. */
export function joinLinePair(project: Project, keep: number, drop: number): Joined {
  const pair = [keep, drop].flatMap((id) => project.lines.find((line) => line.id === id) ?? []);
  const { lineIds } = joinLines(pair, project.points, coincidenceLength(project));
  if (lineIds.size === 0) return project;
  const lines = project.lines.filter(({ id }) => !lineIds.has(id));
  return { points: project.points, lines, patches: joinPatches(project.patches, lineIds) };
}

/**
 * Joins those of the given lines that have the same course into the first of each. Patches within the same lines stay.
 */
export function joinCourses<Lists extends Drawn>(
  drawn: Lists,
  ids: ReadonlySet<number>,
  tolerance: number,
): Lists {
  const own = drawn.lines.filter(({ id }) => ids.has(id));
  const { lineIds } = joinLines(own, drawn.points, tolerance);
  if (lineIds.size === 0) return drawn;
  const lines = drawn.lines.filter(({ id }) => !lineIds.has(id));
  const patches = drawn.patches.map((patch) => withLines(patch, lineIds));
  return { ...drawn, points: withoutUnused(drawn.points, own, lines), lines, patches };
}

/** Replaces points by others: `pointIds` has the point that stays for each one that goes. */
function withPoints(project: Project, pointIds: ReadonlyMap<number, number>): Joined {
  const tolerance = coincidenceLength(project);
  const points = project.points.filter(({ id }) => !pointIds.has(id));
  const moved = project.lines.map((line) =>
    line.points.some((id) => pointIds.has(id))
      ? { ...line, points: line.points.map((id) => pointIds.get(id) ?? id) }
      : line,
  );
  const { lines, lineIds } = joinLines(moved, points, tolerance);
  if (pointIds.size === 0 && lineIds.size === 0) return project;
  return {
    // The line that replaces others may begin elsewhere.
    points: lineIds.size === 0 ? points : withoutUnused(points, moved, lines),
    lines,
    patches: joinPatches(project.patches, lineIds),
  };
}

/** Returns the points without those of some lines before that no line uses any more; the same list if there are none. */
export function withoutUnused(
  points: readonly ProjectPoint[],
  before: readonly ProjectLine[],
  lines: readonly ProjectLine[],
): readonly ProjectPoint[] {
  const used = new Set(lines.flatMap((line) => line.points));
  const unused = new Set(before.flatMap((line) => line.points).filter((id) => !used.has(id)));
  return unused.size === 0 ? points : points.filter(({ id }) => !unused.has(id));
}

/** Signed ids of the lines that stay, for the lines that go. */
type LineIds = ReadonlyMap<number, number>;

function joinLines(
  all: readonly ProjectLine[],
  points: readonly ProjectPoint[],
  tolerance: number,
): { readonly lines: readonly ProjectLine[]; readonly lineIds: LineIds } {
  const positions = new Map(points.map(({ id, position }) => [id, position]));
  const courseOf = (line: ProjectLine): Position[] => line.points.map((id) => positions.get(id) ?? zero);
  const isSame = (a: Position, b: Position): boolean => distance(a, b) <= tolerance;
  const known = new Map<string, ProjectLine[]>();
  const lineIds = new Map<number, number>();
  for (const line of all) {
    // A closed line may begin anywhere.
    const key = isClosed(line) ? line.type : lineKey(line);
    const candidates = known.get(key) ?? [];
    const course = courseOf(line);
    const directionTo = (other: ProjectLine): 1 | -1 | 0 => {
      const its = courseOf(other);
      if (isClosed(line)) return closedDirection(line.type, course, its, isSame);
      if (other.points[0] === line.points[0] && sameCourse(line.type, course, its, isSame)) return 1;
      const isBack = other.points.at(-1) === line.points[0];
      return isBack && sameCourse(line.type, course, its.toReversed(), isSame) ? -1 : 0;
    };
    const same = candidates.find((other) => directionTo(other) !== 0);
    if (same) lineIds.set(line.id, directionTo(same) * same.id);
    else known.set(key, [...candidates, line]);
  }
  return { lines: all.filter(({ id }) => !lineIds.has(id)), lineIds };
}

function joinPatches(all: readonly ProjectPatch[], lineIds: LineIds): readonly ProjectPatch[] {
  const seen = new Set<string>();
  return all
    .map((patch) => withLines(patch, lineIds))
    .filter(({ loops }) => {
      const key = loopsKey(loops);
      if (seen.has(key)) return false;
      seen.add(key);
      return true;
    });
}

/** Returns a patch with lines that stay instead of those that go. */
function withLines(patch: ProjectPatch, lineIds: LineIds): ProjectPatch {
  const isChanged = patch.loops.some((loop) => loop.some((step) => lineIds.has(Math.abs(step))));
  if (!isChanged) return patch;
  const loops = patch.loops.map((loop) =>
    loop.map((step) => Math.sign(step) * (lineIds.get(Math.abs(step)) ?? Math.abs(step))),
  );
  return { ...patch, loops };
}
