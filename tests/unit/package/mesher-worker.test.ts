/** The client of the worker, tested against a mock worker that misbehaves. */
import { createMesher, type Mesher, type MesherError } from "tetrafront";
import { beforeEach, describe, expect, test, vi } from "vitest";

import type { EngineResult, Reply, Request } from "../../../wasm/src/engine/protocol.js";
import { NO_QUALITY } from "../../../wasm/src/engine/quality-report.js";
import type { WorkerEvents } from "../../../wasm/src/engine/worker-host.js";
import { projectArrays } from "../../../wasm/src/project/arrays.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface } from "../../support/surfaces.js";

/** A mock worker as the client sees it, with functions for the test to control it. */
interface MockWorker {
  /** Requests other than `load`. */
  readonly requests: Exclude<Request, { kind: "load" }>[];
  /** The requests `load`, without a module if the worker is to compile it. */
  readonly loads: Omit<Extract<Request, { kind: "load" }>, "kind">[];
  readonly reply: (reply: Reply) => void;
  readonly crash: (message: string) => void;
  terminated: boolean;
}

/** The smallest valid module: a header. */
const module = new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0));
const READY = { kind: "ready", name: "engine", module } as const;
const workers: MockWorker[] = [];
/** Error thrown instead of starting a worker. */
let refusal: Error | undefined;

vi.mock("../../../wasm/dist/engine/worker-host-node.js", () => ({
  loadRemedies: { worker: "Serve worker.js.", engine: "Serve engine.wasm." },
  startWorker: (events: WorkerEvents) => {
    if (refusal !== undefined) throw refusal;
    const worker: MockWorker = {
      requests: [],
      loads: [],
      reply: (reply) => events.onReply(reply),
      crash: (message) => events.onCrash(message),
      terminated: false,
    };
    workers.push(worker);
    return {
      post: (request: Request) =>
        request.kind === "load"
          ? worker.loads.push({ name: request.name, module: request.module })
          : worker.requests.push(request),
      keepAlive: () => undefined,
      terminate: () => (worker.terminated = true),
    };
  },
}));

function workerNumber(index: number): MockWorker {
  const worker = workers[index];
  if (worker === undefined) throw new Error(`there is no worker ${index}`);
  return worker;
}

async function readyMesher(): Promise<Mesher> {
  const starting = createMesher();
  workerNumber(0).reply(READY);
  return starting;
}

const codeOf = (failure: unknown) => (failure as MesherError).code;

/** Returns the id of the request with this index. */
const idOf = (worker: MockWorker, index = 0) => worker.requests[index]?.id ?? NaN;

const none = new Uint32Array();
const noPoints = new Float64Array();
const noBytes = new Uint8Array();
const noDiagnostics = {
  code: new Uint16Array(),
  severity: noBytes,
  entities: { lengths: none, items: { kind: noBytes, index: none } },
  hasPosition: noBytes,
  position: noPoints,
  values: { lengths: none, items: noPoints },
};

function resultWith(fingerprint: string): EngineResult {
  return {
    status: "done",
    hasFoundNothingBetter: false,
    regionStatistics: [],
    surface: {
      points: noPoints,
      triangles: none,
      trianglePatch: none,
      triangleRegions: none,
      sides: none,
      sideLine: none,
    },
    volume: { points: noPoints, tetrahedra: none, regions: none, front: none },
    diagnostics: noDiagnostics,
    statistics: {
      nodes: 0,
      tetrahedra: 0,
      triangles: 0,
      quality: NO_QUALITY,
      patches: [],
      seconds: { total: 0, check: 0, sides: 0, surface: 0, volume: 0, optimize: 0 },
      dihedral: { min: 0, max: 0 },
      radiusRatio: { min: 0, mean: 0 },
      volume: 0,
      recovery: { relaxed: 0, starred: 0, remeshed: 0, filled: 0, steinerPoints: 0 },
      interior: { lattice: 0 },
      threads: 1,
      front: {
        pops: 0,
        gatheredFaces: 0,
        candidatesTried: 0,
        facesTested: 0,
        facesAnalysed: 0,
        exactPredicates: 0,
      },
      fingerprint,
    },
  };
}

beforeEach(() => {
  workers.splice(0);
  refusal = undefined;
});

describe("createMesher", () => {
  test("waits until the engine is loaded", async () => {
    let isReady = false;
    const starting = createMesher().then(() => (isReady = true));
    await Promise.resolve();
    expect(isReady).toBe(false);
    workerNumber(0).reply(READY);
    expect(await starting).toBe(true);
  });

  test("rejects if the engine cannot be loaded or the worker crashes", async () => {
    const unusable = createMesher();
    workerNumber(0).reply({ kind: "unusable", name: "engine", message: "no WebAssembly" });
    await expect(unusable).rejects.toThrow(/cannot be loaded.*no WebAssembly/);
    await expect(unusable).rejects.toMatchObject({ name: "MesherError", code: "engine-not-loaded" });
    const dead = createMesher();
    workerNumber(1).crash("out of threads");
    await expect(dead).rejects.toMatchObject({ name: "MesherError", code: "engine-not-loaded" });
    expect(workers.map(({ terminated }) => terminated)).toEqual([true, true]);
  });
});

test("createMesher reports a browser that refuses to start a worker like any other load error", async () => {
  refusal = new TypeError("This document requires 'TrustedScriptURL' assignment");
  await expect(createMesher()).rejects.toMatchObject({
    name: "MesherError",
    code: "engine-not-loaded",
    message: expect.stringMatching(/TrustedScriptURL.*Serve/) as string,
  });
});

describe("runs", () => {
  test("are sent one at a time, in order", async () => {
    const mesher = await readyMesher();
    const worker = workerNumber(0);
    const runs = [mesher.fillSurface(boxSurface(1)), mesher.meshProject(cubeProject())];
    expect(worker.requests.map(({ kind }) => kind)).toEqual(["fill-surface"]);
    worker.reply({ kind: "result", id: idOf(worker), result: resultWith("first") });
    expect((await runs[0])?.report.fingerprint).toBe("first");
    expect(worker.requests.map(({ kind }) => kind)).toEqual(["fill-surface", "mesh-model"]);
    worker.reply({ kind: "result", id: idOf(worker, 1), result: resultWith("second") });
    expect((await runs[1])?.report.fingerprint).toBe("second");
  });

  test("take the numbers and volumes of their regions from the worker's reply", async () => {
    const mesher = await readyMesher();
    const worker = workerNumber(0);
    const run = mesher.fillSurface(boxSurface(1));
    const regions = new Uint32Array([0, 1, 1]);
    const volume = { points: new Float64Array(12), tetrahedra: new Uint32Array(12), regions, front: none };
    const regionStatistics = [
      { tetrahedra: 1, volume: 0.5 },
      { tetrahedra: 2, volume: 0.25 },
    ];
    const result = { ...resultWith(""), status: "cancelled", volume, regionStatistics } as const;
    worker.reply({ kind: "result", id: idOf(worker), result });
    expect((await run).report.regions).toMatchObject(regionStatistics);
  });

  test("ignore replies with other ids", async () => {
    const mesher = await readyMesher();
    const worker = workerNumber(0);
    const progress = vi.fn();
    const run = mesher.fillSurface(boxSurface(1), {}, { onProgress: progress });
    const id = idOf(worker);
    const otherFields = {
      phase: "volume",
      fraction: 0,
      nodes: 0,
      triangles: 0,
      tetrahedra: 0,
      frontFaces: 0,
      expectedTetrahedra: 0,
      exactFillFraction: 0,
    } as const;
    worker.reply({ kind: "progress", id: id - 1, progress: { ...otherFields, elapsedSeconds: 0 } });
    worker.reply({ kind: "result", id: id - 1, result: resultWith("late") });
    worker.reply({ kind: "result", id, result: resultWith("own") });
    worker.reply({ kind: "result", id, result: resultWith("again") });
    expect((await run).report.fingerprint).toBe("own");
    expect(progress).not.toHaveBeenCalled();
  });
});

describe("a worker", () => {
  test.each<[string, (worker: MockWorker) => void, string]>([
    ["crashes", (worker) => worker.crash("unreachable executed"), "engine-failed"],
    [
      "runs out of memory",
      (worker) =>
        worker.reply({
          kind: "failure",
          id: idOf(worker),
          reason: "out-of-memory",
          message: "out of memory",
          isEngineLost: false,
          bytes: 2 ** 32,
        }),
      "out-of-memory",
    ],
    [
      "reports a failure",
      (worker) =>
        worker.reply({
          kind: "failure",
          id: idOf(worker),
          reason: "engine-failed",
          message: "trap",
          isEngineLost: true,
          bytes: 0,
        }),
      "engine-failed",
    ],
  ])("that %s is replaced, and queued calls continue", async (_, fail, code) => {
    const mesher = await readyMesher();
    const first = mesher.fillSurface(boxSurface(1));
    const second = mesher.fillSurface(boxSurface(2));
    const preview = mesher.previewProject(cubeProject());
    fail(workerNumber(0));
    await expect(first).rejects.toMatchObject({ name: "MesherError", code });
    await expect(preview).rejects.toMatchObject({ code });
    expect(workerNumber(0).terminated).toBe(true);
    const fresh = workerNumber(1);
    fresh.reply(READY);
    // The client ignores late messages of the old worker.
    workerNumber(0).crash("again");
    workerNumber(0).reply({ kind: "result", id: idOf(fresh), result: resultWith("ghost") });
    fresh.reply({ kind: "result", id: idOf(fresh), result: resultWith("fresh") });
    expect((await second).report.fingerprint).toBe("fresh");
    expect(workers).toHaveLength(2);
  });
});

describe("a replacement worker", () => {
  test.each<[string, (worker: MockWorker) => void]>([
    ["that crashes at once", (worker) => worker.crash("no script")],
    [
      "that cannot load the engine",
      (worker) => worker.reply({ kind: "unusable", name: "engine", message: "no file" }),
    ],
  ])("%s is not requested again: all calls are rejected with the reason", async (_, fail) => {
    const mesher = await readyMesher();
    const calls = [
      mesher.fillSurface(boxSurface(1)),
      mesher.fillSurface(boxSurface(2)),
      mesher.inspectSurface(boxSurface(1)),
    ];
    const settled = Promise.allSettled(calls);
    workerNumber(0).crash("unreachable executed");
    const later = mesher.inspectSurface(boxSurface(1));
    fail(workerNumber(1));
    const code = (await settled).map((call) => (call.status === "rejected" ? codeOf(call.reason) : "done"));
    expect(code).toEqual(["engine-failed", "engine-not-loaded", "engine-failed"]);
    await expect(later).rejects.toMatchObject({ code: "engine-not-loaded" });
    await expect(mesher.fillSurface(boxSurface(1))).rejects.toMatchObject({ code: "engine-not-loaded" });
    expect(workers.map(({ terminated }) => terminated)).toEqual([true, true]);
  });

  test("that the browser refuses to start is not requested again", async () => {
    const mesher = await readyMesher();
    const runs = [mesher.fillSurface(boxSurface(1)), mesher.fillSurface(boxSurface(2))];
    const settled = Promise.allSettled(runs);
    refusal = new Error("no more threads");
    workerNumber(0).crash("unreachable executed");
    const code = (await settled).map((call) => (call.status === "rejected" ? codeOf(call.reason) : "done"));
    expect(code).toEqual(["engine-failed", "engine-not-loaded"]);
    expect(workers).toHaveLength(1);
  });
});

test("a replacement worker gets the compiled engine", async () => {
  const mesher = await readyMesher();
  const run = mesher.fillSurface(boxSurface(1));
  workerNumber(0).crash("unreachable executed");
  await expect(run).rejects.toMatchObject({ code: "engine-failed" });
  expect(workerNumber(1).loads).toEqual([{ name: "engine", module }]);
});

describe("the tools", () => {
  /** Starts a mesher in its own copy of the package, which has no tools yet, with a proposal and a run. */
  async function waitingForTools() {
    vi.resetModules();
    const { createMesher } = await import("tetrafront");
    const starting = createMesher();
    const worker = workerNumber(0);
    worker.reply(READY);
    const mesher = await starting;
    const run = mesher.fillSurface(boxSurface(1));
    const proposal = mesher.proposeSizes(cubeProject());
    worker.reply({ kind: "wanted", name: "tools" });
    return { mesher, worker, run, proposal };
  }
  const answer = { size: 2, sources: projectArrays(cubeProject()).grid.sources };
  const compileTools = { name: "tools", module: undefined } as const;

  test("are compiled by the first worker that wants them, and later workers get them", async () => {
    const { mesher, worker, run, proposal } = await waitingForTools();
    expect(worker.loads.at(-1)).toEqual(compileTools);
    worker.reply({ kind: "ready", name: "tools", module });
    worker.reply({ kind: "answer", id: idOf(worker, 1), answer });
    expect(await proposal).toEqual({ size: 2, sources: [] });
    worker.crash("unreachable executed");
    await expect(run).rejects.toMatchObject({ code: "engine-failed" });
    const fresh = workerNumber(1);
    fresh.reply(READY);
    void mesher.proposeSizes(cubeProject()).catch(() => undefined);
    fresh.reply({ kind: "wanted", name: "tools" });
    expect(fresh.loads).toEqual([
      { name: "engine", module },
      { name: "tools", module },
    ]);
    mesher.dispose();
  });

  test("that cannot be loaded reject only the calls that need them; the next such call tries again", async () => {
    const { mesher, worker, run, proposal } = await waitingForTools();
    const message = "http://localhost/tools.wasm is answered with HTTP status 404";
    worker.reply({ kind: "unusable", name: "tools", message });
    worker.reply({ kind: "unanswerable", id: idOf(worker, 1), message });
    await expect(proposal).rejects.toMatchObject({
      name: "MesherError",
      code: "engine-not-loaded",
      data: { what: "engine", reason: message, remedy: "Serve engine.wasm." },
    });
    expect(worker.terminated).toBe(false);
    const next = mesher.proposeSizes(cubeProject());
    worker.reply({ kind: "wanted", name: "tools" });
    expect(worker.loads.slice(1)).toEqual([compileTools, compileTools]);
    worker.reply({ kind: "ready", name: "tools", module });
    worker.reply({ kind: "answer", id: idOf(worker, 2), answer });
    expect(await next).toEqual({ size: 2, sources: [] });
    worker.reply({ kind: "result", id: idOf(worker), result: resultWith("own") });
    expect((await run).report.fingerprint).toBe("own");
  });

  test("whose worker is disposed of while it compiles them are compiled by the next worker", async () => {
    const { mesher, run, proposal } = await waitingForTools();
    const settled = Promise.allSettled([run, proposal]);
    const { createMesher } = await import("tetrafront");
    const starting = createMesher();
    const other = workerNumber(1);
    other.reply(READY);
    const second = await starting;
    void second.proposeSizes(cubeProject()).catch(() => undefined);
    other.reply({ kind: "wanted", name: "tools" });
    expect(other.loads).toEqual([{ name: "engine", module }]);
    mesher.dispose();
    expect((await settled).map(({ status }) => status)).toEqual(["rejected", "rejected"]);
    expect(other.loads.at(-1)).toEqual(compileTools);
    second.dispose();
  });
});

test("if a query runs out of memory, the run beside it is rejected with its progress", async () => {
  const mesher = await readyMesher();
  const worker = workerNumber(0);
  const run = mesher.fillSurface(boxSurface(1));
  const preview = mesher.previewProject(cubeProject());
  const runProgress = { phase: "volume", tetrahedra: 1000, expectedTetrahedra: 8000 } as const;
  const otherFields = {
    fraction: 0.5,
    nodes: 9,
    triangles: 9,
    frontFaces: 9,
    exactFillFraction: 0,
    elapsedSeconds: 1,
  };
  worker.reply({ kind: "progress", id: idOf(worker), progress: { ...runProgress, ...otherFields } });
  const failure = {
    kind: "failure",
    reason: "out-of-memory",
    message: "out of memory",
    isEngineLost: false,
  } as const;
  worker.reply({ ...failure, id: idOf(worker, 1), bytes: 2 ** 32 });
  await expect(run).rejects.toMatchObject({ data: { ...runProgress, bytes: 2 ** 32, sizeFactor: 2.4 } });
  await expect(preview).rejects.toMatchObject({
    data: { bytes: 2 ** 32, phase: undefined, tetrahedra: 0 },
  });
});

describe("the failure of an abandoned query", () => {
  async function abandonedBesideRun() {
    const mesher = await readyMesher();
    const worker = workerNumber(0);
    const run = mesher.fillSurface(boxSurface(1));
    const stop = new AbortController();
    const inspection = mesher.inspectSurface(boxSurface(1), {}, { signal: stop.signal });
    stop.abort();
    await expect(inspection).rejects.toMatchObject({ code: "cancelled" });
    const failure = { kind: "failure", id: idOf(worker, 1), reason: "out-of-memory", bytes: 9 } as const;
    return { worker, run, failure: { ...failure, message: "out of memory" } };
  }

  test("does not affect the active run", async () => {
    const { worker, run, failure } = await abandonedBesideRun();
    worker.reply({ ...failure, isEngineLost: false });
    expect(worker.terminated).toBe(false);
    worker.reply({ kind: "result", id: idOf(worker), result: resultWith("own") });
    expect((await run).report.fingerprint).toBe("own");
  });

  test("rejects the active run if the engine is lost", async () => {
    const { worker, run, failure } = await abandonedBesideRun();
    worker.reply({ ...failure, reason: "engine-failed", isEngineLost: true });
    await expect(run).rejects.toMatchObject({ code: "engine-failed" });
    expect(worker.terminated).toBe(true);
  });
});

describe("a worker asked to cancel", () => {
  test("can take its time to copy the result after it confirms", async () => {
    const mesher = await readyMesher();
    const worker = workerNumber(0);
    const stop = new AbortController();
    const run = mesher.fillSurface(boxSurface(1), {}, { signal: stop.signal });
    stop.abort();
    expect(worker.requests.at(-1)).toEqual({ kind: "cancel", id: idOf(worker) });
    worker.reply({ kind: "stopping", id: idOf(worker) });
    await new Promise((resolve) => setTimeout(resolve, 150));
    expect(worker.terminated).toBe(false);
    worker.reply({ kind: "result", id: idOf(worker), result: { ...resultWith(""), status: "cancelled" } });
    expect((await run).report.status).toBe("cancelled");
  });

  // A loaded machine delays timers. Then retry.
  test(
    "is terminated after 0.5 s without an answer, and a preview is requested again",
    { retry: 3 },
    async () => {
      const mesher = await readyMesher();
      const stop = new AbortController();
      const run = mesher.fillSurface(boxSurface(1), {}, { signal: stop.signal });
      const preview = mesher.previewProject(cubeProject());
      const aborted = performance.now();
      stop.abort();
      const { report } = await run;
      expect(report).toMatchObject({ status: "cancelled", tetrahedra: 0 });
      expect(performance.now() - aborted).toBeLessThan(1000);
      // It gets some time to confirm.
      expect(report.seconds.total).toBeGreaterThan(0.3);
      expect(workerNumber(0).terminated).toBe(true);
      const fresh = workerNumber(1);
      fresh.reply(READY);
      expect(fresh.requests).toMatchObject([{ kind: "question", call: "previewModel" }]);
      const arrays = {
        linePoints: noPoints,
        lineOffsets: none,
        patchPoints: noPoints,
        patchTriangles: none,
        patchOffsets: none,
      };
      fresh.reply({
        kind: "answer",
        id: idOf(fresh),
        answer: { ...arrays, diagnostics: noDiagnostics },
      });
      expect((await preview).diagnostics).toEqual([]);
    },
  );

  test("is terminated without an answer, and queries are sent again with copies of their arrays", async () => {
    const mesher = await readyMesher();
    const stop = new AbortController();
    const run = mesher.fillSurface(boxSurface(1), {}, { signal: stop.signal });
    const surface = boxSurface(1);
    const [points, corners] = [surface.points.length, surface.triangles.length];
    const queries = [
      mesher.inspectSurface(surface),
      mesher.repairSurface(surface),
      mesher.refineSurface(surface, { size: 1 }),
    ];
    for (const query of queries) query.catch(() => undefined);
    structuredClone(surface, { transfer: [surface.points.buffer, surface.triangles.buffer] });
    stop.abort();
    expect((await run).report.status).toBe("cancelled");
    const resent = workerNumber(1).requests.filter((request) => request.kind === "question");
    expect(resent.map(({ call }) => call)).toEqual(["inspectSurface", "repairSurface", "refineSurface"]);
    for (const { given } of resent) {
      expect(given.slice(0, 2)).toMatchObject([{ length: points }, { length: corners }]);
    }
    mesher.dispose();
  });
});
