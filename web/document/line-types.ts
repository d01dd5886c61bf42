import type { LineType } from "tetrafront/project";

/** Types of lines, in the order in which the app offers them. */
export const lineTypes = [
  "straight",
  "arc",
  "circle",
  "parabolic",
  "spline",
  "hermite",
] as const satisfies readonly LineType[];

/** Whether lines of a type run through any number of points, and may end where they begin. */
export const runsThroughMany = (type: LineType): boolean => type === "spline" || type === "hermite";

/** Types of lines with their points: a circle names its first point twice. */
const isCircle = (type: LineType): boolean => type === "circle";

/**
 * Returns the points of a line after its type has changed: a circle gets its first point again at its end, and another
 * type of line loses it, if it then has a permitted number of points.
 */
export function pointsForType(
  points: readonly number[],
  before: LineType,
  after: LineType,
): readonly number[] {
  const isClosed = points.length > 1 && points[0] === points.at(-1);
  if (isCircle(after) && !isClosed && points.length === 3) return [...points, ...points.slice(0, 1)];
  if (isCircle(before) && isClosed && points.length > 2 && !runsThroughMany(after))
    return points.slice(0, -1);
  return points;
}
