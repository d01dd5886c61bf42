/** Recorded fronts with changed rules. */
import { createMesher, type Mesher } from "tetrafront";
import { type FrontExperiment, recordTrace } from "tetrafront/trace";
import { afterAll, beforeAll, expect, test } from "vitest";
import { galleryProject, tracedIn } from "../../support/recorded-models.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const project = galleryProject("unit-cube");
const record = (experiment?: FrontExperiment) =>
  recordTrace(mesher, project, { optimization: "none", experiment });

test("the usual rules change nothing", async () => {
  const usual = await record();
  const rules = { relaxation: true, tolerance: 1, search: "grid" } as const;
  const { result, trace } = await record(rules);
  expect(result.report.fingerprint).toBe(usual.result.report.fingerprint);
  expect(tracedIn(trace).header.experiment).toEqual(rules);
  expect(tracedIn(trace).summary()).toEqual(tracedIn(usual.trace).summary());
  expect(tracedIn(usual.trace).header.experiment).toBeUndefined();
});

test("a linear search gives the same mesh", async () => {
  const plain = await mesher.meshProject(project, { optimization: "none" });
  const { result, trace } = await record({ search: "linear" });
  expect(result.report.fingerprint).toBe(plain.report.fingerprint);
  expect(tracedIn(trace).header.experiment).toEqual({ search: "linear" });
});

test("without relaxation no face is completed under lenient rules", async () => {
  const wing = galleryProject("wing-in-a-tunnel");
  const usual = await mesher.meshProject(wing, { optimization: "none" });
  expect(usual.report.recovery.relaxed).toBeGreaterThan(0);
  const { result, trace: bytes } = await recordTrace(mesher, wing, {
    optimization: "none",
    experiment: { relaxation: false },
  });
  expect(result.report).toMatchObject({ status: "done", recovery: { relaxed: 0 } });
  const trace = tracedIn(bytes);
  for (let i = 1; i <= trace.stepCount; i++) {
    const step = trace.stepAt(i);
    if (step?.kind === "advance") expect(step.outcome === "accepted" && step.ruleClass > 0).toBe(false);
  }
});

test("without tolerance no new node is too close to a face", async () => {
  const usual = await record();
  expect(tracedIn(usual.trace).summary().refused["too-close"]).toBeGreaterThan(0);
  const { result, trace } = await record({ tolerance: 0 });
  expect(result.report.status).toBe("done");
  expect(tracedIn(trace).summary().refused["too-close"]).toBe(0);
});

test.each([{ tolerance: -1 }, { tolerance: 11 }, { tolerance: NaN }, { search: "octree" }, { speed: 1 }])(
  "%j is refused",
  async (experiment) => {
    await expect(record(experiment as FrontExperiment)).rejects.toThrow(/argument experiment/);
  },
);
