/** Numbers as the panels show them. */
import { expect, it } from "vitest";
import { formatMeasure } from "../../../web/strings/format";

it.each([
  [0.0012346, "mm", 1, "0.001235 mm"],
  [999.96, "mm", 2, "1000 mm²"],
  [9876.5, "mm", 3, "9877 mm³"],
  [3_141_592.65, "mm", 3, "3,142,000 mm³"],
  [-1_234_567, undefined, 3, "-1,235,000"],
  [4.18879e12, "mm", 3, "4,189,000,000,000 mm³"],
  [4.18879e22, "m", 3, "4.189e+22 m³"],
] as const)("%d %s to the power %d", (value, unit, power, text) => {
  expect(formatMeasure(value, unit, power)).toBe(text);
});
