import type { BodyPlacement } from "tetrafront/project";
import type { Position } from "./position";
import { cross } from "./vectors";

/** Placements of bodies: points are scaled, then rotated by a unit quaternion x y z w, then moved. */

export type Quaternion = readonly [x: number, y: number, z: number, w: number];

export const noRotation: Quaternion = [0, 0, 0, 1];

/** Returns where a given point of a body is. */
export function placed([x, y, z]: Position, placement: BodyPlacement = {}): Position {
  const { position = [0, 0, 0], rotation = noRotation, scale = 1 } = placement;
  const [a, b, c] = rotated([scale * x, scale * y, scale * z], rotation);
  return [a + position[0], b + position[1], c + position[2]];
}

/** Returns where a point goes that moves with a body from one placement to another. */
export function carried(point: Position, from: BodyPlacement = {}, to: BodyPlacement = {}): Position {
  const { position = [0, 0, 0], rotation: [x, y, z, w] = noRotation, scale = 1 } = from;
  const offset = point.map((value, k) => (value - (position[k] ?? 0)) / scale) as [number, number, number];
  return placed(rotated(offset, [-x, -y, -z, w]), to);
}

/** v + 2 q × (q × v + w v) for the vector part q and the scalar part w. */
function rotated(v: Position, [x, y, z, w]: Quaternion): Position {
  const q: Position = [x, y, z];
  const inner = cross(q, v).map((part, k) => part + w * (v[k] ?? 0)) as [number, number, number];
  const outer = cross(q, inner);
  return [v[0] + 2 * outer[0], v[1] + 2 * outer[1], v[2] + 2 * outer[2]];
}

/** Returns the box around the corners of a placed box. */
export function placedBox(
  low: Position,
  high: Position,
  placement: BodyPlacement | undefined,
): { readonly low: Position; readonly high: Position } {
  if (!placement) return { low, high };
  const corners = Array.from({ length: 8 }, (_, corner) =>
    placed(
      [0, 1, 2].map((axis) => (((corner >> axis) & 1) === 1 ? high : low)[axis] ?? 0) as [
        number,
        number,
        number,
      ],
      placement,
    ),
  );
  const extreme = (of: (...values: number[]) => number): Position => [
    of(...corners.map(([x]) => x)),
    of(...corners.map(([, y]) => y)),
    of(...corners.map(([, , z]) => z)),
  ];
  return { low: extreme(Math.min), high: extreme(Math.max) };
}

const degree = Math.PI / 180;

/** Returns the axis and the angle in degrees of a rotation; undefined for none. */
export function turnOf([x, y, z, w]: Quaternion):
  | { readonly axis: Position; readonly angle: number }
  | undefined {
  const sine = Math.hypot(x, y, z);
  return sine === 0 ? undefined : { axis: [x, y, z], angle: (2 * Math.atan2(sine, w)) / degree };
}

/** Returns the rotation about an axis by an angle in degrees; none about 0 0 0. */
export function turned(axis: Position, angle: number): Quaternion {
  const half = (angle * degree) / 2;
  const sine = Math.sin(half) / Math.hypot(...axis);
  return Number.isFinite(sine)
    ? [axis[0] * sine, axis[1] * sine, axis[2] * sine, Math.cos(half)]
    : noRotation;
}

/** Returns the rotation about x, then y, then z, by angles in degrees. */
export function rotationOf(angles: Position): Quaternion {
  const [sx, sy, sz] = angles.map((angle) => Math.sin((angle * degree) / 2)) as [number, number, number];
  const [cx, cy, cz] = angles.map((angle) => Math.cos((angle * degree) / 2)) as [number, number, number];
  const parts = [
    sx * cy * cz - cx * sy * sz,
    cx * sy * cz + sx * cy * sz,
    cx * cy * sz - sx * sy * cz,
    cx * cy * cz + sx * sy * sz,
  ] as const;
  return unit(parts);
}

/** Returns the rotation by `first` followed by `then`. */
export function combined(then: Quaternion, first: Quaternion): Quaternion {
  const [x, y, z, w] = then;
  const [a, b, c, d] = first;
  return unit([
    w * a + x * d + y * c - z * b,
    w * b - x * c + y * d + z * a,
    w * c + x * b - y * a + z * d,
    w * d - x * a - y * b - z * c,
  ]);
}

function unit(parts: Quaternion): Quaternion {
  const norm = Math.hypot(...parts);
  return parts.map((part) => part / norm) as [number, number, number, number];
}

/** Returns the angles about x, y and z of a rotation, in degrees, rounded to a millionth. */
export function anglesOf([x, y, z, w]: Quaternion): Position {
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  const angles: Position = [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
  return angles.map((angle) => Math.round((angle / degree) * 1e6) / 1e6 + 0) as [number, number, number];
}
