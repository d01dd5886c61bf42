import type { Project, ProjectLine } from "tetrafront/project";
import { samplesAlong } from "../line-samples";
import type { Flat } from "../planar-loops";
import { cutsAtCrossings, sampledPath } from "../splits/line-crossings";
import { splitLines } from "../splits/split-line";
import { joinCourses } from "../transforms/join-points";
import { toFrame, zero, type Frame } from "../vectors";
import { crossingOf, distanceFrom, type Side } from "./plane-polygons";

/**
 * How near the samples of a curve pass a place on the curve, relative to the distance between two samples: the sagitta of a
 * quarter of a circle in eight parts, a little enlarged.
 */
const sagitta = 0.03;

/**
 * Divides lines that lie in the plane of a frame where they cross each other and where another one ends on them; pieces with
 * the same course become one. `linesOf` returns the ids of the lines. Returns null if a line of a patch that needs a certain
 * number of lines would be divided, and if lines touch elsewhere than at ends afterwards, for example where a circle touches
 * a straight line. O(n²) for n lines.
 */
export function dividedInPlane(
  project: Project,
  linesOf: (project: Project) => ReadonlySet<number>,
  frame: Frame,
  tolerance: number,
): Project | null {
  const ids = linesOf(project);
  const paths = project.lines.filter(({ id }) => ids.has(id)).map((line) => sampledPath(project, line));
  const split = splitLines(project, cutsAtCrossings(project, paths));
  if (split.hasMisfits) return null;
  const joined = joinCourses(split.project, linesOf(split.project), tolerance);
  const lines = flatLines(joined, linesOf(joined), frame);
  const isTouching = lines.some((one, i) => lines.slice(i + 1).some((other) => touch(one, other, tolerance)));
  return isTouching ? null : joined;
}

interface FlatLine {
  readonly line: ProjectLine;
  readonly samples: readonly Flat[];
  readonly low: Flat;
  readonly high: Flat;
}

/** Returns lines in the coordinates of a plane. */
function flatLines(project: Project, ids: ReadonlySet<number>, frame: Frame): readonly FlatLine[] {
  const positions = new Map(project.points.map(({ id, position }) => [id, position]));
  return project.lines
    .filter(({ id }) => ids.has(id))
    .map((line) => {
      const course = samplesAlong(
        line.type,
        line.points.map((point) => positions.get(point) ?? zero),
      );
      const samples = course.map((position): Flat => {
        const [x, y] = toFrame(frame, position);
        return [x, y];
      });
      const bound = (choose: (...values: number[]) => number): Flat => [
        samples.reduce((best, [x]) => choose(best, x), samples[0]?.[0] ?? 0),
        samples.reduce((best, [, y]) => choose(best, y), samples[0]?.[1] ?? 0),
      ];
      return { line, samples, low: bound(Math.min), high: bound(Math.max) };
    });
}

/** Returns how far a side of the samples of a line is from the line at most. */
const reachOf = ({ line }: FlatLine, [[ax, ay], [bx, by]]: Side, tolerance: number): number =>
  line.type === "straight" ? tolerance : Math.max(tolerance, sagitta * Math.hypot(bx - ax, by - ay));

/** Returns whether two lines touch elsewhere than at an end that both have. */
function touch(one: FlatLine, other: FlatLine, tolerance: number): boolean {
  const endsOf = ({ line }: FlatLine) => [line.points.at(0), line.points.at(-1)];
  const shared = endsOf(one).flatMap((end, i) =>
    endsOf(other).includes(end) ? [one.samples.at(i === 0 ? 0 : -1) ?? ([0, 0] as const)] : [],
  );
  const isShared = ([x, y]: Flat, reach: number): boolean =>
    shared.some((end) => Math.hypot(x - end[0], y - end[1]) <= reach);
  const largest = Math.max(...[one, other].map((line) => reachOf(line, [line.low, line.high], tolerance)));
  const isApart = [0, 1].some(
    (k) =>
      (one.low[k] ?? 0) > (other.high[k] ?? 0) + largest ||
      (other.low[k] ?? 0) > (one.high[k] ?? 0) + largest,
  );
  if (isApart) return false;
  for (const side of sidesOf(one.samples)) {
    for (const its of sidesOf(other.samples)) {
      const reach = Math.max(reachOf(one, side, tolerance), reachOf(other, its, tolerance));
      const places = [
        crossingOf(side, its),
        ...its.filter((end) => distanceFrom(end, side) <= reach),
        ...side.filter((end) => distanceFrom(end, its) <= reach),
      ];
      if (places.some((place) => place && !isShared(place, reach))) return true;
    }
  }
  return false;
}

const sidesOf = (samples: readonly Flat[]): readonly Side[] =>
  samples.slice(0, -1).map((from, i) => [from, samples[i + 1] ?? from]);
