/** The engine's verdicts on real models, against an independent check: the paper's test in doubles. */
import { readFileSync } from "node:fs";
import { readProject, type AdvanceStep, type Trace } from "tetrafront";
import { describe, expect, test } from "vitest";
import {
  crossedFaces,
  crossesFace,
  frontFace,
  isBehind,
  newElement,
  nodesOf,
  touching,
} from "../../../web/player/judge";
import { testByLayers, tolerance } from "../../../web/player/layered-test";
import { distanceToFace } from "../../../web/player/unit-space";
import { galleryProject, modelIds, recordFront } from "../../support/recorded-models";

/** Numbers of candidates that were checked, by verdict, and of crossings that the paper's layers find without exact signs. */
interface Checked {
  readonly accepted: number;
  readonly behind: number;
  readonly crosses: number;
  readonly "too-close": number;
  readonly byLayers: number;
}

/** Relative error of distances in doubles. */
const rounding = 1e-9;

/** Checks every refused candidate, and the accepted ones of every `stride`-th step. */
function check(trace: Trace, stride = 1): Checked {
  const counts = { accepted: 0, behind: 0, crosses: 0, "too-close": 0, byLayers: 0 };
  for (let i = 1; i <= trace.stepCount; ++i) {
    const step = trace.stepAt(i);
    if (step?.kind !== "advance") continue;
    for (const candidate of step.candidates) {
      if (candidate.verdict === "accepted" && i % stride !== 1 % stride) continue;
      ++counts[candidate.verdict];
      if (checkCandidate(trace, step, candidate)) ++counts.byLayers;
    }
  }
  return counts;
}

/** Returns whether the candidate crosses a face, and the paper's layers find it. */
function checkCandidate(
  trace: Trace,
  step: AdvanceStep,
  { node, isNew, position, verdict, culprit }: AdvanceStep["candidates"][number],
): boolean {
  const at = `step ${step.step}`;
  const element = newElement(trace, step.face, position, isNew ? null : node);
  if (verdict === "behind") expect(isBehind(element), at).toBe(true);
  if (verdict === "accepted") expect(crossedFaces(trace, step.step - 1, element), at).toEqual([]);
  if (verdict === "too-close") {
    const { distance, least } = distanceToFace(trace, step, position, culprit ?? 0);
    expect(distance, at).toBeLessThan(least * (1 + rounding));
  }
  if (verdict !== "crosses") return false;
  expect(crossesFace(trace, element, culprit ?? 0, touching), at).toBe(true);
  // The paper's layers (a) and (b) rule out nothing that crosses; (c) leaves only common nodes to the exact signs.
  const { boxGap, minGap, shapeExcess, finds } = testByLayers(element, frontFace(trace, culprit ?? 0));
  expect(boxGap, at).toBeLessThanOrEqual(minGap);
  expect(shapeExcess, at).toBeLessThanOrEqual(tolerance);
  if (!finds) expect(nodesOf(trace, culprit ?? 0).some((other) => element.nodes.includes(other))).toBe(true);
  return finds;
}

/** Approximate number of steps per model whose accepted candidate is checked. A check takes O(n) for n faces of the front. */
const stepsPerModel = 800;

describe("accepted candidates cross nothing, and refused ones fail for the reason given:", () => {
  test("every one of the unit cube", async () => {
    const trace = await recordFront(galleryProject("unit-cube"));
    const { refused } = trace.summary();
    const { byLayers, ...checked } = check(trace);
    expect(checked).toEqual({ accepted: trace.summary().accepted, ...refused });
    expect(byLayers).toBeGreaterThan(checked.crosses / 2);
  });

  test.each(modelIds.filter((id) => id !== "unit-cube"))("those of %s", async (id) => {
    const trace = await recordFront(galleryProject(id));
    const { accepted, crosses } = check(trace, Math.max(1, Math.floor(trace.stepCount / stepsPerModel)));
    expect(accepted).toBeGreaterThan(0.8 * stepsPerModel);
    expect(crosses).toBeGreaterThan(0);
  });

  test("those of the needles, among which are nodes in the plane of their face", async () => {
    const file = new URL("../../../public/lessons/needles.json", import.meta.url);
    const project = readProject(readFileSync(file, "utf8"));
    if (!project.success) throw new Error(project.errors[0].message);
    const checked = check(await recordFront(project.value), 3);
    expect(checked.behind).toBeGreaterThan(0);
    expect(checked.crosses).toBeGreaterThan(0);
  });
});
