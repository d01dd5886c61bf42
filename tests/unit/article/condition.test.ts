/** Conditions of tasks. */
import { describe, expect, test } from "vitest";
import { ConditionMismatch, evaluate, parseCondition, valuesIn } from "../../../web/teach/article/condition";

const values: Readonly<Record<string, number>> = { "A.size": 0.5, "A.refused": 0, "B.x": 3 };
const value = (text: string): number =>
  evaluate(parseCondition(text), ({ figure, name }) => values[`${figure}.${name}`] ?? NaN);

describe("conditions", () => {
  test.each([
    ["1 + 2 * 3", 7],
    ["(1 + 2) * 3", 9],
    ["7 - 2 - 1", 4],
    ["8 / 4 / 2", 1],
    ["-B.x", -3],
    ["A.size == 0.5", 1],
    ["A.size != 0.5", 0],
    ["B.x > 2 and A.refused == 0", 1],
    ["B.x < 2 or A.size <= .5", 1],
    ["1 or 0 and 0", 1],
    ["not A.refused", 1],
    ["not A.refused and not B.x", 0],
    ["B.x >= 4", 0],
  ])("%s is %d", (text, expected) => {
    expect(value(text)).toBe(expected);
  });

  test("a value that is not known makes every relation false", () => {
    for (const relation of ["==", "!=", "<", ">", "<=", ">="]) expect(value(`A.none ${relation} 0`)).toBe(0);
    expect(value("A.none and 1")).toBe(0);
  });

  test.each([
    ["", "a number or a value such as A.size", ""],
    ["A.size ==", "a number or a value such as A.size", ""],
    ["size > 1", "a number or a value such as A.size", "size"],
    ["(1 > 0", '")"', ""],
    ["1 > 0 2", "and, or, or the end", "2"],
    ["alert(1)", "a number or a value such as A.size", "alert"],
  ])("%j is refused", (text, expected, found) => {
    expect(() => parseCondition(text)).toThrow(ConditionMismatch);
    try {
      parseCondition(text);
    } catch (error) {
      expect([(error as ConditionMismatch).expected, (error as ConditionMismatch).found]).toEqual([
        expected,
        found,
      ]);
    }
  });

  test("names the values that it depends on", () => {
    expect(valuesIn(parseCondition("A.size > 1 and not (B.x == A.size)"))).toEqual([
      { figure: "A", name: "size" },
      { figure: "B", name: "x" },
      { figure: "A", name: "size" },
    ]);
  });
});
