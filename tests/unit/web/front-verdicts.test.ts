/** The engine's verdicts on real models, against an independent check: the paper's test in doubles. */
import { readFileSync } from "node:fs";
import { createMesher, type Mesher } from "tetrafront";
import { type Project, readProject } from "tetrafront/project";
import type { AdvanceStep, Trace } from "tetrafront/trace";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  crossedFaces,
  crossesFace,
  frontFace,
  isBehind,
  newElement,
  nodesOf,
  sixVolumes,
  touching,
} from "../../../web/teach/player/judge";
import { testByLayers, tolerance } from "../../../web/teach/player/layered-test";
import { distanceToFace } from "../../../web/teach/player/unit-space";
import { crossedNear, FrontGrid, rounding, tooCloseNear } from "../../support/front-grid";
import { galleryProject, modelIds, recordFront } from "../../support/recorded-models";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** Numbers of candidates that were checked, by verdict, and of crossings that the paper's layers find without exact signs. */
interface Checked {
  readonly accepted: number;
  readonly behind: number;
  readonly crosses: number;
  readonly "too-close": number;
  readonly byLayers: number;
}

/** Checks every candidate of a trace. */
function check(trace: Trace): Checked {
  const counts = { accepted: 0, behind: 0, crosses: 0, "too-close": 0, byLayers: 0 };
  const grid = new FrontGrid(trace);
  for (let i = 1; i <= trace.stepCount; ++i) {
    const step = trace.stepAt(i);
    if (step?.kind !== "advance") continue;
    grid.advance(i - 1);
    for (const candidate of step.candidates) {
      ++counts[candidate.verdict];
      if (checkCandidate(trace, grid, step, candidate)) ++counts.byLayers;
    }
  }
  return counts;
}

/** Fails with a message. Of the many candidates, each `expect` would cost as much as what it checks. */
function demand(holds: boolean, message: string): void {
  if (!holds) expect.fail(message);
}

/** Returns whether the candidate crosses a face, and the paper's layers find it. */
function checkCandidate(
  trace: Trace,
  grid: FrontGrid,
  step: AdvanceStep,
  { node, isNew, position, verdict, culprit }: AdvanceStep["candidates"][number],
): boolean {
  const at = `step ${step.step}`;
  const element = newElement(trace, step.face, position, isNew ? null : node);
  if (verdict === "behind") demand(isBehind(element), `${at}: the apex is not behind the base face`);
  if (verdict === "accepted") {
    demand(sixVolumes(element.corners) > 0, `${at}: the apex is behind the base face`);
    const crossed = crossedNear(trace, grid, element);
    const close = isNew ? tooCloseNear(trace, grid, step, position) : [];
    if (crossed.length + close.length > 0)
      expect({ at, crossed, close }).toEqual({ at, crossed: [], close: [] });
    return false;
  }
  if (verdict === "too-close") {
    const { distance, least } = distanceToFace(trace, step, position, culprit ?? 0);
    demand(distance < least * (1 + rounding), `${at}: the face is ${distance} away, not below ${least}`);
    const close = tooCloseNear(trace, grid, step, position);
    demand(
      culprit !== null && close.includes(culprit),
      `${at}: face ${culprit} is not among ${close.join()}`,
    );
  }
  if (verdict !== "crosses") return false;
  const face = culprit ?? 0;
  demand(crossesFace(trace, element, face, touching), `${at}: face ${face} is not crossed`);
  // The paper's layers (a) and (b) rule out nothing that crosses; (c) leaves only common nodes to the exact signs.
  const { boxGap, minGap, shapeExcess, finds } = testByLayers(element, frontFace(trace, face));
  demand(boxGap <= minGap, `${at}: the boxes are ${boxGap} apart, more than ${minGap}`);
  demand(shapeExcess <= tolerance, `${at}: the shapes exceed by ${shapeExcess}`);
  const hasCommonNode = finds || nodesOf(trace, face).some((other) => element.nodes.includes(other));
  demand(hasCommonNode, `${at}: no layer finds face ${face}, and it has no common node`);
  return finds;
}

test("the grid finds the faces of the front, and those that an element crosses, as a search of all faces does", async () => {
  const trace = await recordFront(galleryProject("vault"), {}, mesher);
  const grid = new FrontGrid(trace);
  let found = 0;
  for (let i = 1; i <= trace.stepCount; i += 5) {
    grid.advance(i - 1);
    expect(grid.faces).toEqual([...trace.frontAt(i - 1)]);
    const step = trace.stepAt(i);
    if (step?.kind !== "advance") continue;
    for (const { node, isNew, position } of step.candidates) {
      const element = newElement(trace, step.face, position, isNew ? null : node);
      const crossed = crossedFaces(trace, i - 1, element);
      expect(crossedNear(trace, grid, element), `step ${i}`).toEqual(crossed);
      found += crossed.length;
    }
  }
  expect(found).toBeGreaterThan(20);
});

/** Returns a project with larger elements: a check of all candidates takes far longer than the run. */
function coarser(project: Project): Project {
  const larger = <Entry extends { readonly size: number }>(entries: readonly Entry[]) =>
    entries.map((entry) => ({ ...entry, size: 1.5 * entry.size }));
  const { nodes, sources, ...grid } = project.background;
  return {
    ...project,
    background: { ...grid, nodes: larger(nodes), ...(sources && { sources: larger(sources) }) },
  };
}

describe("every accepted candidate passes, and every refused one fails for the reason given:", () => {
  test.each(modelIds)("%s", async (id) => {
    const trace = await recordFront(coarser(galleryProject(id)), {}, mesher);
    const { refused, accepted } = trace.summary();
    const { byLayers, ...checked } = check(trace);
    expect(checked).toEqual({ accepted, ...refused });
    expect(byLayers).toBeGreaterThan(checked.crosses / 2);
  });

  test("the needles, among which are nodes in the plane of their face", async () => {
    const file = new URL("../../support/needles.json", import.meta.url);
    const project = readProject(readFileSync(file, "utf8"));
    if (!project.success) throw new Error(project.errors[0].message);
    const checked = check(await recordFront(project.value, {}, mesher));
    expect(checked.behind).toBeGreaterThan(0);
    expect(checked.crosses).toBeGreaterThan(0);
  });
});
