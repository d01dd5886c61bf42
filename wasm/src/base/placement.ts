/** Where points are: scaled, then rotated, then moved. */
export interface Placement {
  /** Position of the origin of the given points, in model units. Default 0 0 0. */
  readonly position?: readonly [number, number, number] | undefined;
  /** Unit quaternion x y z w. Default 0 0 0 1. */
  readonly rotation?: readonly [number, number, number, number] | undefined;
  /** Factor above 0. Default 1. */
  readonly scale?: number | undefined;
}

const isIdentity = ({ position, rotation, scale = 1 }: Placement): boolean =>
  position === undefined && rotation === undefined && scale === 1;

/** Returns the placed copy of points. */
export function placedPoints(points: Float64Array, placement: Placement = {}): Float64Array {
  const moved = points.slice();
  if (isIdentity(placement)) return moved;
  const { position = [0, 0, 0], scale = 1 } = placement;
  const rows = rotationRows(placement.rotation);
  for (let i = 0; i < points.length; i += 3) {
    const [x, y, z] = [scale * (points[i] ?? 0), scale * (points[i + 1] ?? 0), scale * (points[i + 2] ?? 0)];
    for (const axis of [0, 1, 2] as const) {
      const [a, b, c] = rows[axis];
      moved[i + axis] = a * x + b * y + c * z + position[axis];
    }
  }
  return moved;
}

/** Returns the points whose placed copy is given, but for rounding. */
export function unplacedPoints(placed: Float64Array, placement: Placement = {}): Float64Array {
  const given = placed.slice();
  if (isIdentity(placement)) return given;
  const { position = [0, 0, 0], scale = 1 } = placement;
  const [a, b, c] = rotationRows(placement.rotation);
  for (let i = 0; i < placed.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map(
      (axis) => (placed[i + axis] ?? 0) - (position[axis] ?? 0),
    ) as unknown as Row;
    for (const axis of [0, 1, 2] as const)
      given[i + axis] = (a[axis] * x + b[axis] * y + c[axis] * z) / scale;
  }
  return given;
}

type Row = readonly [number, number, number];

/** Returns the matrix of a quaternion, which may differ from a unit quaternion by rounding. */
function rotationRows(
  rotation: readonly [x: number, y: number, z: number, w: number] = [0, 0, 0, 1],
): readonly [Row, Row, Row] {
  // Unlike Math.hypot, this gives the same result on all machines.
  const norm = Math.sqrt(rotation.reduce((sum, part) => sum + part * part, 0));
  const [x, y, z, w] = rotation.map((part) => part / norm) as [number, number, number, number];
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
  ];
}
