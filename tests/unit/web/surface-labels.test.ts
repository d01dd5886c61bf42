/** The labels of a patch in space: its corners, the base edge and a candidate, at the positions that they name. */
import { createMesher } from "tetrafront";
import type { SurfaceTrace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { cornersOfPlane } from "../../../web/teach/player/plane-drawing";
import { surfaceLabels } from "../../../web/teach/player/surface-labels";
import { recordSurface } from "../../support/recorded-models";

let surface: SurfaceTrace;
beforeAll(async () => {
  const mesher = await createMesher();
  const { trace } = await recordSurface(mesher, "square-to-circle");
  mesher.dispose();
  if (trace.surface === null) throw new Error("the trace has no lines and patches");
  surface = trace.surface;
});

/** States of the fronts, with their patches. */
const states = () =>
  surface.fronts.flatMap((front) =>
    Array.from({ length: front.lastStep - front.firstStep }, (_, i) => ({
      front,
      state: front.firstStep + i,
    })),
  );

it("has the letters of the plane at the same nodes in space", () => {
  for (const { front, state } of states()) {
    const letters = surfaceLabels(surface, state, null).filter(({ text }) => /^[A-D]$/.test(text));
    expect(letters.map(({ text }) => text)).toEqual(front.isCurved ? ["A", "B", "C", "D"] : []);
    letters.forEach(({ position, text }) => {
      const corner = cornersOfPlane(front).find(({ name }) => name === text);
      const node = corner?.node ?? -1;
      expect(position).toEqual([...front.positions.subarray(3 * node, 3 * node + 3)]);
    });
  }
});

it("names the base edge, the chosen candidate, and the edge that refuses it", () => {
  let refused = 0;
  for (const { state } of states()) {
    const step = surface.stepAt(state);
    if (step?.kind !== "edge") continue;
    for (const [rank, { node, isNew, culprit }] of step.candidates.entries()) {
      const texts = surfaceLabels(surface, state, rank)
        .map(({ text }) => text)
        .filter((text) => !/^[A-D]$/.test(text));
      const number = (index: number): string => index.toLocaleString("en-US");
      expect(texts).toEqual([
        `base ${number(step.edge)}`,
        ...(node === null ? [] : [isNew ? "new node" : `node ${number(node)}`]),
        ...(culprit === null ? [] : [`edge ${number(culprit)}`]),
      ]);
      refused += Number(culprit !== null);
    }
  }
  expect(refused).toBeGreaterThan(0);
});

it("names the size at a station, then the averagings, then the next side, beat by beat", () => {
  const station = Array.from({ length: surface.stepCount }, (_, i) => surface.stepAt(i + 1)).find(
    (step) => step?.kind === "station" && step.rounds > 0,
  );
  if (station?.kind !== "station") throw new Error("no side was averaged");
  const texts = (["station", "averages", "side"] as const).map((beat) =>
    surfaceLabels(surface, station.step, null, beat).map(({ text }) => text),
  );
  const number = (value: number): string => Number(value.toPrecision(3)).toString();
  const averages = `${station.rounds} averaging${station.rounds === 1 ? "" : "s"}`;
  const all = [`size ${number(station.startSize)}`, averages, `side ${number(station.length)}`];
  expect(texts).toEqual([all.slice(0, 1), all.slice(0, 2), all]);
  expect(surfaceLabels(surface, station.step, null)).toEqual([]);
});

it("has no labels in lines, in finished patches and before the first step", () => {
  for (const state of [0, surface.lastLineStep, ...surface.fronts.map(({ lastStep }) => lastStep)])
    expect(surfaceLabels(surface, state, null)).toEqual([]);
});
