/** The front of a patch that stalls, as tests/cpp/surface_recorder_test.cpp has recorded it. */
import { readFileSync } from "node:fs";
import { readTrace, type SurfaceTrace } from "tetrafront/trace";
import { expect, test } from "vitest";
import { TraceBytes, traceBytes, writeFirstFaces } from "../../support/traces.js";

const recorded = readFileSync(new URL("../../fixtures/stalled-front.bin", import.meta.url));
/** Events of lines and patches have their kind in four bits. */
const LINE = 1;
const DIVIDED = 3;
const ENDED = 11;
const HAS_STALLED = 16;
/** The event `ended` and its hash. */
const END_BYTES = 9;

function read(patches: Uint8Array, version = 4) {
  // A surface has lines: one without nodes.
  const events = new TraceBytes().byte(LINE).varint(0).double(0).double(0).double(0);
  events.byte(DIVIDED).double(0).varint(0);
  for (const byte of patches) events.byte(byte);
  writeFirstFaces(events, []);
  return readTrace(traceBytes({ points: [], steps: 0, events: events.event(6), version }));
}

function surfaceOf(patches: Uint8Array, version?: number): SurfaceTrace {
  const trace = read(patches, version);
  if (!trace.success) throw new Error(trace.errors[0].message);
  if (trace.value.surface === null) throw new Error("the trace has no patches");
  return trace.value.surface;
}

test("edges that cannot be completed stay in a front that stalls", () => {
  const surface = surfaceOf(recorded);
  const [front] = surface.fronts;
  expect(front).toMatchObject({ end: "stalled", improved: null });
  const steps = Array.from({ length: surface.stepCount }, (_, i) => surface.stepAt(i + 1));
  const givenUp = steps.flatMap((step) =>
    step?.kind === "edge" && step.outcome === "postponed" && step.nextPass === null ? [step.edge] : [],
  );
  expect(givenUp.length).toBeGreaterThan(0);
  const last = front?.lastStep ?? 0;
  const left = [...(front?.edgesDied ?? [])].flatMap((died, edge) => (died > last ? [edge] : []));
  expect(left.length).toBeGreaterThan(0);
  expect(givenUp).toEqual(expect.arrayContaining(left));
});

test.each([2, 3])("files of version %i have the same patches", (version) => {
  expect(surfaceOf(recorded, version).fronts).toEqual(surfaceOf(recorded).fronts);
});

test("a front with edges is not one that has covered its patch", () => {
  const closed = Uint8Array.from(recorded);
  expect(closed.at(-END_BYTES)).toBe(ENDED + HAS_STALLED);
  closed[closed.length - END_BYTES] = ENDED;
  expect(read(closed)).toMatchObject({
    success: false,
    errors: [
      { message: expect.stringContaining("the front of patch 0 ends before it is closed") as unknown },
    ],
  });
});
