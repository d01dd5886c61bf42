/** Reads by how much something is to be moved, rotated or scaled, as people type it. */
import type { Position } from "../document/position";
import type { HandleMode } from "../document/tools";
import { expressionFrom } from "../document/expression-edits";
import {
  quantityPosition,
  scaleQuantities,
  subtractQuantities,
  type QuantityPosition,
} from "../document/quantity-positions";
import type { Affine } from "../document/transforms/affine";
import { typedRotation, typedScaling, typedTranslation } from "../document/transforms/typed-maps";
import { axisDirections, zero, type Frame } from "../document/vectors";
import { readNumber, type NamedNumbers } from "../expressions/expression";
import { quantity, valueOf, type Quantity } from "../expressions/quantity";
import { readCoordinates } from "./drawing/coordinates";

export type Axis = 0 | 1 | 2;

export interface MotionContext {
  readonly mode: HandleMode;
  /** The point that was taken hold of, or the middle of what moves. */
  readonly base: Position;
  /** If a single point moves, its coordinates with their expressions; otherwise null. */
  readonly point: QuantityPosition | null;
  /** The chosen axis; null without one. */
  readonly axis: Axis | null;
  /** The direction in which the pointer has moved it, or about which it has rotated it; null without a drag. */
  readonly direction: Position | null;
  /** The work plane. */
  readonly frame: Frame;
  /** The parameters of the project. */
  readonly named: NamedNumbers;
}

export type TypedMotion =
  | { readonly success: true; readonly map: Affine }
  | { readonly success: false; readonly reason: "no-motion" | "no-angle" | "no-factor" };

/**
 * Returns what a text means:
 * - moving: `0.5` is the distance along the axis, or as the pointer has moved it, or along x of the work plane;
 *   `@0.5,0,0` and `5<30` are offsets; `1,2,0` is where the base goes;
 * - rotating: `30` are degrees about the axis, or about the normal of the work plane;
 * - scaling: `2` is the factor along the axis, or along all; `2,1,1` are those along x, y and z.
 *
 * The map has the expressions that were typed. Those of a place where the base goes apply to a single point only: the middle
 * of several entities is a number.
 */
export function readMotion(text: string, context: MotionContext): TypedMotion {
  const { mode, base, point, axis, direction, frame, named } = context;
  const body = text.trim().replace(/[,\s]+$/, "");
  const read = (part: string): Quantity | null => {
    const value = readNumber(part, named);
    return value === null ? null : quantity(value, expressionFrom(part));
  };
  const number = read(mode === "translate" ? body.replace(/^@/, "") : body);
  switch (mode) {
    case "translate": {
      if (number !== null) {
        const along = axis === null ? (direction ?? frame.x) : axisDirections[axis];
        return { success: true, map: typedTranslation(scaleQuantities(along, number)) };
      }
      const isOffset = body.startsWith("@") || body.includes("<");
      const typed = readCoordinates(body, { last: isOffset ? zero : base, frame, named });
      if (!typed.success) return { success: false, reason: "no-motion" };
      const keepsTexts = isOffset || point !== null;
      const to = quantityPosition(typed.position, keepsTexts ? typed.expressions : []);
      const offset = isOffset ? to : subtractQuantities(to, point ?? base);
      return { success: true, map: typedTranslation(offset) };
    }
    case "rotate": {
      const about = axis === null ? (direction ?? frame.z) : axisDirections[axis];
      if (number === null) return { success: false, reason: "no-angle" };
      return { success: true, map: typedRotation(base, about, number) };
    }
    case "scale": {
      const factors = number === null ? body.split(/[,;]/).map(read) : null;
      const all = factors ?? [0, 1, 2].map((k) => (axis === null || axis === k ? number : 1));
      const [x, y, z] = all;
      if (x == null || y == null || z == null || all.length > 3 || Math.min(...[x, y, z].map(valueOf)) <= 0)
        return { success: false, reason: "no-factor" };
      return { success: true, map: typedScaling(base, [x, y, z]) };
    }
  }
}

/** Returns the axis that a key names; null if it names none. */
export function axisOfKey(key: string): Axis | null {
  const index = key.length === 1 ? "xyz".indexOf(key.toLowerCase()) : -1;
  return index < 0 ? null : (index as Axis);
}

/** Returns the text after Tab: the next number of it; the same text if it takes no more. */
export function nextNumber(text: string, mode: HandleMode | null, axis: Axis | null): string {
  const body = text.trim();
  const count = body.split(",").length;
  if (mode === "rotate" || body.includes("<") || body.endsWith(",")) return text;
  if (mode === "translate" && !/[@,]/.test(body)) {
    // A single number is an offset: so are those after it.
    const before = axis === null ? "" : "0,".repeat(axis);
    return axis === 2 ? text : `@${before}${body || "0"},`;
  }
  return body === "" || count > 2 ? text : `${body},`;
}
