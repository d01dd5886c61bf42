import type { ProjectLine } from "tetrafront/project";
import { noRotation, type Quaternion } from "../placement";
import type { Quantity } from "../../expressions/quantity";
import type { Position } from "../position";
import type { QuantityPosition } from "../quantity-positions";
import { add, addScaled, axisDirections, cross, dot, scale, subtract, turn, unit, zero } from "../vectors";

/** A map of space that keeps straight lines straight: p becomes its linear part times p, plus an offset. */
export interface Affine {
  /** Images of the directions x, y and z. */
  readonly columns: readonly [Position, Position, Position];
  readonly offset: Position;
  /** Rotation and factor of a map that keeps all angles and does not mirror; null for other maps. */
  readonly similarity: { readonly rotation: Quaternion; readonly factor: number } | null;
  /** The same map with the expressions that its numbers were typed as; omitted for plain numbers. */
  readonly typed?: TypedAffine;
}

/** A map whose numbers may have been typed as expressions. */
export interface TypedAffine {
  readonly columns: readonly [QuantityPosition, QuantityPosition, QuantityPosition];
  readonly offset: QuantityPosition;
  /** By how much the map enlarges lengths, on average. */
  readonly factor: Quantity;
  /** Whether directions depend on an expression. The rotations of bodies cannot follow one. */
  readonly rotates: boolean;
}

/** Returns the image of a direction: without the offset. */
export function mapDirection({ columns: [x, y, z] }: Affine, direction: Position): Position {
  return add(add(scale(x, direction[0]), scale(y, direction[1])), scale(z, direction[2]));
}

/** Returns a line after a map: its tangents are directions. */
export function mapTangents<Line extends Pick<ProjectLine, "startTangent" | "endTangent">>(
  map: Affine,
  line: Line,
): Line {
  const { startTangent, endTangent } = line;
  if (!startTangent && !endTangent) return line;
  return {
    ...line,
    ...(startTangent && { startTangent: mapDirection(map, startTangent) }),
    ...(endTangent && { endTangent: mapDirection(map, endTangent) }),
  };
}

/** A coordinate below this share of the terms that it is the sum of is the rounding error of a 0. */
const roundingShare = 2 ** -50;

/** Returns the image of a position. Coordinates that would be 0 without rounding are 0. */
export function mapPosition({ columns: [a, b, c], offset }: Affine, [x, y, z]: Position): Position {
  const coordinate = (k: 0 | 1 | 2): number => sumWithoutNoise(a[k] * x, b[k] * y, c[k] * z, offset[k]);
  return [coordinate(0), coordinate(1), coordinate(2)];
}

/** Returns the sum of the terms; 0 if it is their rounding error. */
function sumWithoutNoise(a: number, b: number, c: number, d: number): number {
  const sum = a + b + c + d;
  const size = Math.abs(a) + Math.abs(b) + Math.abs(c) + Math.abs(d);
  return Math.abs(sum) <= roundingShare * size ? 0 : sum;
}

/** Returns by how much the map enlarges volumes; negative if it mirrors. */
export function determinant({ columns: [x, y, z] }: Affine): number {
  return (
    x[0] * (y[1] * z[2] - y[2] * z[1]) +
    x[1] * (y[2] * z[0] - y[0] * z[2]) +
    x[2] * (y[0] * z[1] - y[1] * z[0])
  );
}

/** Relative difference of lengths, and cosine of angles, up to which a map keeps the shape of circles. */
const circleTolerance = 1e-9;

/** Returns whether circles stay circles: the map stretches all directions alike, mirrored or not. */
export function keepsCircles({ columns: [x, y, z] }: Affine): boolean {
  const square = dot(x, x);
  const limit = circleTolerance * square;
  return (
    [dot(y, y), dot(z, z)].every((other) => Math.abs(other - square) <= limit) &&
    [dot(x, y), dot(y, z), dot(z, x)].every((product) => Math.abs(product) <= limit)
  );
}

/** Returns by how much the map enlarges lengths, on average. */
export const meanFactor = (map: Affine): number => Math.cbrt(Math.abs(determinant(map)));

export function translation(offset: Position): Affine {
  return { columns: axisDirections, offset, similarity: { rotation: noRotation, factor: 1 } };
}

/** Returns the map with a linear part that leaves a centre where it is. */
function about(centre: Position, columns: Affine["columns"], similarity: Affine["similarity"]): Affine {
  const linear: Affine = { columns, offset: zero, similarity };
  return { ...linear, offset: subtract(centre, mapDirection(linear, centre)) };
}

/** Returns the rotation about an axis through a centre, by degrees, counter-clockwise around the axis (Rodrigues). */
export function rotationAbout(centre: Position, axis: Position, degrees: number): Affine {
  const direction = unit(axis) ?? [0, 0, 1];
  const [cosine, sine] = turn(degrees / 360);
  const column = (k: 0 | 1 | 2): Position => {
    const along = scale(direction, (1 - cosine) * dot(direction, axisDirections[k]));
    return addScaled(addScaled(along, axisDirections[k], cosine), cross(direction, axisDirections[k]), sine);
  };
  const half = (degrees * Math.PI) / 360;
  const [x, y, z] = scale(direction, Math.sin(half));
  const rotation: Quaternion = [x, y, z, Math.cos(half)];
  return about(centre, [column(0), column(1), column(2)], { rotation, factor: 1 });
}

/** Returns the map that multiplies distances from a centre along each axis by a factor. */
export function scalingAbout(centre: Position, [x, y, z]: Position): Affine {
  const isSimilar = x === y && y === z && x > 0;
  const columns = [
    scale(axisDirections[0], x),
    scale(axisDirections[1], y),
    scale(axisDirections[2], z),
  ] as const;
  return about(centre, columns, isSimilar ? { rotation: noRotation, factor: x } : null);
}

/** Returns the reflection in the plane through a point with a normal. */
export function reflectionAt(point: Position, normal: Position): Affine {
  const n = unit(normal) ?? [0, 0, 1];
  const column = (k: 0 | 1 | 2): Position => addScaled(axisDirections[k], n, -2 * dot(axisDirections[k], n));
  return about(point, [column(0), column(1), column(2)], null);
}
