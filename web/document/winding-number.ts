import type { SurfaceInput } from "tetrafront";
import type { Position } from "./position";
import { dot } from "./vectors";

export type Triangles = Pick<SurfaceInput, "points" | "triangles">;

/** Returns the position of a node. */
export const cornerOf = (points: Float64Array, node: number): Position => [
  points[3 * node] ?? 0,
  points[3 * node + 1] ?? 0,
  points[3 * node + 2] ?? 0,
];

/**
 * Returns how often a surface winds around a position: the sum of the solid angles of its triangles / 4π
 * (van Oosterom and Strackee 1983).
 */
export function windingNumber({ points, triangles }: Triangles, [x, y, z]: Position): number {
  let sum = 0;
  const from = (node: number): Position => {
    const [u, v, w] = cornerOf(points, node);
    return [u - x, v - y, w - z];
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const a = from(triangles[t] ?? 0);
    const b = from(triangles[t + 1] ?? 0);
    const c = from(triangles[t + 2] ?? 0);
    const [la, lb, lc] = [Math.hypot(...a), Math.hypot(...b), Math.hypot(...c)];
    const volume =
      a[0] * (b[1] * c[2] - b[2] * c[1]) +
      a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
    const spread = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    sum += 2 * Math.atan2(volume, spread);
  }
  return sum / (4 * Math.PI);
}
