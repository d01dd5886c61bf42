import { type Flat, isInside } from "../planar-loops";

/** Closed polygons in a plane: a position belongs to their area if an odd number of them contains it. */
export type Polygons = readonly (readonly Flat[])[];

/** Returns whether a position lies in the area of polygons. */
export const isWithin = (position: Flat, polygons: Polygons): boolean =>
  polygons.filter((polygon) => isInside(position, polygon)).length % 2 === 1;

/**
 * Returns a position well within the area of polygons: between the highest two heights of corners that are furthest apart, in
 * the middle of the widest piece of the area there. Undefined without an area.
 */
export function innerPlace(polygons: Polygons): Flat | undefined {
  const heights = [...new Set(polygons.flatMap((polygon) => polygon.map(([, y]) => y)))].sort(
    (a, b) => a - b,
  );
  const gaps = heights.slice(1).map((high, i) => [heights[i] ?? high, high] as const);
  const [widest] = gaps.toSorted((a, b) => b[1] - b[0] - (a[1] - a[0]));
  if (!widest) return undefined;
  const y = (widest[0] + widest[1]) / 2;
  const crossings = polygons
    .flatMap((polygon) =>
      polygon.flatMap(([ax, ay], i) => {
        const [bx, by] = polygon[(i + 1) % polygon.length] ?? [ax, ay];
        return ay > y !== by > y ? [ax + ((y - ay) / (by - ay)) * (bx - ax)] : [];
      }),
    )
    .sort((a, b) => a - b);
  const pieces = crossings.flatMap((x, i) => {
    const end = crossings[i + 1];
    return i % 2 === 0 && end !== undefined ? [[x, end] as const] : [];
  });
  const [piece] = pieces.toSorted((a, b) => b[1] - b[0] - (a[1] - a[0]));
  return piece && [(piece[0] + piece[1]) / 2, y];
}

/** Returns whether the areas of polygons surely overlap: sides cross, or one contains a place of the other. */
export function overlap(a: Polygons, b: Polygons): boolean {
  const [inA, inB] = [innerPlace(a), innerPlace(b)];
  if ((inA && isWithin(inA, b)) || (inB && isWithin(inB, a))) return true;
  return sidesOf(a).some((side) => sidesOf(b).some((other) => crossingOf(side, other) !== null));
}

/** A segment from one end to the other. */
export type Side = readonly [from: Flat, to: Flat];

const sidesOf = (polygons: Polygons): readonly Side[] =>
  polygons.flatMap((polygon) =>
    polygon.map((from, i): Side => [from, polygon[(i + 1) % polygon.length] ?? from]),
  );

/** Segments are parallel if the sine of their angle is at most this. */
const parallelSine = 1e-12;

/** Returns where two segments cross, ends excluded; null if they do not. */
export function crossingOf([a, b]: Side, [c, d]: Side): Flat | null {
  const [ux, uy] = [b[0] - a[0], b[1] - a[1]];
  const [vx, vy] = [d[0] - c[0], d[1] - c[1]];
  const across = ux * vy - uy * vx;
  if (Math.abs(across) <= parallelSine * Math.hypot(ux, uy) * Math.hypot(vx, vy)) return null;
  const [wx, wy] = [c[0] - a[0], c[1] - a[1]];
  const s = (wx * vy - wy * vx) / across;
  const t = (wx * uy - wy * ux) / across;
  return s > 0 && s < 1 && t > 0 && t < 1 ? [a[0] + s * ux, a[1] + s * uy] : null;
}

/** Returns the distance of a position from a segment. */
export function distanceFrom([x, y]: Flat, [a, b]: Side): number {
  const [ux, uy] = [b[0] - a[0], b[1] - a[1]];
  const squared = ux * ux + uy * uy;
  const share = squared > 0 ? Math.max(0, Math.min(1, ((x - a[0]) * ux + (y - a[1]) * uy) / squared)) : 0;
  return Math.hypot(x - a[0] - share * ux, y - a[1] - share * uy);
}
