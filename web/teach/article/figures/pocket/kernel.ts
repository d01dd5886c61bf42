/** The kernel of a pocket: all positions that see all of its faces. It is convex: what the planes of the faces leave of a box. */
import type { Position } from "../../../../document/position";
import { add, between, cross, dot, mean, scale, subtract } from "../../../../document/vectors";
import { clamp } from "../../kit/motion";
import type { Pocket } from "./pocket-rules";

/** A convex body as its faces, each a polygon in one plane; empty if there is none. */
export type ConvexBody = readonly (readonly Position[])[];

/** A plane that differs from a face of the body by rounding only cuts nothing off: this share of its size. */
const rounding = 1e-12;

/** Returns the kernel, in doubles and for display; whether a position is in it is for `seenFrom` to decide. O(faces²). */
export function kernelOf({ corners, faces }: Pocket): ConvexBody {
  const low = [0, 1, 2].map((axis) => Math.min(...corners.map((corner) => corner[axis] ?? 0)));
  const high = [0, 1, 2].map((axis) => Math.max(...corners.map((corner) => corner[axis] ?? 0)));
  let body = boxBetween(low as unknown as Position, high as unknown as Position);
  for (const face of faces) {
    const [a, b, c] = face.map((corner) => corners[corner] ?? [0, 0, 0]) as [Position, Position, Position];
    const normal = cross(subtract(b, a), subtract(c, a));
    body = clip(body, (position) => dot(normal, subtract(position, a)), normal);
  }
  return body;
}

function boxBetween(low: Position, high: Position): ConvexBody {
  const corner = (bits: number): Position =>
    [0, 1, 2].map((axis) => ((bits >> axis) & 1 ? high : low)[axis]) as unknown as Position;
  return [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ].map((bits) => bits.map(corner));
}

/** Returns the part of a body where `height` is positive, with the face that the cut makes. */
function clip(body: ConvexBody, height: (position: Position) => number, normal: Position): ConvexBody {
  const limit = rounding * Math.hypot(...normal) ** 1.5;
  const isKept = (position: Position): boolean => height(position) > -limit;
  if (body.every((polygon) => polygon.every(isKept))) return body;
  const cut: Position[] = [];
  const kept = body.flatMap((polygon) => {
    const part = polygon.flatMap((from, i) => {
      const to = polygon[(i + 1) % polygon.length] ?? from;
      const own = isKept(from) ? [from] : [];
      if (Math.abs(height(from)) <= limit) cut.push(from);
      if (isKept(from) === isKept(to)) return own;
      const end = between(from, to, clamp(height(from) / (height(from) - height(to)), 0, 1));
      cut.push(end);
      return [...own, end];
    });
    return part.length >= 3 ? [part] : [];
  });
  return kept.length > 0 && cut.length >= 3 ? [...kept, aroundMiddle(cut, normal)] : [];
}

/** Returns the corners of a convex polygon in their order around its middle, counter-clockwise seen against the normal. */
function aroundMiddle(corners: readonly Position[], normal: Position): readonly Position[] {
  const middle = mean(corners);
  const first = subtract(corners[0] ?? middle, middle);
  const second = cross(first, normal);
  const size = Math.hypot(...normal) || 1;
  const angle = (corner: Position): number => {
    const to = subtract(corner, middle);
    return Math.atan2(dot(to, second) / size, dot(to, first));
  };
  return [...corners].sort((a, b) => angle(a) - angle(b));
}

/** Returns the volume of a convex body. */
export function bodyVolume(body: ConvexBody): number {
  if (body.length < 4) return 0;
  const middle = middleOf(body);
  const volumes = body.flatMap((polygon) =>
    polygon.slice(2).map((corner, i) => {
      const [a, b, c] = [polygon[0] ?? middle, polygon[i + 1] ?? middle, corner].map((each) =>
        subtract(each, middle),
      ) as [Position, Position, Position];
      return Math.abs(dot(a, cross(b, c))) / 6;
    }),
  );
  return volumes.reduce((sum, volume) => sum + volume, 0);
}

/** Returns the mean of the corners of a body. */
export function middleOf(body: ConvexBody): Position {
  const corners = body.flat();
  return scale(corners.reduce(add, [0, 0, 0] as Position), 1 / Math.max(1, corners.length));
}
