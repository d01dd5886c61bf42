import { expect, it } from "vitest";
import { roundTime, TimeLeft } from "../../../web/session/time-left";

it("counts down in a run of even progress", () => {
  const left = new TimeLeft();
  for (let second = 3; second < 60; ++second)
    expect(left.add(second / 60, second)).toBeCloseTo(60 - second, 9);
});

it("is unknown at the beginning, and at the end", () => {
  const left = new TimeLeft();
  expect(left.add(0.5, 0.1)).toBeNull();
  expect(left.add(0.001, 10)).toBeNull();
  expect(left.add(1, 20)).toBeNull();
});

it("follows a run that becomes slower, without jumps", () => {
  const left = new TimeLeft();
  let before: number | null = null;
  for (let second = 2; second < 200; ++second) {
    // Half of the work takes 20 seconds, the rest 180.
    const fraction = second <= 20 ? second / 40 : 0.5 + (second - 20) / 360;
    const now = left.add(fraction, second);
    if (before !== null && now !== null) expect(Math.abs(now - before)).toBeLessThan(20);
    before = now;
  }
  expect(before).toBeLessThan(10);
});

it("is rounded to what an estimate can say", () => {
  expect(
    [0.4, 4, 11, 27, 44, 58, 130, 601].map((seconds) => Object.values(roundTime(seconds)).join(" ")),
  ).toEqual(["1 s", "5 s", "10 s", "30 s", "45 s", "1 min", "2 min", "10 min"]);
});
