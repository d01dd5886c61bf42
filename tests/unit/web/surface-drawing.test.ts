/** Drawings of lines and patches: what they show of a state. */
import { createMesher } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import type { DrawingView } from "../../../web/teach/player/front-drawing";
import { firstState } from "../../../web/teach/player/phases";
import { initialPlayerState } from "../../../web/teach/player/player";
import { supposedFrontText } from "../../../web/teach/panels/player/supposed-front";
import { surfaceDrawing } from "../../../web/teach/player/surface-drawing";
import { surfaceLabels } from "../../../web/teach/player/surface-labels";
import { stepMarks, surfaceScene } from "../../../web/teach/player/surface-scene";
import { recordSurface } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  const mesher = await createMesher();
  ({ trace } = await recordSurface(mesher, "unit-cube"));
  mesher.dispose();
});

/** Looks from far away along -z, in parallel. */
const fromAbove: DrawingView = {
  width: 200,
  height: 200,
  eye: [0.5, 0.5, 1000],
  toScreen: ([x, y]) => ({ x: 50 + 100 * x, y: 150 - 100 * y }),
};

const drawn = (state: number): string => {
  const { surface } = trace;
  if (!surface) throw new Error("the trace has no lines and patches");
  const labels = surfaceLabels(surface, state, null);
  return surfaceDrawing(trace, { step: firstState(trace) + state, candidate: null, labels }, fromAbove);
};
const countOf = (drawing: string, part: RegExp): number => drawing.match(part)?.length ?? 0;
const triangles = /<polygon points="[^"]*" fill="[^"]*" stroke=/g;
const segmentsOf = (drawing: string, width: string): number =>
  [...drawing.matchAll(new RegExp(`<path d="([^"]*)"[^>]*stroke-width="${width}"`, "g"))].reduce(
    (sum, [, path = ""]) => sum + countOf(path, /M/g),
    0,
  );

it("have the triangles, sides, front and base edge of every kind of state", () => {
  const count = trace.surface?.stepCount ?? 0;
  const seen = { made: 0, base: 0, walk: 0 };
  for (let state = 0; state <= count; state += 7) {
    const scene = surfaceScene(trace, state);
    const finished = (trace.surface?.fronts ?? []).slice(0, scene.finished);
    const expected =
      finished.reduce((sum, front) => sum + (front.improved ?? front).triangles.length / 3, 0) + scene.made;
    const drawing = drawn(state);
    expect(countOf(drawing, triangles), `state ${state}`).toBe(expected);
    expect(segmentsOf(drawing, "1.6"), `state ${state}`).toBe(scene.sides.length / 2);
    expect(segmentsOf(drawing, "2.4"), `state ${state}`).toBe((scene.front.length + scene.walk.length) / 2);
    const kind = trace.surface?.stepAt(state)?.kind;
    const isEdge = kind === "edge";
    // Steps of lines mark the sides that they find or divide.
    const isMarked = isEdge || kind === "station" || kind === "divided";
    expect(segmentsOf(drawing, "4") > 0, `state ${state}`).toBe(isMarked);
    expect(drawing).not.toContain("NaN");
    seen.made += scene.made;
    seen.walk += scene.walk.length;
    seen.base += isEdge ? 1 : 0;
  }
  expect(Math.min(...Object.values(seen))).toBeGreaterThan(0);
});

it("name the step as the player does, and what it is about", () => {
  expect(drawn(3)).toContain("<title>Unit cube, lines, step 3 of ");
  const inPatch = drawn((trace.surface?.lastLineStep ?? 0) + 20);
  expect(inPatch).toMatch(/<title>Unit cube, patches, step \d+ of \d+<\/title>/);
  expect(inPatch).toMatch(/>base \d+<\/text>/);
});

it("show the patch before the step, with the triangle of a refused candidate that is chosen", () => {
  const { surface } = trace;
  if (!surface) throw new Error("the trace has no lines and patches");
  let count = 0;
  for (let state = 1; state <= surface.stepCount; state++) {
    const step = surface.stepAt(state);
    if (step?.kind !== "edge") continue;
    step.candidates.forEach(({ verdict, node }, rank) => {
      const isSupposed = verdict === "crosses" || verdict === "too-close";
      const { triangle, supposed } = stepMarks(trace, state, rank);
      expect(surfaceScene(trace, state, rank)).toEqual(surfaceScene(trace, isSupposed ? state - 1 : state));
      expect(triangle).toHaveLength(isSupposed || step.triangle === null ? 0 : 3);
      expect(supposed).toHaveLength(isSupposed && node !== null ? 3 : 0);
      const number = state + firstState(trace);
      const shown = { ...initialPlayerState, trace, step: number, lensStep: number, candidate: rank };
      expect(supposedFrontText(shown) !== null).toBe(isSupposed);
      expect(supposedFrontText(shown)?.includes("in red") === true).toBe(supposed.length > 0);
      if (isSupposed && node !== null) count++;
    });
    expect(stepMarks(trace, state, null).supposed).toEqual([]);
  }
  expect(count).toBeGreaterThan(0);
});
