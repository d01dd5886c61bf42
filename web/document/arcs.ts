import { call, minus, over, times, valueOf, type Quantity } from "../expressions/quantity";
import type { Position } from "./position";
import {
  addQuantities,
  crossQuantities,
  dotQuantities,
  scaleQuantities,
  subtractQuantities,
  valuesOf,
  type QuantityPosition,
} from "./quantity-positions";
import { add, addScaled, cross, dot, length, scale, subtract } from "./vectors";

/** The part of a circle from `start` counter-clockwise around `normal`. */
export interface CircularArc {
  readonly centre: Position;
  readonly normal: Position;
  readonly start: Position;
  /** Radians. */
  readonly angle: number;
}

/** Points whose triangle has a smaller area, relative to its longest side, define no circle: as in the engine. */
const collinearity = 1e-9;

/** Returns the arc from a over b to c; null if the three lie on one straight line. */
export function arcThrough(a: Position, b: Position, c: Position): CircularArc | null {
  const circle = circleThrough(a, b, c);
  if (!circle) return null;
  const { centre, normal } = circle;
  const radius = subtract(a, centre);
  const end = subtract(c, centre);
  const angle = Math.atan2(dot(cross(radius, end), normal), dot(radius, end));
  return { ...circle, angle: angle > 0 ? angle : angle + 2 * Math.PI };
}

/** Returns the whole circle from a over b and c; null if the three lie on one straight line. */
export function circleThrough(a: Position, b: Position, c: Position): CircularArc | null {
  const [ab, ac] = [subtract(b, a), subtract(c, a)];
  const normal = cross(ab, ac);
  const area = length(normal);
  const longest = Math.max(length(ab), length(ac), length(subtract(c, b)));
  if (!(area > collinearity * longest * longest)) return null;
  const weighted = subtract(scale(ac, dot(ab, ab)), scale(ab, dot(ac, ac)));
  const toCentre = scale(cross(weighted, normal), 1 / (2 * area * area));
  return { centre: add(a, toCentre), normal: scale(normal, 1 / area), start: a, angle: 2 * Math.PI };
}

/** Returns the position at a share of the angle, 0 to 1. */
export function onArc({ centre, normal, start, angle }: CircularArc, share: number): Position {
  const radius = subtract(start, centre);
  const turned = addScaled(
    scale(radius, Math.cos(share * angle)),
    cross(normal, radius),
    Math.sin(share * angle),
  );
  return add(centre, turned);
}

/**
 * Returns the middle of the shorter arc with a radius between two ends, on the side of a position; without one, on the left
 * seen against the normal of the plane. Returns null if the radius is smaller than half the distance of the ends.
 */
export function middleOfArc(
  [a, b]: readonly [Position, Position],
  radius: number,
  normal: Position,
  side: Position | null,
): Position | null {
  const chord = subtract(b, a);
  const half = length(chord) / 2;
  if (!(half > 0) || radius < half * (1 - 1e-12)) return null;
  const centre = add(a, scale(chord, 0.5));
  const along = scale(chord, 0.5 / half);
  const across = acrossChord(along, normal, side && subtract(side, centre));
  return addScaled(centre, across, radius - Math.sqrt(Math.max(0, radius * radius - half * half)));
}

/** As `middleOfArc`, with the expressions that follow from those of the ends and of the radius. */
export function quantityMiddleOfArc(
  [a, b]: readonly [QuantityPosition, QuantityPosition],
  radius: Quantity,
  normal: Position,
  side: Position | null,
): QuantityPosition | null {
  const plain = middleOfArc([valuesOf(a), valuesOf(b)], valueOf(radius), normal, side);
  if (!plain || [...a, ...b, radius].every((one) => typeof one === "number")) return plain;
  const chord = subtractQuantities(b, a);
  const centre = addQuantities(a, scaleQuantities(chord, 0.5));
  const bulge = subtract(plain, valuesOf(centre));
  const left = crossQuantities(normal, chord);
  const norm = length(valuesOf(left));
  // The plane of an arc whose chord is normal to the work plane was chosen by the pointer.
  const isNormal = norm <= 1e-6 * length(valuesOf(chord));
  const across = isNormal
    ? scale(bulge, 1 / length(bulge))
    : left.map((part) => over(part, call("sqrt", dotQuantities(left, left))));
  const quarter = times(0.25, dotQuantities(chord, chord));
  const depth = call("sqrt", call("abs", minus(times(radius, radius), quarter)));
  const height = times(!isNormal && dot(bulge, valuesOf(left)) < 0 ? -1 : 1, minus(radius, depth));
  return addQuantities(centre, scaleQuantities(across as QuantityPosition, height));
}

/** Returns the direction from a chord to its arc: in the plane, or towards a position if the chord is normal to the plane. */
function acrossChord(along: Position, normal: Position, side: Position | null): Position {
  const left = cross(normal, along);
  if (length(left) > 1e-6) {
    return scale(left, (side && dot(side, left) < 0 ? -1 : 1) / length(left));
  }
  const towards = side ? addScaled(side, along, -dot(side, along)) : left;
  if (length(towards) > 0) return scale(towards, 1 / length(towards));
  const other = cross(along, Math.abs(along[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]);
  return scale(other, 1 / length(other));
}
