import type { Project, ProjectLine } from "tetrafront/project";
import { coincidenceLength } from "../insert-shape";
import type { LinePath } from "../line-paths";
import { linePositions } from "../line-samples";
import type { Position } from "../position";
import { addScaled, cross, distance, dot, length, subtract } from "../vectors";
import { crossingNear, lineCurve, nearestParameter, type LineCurve } from "./line-curve";
import type { Cut } from "./split-line";

/** How near the samples of two curves pass each other where the curves cross, relative to the distance of the samples. */
const sampleGap = 0.05;

/** Positions per smooth piece of a line that the engine has not sampled. */
const samples = 24;

/** Returns the course of a line by samples of its own. */
export function sampledPath(project: Project, line: ProjectLine): LinePath {
  const points = linePositions(project, line);
  const curve = line.type === "straight" ? null : lineCurve(line.type, points);
  if (!curve) return { line, positions: points };
  const inner = curve.knots.slice(1).flatMap((to, i) => {
    const from = curve.knots[i] ?? 0;
    return Array.from({ length: samples }, (_, k) => curve.at(from + ((to - from) * (k + 1)) / samples));
  });
  return { line, positions: [curve.at(0), ...inner] };
}

interface Course {
  readonly path: LinePath;
  readonly curve: LineCurve;
  readonly low: Position;
  readonly high: Position;
}

/**
 * Returns where lines would have to be split so that they meet at ends only: where another line ends on them, and where two
 * lines cross. O(lines² + near pairs · samples²).
 */
export function cutsAtCrossings(project: Project, paths: readonly LinePath[]): readonly Cut[] {
  const tolerance = 10 * coincidenceLength(project);
  const courses = paths.flatMap((path) => courseOf(project, path) ?? []);
  return courses.flatMap((one, i) =>
    courses.slice(i + 1).flatMap((other) => {
      if (!areNear(one, other, tolerance)) return [];
      return [
        ...endsOn(one, other, tolerance),
        ...endsOn(other, one, tolerance),
        ...crossings(one, other, tolerance),
      ];
    }),
  );
}

function courseOf(project: Project, path: LinePath): Course | null {
  const points = linePositions(project, path.line);
  const curve = points.length === path.line.points.length ? lineCurve(path.line.type, points) : null;
  if (!curve) return null;
  const bound = (choose: (a: number, b: number) => number): Position =>
    path.positions.reduce(
      ([x, y, z], [a, b, c]) => [choose(x, a), choose(y, b), choose(z, c)],
      path.positions[0] ?? [0, 0, 0],
    );
  const [low, high] = [bound(Math.min), bound(Math.max)];
  // Curves leave the box of their samples a little.
  const margin = path.line.type === "straight" ? 0 : sampleGap * distance(low, high);
  const grown = (corner: Position, by: number): Position => [corner[0] + by, corner[1] + by, corner[2] + by];
  return { path, curve, low: grown(low, -margin), high: grown(high, margin) };
}

const areNear = (a: Course, b: Course, margin: number): boolean =>
  a.low.every((x, k) => x <= (b.high[k] ?? 0) + margin && (b.low[k] ?? 0) <= (a.high[k] ?? 0) + margin);

const endsOf = ({ curve }: Course): readonly Position[] => [curve.at(0), curve.at(1)];

/** Returns where a line ends within another one; a closed line ends at its seam. */
function endsOn(one: Course, other: Course, tolerance: number): readonly Cut[] {
  const { line } = one.path;
  const isClosed = line.points[0] === line.points.at(-1);
  const ends = isClosed ? [line.points[0]] : [line.points[0], line.points.at(-1)];
  return ends.flatMap((point, i) => {
    const position = one.curve.at(i);
    if (endsOf(other).some((end) => distance(end, position) <= tolerance)) return [];
    const on = other.curve.at(nearestParameter(other.curve, position));
    return distance(on, position) <= tolerance ? [{ line: other.path.line.id, position, point }] : [];
  });
}

/** Returns where two lines cross away from their ends. */
function crossings(one: Course, other: Course, tolerance: number): readonly Cut[] {
  const ends = [...endsOf(one), ...endsOf(other)];
  const found: Position[] = [];
  for (const near of candidates(one.path.positions, other.path.positions)) {
    const parameters = crossingNear(one.curve, other.curve, near, tolerance / 10);
    if (!parameters) continue;
    const place = one.curve.at(parameters[0]);
    if ([...ends, ...found].every((known) => distance(known, place) > tolerance)) found.push(place);
  }
  return found.flatMap((position) => [
    { line: one.path.line.id, position },
    { line: other.path.line.id, position },
  ]);
}

/** Returns places at which two polylines pass near each other. */
function candidates(a: readonly Position[], b: readonly Position[]): readonly Position[] {
  return a.slice(1).flatMap((to, i) =>
    b.slice(1).flatMap((end, k) => {
      const [from, start] = [a[i] ?? to, b[k] ?? end];
      const [u, v, w] = [subtract(to, from), subtract(end, start), subtract(start, from)];
      const normal = cross(u, v);
      const square = dot(normal, normal);
      const size = Math.max(length(u), length(v));
      if (square <= 1e-18 * size ** 4) return [];
      const [s, t] = [dot(cross(w, v), normal) / square, dot(cross(w, u), normal) / square];
      const isWithin = [s, t].every((share) => share >= -sampleGap && share <= 1 + sampleGap);
      const [p, q] = [addScaled(from, u, s), addScaled(start, v, t)];
      return isWithin && distance(p, q) <= sampleGap * size ? [p] : [];
    }),
  );
}
