import { NO_REGION, type Mesh } from "tetrafront";
import { isWithin } from "tetrafront/internal";
import type { Position } from "./position";
import { cornerOf, windingNumber, type Triangles } from "./winding-number";
import { boxOf } from "./vectors";

/**
 * Returns whether a solid of a file lies in the material of another, or fills a void of another with which it shares all
 * its faces: shells inside a region are then regions. Otherwise they are cavities, but a solid inside a void is still
 * meshed. `bodies`: the surfaces made of the file. O(n) per pair of bodies whose boxes are nested.
 */
export function hasInnerSolid(bodies: readonly Triangles[], surfaceRegions: Mesh["surfaceRegions"]): boolean {
  if (surfaceRegions !== undefined && hasEnclosedRegion(surfaceRegions)) return true;
  const boxes = bodies.map(({ points }) => boxOf(points));
  return bodies.some((inner, i) =>
    bodies.some((outer, o) => {
      const [small, large] = [boxes[i], boxes[o]];
      if (i === o || !small || !large) return false;
      return isWithin(small, large) && Math.abs(windingNumber(outer, firstPoint(inner))) > 0.5;
    }),
  );
}

/** Returns whether there is a region with other regions beyond all its triangles. */
function hasEnclosedRegion({ regions, triangleRegions }: NonNullable<Mesh["surfaceRegions"]>): boolean {
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
