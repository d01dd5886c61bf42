import { LIMITS } from "tetrafront";
import {
  call,
  formulaText,
  minus,
  over,
  plus,
  quantity,
  times,
  valueOf,
  type Quantity,
} from "../expressions/quantity";
import type { Position } from "./position";
import { axisBeside, frameAlong, turn, zero, type Frame } from "./vectors";

/** A position whose coordinates may have been typed as expressions. */
export type QuantityPosition = readonly [Quantity, Quantity, Quantity];

/** Returns a position with the expressions of its coordinates; null or undefined for a coordinate without one. */
export function quantityPosition(
  [x, y, z]: Position,
  [a, b, c]: readonly (string | null | undefined)[] = [],
): QuantityPosition {
  return [quantity(x, a), quantity(y, b), quantity(z, c)];
}

export const valuesOf = ([x, y, z]: QuantityPosition): Position => [valueOf(x), valueOf(y), valueOf(z)];

/** Returns the expressions of coordinates; null for a coordinate without one. */
export const formulaTexts = (position: QuantityPosition): readonly (string | null)[] =>
  position.map(formulaText);

/** Returns whether no coordinate has an expression. */
export const isPlain = (position: QuantityPosition): position is Position =>
  position.every((part) => typeof part === "number");

/** Returns whether a text is too long for the file. */
export const isTooLong = (text: string | null): boolean => (text ?? "").length > LIMITS.expression;

/**
 * Returns the expressions of the coordinates of positions that belong together. Returns null if one of them is too long for
 * the file: what follows a parameter with some of its points only would be distorted.
 */
export function storableTexts(
  positions: readonly QuantityPosition[],
): readonly (readonly (string | null)[])[] | null {
  const texts = positions.map(formulaTexts);
  return texts.some((three) => three.some(isTooLong)) ? null : texts;
}

export function addQuantities(a: QuantityPosition, b: QuantityPosition): QuantityPosition {
  return [plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])];
}

export function subtractQuantities(a: QuantityPosition, b: QuantityPosition): QuantityPosition {
  return [minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])];
}

export function scaleQuantities([x, y, z]: QuantityPosition, factor: Quantity): QuantityPosition {
  return [times(factor, x), times(factor, y), times(factor, z)];
}

/** Returns the position whose coordinates in a frame are given. */
export function quantitiesFromFrame(
  { origin, x, y, z }: Frame<QuantityPosition>,
  local: QuantityPosition,
): QuantityPosition {
  const along = [x, y, z].map((axis, k) => scaleQuantities(axis, local[k] ?? 0));
  return along.reduce(addQuantities, origin);
}

/** Returns a position turned around an axis of length 1 through a centre, counter-clockwise, by a number of turns. */
export function turnedQuantities(
  position: QuantityPosition,
  centre: QuantityPosition,
  axis: Position,
  turns: number,
): QuantityPosition {
  const arm = subtractQuantities(position, centre);
  const [cosine, sine] = turn(turns);
  const along = scaleQuantities(axis, times(1 - cosine, dotQuantities(arm, axis)));
  const across = scaleQuantities(crossQuantities(axis, arm), sine);
  return [scaleQuantities(arm, cosine), across, along].reduce(addQuantities, centre);
}

export const dotQuantities = (a: QuantityPosition, b: QuantityPosition): Quantity =>
  plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));

export function crossQuantities(a: QuantityPosition, b: QuantityPosition): QuantityPosition {
  const part = (i: 0 | 1 | 2, j: 0 | 1 | 2): Quantity => minus(times(a[i], b[j]), times(a[j], b[i]));
  return [part(1, 2), part(2, 0), part(0, 1)];
}

/** Cosine and sine of an angle in degrees. */
export function turnBy(angle: Quantity): readonly [cosine: Quantity, sine: Quantity] {
  return typeof angle === "number" ? turn(angle / 360) : [call("cos", angle), call("sin", angle)];
}

/** As `frameAlong`: the axes follow from the direction. */
export function quantityFrameAlong(direction: QuantityPosition): Frame<QuantityPosition> {
  const plain = frameAlong(valuesOf(direction));
  if (isPlain(direction)) return plain;
  const norm = call("sqrt", dotQuantities(direction, direction));
  const z = direction.map((part) => over(part, norm)) as [Quantity, Quantity, Quantity];
  const helper = axisBeside(plain.z);
  const slope = dotQuantities(z, helper);
  const sine = call("sqrt", minus(1, times(slope, slope)));
  const x = subtractQuantities(helper, scaleQuantities(z, slope)).map((part) => over(part, sine));
  const y = crossQuantities(z, helper).map((part) => over(part, sine));
  return { origin: zero, x: x as [Quantity, Quantity, Quantity], y: y as [Quantity, Quantity, Quantity], z };
}
