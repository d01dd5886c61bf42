import type { LineType } from "tetrafront/project";
import { runsThroughMany } from "./line-types";
import { arcThrough, circleThrough, onArc } from "./arcs";
import type { Position } from "./position";
import { addScaled, dot, length, scale, subtract } from "./vectors";

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
    case "hermite":
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

/** Returns whether a line ends at the point at which it begins. */
export const isClosed = ({ points }: { readonly points: readonly number[] }): boolean =>
  points.length > 2 && points[0] === points.at(-1);

/**
 * Returns whether two closed lines of a type have the same course, wherever it begins: 1 in the same direction, -1 in the
 * opposite one, 0 if not.
 */
export function closedDirection(
  type: LineType,
  a: readonly Position[],
  b: readonly Position[],
  isSame: (p: Position, q: Position) => boolean,
): 1 | -1 | 0 {
  if (type === "circle") return circleDirection(a, b, isSame);
  if (!runsThroughMany(type) || a.length !== b.length) return 0;
  const [first, ...further] = a.slice(0, -1);
  const count = further.length + 1;
  const start = first ? b.findIndex((position) => isSame(position, first)) : -1;
  if (start < 0) return 0;
  const follows = (sign: 1 | -1): boolean =>
    further.every((p, i) => isSame(p, b[(start + sign * (i + 1) + count) % count] ?? p));
  return follows(1) ? 1 : follows(-1) ? -1 : 0;
}

/** Circles are the same if they have three places of one of them in common. */
function circleDirection(
  [p, q, r]: readonly Position[],
  [s, t, u]: readonly Position[],
  isSame: (p: Position, q: Position) => boolean,
): 1 | -1 | 0 {
  const [a, b] = [p && q && r && circleThrough(p, q, r), s && t && u && circleThrough(s, t, u)];
  if (!a || !b || !isSame(a.centre, b.centre)) return 0;
  const arms = [0, 1 / 3, 2 / 3].map((share) => subtract(onArc(a, share), b.centre));
  const radius = length(subtract(b.start, b.centre));
  const isOn = arms.every((arm) => {
    const inPlane = addScaled(arm, b.normal, -dot(arm, b.normal));
    return isSame(arm, scale(inPlane, radius / length(inPlane)));
  });
  return isOn ? (dot(a.normal, b.normal) > 0 ? 1 : -1) : 0;
}

/** Identifies the lines around a patch, in any order and direction; the loops of a tube have no order either. */
export function loopsKey(loops: readonly (readonly number[])[]): string {
  const keyOf = (loop: readonly number[]): string =>
    loop
      .map(Math.abs)
      .sort((a, b) => a - b)
      .join(" ");
  return loops.map(keyOf).sort().join("; ");
}
