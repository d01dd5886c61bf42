/** The worker: receives requests, runs the engine in slices, sends replies (protocol.ts). */
import { workerPort } from "#worker-port";
import type { FailureReason } from "../diagnostics/mesher-error.js";
import type { FrontRecording, MeshStatus } from "../mesh/report.js";
import type { EngineMesh, EngineVolume } from "./engine-mesh.js";
import { CALLS, toolFor } from "./calls.js";
import { LazyModule, textOf } from "./lazy-module.js";
import {
  type Engine,
  type EngineRun,
  type EngineTool,
  isTiled,
  loadEngine,
  loadTools,
  loadTraceEngine,
  type LoadModule,
  type Tools,
  type TraceEngine,
} from "./loader.js";
import type { CompiledModule } from "./instantiated.js";
import type { BlockRequest, EngineResult, ModuleName, Question, Request } from "./protocol.js";
import { qualityReport } from "./quality-report.js";
import { regionStatistics } from "./region-statistics.js";
import { RunClock } from "./run-clock.js";
import { failureOf, runInSlices, type SliceControl, workInSlices } from "./slices.js";
import { TilePool, usableThreads } from "./tile-pool.js";
import { buffersOf } from "./transfer.js";

const cancelled = new Set<number>();
/** Questions to answer with what has been made so far. */
const stopped = new Set<number>();
const running = new Set<number>();

/** A failure that the engine has reported, to be sent as a reply. */
class ReportedFailure extends Error {
  readonly reason: FailureReason;

  constructor(reason: FailureReason, message: string) {
    super(message);
    this.reason = reason;
  }
}

const OUT_OF_MEMORY = "out of memory";

/** The engine returns null if it has no memory for a run or tool. */
function noMemory(): ReportedFailure {
  return new ReportedFailure("out-of-memory", OUT_OF_MEMORY);
}

/** The code of the module "engine", for workers that optimize tiles. */
let engineCode: CompiledModule | undefined;

const lazyEngine = new LazyModule<Engine>({
  // The creator sends it unasked, because the mesher is ready only with it.
  askForCode: () => undefined,
  load: (given) => loadEngine(given, workerPort.compile),
  onReady: (module) => {
    engineCode = module;
    workerPort.post({ kind: "ready", name: "engine", module });
  },
  onUnusable: (message) => workerPort.post({ kind: "unusable", name: "engine", message }),
});

/** Returns a module that is loaded when a request needs it. */
function onDemand<Instance>(name: ModuleName, load: LoadModule<Instance>): LazyModule<Instance> {
  return new LazyModule<Instance>({
    askForCode: () => workerPort.post({ kind: "wanted", name }),
    load: (given) => load(given, workerPort.compile),
    onReady: (module) => workerPort.post({ kind: "ready", name, module }),
    onUnusable: (message) => workerPort.post({ kind: "unusable", name, message }),
  });
}

const lazyTools = onDemand("tools", loadTools);
const lazyTrace = onDemand("trace", loadTraceEngine);

const modules = { engine: lazyEngine, tools: lazyTools, trace: lazyTrace } as const;

/** The modules that fill models and surfaces. */
type RunEngine = Engine | TraceEngine;

// Listens at once, because a browser drops messages sent before a worker listens.
workerPort.onRequest((request) => void serve(request));
lazyEngine.instance().catch(() => undefined);

async function serve(request: Request): Promise<void> {
  switch (request.kind) {
    case "load":
      return modules[request.name].receive(request.module);
    case "cancel":
      if (running.has(request.id)) cancelled.add(request.id);
      return;
    case "stop":
      if (running.has(request.id)) stopped.add(request.id);
      return;
    case "mesh-model":
      return workIn(runModule(request), request.id, (engine) =>
        mesh(request, withRules(modelRun(engine, request), request)),
      );
    case "fill-surface":
      return workIn(runModule(request), request.id, (engine) =>
        mesh(request, withRules(surfaceRun(engine, request), request)),
      );
    case "read":
      return readBlock(request);
    case "release":
      kept.get(request.id)?.delete();
      kept.delete(request.id);
      return;
    case "question":
      return workIn<Engine | Tools>(modules[CALLS[request.call].module], request.id, (module) =>
        answer(module, request),
      );
  }
}

function runModule({ recordTrace }: RunRequest): LazyModule<RunEngine> {
  return recordTrace ? lazyTrace : lazyEngine;
}

/** Works on the request with this id in an instance of the module that it needs; replies if that fails. */
async function workIn<Instance extends RunEngine | Tools>(
  module: LazyModule<Instance>,
  id: number,
  work: (instance: Instance) => Promise<void>,
): Promise<void> {
  let instance: Instance | undefined;
  running.add(id);
  try {
    instance = await module.instance();
    await work(instance);
  } catch (failure) {
    if (instance === undefined) workerPort.post({ kind: "unanswerable", id, message: textOf(failure) });
    else replyFailure(instance, id, failure);
  } finally {
    running.delete(id);
    cancelled.delete(id);
    stopped.delete(id);
  }
}

/** Changes the rules of a run that is recorded. */
function withRules(run: EngineRun | null, { recordTrace }: RunRequest): EngineRun | null {
  const { relaxation = true, tolerance = 1, search = "grid" } = recordTrace ?? {};
  run?.experiment?.(relaxation, tolerance, search === "linear");
  return run;
}

function modelRun(engine: RunEngine, request: Extract<Request, { kind: "mesh-model" }>): EngineRun | null {
  const { model, bodies, grid, options } = request;
  return bodies === undefined
    ? engine.meshModel(model, grid, options)
    : engine.meshWithBodies(model, bodies, grid, options);
}

function surfaceRun(
  engine: RunEngine,
  request: Extract<Request, { kind: "fill-surface" }>,
): EngineRun | null {
  const { points, triangles, regions, grid, options } = request;
  return engine.fillSurface(points, triangles, regions, grid, options);
}

/** A question that was abandoned while it waited is not begun. */
async function answer(module: Engine | Tools, { id, call, given }: Question): Promise<void> {
  await workerPort.letRequestsIn();
  if (!cancelled.has(id)) await work(id, toolFor(module, call, given));
}

async function work(id: number, tool: EngineTool | null): Promise<void> {
  if (tool === null) throw noMemory();
  try {
    assertHealthy(tool);
    const isComplete = await workInSlices(tool, { ...controlOf(id), isStopped: () => stopped.has(id) });
    if (!isComplete) return;
    const answer = tool.result();
    assertHealthy(tool);
    workerPort.post({ kind: "answer", id, answer }, buffersOf(answer));
  } finally {
    tool.delete();
  }
}

function controlOf(id: number): SliceControl {
  return {
    isCancelled: () => cancelled.has(id),
    onProgress: (progress) => workerPort.post({ kind: "progress", id, progress }),
    letRequestsIn: workerPort.letRequestsIn,
  };
}

type RunRequest = Extract<Request, { kind: "mesh-model" | "fill-surface" }>;

async function mesh(
  { id, showFront, showUnoptimized, recordTrace, threads: asked, inBlocks }: RunRequest,
  run: EngineRun | null,
): Promise<void> {
  if (run === null) throw noMemory();
  const clock = new RunClock();
  const threads = usableThreads(asked);
  const tiles = poolFor(run, threads);
  try {
    assertHealthy(run);
    const onFront = (corners: Float64Array): void =>
      workerPort.post({ kind: "front", id, corners }, buffersOf(corners));
    const onUnoptimized = (mesh: EngineMesh): void =>
      workerPort.post({ kind: "unoptimized", id, mesh }, buffersOf(mesh));
    const onTrace = (events: Uint8Array): void =>
      workerPort.post({ kind: "trace", id, events }, buffersOf(events));
    const control = {
      ...controlOf(id),
      onTrace: recordTrace ? onTrace : undefined,
      onFront: showFront ? onFront : undefined,
      onUnoptimized: showUnoptimized ? onUnoptimized : undefined,
      tiles,
    };
    const status = await runInSlices(run, clock, control);
    if (status === "cancelled") workerPort.post({ kind: "stopping", id });
    tiles?.close();
    const isKept = inBlocks && status === "done";
    const result = resultOf(run, status, clock, { threads, isKept });
    if (isKept) kept.set(id, run);
    workerPort.post({ kind: "result", id, result }, buffersOf(result));
  } finally {
    tiles?.close();
    if (!kept.has(id)) run.delete();
  }
}

/** Runs whose meshes stay in the engine, by the ids of their requests. */
const kept = new Map<number, EngineRun>();

function readBlock({ id, run: of, part, first, last }: BlockRequest): void {
  try {
    const run = kept.get(of);
    if (run === undefined) throw new Error("the mesh has been released");
    const answer = run[part](first, last);
    assertHealthy(run);
    workerPort.post({ kind: "answer", id, answer }, buffersOf(answer));
  } catch (failure) {
    workerPort.post({ kind: "unanswerable", id, message: textOf(failure) });
  }
}

/** Number of nodes or tetrahedra that are copied at once. */
const BLOCK = 1 << 16;

/** Returns the arrays of a finished mesh, without a copy of them in the engine's memory. */
function volumeOf(run: EngineRun): EngineVolume {
  const [nodes, count] = [run.nodeCount(), run.tetrahedronCount()];
  const points = new Float64Array(3 * nodes);
  for (let first = 0; first < nodes; first += BLOCK) points.set(run.points(first, first + BLOCK), 3 * first);
  const tetrahedra = new Uint32Array(4 * count);
  for (let first = 0; first < count; first += BLOCK)
    tetrahedra.set(run.tetrahedra(first, first + BLOCK), 4 * first);
  const regions = new Uint32Array(count);
  const runs = run.regionRuns();
  for (let i = 0, first = 0; i < runs.length; i += 2) {
    const end = first + (runs[i + 1] ?? 0);
    regions.fill(runs[i] ?? 0, first, end);
    first = end;
  }
  return { points, tetrahedra, regions, front: new Uint32Array() };
}

const noVolume = (): EngineVolume => ({
  points: new Float64Array(),
  tetrahedra: new Uint32Array(),
  regions: new Uint32Array(),
  front: new Uint32Array(),
});

/** Returns the workers beside this one for a run; none if one thread is enough, or if it is recorded. */
function poolFor(run: EngineRun, threads: number): TilePool | undefined {
  if (threads === 1 || engineCode === undefined || !isTiled(run)) return undefined;
  return new TilePool(run, threads, engineCode);
}

/** `isKept`: whether the mesh stays in the engine. */
function resultOf(
  run: EngineRun,
  status: MeshStatus,
  clock: RunClock,
  { threads, isKept }: { readonly threads: number; readonly isKept: boolean },
): EngineResult {
  const surface = run.surface();
  const volume = isKept ? noVolume() : status === "done" ? volumeOf(run) : run.volume();
  const quality = run.quality();
  const statistics = {
    nodes: run.nodeCount(),
    tetrahedra: run.tetrahedronCount(),
    triangles: surface.triangles.length / 3,
    dihedral: { min: quality.minDihedral, max: quality.maxDihedral },
    radiusRatio: { min: quality.minRadiusRatio, mean: quality.meanRadiusRatio },
    volume: quality.volume,
    quality: qualityReport(run.statistics()),
    patches: run.patches(),
    recovery: run.recovery(),
    front: run.counters(),
    interior: { lattice: run.latticeCount() },
    threads,
    // A cancelled mesh depends on the time of the cancellation, and the caller is waiting.
    fingerprint: status === "cancelled" ? "" : run.fingerprint(),
  };
  const metricShapes = run.metricShapes();
  const diagnostics = run.diagnostics();
  const hasFoundNothingBetter = run.hasFoundNothingBetter();
  const recording = recordingOf(run);
  assertHealthy(run);
  return {
    status,
    surface,
    volume,
    ...(isKept && { regionRuns: run.regionRuns() }),
    ...(metricShapes.radiusRatio.length > 0 && { metricShapes }),
    diagnostics,
    hasFoundNothingBetter,
    ...(recording && { recording }),
    regionStatistics: regionStatistics(volume, statistics.quality),
    statistics: { ...statistics, seconds: clock.seconds() },
  };
}

/** Returns what a run knows of its recorded steps; undefined if it records none. */
function recordingOf(run: EngineRun): FrontRecording | undefined {
  const fingerprint = run.frontFingerprint?.();
  const steps = run.recordedSteps?.();
  return fingerprint === undefined || steps === undefined ? undefined : { fingerprint, steps };
}

/** After a failure the engine returns empty values, which must not pass for a result. */
function assertHealthy(run: { failure(): number; failureMessage(): string }): void {
  const failure = failureOf(run);
  if (failure === "none") return;
  // A text of the engine would need memory.
  throw failure === "out-of-memory" ? noMemory() : new ReportedFailure(failure, run.failureMessage());
}

/** The client replaces the worker after this (protocol.ts). */
function replyFailure(instance: RunEngine | Tools, id: number, failure: unknown): void {
  const reason = failure instanceof ReportedFailure ? failure.reason : "engine-failed";
  const message = textOf(failure);
  const isEngineLost = !(failure instanceof ReportedFailure);
  workerPort.post({ kind: "failure", id, reason, message, isEngineLost, bytes: instance.memoryBytes() });
}
