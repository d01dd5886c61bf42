/** Recorded runs: the mesh stays the same, and the trace replays to it. */
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { createMesher } from "tetrafront";
import { recordTrace } from "tetrafront/trace";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { tetrafront } from "../../support/command-line.js";
import { galleryProject as gallery, tracedIn as read } from "../../support/recorded-models.js";
import { boxSurface, needleGearSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const models = new URL("../../../public/models/", import.meta.url);
const textOf = (id: string): string => readFileSync(new URL(`${id}.json`, models), "utf8");

let mesher: Awaited<ReturnType<typeof createMesher>>;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** As recorded runs: by the front alone. */
const unoptimized = { optimization: "none", interior: "front" } as const;

/** Bytes that a step may take on average. */
const maxBytesPerStep = 60;

describe("a trace replays to the mesh of an unrecorded run:", () => {
  test.each([
    ["one region", "unit-cube"],
    ["a stretched field", "wing-in-a-tunnel"],
    ["regions in one front", "core-in-a-shell"],
    ["regions with an interface, one front after the other", "pipe-and-flow"],
  ])("%s (%s)", async (_, id) => {
    const project = gallery(id);
    const plain = await mesher.meshProject(project, unoptimized);
    const { result, trace: bytes } = await recordTrace(mesher, project, unoptimized);
    const trace = read(bytes);
    expect(result.report.fingerprint).toBe(plain.report.fingerprint);
    expect(trace.header).toMatchObject({ name: project.name, status: "done" });
    expect(trace.header.fingerprint).toBe(plain.report.fingerprint);
    const replayed = trace.finalMesh();
    expect(replayed.fingerprint).toBe(plain.report.fingerprint);
    expect(replayed.points).toEqual(plain.mesh.points);
    expect(replayed.tetrahedra).toEqual(plain.mesh.tetrahedra);
    expect(replayed.tetrahedronRegion).toEqual(plain.mesh.tetrahedronRegion);
    const { accepted, postponed, changes, steps } = trace.summary();
    expect(accepted + postponed + Object.values(changes).reduce((sum, count) => sum + count, 0)).toBe(steps);
    expect(accepted + postponed).toBe(plain.report.front.pops);
    const allSteps = steps + (trace.surface?.stepCount ?? 0);
    expect((bytes?.length ?? 0) / allSteps).toBeLessThan(maxBytesPerStep);
    expect(trace.frontAt(trace.stepCount)).toHaveLength(0);
  });

  test("recovery: needles, among which the front stalls", async () => {
    const surface = needleGearSurface(8);
    const plain = await mesher.fillSurface(surface, unoptimized);
    const { trace: bytes } = await recordTrace(mesher, surface, unoptimized);
    const trace = read(bytes);
    const { changes } = trace.summary();
    expect(changes["exact-fill"] + changes.star + changes.reopened).toBeGreaterThan(0);
    expect(trace.finalMesh().fingerprint).toBe(plain.report.fingerprint);
  });
});

// If the machine is so loaded that the worker misses its limit of 0.5 s, the trace is lost, as documented. Then retry.
test("a cancelled run has a trace up to there", { retry: 3 }, async () => {
  const stop = new AbortController();
  let recorded = 0;
  const onTrace = (events: Uint8Array): void => {
    recorded += events.length;
    // The first events may be those before the first step.
    if (recorded > 20 * maxBytesPerStep) stop.abort();
  };
  const { result, trace } = await recordTrace(mesher, boxSurface(30), unoptimized, {
    signal: stop.signal,
    onTrace,
  });
  expect(result.report.status).toBe("cancelled");
  const { header, stepCount } = read(trace);
  expect(header).toMatchObject({ status: "cancelled", fingerprint: "0".repeat(16) });
  expect(stepCount).toBeGreaterThan(0);
});

test("a run without a front has no trace", async () => {
  const open = boxSurface(2);
  const surface = { ...open, triangles: open.triangles.slice(3) };
  const { result, trace } = await recordTrace(mesher, surface);
  expect(result.report.status).toBe("invalid-input");
  expect(trace).toBeUndefined();
});

test("a run rejects with the error that onTrace throws", async () => {
  const failure = new Error("no more room");
  const onTrace = (): void => {
    throw failure;
  };
  await expect(mesher.fillSurface(boxSurface(2), {}, { onTrace })).rejects.toBe(failure);
});

describe("tetrafront trace", () => {
  const folder = temporaryFolder();
  const run = (...args: string[]) => tetrafront(folder.path, args);
  const inFolder = (name: string): string => path.join(folder.path, name);

  test("writes a trace whose fingerprint is that of the mesh without optimization, and describes it", async () => {
    writeFileSync(inFolder("cube.json"), textOf("unit-cube"));
    const recorded = await run("trace", "cube.json", "-o", "cube.tft");
    expect(recorded).toMatchObject({ code: 0 });
    expect(recorded.stderr).toMatch(/cube\.json: done, \d+ steps, .* -> cube\.tft/);
    const described = await run("trace", "cube.tft", "--summary");
    const summary: unknown = JSON.parse(described.stdout);
    const trace = read(readFileSync(inFolder("cube.tft")));
    expect(summary).toEqual(trace.summary());
    const plain = await mesher.meshProject(gallery("unit-cube"), unoptimized);
    expect(summary).toMatchObject({
      fingerprint: plain.report.fingerprint,
      accepted: plain.report.tetrahedra,
    });
  });

  test("changes the rules of the front as an experiment does, and keeps the changes in the trace", async () => {
    writeFileSync(inFolder("cube.json"), textOf("unit-cube"));
    const changes = [
      "--no-relaxation",
      "--front-tolerance",
      "0.5",
      "--search",
      "linear",
      "--order",
      "random",
    ];
    expect(await run("trace", "cube.json", "-o", "changed.tft", ...changes)).toMatchObject({ code: 0 });
    const { header } = read(readFileSync(inFolder("changed.tft")));
    const experiment = { relaxation: false, tolerance: 0.5, search: "linear" } as const;
    expect(header).toMatchObject({ order: "random", experiment });
    const { trace } = await recordTrace(mesher, gallery("unit-cube"), {
      ...unoptimized,
      order: "random",
      experiment,
    });
    expect(header.fingerprint).toBe(read(trace).header.fingerprint);
    await run("trace", "cube.json", "-o", "plain.tft");
    expect(read(readFileSync(inFolder("plain.tft"))).header.experiment).toBeUndefined();
  });

  test.each([
    [["trace", "cube.json", "-o", "a.tft", "--front-tolerance", "11"], /from 0 to 10/],
    [["trace", "cube.json", "-o", "a.tft", "--front-tolerance", "wide"], /from 0 to 10/],
    [["trace", "cube.json", "-o", "a.tft", "--search", "guess"], /Allowed choices are grid, linear/],
    [["trace", "cube.json"], /There is no output file for the trace/],
    [["trace", "cube.tft"], /Add --summary/],
    [["trace", "cube.tft", "--summary", "-o", "other.tft"], /Omit --output/],
    [["trace", "cube.json", "-o", "cube.json"], /cube\.json/],
    [["trace", "broken.tft", "--summary"], /broken\.tft/],
    [["trace", "missing.tft", "--summary"], /missing\.tft/],
  ])("refuses %s", async (args, message) => {
    writeFileSync(inFolder("cube.json"), textOf("unit-cube"));
    writeFileSync(inFolder("broken.tft"), "TFTRACE");
    const { code, stderr } = await run(...args);
    expect(stderr).toMatch(message);
    expect(code).toBe(2);
  });
});
