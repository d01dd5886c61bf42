import { expressionFrom } from "../../document/expression-edits";
import type { Position } from "../../document/position";
import {
  addQuantities,
  quantitiesFromFrame,
  storableTexts,
  turnBy,
  valuesOf,
  type QuantityPosition,
} from "../../document/quantity-positions";
import { zero, type Frame } from "../../document/vectors";
import { readNumber, type NamedNumbers } from "../../expressions/expression";
import { quantity, times, type Quantity } from "../../expressions/quantity";

/** What typed coordinates refer to. */
export interface CoordinateContext {
  /** The place picked last, with the expressions of its coordinates; null if there is none. */
  readonly last: QuantityPosition | null;
  /** The work plane. */
  readonly frame: Frame;
  /** The parameters of the project. */
  readonly named?: NamedNumbers;
}

export type TypedPosition =
  | {
      readonly success: true;
      readonly position: Position;
      /** What x, y and z are computed from; null for plain numbers. Empty if only plain numbers were typed. */
      readonly expressions: readonly (string | null)[];
    }
  | { readonly success: false; readonly reason: "syntax" | "no-last-place" };

const syntax = { success: false, reason: "syntax" } as const;

/**
 * Reads coordinates as people type them. Each number may be an expression, such as `sqrt(2)/2`:
 * - `1, 2, 0`: x, y and z;
 * - `1, 2`: x and y in the work plane;
 * - `@0.5, 0, 0` or `@0.5, 0`: the same, relative to the place picked last;
 * - `5 < 30`: length and angle in degrees in the work plane, from the place picked last or, without one, from the
 *   plane's origin.
 */
export function readCoordinates(text: string, { last, frame, named }: CoordinateContext): TypedPosition {
  const read = (part: string): Quantity | null => {
    const value = readNumber(part, named);
    return value === null ? null : quantity(value, expressionFrom(part));
  };
  const trimmed = text.trim();
  const isRelative = trimmed.startsWith("@");
  if (isRelative && !last) return { success: false, reason: "no-last-place" };
  const body = isRelative ? trimmed.slice(1) : trimmed;
  const base = isRelative ? last : null;
  if (body.includes("<")) return polar(body.split("<").map(read), last ?? frame.origin, frame);
  const numbers = parts(body).map(read);
  const [a, b, c] = numbers;
  if (a == null || b == null || c === null || numbers.length > 3) return syntax;
  const inPlane = c === undefined;
  const offset: QuantityPosition = inPlane ? inDirections(frame, a, b) : [a, b, c];
  const origin = base ?? (inPlane ? frame.origin : zero);
  return typedPosition(addQuantities(origin, offset), numbers);
}

function polar(
  [length, angle, ...more]: readonly (Quantity | null)[],
  from: QuantityPosition,
  frame: Frame,
): TypedPosition {
  if (length == null || angle == null || more.length > 0) return syntax;
  const [cosine, sine] = turnBy(angle);
  const offset = inDirections(frame, times(length, cosine), times(length, sine));
  return typedPosition(addQuantities(from, offset), [length, angle]);
}

/** The coordinates follow expressions if one was typed, unless the texts would be too long for the file. */
function typedPosition(
  position: QuantityPosition,
  typed: readonly (Quantity | null | undefined)[],
): TypedPosition {
  const isPlain = typed.every((one) => typeof one !== "object" || one === null);
  const [texts = []] = isPlain ? [] : (storableTexts([position]) ?? []);
  return { success: true, position: valuesOf(position), expressions: texts };
}

const inDirections = (frame: Frame, x: Quantity, y: Quantity): QuantityPosition =>
  quantitiesFromFrame({ ...frame, origin: zero }, [x, y, 0]);

/** Splits at commas and semicolons; without any, at spaces. No function takes more than one number. */
function parts(text: string): readonly string[] {
  return /[,;]/.test(text) ? text.split(/[,;]/) : text.trim().split(/\s+/);
}
