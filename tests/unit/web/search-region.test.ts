/** The search region of the lens against the candidates that the engine has found, with and without stretching. */
import { readFileSync } from "node:fs";
import type { AdvanceStep, Trace } from "tetrafront/trace";
import { expect, test } from "vitest";
import { nodesOf } from "../../../web/teach/player/judge";
import { outlineOf, searchRegionOf, type SearchRegion } from "../../../web/teach/player/search-region";
import { cubeProject, stretchedCube } from "../../support/projects";
import { recordFront } from "../../support/recorded-models";

type Vector = readonly [number, number, number];

/** Returns the length of H⁻¹ (position − centre), by Gaussian elimination. */
function distanceIn({ axes, centre }: SearchRegion, position: Vector): number {
  const rows = [0, 1, 2].map((row) => [
    ...axes.map((axis) => axis[row] ?? 0),
    (position[row] ?? 0) - (centre[row] ?? 0),
  ]);
  for (let pivot = 0; pivot < 3; pivot++)
    for (let row = 0; row < 3; row++) {
      if (row === pivot) continue;
      const factor = (rows[row]?.[pivot] ?? 0) / (rows[pivot]?.[pivot] ?? 1);
      rows[row] = (rows[row] ?? []).map((term, column) => term - factor * (rows[pivot]?.[column] ?? 0));
    }
  return Math.hypot(...rows.map((row, i) => (row[3] ?? 0) / (row[i] ?? 1)));
}

/** Nodes of faces of the front that have an edge in common with the base face. */
function neighboursOf(trace: Trace, { step, face }: AdvanceStep): Set<number> {
  const base = nodesOf(trace, face);
  const adjacent = Array.from(trace.frontAt(step - 1), (other) => nodesOf(trace, other)).filter(
    (nodes) => nodes.filter((node) => base.includes(node)).length === 2,
  );
  return new Set(adjacent.flat());
}

test.each([
  ["a ball", cubeProject(0.2)],
  ["an ellipsoid", stretchedCube(0.2)],
])(
  "it is %s that holds all candidates but the neighbours', and reaches the farthest ones",
  async (_, project) => {
    const trace = await recordFront(project);
    let farthest = 0;
    let count = 0;
    for (let i = 1; i <= trace.stepCount; i++) {
      const step = trace.stepAt(i);
      if (step?.kind !== "advance") continue;
      const region = searchRegionOf(trace, step);
      const neighbours = neighboursOf(trace, step);
      for (const { node, isNew, position } of step.candidates) {
        if (isNew || node === null || neighbours.has(node)) continue;
        const share = distanceIn(region, position) / region.radius;
        // The trace has sizes and the ideal point in single precision, or less.
        expect(share, `step ${i}`).toBeLessThan(1.001);
        farthest = Math.max(farthest, share);
        count++;
      }
    }
    expect(count).toBeGreaterThan(50);
    expect(farthest).toBeGreaterThan(0.95);
  },
);

test("its outline is everywhere at the radius, and passes along all axes", async () => {
  const trace = await recordFront(stretchedCube(0.2));
  const step = trace.stepAt(1);
  if (step?.kind !== "advance") throw new Error("the first step is no advance");
  expect(step.tensor).not.toBeNull();
  const region = searchRegionOf(trace, step);
  const outline = outlineOf(region);
  expect(outline.length % 2).toBe(0);
  for (const position of outline) expect(distanceIn(region, position) / region.radius).toBeCloseTo(1, 9);
  // The stretching is 3; the circles need not pass through its ends.
  const along = outline.map((position) => Math.hypot(...position.map((x, i) => x - (region.centre[i] ?? 0))));
  expect(Math.max(...along) / Math.min(...along)).toBeGreaterThan(1.5);
});

test("its radius grows with the rule class as in the engine", async () => {
  const rules = readFileSync(new URL("../../../cpp/src/volume/rules.h", import.meta.url), "utf8");
  const radii = Array.from(rules.matchAll(/\.searchRadius = ([\d.]+)/g), ([, radius]) => Number(radius));
  expect(radii.length).toBeGreaterThan(1);
  const trace = await recordFront(cubeProject(0.5));
  const step = trace.stepAt(1);
  if (step?.kind !== "advance") throw new Error("the first step is no advance");
  const radiusAt = (ruleClass: number): number => searchRegionOf(trace, { ...step, ruleClass }).radius;
  for (const [ruleClass, radius] of radii.entries())
    expect(radiusAt(ruleClass) / radiusAt(0)).toBeCloseTo(radius / (radii[0] ?? 1), 12);
});
