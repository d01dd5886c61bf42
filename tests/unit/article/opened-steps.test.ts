/** Links of the lessons that open a step in the app: the step is about what their text says, with the engine of this build. */
import { readFileSync } from "node:fs";
import type { SurfaceStep, Trace } from "tetrafront/trace";
import { expect, test } from "vitest";
import { firstState } from "../../../web/teach/player/phases";
import { galleryProject, recordFront } from "../../support/recorded-models";

/** Returns the step that a lesson opens in a model. */
function openedStep(lesson: number, model: string): number {
  const text = readFileSync(new URL(`../../../web/lessons/${lesson}.md`, import.meta.url), "utf8");
  return Number(new RegExp(`\\(open:model=${model} step=(-?\\d+)\\)`).exec(text)?.[1]);
}

const surfaceStep = (trace: Trace, step: number): SurfaceStep | undefined =>
  trace.surface?.stepAt(step - firstState(trace));

test("lesson 2 opens the first step along a line", async () => {
  const trace = await recordFront(galleryProject("plate-with-hole"));
  const step = openedStep(2, "plate-with-hole");
  expect(step).toBe(firstState(trace) + 1);
  expect(surfaceStep(trace, step)?.kind).toBe("station");
});

test("lesson 3 opens a step of the front on a curved wall", async () => {
  const trace = await recordFront(galleryProject("square-to-circle"));
  const shown = surfaceStep(trace, openedStep(3, "square-to-circle"));
  if (shown?.kind !== "edge") throw new Error(`the step is about ${shown?.kind}`);
  expect(trace.surface?.fronts[shown.front]?.isCurved).toBe(true);
  expect(shown.outcome).toBe("accepted");
});

test("lessons 10 and 11 open the filled cube, which needed no recovery", async () => {
  const trace = await recordFront(galleryProject("unit-cube"));
  for (const lesson of [10, 11]) expect(openedStep(lesson, "unit-cube")).toBe(trace.stepCount);
  expect(trace.steps.frontSizes[trace.stepCount]).toBe(0);
  const recovered = Array.from(trace.steps.outcomes).filter((outcome) => outcome > 1);
  expect(recovered).toEqual([]);
});
