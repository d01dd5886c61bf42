import { expect, it } from "vitest";
import { roundTime, TimeLeft } from "../../../wasm/src/base/time-left.js";

it("counts down in a run of even progress, from a little too much", () => {
  const left = new TimeLeft();
  for (let second = 0; second < 60; ++second) {
    const now = left.add(second / 60, second);
    expect(now === null, `second ${second}`).toBe(second < 12);
    expect(now ?? 60 - second, `second ${second}`).toBeGreaterThanOrEqual(60 - second);
    expect(now ?? 60 - second, `second ${second}`).toBeLessThan(1.25 * (60 - second) + 4);
  }
});

it("is unknown at the beginning, and at the end", () => {
  const left = new TimeLeft();
  expect(left.add(0.5, 0.1)).toBeNull();
  expect(left.add(0.1, 10)).toBeNull();
  expect(left.add(1, 20)).toBeNull();
});

/** Fraction and second of the reports of a sphere with 1.5 million tetrahedra. */
const ofSphere = [
  [0.047, 0.4], [0.146, 1.15], [0.156, 1.66], [0.193, 2.41], [0.231, 3.24], [0.245, 4.04], [0.277, 4.79], [0.293, 5.53],
  [0.317, 6.3], [0.335, 7.03], [0.376, 7.78], [0.399, 8.61], [0.411, 9.37], [0.423, 9.97], [0.426, 10.92], [0.454, 11.98],
  [0.461, 12.72], [0.494, 13.54], [0.544, 14.36], [0.623, 15.12], [0.648, 15.89], [0.662, 16.64], [0.674, 17.38],
  [0.69, 18.12], [0.698, 18.86], [0.704, 19.59], [0.72, 20.36], [0.738, 21.1], [0.755, 21.86], [0.767, 22.64],
  [0.774, 23.39], [0.783, 24.14], [0.854, 24.91], [0.872, 25.68], [0.895, 26.45], [0.925, 27.2], [0.948, 27.95],
] as const; // prettier-ignore
/** Second at which this run ended. */
const sphereEnd = 29.3;

it("is never far too short in a run whose progress becomes slower", () => {
  const left = new TimeLeft();
  for (const [fraction, second] of ofSphere) {
    const share = (left.add(fraction, second) ?? sphereEnd - second) / (sphereEnd - second);
    expect(share, `second ${second}`).toBeGreaterThan(0.75);
    // Two seconds too much before the end are not far from the truth.
    if (second < 0.8 * sphereEnd) expect(share, `second ${second}`).toBeLessThan(1.6);
  }
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
