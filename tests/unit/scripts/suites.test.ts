/** Tests the plan by which `npm test` runs its suites. */
import { expect, test } from "vitest";

import { steps } from "../../../scripts/build.mjs";
import { lanes, suites } from "../../../scripts/lib/suites.mjs";

test("every suite runs in one lane", () => {
  expect(lanes.flat().sort()).toEqual(Object.keys(suites).sort());
});

test("suites need parts that can be built", () => {
  const needed = Object.values(suites).flatMap(({ needs }) => needs);
  expect(Object.keys(steps)).toEqual(expect.arrayContaining(needed));
});

test("programs that build in the same folder are built one after the other", () => {
  const laneOf = (name: keyof typeof suites) => lanes.findIndex((lane) => lane.includes(name));
  expect(laneOf("cpp-asan")).toBe(laneOf("cpp"));
});
