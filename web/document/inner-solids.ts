import { NO_REGION, type PatchedSurface, type SurfaceFile } from "tetrafront";
import { boxOf } from "./drawn-surface";
import type { Position } from "./position";
import { dot } from "./vectors";

type Triangles = Pick<PatchedSurface, "points" | "triangles">;

/**
 * Returns whether a solid of a file lies in the material of another, or fills a void of another with which it shares all
 * its faces: shells inside a region are then regions. Otherwise they are cavities, and a solid inside a void is meshed
 * all the same. `bodies`: the surfaces made of the file. O(n) per pair of bodies whose boxes are nested.
 */
export function hasInnerSolid(
  bodies: readonly Triangles[],
  surfaceRegions: SurfaceFile["surfaceRegions"],
): boolean {
  if (surfaceRegions !== undefined && hasEnclosedRegion(surfaceRegions)) return true;
  const boxes = bodies.map(({ points }) => boxOf(points));
  return bodies.some((inner, i) =>
    bodies.some((outer, o) => {
      const [small, large] = [boxes[i], boxes[o]];
      if (i === o || !small || !large) return false;
      const isNested = small.low.every(
        (x, k) => x > (large.low[k] ?? x) && (small.high[k] ?? x) < (large.high[k] ?? x),
      );
      return isNested && Math.abs(windingNumber(outer, firstPoint(inner))) > 0.5;
    }),
  );
}

/** Returns whether there is a region with other regions beyond all its triangles. */
function hasEnclosedRegion({
  regions,
  triangleRegions,
}: NonNullable<SurfaceFile["surfaceRegions"]>): boolean {
  const isOuter = new Uint8Array(regions.length);
  const hasTriangles = new Uint8Array(regions.length);
  for (let side = 0; side < triangleRegions.length; side++) {
    const region = triangleRegions[side] ?? NO_REGION;
    if (region === NO_REGION) continue;
    hasTriangles[region] = 1;
    if ((triangleRegions[side ^ 1] ?? NO_REGION) === NO_REGION) isOuter[region] = 1;
  }
  return hasTriangles.some((has, region) => has === 1 && isOuter[region] === 0);
}

const firstPoint = ({ points, triangles }: Triangles): Position => cornerOf(points, triangles[0] ?? 0);

const cornerOf = (points: Float64Array, node: number): Position => [
  points[3 * node] ?? 0,
  points[3 * node + 1] ?? 0,
  points[3 * node + 2] ?? 0,
];

/**
 * Returns how often a surface winds around a position: the sum of the solid angles of its triangles / 4π
 * (van Oosterom and Strackee 1983).
 */
function windingNumber({ points, triangles }: Triangles, [x, y, z]: Position): number {
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
