import type { LineType } from "tetrafront";
import { arcThrough, circleThrough, onArc } from "./arcs";
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
      return a.length === b.length && a.every((p, i) => isSame(p, b[i] ?? p));
    case "arc":
    case "circle":
      return sameArc(type, a, b, isSame);
  }
}

/** Arcs with the same ends are the same if two places between them are. */
function sameArc(
  type: "arc" | "circle",
  a: readonly Position[],
  b: readonly Position[],
  isSame: (p: Position, q: Position) => boolean,
): boolean {
  const arcOf = ([p, q, r]: readonly Position[]) =>
    p && q && r ? (type === "arc" ? arcThrough : circleThrough)(p, q, r) : null;
  const [first, second] = [arcOf(a), arcOf(b)];
  if (!first || !second) return false;
  return [1 / 3, 2 / 3].every((share) => isSame(onArc(first, share), onArc(second, share)));
}

/** Identifies the lines around a patch, in any order and direction. */
export function loopsKey(loops: readonly (readonly number[])[]): string {
  const keyOf = (loop: readonly number[]): string =>
    loop
      .map(Math.abs)
      .sort((a, b) => a - b)
      .join(" ");
  const [outer = [], ...holes] = loops;
  return [keyOf(outer), ...holes.map(keyOf).sort()].join("; ");
}
