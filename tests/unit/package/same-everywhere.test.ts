/** Functions with the same bits in every JavaScript engine. */
import { expect, test } from "vitest";

import { cosineAndSine, hyperbolicCosineAndSine, steady } from "../../../wasm/src/base/same-everywhere.js";
import { randomSource } from "../../support/random.js";

const ULP = Number.EPSILON;

test("cosines and sines are those of the angle, also after many turns", () => {
  const random = randomSource(7);
  for (let i = 0; i < 20_000; i++) {
    const angle = (random() / 2 ** 32 - 0.5) * (i % 2 ? 7 : 2000);
    const [cosine, sine] = cosineAndSine(angle);
    expect(Math.abs(cosine - Math.cos(angle))).toBeLessThanOrEqual(ULP);
    expect(Math.abs(sine - Math.sin(angle))).toBeLessThanOrEqual(ULP);
  }
});

test("sines of small angles have a small relative error", () => {
  for (let angle = 0.7; angle > 1e-300; angle /= 3) {
    expect(Math.abs(cosineAndSine(angle)[1] / Math.sin(angle) - 1)).toBeLessThanOrEqual(2 * ULP);
  }
  expect(cosineAndSine(0)).toEqual([1, 0]);
});

test("angles of the four quadrants turn a position by quarters", () => {
  for (let k = -9; k <= 9; k++) {
    const [cosine, sine] = cosineAndSine((k * Math.PI) / 2);
    const exact =
      [
        [1, 0],
        [0, 1],
        [-1, 0],
        [0, -1],
      ][k & 3] ?? [];
    expect(Math.hypot(cosine - (exact[0] ?? 0), sine - (exact[1] ?? 0))).toBeLessThan(9 * ULP);
  }
});

test("hyperbolic functions have a relative error of some units of the last place", () => {
  for (let value = -12; value <= 12; value += 0.37) {
    const [cosine, sine] = hyperbolicCosineAndSine(value);
    expect(Math.abs(cosine / Math.cosh(value) - 1)).toBeLessThan(64 * ULP);
    expect(Math.abs(sine - Math.sinh(value)) / cosine).toBeLessThan(64 * ULP);
  }
});

test("steady values do not depend on the last bits", () => {
  for (const value of [0.1, 1 / 3, Math.PI, 1e-7, 12_345.678]) {
    for (const factor of [1 - ULP, 1 + ULP]) expect(steady(value * factor)).toBe(steady(value));
    expect(Math.abs(steady(value) / value - 1)).toBeLessThan(1e-7);
  }
});
