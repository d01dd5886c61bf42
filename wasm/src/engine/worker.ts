/** The worker: receives requests, runs the engine in slices, sends replies (protocol.ts). */
import { workerPort } from "#worker-port";
import type { FailureReason } from "../diagnostics/mesher-error.js";
import type { MeshStatus } from "../mesh/report.js";
import type { UnoptimizedMesh } from "./control.js";
import { type CompiledEngine, type Engine, type EngineRun, type EngineTool, loadEngine } from "./loader.js";
import type { Answer, EngineResult, Question, Request } from "./protocol.js";
import { qualityReport } from "./quality-report.js";
import { RunClock } from "./run-clock.js";
import { failureOf, runInSlices, type SliceControl, workInSlices } from "./slices.js";
import { buffersOf } from "./transfer.js";

const cancelled = new Set<number>();
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

/** Listens at once, because a browser drops messages sent before a worker listens. */
const loaded = new Promise<Engine | undefined>((resolve) => {
  workerPort.onRequest((request) => {
    if (request.kind === "load") resolve(load(request.module));
    else void loaded.then((engine) => engine && serve(engine, request));
  });
});

/** Returns the engine; reports and returns undefined if it cannot be loaded. */
async function load(given: CompiledEngine | undefined): Promise<Engine | undefined> {
  try {
    const { engine, module } = await loadEngine(given, workerPort.compile);
    workerPort.post({ kind: "ready", module });
    return engine;
  } catch (failure) {
    const message = failure instanceof Error ? failure.message : String(failure);
    workerPort.post({ kind: "unusable", message });
    return undefined;
  }
}

async function serve(engine: Engine, request: WorkRequest): Promise<void> {
  try {
    await handle(engine, request);
  } catch (failure) {
    replyFailure(engine, request.id, failure);
  }
}

type WorkRequest = Exclude<Request, { kind: "load" }>;

async function handle(engine: Engine, request: WorkRequest): Promise<void> {
  switch (request.kind) {
    case "cancel":
      if (running.has(request.id)) cancelled.add(request.id);
      return;
    case "mesh-model":
      return mesh(request, engine.meshModel(request.model, request.grid, request.options));
    case "fill-surface":
      return mesh(
        request,
        engine.fillSurface(request.points, request.triangles, request.grid, request.options),
      );
    default:
      return answer(engine, request);
  }
}

/** A question that was abandoned while it waited is not begun. */
async function answer(engine: Engine, question: Question): Promise<void> {
  const { id } = question;
  running.add(id);
  try {
    await workerPort.letRequestsIn();
    if (!cancelled.has(id)) await work(question, toolFor(engine, question));
  } finally {
    running.delete(id);
    cancelled.delete(id);
  }
}

function toolFor(engine: Engine, question: Question): EngineTool | null {
  switch (question.kind) {
    case "preview":
      return engine.previewModel(question.model, question.grid, question.options);
    case "cover":
      return engine.cover(question.model, question.size, question.shape);
    case "propose":
      return engine.propose(question.model, question.options);
    case "background-from-mesh":
      return engine.backgroundFromMesh(question.mesh, question.sizes);
    case "inspect-surface":
      return engine.inspectSurface(question.points, question.triangles, question.options);
    case "repair-surface":
      return engine.repairSurface(question.points, question.triangles, question.options);
    case "refine-surface":
      return engine.refineSurface(
        question.points,
        question.triangles,
        question.grid,
        question.options,
        question.volume,
      );
    case "remesh-surface":
      return engine.remeshSurface(
        question.points,
        question.triangles,
        question.groups,
        question.grid,
        question.options,
      );
    case "inspect-mesh":
      return engine.inspectMesh(question.points, question.tetrahedra, question.regions);
  }
}

async function work({ id, kind }: Question, tool: EngineTool | null): Promise<void> {
  if (tool === null) throw noMemory();
  try {
    assertHealthy(tool);
    const isComplete = await workInSlices(tool, controlOf(id));
    if (!isComplete) return;
    const answer = tool.result();
    assertHealthy(tool);
    workerPort.post({ kind: "answer", id, question: kind, answer } as Answer, buffersOf(answer));
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

async function mesh({ id, showFront, showUnoptimized }: RunRequest, run: EngineRun | null): Promise<void> {
  if (run === null) throw noMemory();
  const clock = new RunClock();
  running.add(id);
  try {
    assertHealthy(run);
    const onFront = (corners: Float64Array): void =>
      workerPort.post({ kind: "front", id, corners }, buffersOf(corners));
    const onUnoptimized = (mesh: UnoptimizedMesh): void =>
      workerPort.post({ kind: "unoptimized", id, mesh }, buffersOf(mesh));
    const control = {
      ...controlOf(id),
      onFront: showFront ? onFront : undefined,
      onUnoptimized: showUnoptimized ? onUnoptimized : undefined,
    };
    const status = await runInSlices(run, clock, control);
    if (status === "cancelled") workerPort.post({ kind: "stopping", id });
    const result = resultOf(run, status, clock);
    workerPort.post({ kind: "result", id, result }, buffersOf(result));
  } finally {
    running.delete(id);
    cancelled.delete(id);
    run.delete();
  }
}

function resultOf(run: EngineRun, status: MeshStatus, clock: RunClock): EngineResult {
  const surface = run.surface();
  const volume = run.volume();
  const quality = run.quality();
  const statistics = {
    nodes: volume.points.length / 3,
    tetrahedra: volume.tetrahedra.length / 4,
    triangles: surface.triangles.length / 3,
    dihedral: { min: quality.minDihedral, max: quality.maxDihedral },
    radiusRatio: { min: quality.minRadiusRatio, mean: quality.meanRadiusRatio },
    volume: quality.volume,
    quality: qualityReport(run.statistics()),
    patches: run.patches(),
    recovery: run.recovery(),
    front: run.counters(),
    // A cancelled mesh depends on the time of the cancellation, and the caller is waiting.
    fingerprint: status === "cancelled" ? "" : run.fingerprint(),
  };
  const metricShapes = run.metricShapes();
  const diagnostics = run.diagnostics();
  const hasFoundNothingBetter = run.hasFoundNothingBetter();
  assertHealthy(run);
  return {
    status,
    surface,
    volume,
    ...(metricShapes.radiusRatio.length > 0 && { metricShapes }),
    diagnostics,
    hasFoundNothingBetter,
    statistics: { ...statistics, seconds: clock.seconds() },
  };
}

/** After a failure the engine returns empty values, which must not pass for a result. */
function assertHealthy(run: { failure(): number; failureMessage(): string }): void {
  const failure = failureOf(run);
  if (failure === "none") return;
  // A text of the engine would need memory.
  throw failure === "out-of-memory" ? noMemory() : new ReportedFailure(failure, run.failureMessage());
}

/** The client replaces the worker after this (protocol.ts). */
function replyFailure(engine: Engine, id: number, failure: unknown): void {
  const reason = failure instanceof ReportedFailure ? failure.reason : "engine-failed";
  const message = failure instanceof Error ? failure.message : String(failure);
  const isEngineLost = !(failure instanceof ReportedFailure);
  workerPort.post({ kind: "failure", id, reason, message, isEngineLost, bytes: engine.memoryBytes() });
}
