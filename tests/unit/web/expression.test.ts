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

  it("has exact tangents of multiples of 45 degrees, and none of a right angle", () => {
    expect(["tan(45)", "tan(-45)", "tan(180)", "tan(225)"].map((text) => readNumber(text))).toEqual([
      1, -1, 0, 1,
    ]);
    expect(readNumber("tan(30)")).toBeCloseTo(1 / Math.sqrt(3), 14);
    expect(["tan(90)", "tan(-90)"].map((text) => readNumber(text))).toEqual([null, null]);
  });

  it.each(["", "abc", "1 2", "1/", "(1", "1)", "1/0", "2pi", "sqrt 4", "sqrt(-1)", "1,5", "0x10", "--"])(
    "rejects %j",
    (text) => {
      expect(readNumber(text)).toBeNull();
    },
  );
});
