import type { BodyPlacement } from "tetrafront/project";
import type { PatchArrays } from "./patch-arrays";
import { placed } from "./placement";
import type { Position } from "./position";
import { add, cross, length, scale as scaled, subtract, unit, zero } from "./vectors";
import { cornerOf } from "./winding-number";

/** The given triangles of a patch of a body. */
export interface PatchFacts {
  readonly triangles: number;
  /** In squared model units. */
  readonly area: number;
  /** Unit vector in the model; null if the triangles do not face one way. */
  readonly normal: Position | null;
  /** Centroid in the model. */
  readonly centre: Position;
}

/** Largest part of the area by which the projection of a planar patch along its normal is smaller. */
const flatness = 1e-9;

/** Returns the facts of the patch with an index, at the placement of its body. O(triangles). */
export function patchFacts(
  { points, triangles, trianglePatch }: PatchArrays,
  patch: number,
  placement: BodyPlacement = {},
): PatchFacts {
  let [count, area, sum, moment] = [0, 0, zero, zero];
  trianglePatch.forEach((owner, t) => {
    if (owner !== patch) return;
    const corner = (k: number): Position => cornerOf(points, triangles[3 * t + k] ?? 0);
    const normal = cross(subtract(corner(1), corner(0)), subtract(corner(2), corner(0)));
    ++count;
    area += length(normal) / 2;
    const middle = scaled(add(add(corner(0), corner(1)), corner(2)), 1 / 3);
    moment = add(moment, scaled(middle, length(normal) / 2));
    sum = add(sum, normal);
  });
  const { scale = 1, ...turned } = placement;
  const normal = length(sum) / 2 >= (1 - flatness) * area ? unit(sum) : null;
  return {
    triangles: count,
    area: area * scale ** 2,
    centre: placed(area > 0 ? scaled(moment, 1 / area) : zero, placement),
    normal: normal && placed(normal, { ...turned, position: [0, 0, 0] }),
  };
}
