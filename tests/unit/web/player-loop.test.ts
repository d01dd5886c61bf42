/** The range of steps that the player repeats. */
import { createMesher } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { loopAround, loopLimits, shownLoop, withLoopEnd } from "../../../web/teach/player/loop";
import { phasesOf } from "../../../web/teach/player/phases";
import { recordFront, galleryProject, recordSurface } from "../../support/recorded-models";

let volume: Trace;
let surface: Trace;
beforeAll(async () => {
  volume = await recordFront(galleryProject("unit-cube"));
  const mesher = await createMesher();
  ({ trace: surface } = await recordSurface(mesher, "unit-cube"));
  mesher.dispose();
});

it("reaches 50 steps to both sides, but not into another phase", () => {
  expect(loopAround(volume, 200)).toEqual({ from: 150, to: 250 });
  expect(loopAround(volume, 10)).toEqual({ from: 0, to: 60 });
  expect(loopAround(volume, volume.stepCount)).toEqual({ from: volume.stepCount - 50, to: volume.stepCount });
  for (const { from, to } of phasesOf(surface)) {
    expect(loopAround(surface, from).from).toBe(from);
    expect(loopAround(surface, to).to).toBe(to);
  }
});

it("counts the steps of its phase, as the player shows them", () => {
  const patches = phasesOf(surface).find(({ phase }) => phase === "patches");
  if (!patches) throw new Error("the trace has no patches");
  const loop = loopAround(surface, patches.from + 60);
  expect(shownLoop(surface, loop)).toEqual({ from: 10, to: 110 });
  expect(withLoopEnd(surface, loop, "from", 20)).toEqual({ from: patches.from + 20, to: loop.to });
  expect(loopLimits(surface, loop, "to")).toEqual([1, patches.to - patches.from]);
});

it("moves the other end if the ends would meet", () => {
  const loop = { from: 150, to: 250 };
  expect(withLoopEnd(volume, loop, "to", 300)).toEqual({ from: 150, to: 300 });
  expect(withLoopEnd(volume, loop, "from", 400)).toEqual({ from: 400, to: 401 });
  expect(withLoopEnd(volume, loop, "to", 100)).toEqual({ from: 99, to: 100 });
  expect(loopLimits(volume, loop, "from")).toEqual([0, volume.stepCount - 1]);
});
