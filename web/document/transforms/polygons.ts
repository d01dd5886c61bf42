import type { Flat } from "../planar-loops";
import type { Position } from "../position";
import { between, distance, dot, subtract, toFrame, type Frame } from "../vectors";

/** Plane polygons, as positions in a frame: for the question whether a hole lies within a patch. */

/** Returns positions in the plane of a frame. */
export function flattened(polygon: readonly Position[], frame: Frame): Flat[] {
  return polygon.map((position) => {
    const [x, y] = toFrame(frame, position);
    return [x, y] as const;
  });
}

/** Returns the distance of a position from the sides of a closed polygon. */
export function distanceFrom(position: Position, polygon: readonly Position[]): number {
  return polygon.reduce((least, a, i) => {
    const b = polygon[(i + 1) % polygon.length] ?? a;
    const side = subtract(b, a);
    const squared = dot(side, side);
    const share = squared > 0 ? Math.max(0, Math.min(1, dot(subtract(position, a), side) / squared)) : 0;
    return Math.min(least, distance(position, between(a, b, share)));
  }, Infinity);
}
