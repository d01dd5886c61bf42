/** The numbers of the ideal point and of distances under the lens, against what the engine has recorded. */
import type { AdvanceStep, Trace } from "tetrafront/trace";
import { describe, expect, it } from "vitest";
import { cornersOf } from "../../../web/teach/player/judge";
import { distanceToFace, idealNumbers, unitAxes } from "../../../web/teach/player/unit-space";
import { cubeProject, stretchedCube } from "../../support/projects";
import { recordFront } from "../../support/recorded-models";

type Vector = readonly [number, number, number];

const stepsOf = (trace: Trace): AdvanceStep[] =>
  Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).filter(
    (step): step is AdvanceStep => step?.kind === "advance",
  );

/** Returns H⁻¹ v by Gaussian elimination. */
function unitOf(step: AdvanceStep, v: Vector): Vector {
  const axes = unitAxes(step);
  const rows = [0, 1, 2].map((row) => [...axes.map((axis) => axis[row] ?? 0), v[row] ?? 0]);
  for (let pivot = 0; pivot < 3; pivot++)
    for (let row = 0; row < 3; row++) {
      if (row === pivot) continue;
      const factor = (rows[row]?.[pivot] ?? 0) / (rows[pivot]?.[pivot] ?? 1);
      rows[row] = (rows[row] ?? []).map((term, column) => term - factor * (rows[pivot]?.[column] ?? 0));
    }
  const [x = 0, y = 0, z = 0] = rows.map((row, i) => (row[3] ?? 0) / (row[i] ?? 1));
  return [x, y, z];
}

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const length = (v: Vector): number => Math.hypot(...v);

describe.each([
  ["without stretching", cubeProject(0.13)],
  ["with stretching", stretchedCube(0.2)],
])("%s", (_, project) => {
  it("the height is that of the recorded ideal point above the centroid", async () => {
    const trace = await recordFront(project);
    for (const step of stepsOf(trace)) {
      const [a, b, c] = cornersOf(trace, step.face);
      const centroid: Vector = [(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3];
      const { height, size, radius } = idealNumbers(trace, step);
      const measured = length(unitOf(step, minus(step.idealPoint, centroid)));
      expect(Math.abs(measured / height - 1), `step ${step.step}`).toBeLessThan(1e-5);
      // Every corner is as far from the centre of the circle: the height of the circumcentre is found by the law of sines.
      const [ab, bc, ca] = [minus(b, a), minus(c, b), minus(a, c)].map((edge) => length(unitOf(step, edge)));
      const cosine = ((ab ?? 0) ** 2 + (ca ?? 0) ** 2 - (bc ?? 0) ** 2) / (2 * (ab ?? 1) * (ca ?? 1));
      expect(radius).toBeCloseTo((bc ?? 0) / (2 * Math.sqrt(1 - cosine ** 2)), 9);
      expect(size).toBeGreaterThan(0);
    }
  });

  it("new nodes that were refused as too close are nearer than the limit", async () => {
    const trace = await recordFront(project);
    const refused = stepsOf(trace).flatMap((step) =>
      step.candidates
        .filter(({ verdict }) => verdict === "too-close")
        .map(({ position, culprit }) => distanceToFace(trace, step, position, culprit ?? -1)),
    );
    expect(refused.length).toBeGreaterThan(0);
    for (const { distance, least } of refused) expect(distance).toBeLessThan(least);
  });
});
