/** One fraction over all calls of a piece of work, whatever their number. */
import { createMesher, type CallProgress } from "tetrafront";
import { expect, test } from "vitest";
import { WholeProgress } from "../../../wasm/src/api/whole-progress.js";
import { progressAt } from "../../support/progress.js";
import { needleGearSurface } from "../../support/surfaces.js";

/** Returns the progress of work, and the fractions that it has reported. */
function recorded(): { readonly whole: WholeProgress; readonly fractions: number[] } {
  const fractions: number[] = [];
  return { whole: new WholeProgress({ onProgress: ({ fraction }) => fractions.push(fraction) }), fractions };
}

const isSorted = (values: readonly number[]): boolean =>
  values.every((value, i) => value >= (values[i - 1] ?? 0));

test("calls that each count from 0 to 1 never lower it, and leave something for the next one", () => {
  const { whole, fractions } = recorded();
  for (const step of ["check", "check", "check", "remesh", "run", "curve"] as const) {
    const { onProgress } = whole.controlOf(step);
    for (const fraction of [0, 0.5, 1]) onProgress?.(progressAt(fraction));
    expect(fractions.at(-1)).toBeLessThan(1);
  }
  whole.end();
  expect(isSorted(fractions)).toBe(true);
  expect(new Set(fractions).size).toBeGreaterThanOrEqual(13);
  expect(fractions.at(-1)).toBe(1);
});

test("a call that consists of calls takes its own share, however they count", () => {
  const { whole, fractions } = recorded();
  const inner = new WholeProgress(whole.next(0.5, { phase: "remesh" }));
  for (let part = 0; part < 4; ++part) inner.next(1 / (4 - part)).onProgress?.(progressAt(1));
  expect(fractions).toEqual([0.125, 0.25, 0.375, 0.5]);
});

test("a control whose call has not begun takes nothing; a call that is left takes what it has done", () => {
  const { whole, fractions } = recorded();
  whole.controlOf("remesh");
  whole.next(0.5).onProgress?.(progressAt(0.5));
  whole.next(1).onProgress?.(progressAt(0.5));
  expect(fractions).toEqual([0.25, 0.625]);
});

test("a surface of needles is remeshed and filled with one fraction, which no step makes jump or rest", async () => {
  const mesher = await createMesher();
  const reports: CallProgress[] = [];
  const surface = needleGearSurface(24);
  const { report } = await mesher.meshSurface(
    surface,
    {},
    { onProgress: (progress) => reports.push(progress) },
  );
  mesher.dispose();
  expect(report.status).toBe("done");
  expect(new Set(reports.map(({ phase }) => phase))).toContain("remesh");
  const fractions = reports.map(({ fraction }) => fraction);
  expect(isSorted(fractions)).toBe(true);
  expect(fractions.at(-1)).toBe(1);
  expect(isSorted(reports.map(({ elapsedSeconds }) => elapsedSeconds))).toBe(true);
  const first = reports.findIndex(({ phase }) => phase === "remesh");
  const end = reports.findLastIndex(({ phase }) => phase === "remesh");
  // The remeshing takes about as long as the run: neither begins near the end. A fast machine may be
  // well into the remeshing when it first reports, so that the fraction before it is what counts.
  expect(fractions[first - 1] ?? 0).toBeLessThan(0.2);
  expect(fractions[end]).toBeGreaterThan(0.4);
  expect(fractions[end]).toBeLessThan(0.8);
});
