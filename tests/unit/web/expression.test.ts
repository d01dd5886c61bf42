import { describe, expect, it } from "vitest";
import { readNumber } from "../../../web/expressions/expression";

describe("readNumber", () => {
  it.each([
    ["0.25", 0.25],
    [".5", 0.5],
    ["1/3", 1 / 3],
    ["2*pi", 2 * Math.PI],
    ["-(1 + 2) / 4", -0.75],
    ["1e-3", 0.001],
    ["2 - -3", 5],
    ["8/2/2", 2],
    ["1 - 2 - 3", -4],
    ["-sqrt(2)/2", -Math.SQRT1_2],
    ["SQRT(9)", 3],
  ])("reads %s", (text, value) => {
    expect(readNumber(text)).toBeCloseTo(value, 14);
  });

  it.each(["", "abc", "1 2", "1/", "(1", "1)", "1/0", "2pi", "sqrt 4", "sqrt(-1)", "1,5", "0x10", "--"])(
    "rejects %j",
    (text) => {
      expect(readNumber(text)).toBeNull();
    },
  );
});
