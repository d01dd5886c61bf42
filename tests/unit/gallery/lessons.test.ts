/**
 * The lessons against the real fronts of their models: each begins in a state that completes no task, every task can be
 * completed, and the numbers that a lesson states are those of the front.
 */
import { readFileSync } from "node:fs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { createMesher, type FrontOrder, type Mesher, type MeshReport } from "tetrafront";
import { readProject } from "tetrafront/project";
import { readTrace, recordTrace, type Trace } from "tetrafront/trace";
import { isShown } from "../../../web/teach/lessons/check-task";
import { parseLesson, type Lesson } from "../../../web/teach/lessons/lesson";
import { listOf } from "../../../web/teach/lessons/lesson-files";
import { runMeasures } from "../../../web/teach/lessons/run-measures";
import { searchCost } from "../../../web/teach/lessons/search-cost";
import { faceSize } from "../../../web/teach/player/front-values";
import { firstState } from "../../../web/teach/player/phases";
import { stopKindsOf } from "../../../web/teach/player/stops";
import { galleryProject, tracedIn } from "../../support/recorded-models";

const inPublic = (file: string): string =>
  readFileSync(new URL(`../../../public/${file}`, import.meta.url), "utf8");

const lessons = listOf(inPublic("lessons/index.json")).map((file): Lesson => {
  const parsed = parseLesson(file, inPublic(`lessons/${file}`));
  if (!parsed.success) throw new Error(parsed.errors.join("\n"));
  return parsed.lesson;
});

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

interface Run {
  readonly trace: Trace;
  readonly report: MeshReport;
}

/** Records as the app does: without optimization, in the order of the lesson or of a comparison. */
async function run({ model, order }: Lesson, other: FrontOrder = order): Promise<Run> {
  const file = model.endsWith(".json") ? `lessons/${model}` : `models/${model}.json`;
  const read = readProject(inPublic(file));
  if (!read.success) throw new Error(read.errors[0].message);
  const { result, trace: bytes } = await recordTrace(mesher, read.value, {
    order: other,
    optimization: "none",
  });
  const trace = bytes && readTrace(bytes);
  if (!trace?.success) throw new Error(`${model} has no trace`);
  return { trace: trace.value, report: result.report };
}

const lessonNamed = (id: string): Lesson => {
  const found = lessons.find((lesson) => lesson.id === id);
  if (!found) throw new Error(`there is no lesson ${id}`);
  return found;
};

describe.each(lessons)("the lesson $title", (lesson) => {
  it("begins in a state of its front that completes no task, and has the steps that it asks for", async () => {
    const { trace, report } = await run(lesson);
    expect(report.status).toBe("done");
    expect(lesson.step).toBeLessThan(trace.stepCount);
    expect(lesson.step).toBeGreaterThanOrEqual(firstState(trace));
    for (const task of lesson.tasks) {
      const { step, coloring } = lesson;
      expect(isShown(task, { trace, step, coloring }), task.ask).toBe(false);
      if (task.kind === "step" && task.reach !== "end") expect(stopKindsOf(trace)).toContain(task.reach);
      if (task.kind === "compare") expect(task.order).not.toBe(lesson.order);
    }
  });
});

/** Returns the first step whose base face is a triangle of the given surface on the walls of the box from -1 to 1. */
function firstOnWall(trace: Trace): number | undefined {
  const { faces, nodes, steps } = trace;
  const isOnWall = (face: number): boolean =>
    [...faces.nodes.subarray(3 * face, 3 * face + 3)].every(
      (node) => Math.max(...nodes.positions.subarray(3 * node, 3 * node + 3).map(Math.abs)) === 1,
    );
  for (let state = 1; state <= trace.stepCount; state++) {
    const step = trace.stepAt(state);
    if (step?.kind !== "advance" || step.face >= (steps.frontSizes[0] ?? 0)) continue;
    if (isOnWall(step.face)) return state;
  }
  return undefined;
}

/** The numbers that lessons state, measured. */
describe("the numbers of the lessons", () => {
  const answers = (id: string): readonly number[] =>
    lessonNamed(id).tasks.flatMap((task) => (task.kind === "number" ? [task.answer] : []));

  it("of the unit cube", async () => {
    const { trace, report } = await run(lessonNamed("front"));
    const sizes = trace.steps.frontSizes;
    expect(answers("front")).toEqual([sizes[0]]);
    expect([report.tetrahedra, trace.stepCount, Math.max(...sizes)]).toEqual([1736, 1743, 662]);
    expect(sizes.indexOf(662)).toBe(432);
    expect(sizes[1]).toBe(494);

    const madeNode = new Set<number>();
    let firstTry = 0;
    for (let state = 1; state <= trace.stepCount; state++) {
      const step = trace.stepAt(state);
      if (step?.kind !== "advance") continue;
      if (step.addedNodes.length > 0) madeNode.add(state);
      firstTry += Number(step.candidates.length === 1);
    }
    expect([madeNode.size, firstTry]).toEqual([188, 1691]);
    expect(madeNode).toContain(100);

    const many = trace.stepAt(1223);
    expect(many?.kind === "advance" && [many.rankedCandidates, many.candidates.length]).toEqual([4, 3]);
    expect(answers("candidates")).toEqual([4]);
    const crossing = trace.stepAt(258);
    expect(crossing?.kind === "advance" && crossing.candidates[0]?.verdict).toBe("crosses");
  });

  it("of the plate with its sides", async () => {
    const { trace } = await run(lessonNamed("sides"));
    /** Lengths of the sides of the line along an axis through a corner of the plate. */
    const sidesAlong = (axis: 0 | 1): number[] => {
      const corner = [-1, -0.6, 0];
      const { positions } = trace.nodes;
      const on = Array.from({ length: trace.header.nodes }, (_, node) => [
        ...positions.subarray(3 * node, 3 * node + 3),
      ])
        .filter((position) => position.every((x, k) => k === axis || x === corner[k]))
        .map((position) => position[axis] ?? 0)
        .sort((a, b) => a - b);
      return on.slice(1).map((x, i) => x - (on[i] ?? 0));
    };
    expect(sidesAlong(1)).toHaveLength(answers("sides")[0] ?? 0);
    const long = sidesAlong(0);
    expect(long).toHaveLength(20);
    expect(long[0]).toBeCloseTo(0.1315, 4);
    expect(Math.min(...long)).toBeCloseTo(0.0735, 4);
    // Steps S1 to S3 from x = 0.5, in the size field of the plate.
    const sizeAt = (x: number): number => 0.07 + (0.07 * x) / 1.1;
    const first = sizeAt(0.5);
    expect((first + sizeAt(0.5 - first / 2)) / 2).toBeCloseTo(answers("sides")[1] ?? 0, 4);
  });

  it("of the patches, the search, the orders and the stall", async () => {
    const duct = await run(lessonNamed("plane"));
    expect(duct.report.patches.map(({ triangles }) => triangles)).toEqual([170, 221, 221, 221, 221, 108]);
    expect(answers("plane")[1]).toBe(duct.trace.steps.frontSizes[0]);

    const intake = await run(lessonNamed("search"));
    const cost = searchCost(intake.trace);
    expect([cost.linear.at(-1), cost.near.at(-1)]).toEqual([74_948_838, 701_836]);
    expect(Math.round((cost.linear.at(-1) ?? 0) / (cost.near.at(-1) ?? 1))).toBe(answers("search")[0]);
    expect(intake.report.front).toMatchObject({ facesTested: 722_660, facesAnalysed: 31_653 });

    const order = lessonNamed("order");
    const measured = async (other: FrontOrder) => {
      const { crossings, smallCrossings, postponed, flat } = runMeasures((await run(order, other)).trace);
      return [crossings, smallCrossings, postponed, flat];
    };
    expect(await measured("smallest-first")).toEqual([1430, 20, 204, 60]);
    expect(await measured("first-in")).toEqual([1812, 110, 281, 82]);
    expect((await measured("layered")).filter((_, i) => i !== 1)).toEqual([326, 31, 40]);

    const strict = await run(order);
    expect([firstOnWall(strict.trace), strict.trace.stepCount]).toEqual([4255, 6918]);
    // The large face that small ones stop, which the first task leads to.
    const { trace: firstIn } = await run(order, "first-in");
    const large = firstIn.stepAt(5142);
    expect(large?.kind === "advance" && [large.face, large.outcome]).toEqual([9781, "postponed"]);
    expect(large?.kind === "advance" && large.candidates.map(({ culprit }) => culprit)).toEqual(
      [1, 2, 3].map(() => 10938),
    );
    expect(faceSize(firstIn, 9781)).toBeCloseTo(0.3, 1);
    expect(faceSize(firstIn, 10938) / faceSize(firstIn, 9781)).toBeLessThan(0.5);
    const crossings = async (other: FrontOrder) =>
      runMeasures((await run(lessonNamed("search"), other)).trace).crossings;
    expect([await crossings("first-in"), await crossings("smallest-first")]).toEqual([1955, 3908]);
    expect(runMeasures(intake.trace).crossings).toBe(2270);

    const wing = await run(lessonNamed("stretching"));
    for (let state = 1; state <= wing.trace.stepCount; state++) {
      const step = wing.trace.stepAt(state);
      if (step?.kind === "advance") expect(step.targetEdge).toBe(1);
    }

    const { trace } = await run(lessonNamed("stall"));
    const changes = Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).flatMap((step) =>
      step?.kind === "recovery" ? [[step.step, step.change] as const] : [],
    );
    expect(changes.slice(0, 3)).toEqual([
      [1553, "star"],
      [1554, "star"],
      [1555, "reopened"],
    ]);
    expect(changes.at(-1)).toEqual([4889, "exact-fill"]);
    expect(trace.steps.frontSizes[1554]).toBe(answers("stall")[0]);
    expect(trace.steps.frontSizes[4888]).toBe(42);
    expect(trace.summary().postponed).toBe(3354);
  });
});

it("the experiment of the lesson on candidates has the figures of its text", async () => {
  const { text } = lessonNamed("candidates");
  const project = galleryProject("unit-cube");
  const [usual, changed] = await Promise.all(
    [1, 2].map(async (tolerance) => {
      const { result, trace } = await recordTrace(mesher, project, {
        optimization: "none",
        experiment: { tolerance },
      });
      return [tracedIn(trace).summary().postponed, result.report.radiusRatio.mean.toFixed(3)];
    }),
  );
  expect(text.replaceAll("\n", " ")).toContain(
    `${changed?.[0]} faces are postponed instead of ${usual?.[0]}`,
  );
  expect(text).toContain(`falls from ${usual?.[1]} to ${changed?.[1]}`);
});
