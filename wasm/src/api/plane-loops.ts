/** The loops of a polygon, checked and as the engine takes them. */
import * as v from "valibot";
import { isA } from "../base/values.js";
import { doubles } from "../calls/schemas.js";
import { MAX_LENGTH } from "../generated/constants.js";
import type { PlaneLoop, PlaneSegment, UnfilledPlane } from "./plane-types.js";

/** Any number, also NaN: numbers that are out of range are named as those of a corner, size or source. */
export const anyNumber = v.custom<number>((value) => typeof value === "number", "a number");
export const positionSchema = v.strictTuple([anyNumber, anyNumber]);
export const loopsSchema = v.array(
  v.lazy((loop) => (isA("Float64Array", loop) ? doubles() : v.array(positionSchema))),
);

/** Corners of all loops, one after the other. */
export interface PlaneLoops {
  /** x y per corner. */
  readonly points: Float64Array;
  /** Number of corners per loop. */
  readonly counts: Uint32Array;
}

/** Returns the loops, or what is wrong with them without regard to each other. */
export function planeLoops(loops: readonly PlaneLoop[]): PlaneLoops | UnfilledPlane {
  const arrays = loops.map(coordinates);
  const problem = arrays.length === 0 ? noPolygon([], "there is no loop") : firstOf(arrays, loopProblem);
  if (problem !== undefined) return problem;
  const counts = Uint32Array.from(arrays, ({ length }) => length / 2);
  const points = new Float64Array(arrays.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const loop of arrays) {
    points.set(loop, at);
    at += loop.length;
  }
  return { points, counts };
}

/** Returns the segment of a loop that a segment of all loops is. */
export function segmentOf({ counts }: PlaneLoops, segment: number): PlaneSegment {
  let left = segment;
  let loop = 0;
  for (; loop + 1 < counts.length && left >= (counts[loop] ?? 0); loop++) left -= counts[loop] ?? 0;
  return { loop, segment: left };
}

/** Names a loop in a sentence. */
export const loopName = (loop: number): string => (loop === 0 ? "the outer loop" : `hole ${loop}`);

function coordinates(loop: PlaneLoop): Float64Array {
  return isA("Float64Array", loop) ? (loop as Float64Array) : Float64Array.from((loop as []).flat());
}

/** Returns the first thing that is found in items. */
export function firstOf<Item, Found>(
  items: readonly Item[],
  find: (item: Item, index: number) => Found | undefined,
): Found | undefined {
  for (const [index, item] of items.entries()) {
    const found = find(item, index);
    if (found !== undefined) return found;
  }
  return undefined;
}

function loopProblem(points: Float64Array, loop: number): UnfilledPlane | undefined {
  if (points.length % 2 !== 0) return noPolygon([loop], `${loopName(loop)} has an odd number of coordinates`);
  const count = points.length / 2;
  if (count < 3) return noPolygon([loop], `${loopName(loop)} has ${count} of at least 3 corners`);
  for (let corner = 0; corner < count; corner++) {
    const [x = NaN, y = NaN] = points.subarray(2 * corner, 2 * corner + 2);
    if (!(Math.abs(x) <= MAX_LENGTH && Math.abs(y) <= MAX_LENGTH)) {
      return {
        success: false,
        code: "invalid-position",
        message: `corner ${corner} of ${loopName(loop)} has the position (${x}, ${y})`,
        remedy: `Use finite coordinates up to ${MAX_LENGTH.toExponential().replace("+", "")}.`,
        loops: [loop],
        segments: [],
      };
    }
    const next = (corner + 1) % count;
    if (x === points[2 * next] && y === points[2 * next + 1]) {
      return {
        success: false,
        code: "same-corner",
        message: `corners ${corner} and ${next} of ${loopName(loop)} are at the same position`,
        remedy: "Move one of them, or leave it out.",
        loops: [loop],
        segments: [{ loop, segment: corner }],
      };
    }
  }
  return undefined;
}

function noPolygon(loops: readonly number[], message: string): UnfilledPlane {
  const remedy = "Pass the outer loop first, then the holes, each with three corners or more.";
  return { success: false, code: "no-polygon", message, remedy, loops, segments: [] };
}
