/**
 * The client of the worker: one run at a time, the others wait; progress, cancelling, and a worker
 * that is replaced when it has failed or does not listen.
 */
import { startWorker } from "#worker-host";

import { packageDiagnostic } from "./diagnostics.js";
import { checkOptions, engineOptions } from "./options.js";
import { parseProject } from "./project.js";
import { nameByPosition, projectArrays, projectNamer, type EntityNamer } from "./project-arrays.js";
import type { Project } from "./project-schema.js";
import type { EnginePreview, EngineResult, FailureReason, Reply, Request } from "./protocol.js";
import { describedPreview, describedResult, emptyResult } from "./report.js";
import { buffersOf } from "./transfer.js";
import type {
  Diagnostic,
  Mesher,
  MeshOptions,
  MeshResult,
  ProjectPreview,
  RunControl,
  SurfaceInput,
} from "./types.js";
import type { WorkerHandle } from "./worker-host.js";

/** Time for the worker to say that it stops; then it is ended by force, within the promised 100 ms. */
const CANCEL_GRACE_MS = 75;
/** Where this thread was busy itself, what the worker said in time is still to be heard. */
const LAST_HEARING_MS = 5;

export type MesherErrorCode = FailureReason | "disposed";

/** Why a run was rejected: never because of bad input, which is a result. */
export class MesherError extends Error {
  override readonly name = "MesherError";
  constructor(
    readonly code: MesherErrorCode,
    message: string,
  ) {
    super(message);
  }
}

/**
 * Starts a worker with an engine in it; resolves when it is loaded. Call `dispose` when done; a Node
 * process that waits for nothing else ends without it.
 *
 *     const mesher = await createMesher();
 *     const { volume, report } = await mesher.fillSurface({ points, triangles }, { size: 0.1 });
 */
export async function createMesher(): Promise<Mesher> {
  const mesher = new WorkerMesher();
  await mesher.ready;
  return mesher;
}

type RunRequest = Extract<Request, { kind: "mesh-model" | "fill-surface" }>;
type PreviewRequest = Extract<Request, { kind: "preview" }>;

interface Job {
  readonly request: RunRequest;
  readonly control: RunControl;
  readonly resolve: (result: EngineResult | "cancelled") => void;
  readonly reject: (failure: MesherError) => void;
}

interface PendingPreview {
  readonly request: PreviewRequest;
  readonly resolve: (preview: EnginePreview) => void;
  readonly reject: (failure: MesherError) => void;
}

class WorkerMesher implements Mesher {
  readonly ready: Promise<void>;
  #settleReady: { resolve: () => void; reject: (failure: MesherError) => void } | undefined;
  #worker: WorkerHandle;
  #lastId = 0;
  #active: Job | undefined;
  readonly #waiting: Job[] = [];
  readonly #previews = new Map<number, PendingPreview>();
  #forceTimer: ReturnType<typeof setTimeout> | undefined;
  #disposed = false;

  constructor() {
    this.ready = new Promise((resolve, reject) => {
      this.#settleReady = { resolve, reject };
    });
    this.#worker = this.#startWorker();
  }

  async meshProject(project: Project, options: MeshOptions = {}, control: RunControl = {}) {
    const parsed = parseProject(project);
    const wrong = parsed.success
      ? checkOptions(options)
      : parsed.problems.map(({ message, remedy }) => packageDiagnostic("invalid-project", message, remedy));
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    const id = this.#nextId();
    const request = {
      kind: "mesh-model",
      id,
      model: projectArrays(project),
      options: engineOptions(options),
    } as const;
    return this.#run(request, control, projectNamer(project));
  }

  async fillSurface(surface: SurfaceInput, options: MeshOptions = {}, control: RunControl = {}) {
    const wrong = [...checkArrays(surface), ...checkOptions(options)];
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    // Copies: transferring the caller's own arrays would empty them.
    const request = {
      kind: "fill-surface",
      id: this.#nextId(),
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      options: engineOptions(options),
    } as const;
    return this.#run(request, control, nameByPosition);
  }

  async previewProject(project: Project): Promise<ProjectPreview> {
    const request = { kind: "preview", id: this.#nextId(), model: projectArrays(project) } as const;
    const preview = await new Promise<EnginePreview>((resolve, reject) => {
      if (this.#disposed) return reject(disposedError());
      this.#previews.set(request.id, { request, resolve, reject });
      this.#worker.post(request, []);
      this.#updateKeepAlive();
    });
    return describedPreview(preview, projectNamer(project));
  }

  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    clearTimeout(this.#forceTimer);
    this.#worker.terminate();
    this.#settleReady?.reject(disposedError());
    this.#rejectUnderWay(disposedError());
    for (const job of this.#waiting.splice(0)) job.reject(disposedError());
  }

  async #run(request: RunRequest, control: RunControl, name: EntityNamer): Promise<MeshResult> {
    const { signal } = control;
    let onAbort: (() => void) | undefined;
    try {
      const result = await new Promise<EngineResult | "cancelled">((resolve, reject) => {
        if (this.#disposed) return reject(disposedError());
        if (signal?.aborted === true) return resolve("cancelled");
        const job = { request, control, resolve, reject };
        onAbort = () => this.#cancel(job);
        signal?.addEventListener("abort", onAbort, { once: true });
        this.#waiting.push(job);
        this.#startNext();
      });
      return result === "cancelled" ? emptyResult("cancelled") : describedResult(result, name);
    } finally {
      if (onAbort !== undefined) signal?.removeEventListener("abort", onAbort);
    }
  }

  #startNext(): void {
    if (this.#active === undefined && !this.#disposed) {
      this.#active = this.#waiting.shift();
      if (this.#active !== undefined) {
        const { request } = this.#active;
        this.#worker.post(request, buffersOf(request.kind === "mesh-model" ? request.model : request));
      }
    }
    this.#updateKeepAlive();
  }

  #cancel(job: Job): void {
    if (this.#active !== job) {
      const place = this.#waiting.indexOf(job);
      if (place >= 0) this.#waiting.splice(place, 1);
      return job.resolve("cancelled");
    }
    this.#worker.post({ kind: "cancel", id: job.request.id }, []);
    this.#forceTimer = setTimeout(() => {
      this.#forceTimer = setTimeout(() => this.#cancelByForce(job), LAST_HEARING_MS);
    }, CANCEL_GRACE_MS);
  }

  #cancelByForce(job: Job): void {
    this.#worker.terminate();
    this.#worker = this.#startWorker();
    for (const { request } of this.#previews.values()) this.#worker.post(request, []);
    this.#finish(() => job.resolve("cancelled"));
  }

  /** The active job is over, in whatever way `settle` says; the next one begins. */
  #finish(settle: () => void): void {
    clearTimeout(this.#forceTimer);
    this.#active = undefined;
    settle();
    this.#startNext();
  }

  #startWorker(): WorkerHandle {
    const worker = startWorker({
      onReply: (reply) => {
        if (worker === this.#worker || reply.kind === "ready") this.#receive(reply);
      },
      onCrash: (message) => {
        if (worker === this.#worker) this.#replaceWorker(crashError(message));
      },
    });
    return worker;
  }

  #receive(reply: Reply): void {
    switch (reply.kind) {
      case "ready":
        this.#settleReady?.resolve();
        this.#settleReady = undefined;
        return this.#updateKeepAlive();
      case "unusable":
        return this.#giveUp(
          new MesherError("engine-failed", `The engine cannot be loaded: ${reply.message}`),
        );
      case "failure":
        return this.#replaceWorker(failureError(reply.reason, reply.message));
      case "preview":
        this.#previews.get(reply.id)?.resolve(reply.preview);
        this.#previews.delete(reply.id);
        return this.#updateKeepAlive();
      case "progress":
      case "stopping":
      case "result":
        return this.#receiveForRun(reply);
    }
  }

  #receiveForRun(reply: Extract<Reply, { kind: "progress" | "stopping" | "result" }>): void {
    const job = this.#active;
    if (job?.request.id !== reply.id) return;
    switch (reply.kind) {
      case "progress":
        return job.control.onProgress?.(reply.progress);
      case "stopping":
        return clearTimeout(this.#forceTimer);
      case "result":
        return this.#finish(() => job.resolve(reply.result));
    }
  }

  /** What was under way is rejected, for it may be the cause; what waits gets a fresh worker. */
  #replaceWorker(failure: MesherError): void {
    if (this.#settleReady !== undefined) return this.#giveUp(failure);
    clearTimeout(this.#forceTimer);
    this.#worker.terminate();
    this.#worker = this.#startWorker();
    this.#rejectUnderWay(failure);
    this.#startNext();
  }

  /** The engine does not even load: another worker would do no better. */
  #giveUp(failure: MesherError): void {
    this.#settleReady?.reject(failure);
    this.#settleReady = undefined;
    this.#rejectUnderWay(failure);
    this.dispose();
  }

  #rejectUnderWay(failure: MesherError): void {
    this.#active?.reject(failure);
    this.#active = undefined;
    for (const preview of this.#previews.values()) preview.reject(failure);
    this.#previews.clear();
  }

  #updateKeepAlive(): void {
    const isBusy = this.#active !== undefined || this.#previews.size > 0 || this.#settleReady !== undefined;
    this.#worker.keepAlive(isBusy);
  }

  #nextId(): number {
    return ++this.#lastId;
  }
}

function checkArrays(surface: SurfaceInput): Diagnostic[] {
  const { points, triangles } = surface as { points: unknown; triangles: unknown };
  if (!(points instanceof Float64Array) || !(triangles instanceof Uint32Array)) {
    return [invalidArrays("the surface's points and triangles are not a Float64Array and a Uint32Array")];
  }
  if (points.length % 3 !== 0 || triangles.length % 3 !== 0) {
    return [invalidArrays("the lengths of the surface's points and triangles are not multiples of 3")];
  }
  return [];
}

function invalidArrays(message: string): Diagnostic {
  const remedy = "Give x y z per node and three node positions per triangle.";
  return packageDiagnostic("invalid-arrays", message, remedy);
}

function disposedError(): MesherError {
  return new MesherError("disposed", "The mesher was disposed of");
}

function crashError(message: string): MesherError {
  return new MesherError("engine-failed", `The engine's worker ended: ${message}`);
}

function failureError(reason: FailureReason, message: string): MesherError {
  switch (reason) {
    case "out-of-memory":
      return new MesherError(reason, "The mesh needs more memory than there is: ask for larger elements");
    case "engine-failed":
      return new MesherError(reason, `The engine failed (${message}): please report it with the model`);
  }
}
