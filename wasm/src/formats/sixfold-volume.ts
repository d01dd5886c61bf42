/** Signed volume of a tetrahedron in double precision, with an error bound. */

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
