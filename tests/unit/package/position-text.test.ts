/** Positions in messages: the digits that matter. */
import { expect, test } from "vitest";

import { positionText } from "../../../wasm/src/base/position-text.js";

test.each([
  [[1.03e-16, 1 / 3, -6e-17], "(0, 0.333333, 0)"],
  [[1e-16, 2e-16, 0], "(1e-16, 2e-16, 0)"],
  [[1234567.12345, 0.5, -1e-3], "(1234567.123, 0.5, -0.001)"],
  [[0, 0, 0], "(0, 0, 0)"],
])("%j is %s", (position, text) => {
  expect(positionText(position)).toBe(text);
});

test("has as many digits as are asked for", () => {
  expect(positionText([1 / 3, 20.0001, 0], 2)).toBe("(0.33, 20, 0)");
});
