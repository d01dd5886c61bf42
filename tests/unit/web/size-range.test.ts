import { expect, it } from "vitest";
import { rangeOf } from "../../../web/session/size-feed";
import { sizeColors } from "../../../web/viewer/layers/sizes-layer";
import { viridis } from "../../../web/ui/theme/viridis";

it("sizes that differ by rounding alone are one size, of one colour", () => {
  const sizes = Float64Array.from([0.05, 0.05 * (1 + 1e-15), 0.05 * (1 - 1e-9), 0.05]);
  const range = rangeOf(sizes);
  expect(range[0]).toBe(range[1]);
  const colors = sizeColors({ sizes, range }, viridis);
  for (let i = 3; i < colors.length; i += 3) expect(colors.subarray(i, i + 3)).toEqual(colors.subarray(0, 3));
});

it("sizes that differ have the first and the last colour at the ends of their range", () => {
  const sizes = Float64Array.from([0.05, 0.0501, 0.06]);
  expect(rangeOf(sizes)).toEqual([0.05, 0.06]);
  const colors = sizeColors({ sizes, range: rangeOf(sizes) }, viridis);
  const ends = sizeColors({ sizes: Float64Array.from([1, 2]), range: [1, 2] }, viridis);
  expect(colors.subarray(0, 3)).toEqual(ends.subarray(0, 3));
  expect(colors.subarray(6)).toEqual(ends.subarray(3));
  expect(colors.subarray(3, 6)).not.toEqual(colors.subarray(0, 3));
});
