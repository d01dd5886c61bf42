import { expressionFrom } from "../../document/expression-edits";
import type { Position } from "../../document/position";
import { add, fromFrame, type Frame } from "../../document/vectors";
import { readNumber, type NamedNumbers } from "../../expressions/expression";

/** What typed coordinates refer to. */
export interface CoordinateContext {
  /** The place picked last; null if there is none. */
  readonly last: Position | null;
  /** The work plane. */
  readonly frame: Frame;
  /** The parameters of the project. */
  readonly named?: NamedNumbers;
}

export type TypedPosition =
  | {
      readonly success: true;
      readonly position: Position;
      /** What x, y and z were typed as; null for plain numbers. Empty if they were not typed as such. */
      readonly expressions: readonly (string | null)[];
    }
  | { readonly success: false; readonly reason: "syntax" | "no-last-place" };

const syntax = { success: false, reason: "syntax" } as const;
const degrees = Math.PI / 180;

/**
 * Reads coordinates as people type them. Each number may be an expression, such as `sqrt(2)/2`:
 * - `1, 2, 0`: x, y and z;
 * - `1, 2`: x and y in the work plane;
 * - `@0.5, 0, 0` or `@0.5, 0`: the same, relative to the place picked last;
 * - `5 < 30`: length and angle in degrees in the work plane, from the place picked last or, without one, from the
 *   plane's origin.
 */
export function readCoordinates(text: string, { last, frame, named }: CoordinateContext): TypedPosition {
  const read = (part: string): number | null => readNumber(part, named);
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
  const offset: Position = inPlane ? inDirections(frame, a, b) : [a, b, c];
  const origin = base ?? (inPlane ? frame.origin : [0, 0, 0]);
  const isAbsolute = base === null && !inPlane;
  const expressions = isAbsolute ? parts(body).map(expressionFrom) : [];
  return { success: true, position: add(origin, offset), expressions };
}

function polar(
  [length, angle, ...more]: readonly (number | null)[],
  from: Position,
  frame: Frame,
): TypedPosition {
  if (length == null || angle == null || more.length > 0) return syntax;
  const [cosine, sine] = circle(angle);
  return {
    success: true,
    position: add(from, inDirections(frame, length * cosine, length * sine)),
    expressions: [],
  };
}

/** Cosine and sine of an angle in degrees; exact for right angles. */
function circle(angle: number): readonly [cosine: number, sine: number] {
  const quarter = [
    [1, 0],
    [0, 1],
    [-1, 0],
    [0, -1],
  ] as const;
  const right = ((angle % 360) + 360) % 360;
  return quarter[right / 90] ?? [Math.cos(angle * degrees), Math.sin(angle * degrees)];
}

const inDirections = (frame: Frame, x: number, y: number): Position =>
  fromFrame({ ...frame, origin: [0, 0, 0] }, [x, y, 0]);

/** Splits at commas and semicolons; without any, at spaces. No function takes more than one number. */
function parts(text: string): readonly string[] {
  return /[,;]/.test(text) ? text.split(/[,;]/) : text.trim().split(/\s+/);
}
