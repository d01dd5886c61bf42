/** Signed volumes in double precision: of a tetrahedron, with an error bound, and of what surfaces enclose. */
import { type Steps, stepwise } from "../base/steps.js";
import type { SurfaceInput } from "../mesh/mesh.js";

/** x y z per node, accessed by index. */
export interface Coordinates {
  at(index: number): number | undefined;
}

export interface SixfoldVolume {
  /** (b−a) × (c−a) · (d−a). */
  readonly volume: number;
  /** Whether the sign of the volume is certain, or the volume is exactly 0. */
  readonly isSure: boolean;
}

/** Shewchuk's error bound for the sign of a determinant of differences, rounded up. */
const ROUNDING = 8e-16;

/** Returns six times the signed volume of the tetrahedron with these nodes. */
export function sixfoldVolume(
  points: Coordinates,
  a: number,
  b: number,
  c: number,
  d: number,
): SixfoldVolume {
  const [ux, uy, uz] = difference(points, a, b);
  const [vx, vy, vz] = difference(points, a, c);
  const [wx, wy, wz] = difference(points, a, d);
  const volume = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
  const size =
    (Math.abs(uy * vz) + Math.abs(uz * vy)) * Math.abs(wx) +
    (Math.abs(uz * vx) + Math.abs(ux * vz)) * Math.abs(wy) +
    (Math.abs(ux * vy) + Math.abs(uy * vx)) * Math.abs(wz);
  return { volume, isSure: size === 0 || Math.abs(volume) > ROUNDING * size };
}

function difference(points: Coordinates, from: number, to: number): [number, number, number] {
  const along = (axis: number) => (points.at(3 * to + axis) ?? 0) - (points.at(3 * from + axis) ?? 0);
  return [along(0), along(1), along(2)];
}

/**
 * Returns the volume that the triangles of each group enclose, by the divergence theorem: positive if they face outward. `groupOf`:
 * the group of a triangle, below `groups`; undefined for triangles that do not count. O(n).
 */
export function* enclosedVolumes(
  { points, triangles }: SurfaceInput,
  groups: number,
  groupOf: (triangle: number) => number | undefined,
): Steps<Float64Array> {
  const volumes = new Float64Array(groups);
  // About a node: far from the origin, the digits would not suffice.
  const first = triangles[0] ?? 0;
  yield* stepwise(triangles.length / 3, (t) => {
    const group = groupOf(t);
    if (group === undefined) return;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    volumes[group] = (volumes[group] ?? 0) + sixfoldVolume(points, first, a, b, c).volume / 6;
  });
  return volumes;
}
