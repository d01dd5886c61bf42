import { expect, it } from "vitest";
import type { DrawnLoop } from "../../../web/document/drawn-loop";
import { loopsToFill } from "../../../web/document/loops-to-fill";

const loop = (lines: readonly number[], ...holes: readonly (readonly number[])[]): DrawnLoop => ({
  lines,
  holes,
  polygon: [],
  holePolygons: [],
  normal: [0, 0, 1],
});

/** `count` squares, each within the one before, in a random order: square k has the lines 4 k + 1 … 4 k + 4. */
function nested(count: number): DrawnLoop[] {
  const square = (k: number): number[] => [1, -2, 3, -4].map((step) => step + Math.sign(step) * 4 * k);
  const loops = Array.from({ length: count }, (_, k) =>
    k + 1 < count ? loop(square(k), square(k + 1)) : loop(square(k)),
  );
  const order = (k: number): number => (7919 * k) % 10_007;
  return loops.map((one, k) => [order(k), one] as const).sort(([a], [b]) => a - b).map(([, one]) => one); // prettier-ignore
}

it("fills every other one of nested loops, and both sides of a line between two loops", () => {
  for (const count of [1, 2, 3, 4, 9]) {
    const loops = nested(count);
    const filled = loopsToFill(loops);
    expect(filled.size).toBe(4 * count);
    for (const [line, { lines }] of filled) {
      const depth = Math.floor((line - 1) / 4);
      // The square at an odd depth is the hole of the one around it.
      const expected = depth % 2 === 1 ? depth - 1 : depth;
      expect(Math.floor((Math.abs(lines[0] ?? 0) - 1) / 4)).toBe(expected);
    }
  }
  const [left, right] = [loop([1, 2, 3, 4]), loop([-3, 5, 6, 7])];
  expect(loopsToFill([left, right]).get(3)).toBe(left);
  expect(loopsToFill([left, right]).get(7)).toBe(right);
});

it("reads each loop a few times only, however deep it lies", () => {
  const count = 10_000;
  let reads = 0;
  const loops = nested(count).map((one) => ({
    ...one,
    get lines() {
      ++reads;
      return one.lines;
    },
  }));
  expect(loopsToFill(loops).size).toBe(4 * count);
  expect(reads).toBeLessThanOrEqual(3 * count);
});
