/** What the colours of the front show: the values of its faces, and where they are on the scale. */
import { expect, it } from "vitest";
import { readTrace, type Trace } from "tetrafront/trace";
import { frontValues, shadeOf } from "../../../web/teach/player/front-values";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

function readStar(): Trace {
  const read = readTrace(starTrace(starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1]))).bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const trace = readStar();

it("the ages of recent and of old faces are apart on the scale, in runs of any length", () => {
  const age = frontValues(trace, "age");
  for (const step of [100, 1000, 11_000, 100_000]) {
    const shadeAfter = (steps: number): number => shadeOf(age, step - steps, step);
    expect([shadeAfter(0), shadeAfter(step)]).toEqual([1, 0]);
    // A face of the last thousandth of the steps has left the first colour by a tenth of the scale.
    expect(shadeAfter(step / 1000)).toBeCloseTo(0.9);
    // Half of the scale belongs to the last eighth; the first half of the steps still has a fifth.
    expect(shadeAfter(step / 8)).toBeCloseTo(0.5);
    expect(shadeAfter(step / 2)).toBeGreaterThan(0.2);
  }
});

it("the triangles of the boundary are the oldest at every step, the first one included", () => {
  const age = frontValues(trace, "age");
  expect(shadeOf(age, age.valueOf(0), 1)).toBe(0);
  for (const face of trace.frontAt(0)) expect(age.valueOf(face)).toBe(0);
  expect(Number.isFinite(shadeOf(age, age.valueOf(0), 0))).toBe(true);
  const made = trace.frontAt(5).find((face) => trace.faces.born[face] === 5);
  expect(made).toBeDefined();
  expect(shadeOf(age, age.valueOf(made ?? 0), 5)).toBe(1);
});

it.each(["size", "layer"] as const)("the scale of %s is linear, and has all faces on it", (coloring) => {
  const values = frontValues(trace, coloring);
  const [from, to] = values.rangeAt(0);
  expect(shadeOf(values, from + 0.25 * (to - from), 0)).toBeCloseTo(0.25);
  for (let face = 0; face < trace.faces.born.length; face++) {
    expect(values.valueOf(face)).toBeGreaterThanOrEqual(from);
    expect(values.valueOf(face)).toBeLessThanOrEqual(to);
  }
});
