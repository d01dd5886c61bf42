/** How many elements and how much volume the regions of a mesh have. */
import { cross, dot, minus, pointOf } from "../base/vectors.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { FileMesh } from "./file-mesh.js";

/** A region of a mesh. */
export interface RegionSummary {
  readonly name: string;
  readonly tetrahedra: number;
  /** In cubed model units. */
  readonly volume: number;
}

/** Returns the regions of a mesh in their order. O(n). */
export function* regionSummaries({
  points,
  tetrahedra,
  tetrahedronRegion,
  regions,
}: Pick<FileMesh, "points" | "tetrahedra" | "tetrahedronRegion" | "regions">): Steps<RegionSummary[]> {
  const counts = new Uint32Array(regions.length);
  const volumes = new Float64Array(regions.length);
  yield* stepwise(tetrahedronRegion.length, (t) => {
    const region = tetrahedronRegion[t] ?? 0;
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
    const corner = pointOf(points, a);
    const [u, v, w] = [b, c, d].map((node) => minus(pointOf(points, node), corner));
    if (u === undefined || v === undefined || w === undefined) return;
    counts[region] = (counts[region] ?? 0) + 1;
    volumes[region] = (volumes[region] ?? 0) + Math.abs(dot(cross(u, v), w)) / 6;
  });
  return regions.map(({ name }, r) => ({ name, tetrahedra: counts[r] ?? 0, volume: volumes[r] ?? 0 }));
}
