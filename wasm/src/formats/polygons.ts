/** Polygons of files cut into triangles from their first corner, which changes nothing about a plane convex one. */

type Triple = readonly [number, number, number];

/** x y z per node, to be looked up by position. */
interface Coordinates {
  at(index: number): number | undefined;
}

/** Adds the triangles of a polygon of three or more corners; false, and nothing added, if it is not convex. */
export function addPolygon(corners: readonly number[], points: Coordinates, triangles: number[]): boolean {
  if (corners.length > 3 && !isConvex(corners, points)) return false;
  for (let i = 2; i < corners.length; i++) {
    triangles.push(corners[0] ?? 0, corners[i - 1] ?? 0, corners[i] ?? 0);
  }
  return true;
}

/** Whether all triangles from the first corner turn the same way as the whole polygon. */
function isConvex(corners: readonly number[], points: Coordinates): boolean {
  const at = (corner: number): Triple => {
    const begin = 3 * corner;
    return [points.at(begin) ?? 0, points.at(begin + 1) ?? 0, points.at(begin + 2) ?? 0];
  };
  const first = at(corners[0] ?? 0);
  const normals = corners.slice(2).map((corner, i) => normal(first, at(corners[i + 1] ?? 0), at(corner)));
  const whole = normals.reduce((a, b): Triple => [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
  return normals.every((n) => n[0] * whole[0] + n[1] * whole[1] + n[2] * whole[2] > 0);
}

function normal(a: Triple, b: Triple, c: Triple): Triple {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}
