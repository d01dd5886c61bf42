import type { LineType } from "tetrafront";
import type { Position } from "./position";

/** Identifies what two lines with the same course have in common: type and ends, in either direction. */
export function lineKey({
  type,
  points,
}: {
  readonly type: LineType;
  readonly points: readonly number[];
}): string {
  const [from = 0, to = 0] = [points.at(0), points.at(-1)];
  return `${type} ${Math.min(from, to)} ${Math.max(from, to)}`;
}

/** Returns whether two lines of a type, from the same start to the same end, have the same course. */
export function sameCourse(
  type: LineType,
  a: readonly Position[],
  b: readonly Position[],
  isSame: (p: Position, q: Position) => boolean,
): boolean {
  switch (type) {
    case "straight":
      return true;
    case "parabolic":
    case "spline":
    case "arc":
    case "circle":
      return a.length === b.length && a.every((p, i) => isSame(p, b[i] ?? p));
  }
}
