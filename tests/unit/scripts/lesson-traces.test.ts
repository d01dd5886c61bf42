/** The traces that the site ships for its lessons: recorded by the engine of this build, small, and with what the lessons show. */
import { readTrace, type Trace } from "tetrafront/trace";
import { beforeAll, expect, test } from "vitest";
import {
  MAX_TRACE_BYTES,
  lessonTraceNames,
  recordLessonTraces,
} from "../../../scripts/lib/lesson-traces.mjs";
import { lessonTraces } from "../../../scripts/lib/site-traces.mjs";

let files: Record<string, Uint8Array>;

beforeAll(async () => {
  files = await recordLessonTraces();
});

function traceOf(name: string): Trace {
  const read = readTrace(files[name] ?? new Uint8Array());
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

test("all are recorded, small, closed and the same in every build", async () => {
  const again = await recordLessonTraces();
  expect(Object.keys(files)).toEqual(lessonTraceNames);
  for (const name of lessonTraceNames) {
    expect(files[name]?.length).toBeLessThanOrEqual(MAX_TRACE_BYTES);
    expect(again[name]).toEqual(files[name]);
    const { header, finalMesh } = { header: traceOf(name).header, finalMesh: traceOf(name).finalMesh() };
    expect(header).toMatchObject({ name, status: "done" });
    expect(finalMesh.fingerprint).toBe(header.fingerprint);
  }
});

test("the site gets these files", async () => {
  const emitted: Record<string, Uint8Array> = {};
  const emitFile = ({ fileName, source }: { fileName: string; source: Uint8Array }) => {
    emitted[fileName] = source;
  };
  await lessonTraces().generateBundle.call({ emitFile });
  expect(emitted).toEqual({
    "traces/ball.tft": files["ball"],
    "traces/cube.tft": files["cube"],
    "traces/box.tft": files["box"],
    "traces/pocket.tft": files["pocket"],
  });
});

test("the ball has a thousand steps with few refusals, and the box the sweeps of the optimizer", () => {
  const ball = traceOf("ball").summary();
  expect(ball.steps).toBeGreaterThan(1000);
  expect(ball.refused.crosses).toBeGreaterThan(10);
  const { optimization } = traceOf("box");
  expect(optimization?.hasMeshes).toBe(true);
  expect(optimization?.summary.sweeps.length).toBeGreaterThan(5);
});

test("no order of faces closes the pocket, and one node does", () => {
  const trace = traceOf("pocket");
  const { accepted, postponed, changes, steps } = trace.summary();
  expect(accepted).toBe(0);
  expect(postponed).toBe(steps - 1);
  expect(changes.star).toBe(1);
  const last = trace.stepAt(steps);
  expect(last?.addedNodes).toHaveLength(1);
  expect(last?.addedElements).toHaveLength(8);
});
