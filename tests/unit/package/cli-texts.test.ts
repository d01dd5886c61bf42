/** Texts of the command line whose numbers must agree with each other. */
import { describe, expect, test } from "vitest";

import { angleText, anglesText } from "../../../wasm/src/cli/tables.js";

describe("angles as text", () => {
  test.each([
    [29.96, 135.04, "29.9° to 135.1°"],
    [30, 135, "30.0° to 135.0°"],
    [30.04, 134.96, "30.0° to 135.0°"],
  ])("never hide that %f or %f is out of range", (min, max, text) => {
    expect(anglesText({ min, max }, 1)).toBe(text);
  });

  test("have the digits asked for", () => {
    expect(angleText(12.3456, 2, Math.floor)).toBe("12.34°");
    expect(angleText(12, 2, Math.ceil)).toBe("12.00°");
  });
});
