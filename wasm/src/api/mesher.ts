/**
 * The client of the worker: one run at a time, the others wait; progress, cancelling, and a worker
 * that is replaced when it has failed or does not listen.
 */
import type { Progress } from "../base/progress.js";
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import { inSteps } from "../calls/yielder.js";
import { type EntityNamer, gridByIndex } from "../diagnostics/entity-names.js";
import {
  cancelledError,
  disposedError,
  failureError,
  type MesherError,
  refuse,
} from "../diagnostics/mesher-error.js";
import { EngineWorker, type WorkReply } from "../engine/engine-worker.js";
import type { Answer, Answers, AnswerTo, EngineResult, Question, Request } from "../engine/protocol.js";
import { buffersOf } from "../engine/transfer.js";
import type {
  MeshInspection,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { MeshInput, SurfaceInput, VolumeMesh } from "../mesh/mesh.js";
import type { MeshResult } from "../mesh/report.js";
import { projectArrays } from "../project/arrays.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import {
  backgroundOf,
  emptyGrid,
  projectBackground,
  projectSources,
  withNodes,
} from "../project/grid-arrays.js";
import { projectNamer, withMissingId } from "../project/names.js";
import type { ProjectPreview } from "../project/preview.js";
import type { Project, ProjectBackground } from "../project/schema.js";
import type { AbortControl, RunControl } from "./control.js";
import {
  checkControl,
  checkMesh,
  checkProject,
  checkSurface,
  checkVolume,
  checkWeld,
  drawnArrays,
  nothingToCover,
  unreadableMesh,
} from "./input-checks.js";
import {
  changeDiagnostics,
  describedInspection,
  describedMesh,
  describedRefinement,
  describedRepair,
} from "./inspection.js";
import type { Mesher, SizeProposal } from "./mesher-interface.js";
import type {
  CoverOptions,
  InspectionOptions,
  MeshOptions,
  PreviewOptions,
  ProposalOptions,
  RefineOptions,
  RepairOptions,
} from "./option-types.js";
import {
  checkCoverOptions,
  checkGridOptions,
  checkInspectionOptions,
  checkOptions,
  checkPreviewOptions,
  checkProposalOptions,
  checkRefineOptions,
  checkRepairOptions,
  engineCoverOptions,
  engineInspectionOptions,
  engineOptions,
  engineProposalOptions,
  engineRepairOptions,
  withSettings,
} from "./options.js";
import { notify, type ProgressListener } from "./progress.js";
import { describedPreview, describedResult, emptyResult } from "./report.js";
import { surfaceNamer } from "./surface-numbers.js";

/** Time for the worker to say that it stops; then it is ended by force, within the promised half second. */
const CANCEL_GRACE_MS = 450;
/** Where this thread was busy itself, what the worker said in time is still to be heard. */
const LAST_HEARING_MS = 5;

/**
 * Starts a worker with an engine in it; resolves when it is loaded. Call `dispose` when done; a Node
 * process that waits for nothing else ends without it. Rejects with a `MesherError` of the code `engine-not-loaded`,
 * or `cancelled` where the signal is aborted before; then no worker is left.
 *
 *     const mesher = await createMesher();
 *     const { volume, report } = await mesher.fillSurface({ points, triangles }, { size: 0.1 });
 */
export async function createMesher(control: AbortControl = {}): Promise<Mesher> {
  refuse(checkControl(control));
  const { signal } = control;
  throwIfCancelled(signal);
  const mesher = new WorkerMesher();
  try {
    await untilCancelled(() => mesher.ready, signal);
    return mesher;
  } catch (failure) {
    mesher.dispose();
    throw failure;
  }
}

type RunRequest = Extract<Request, { kind: "mesh-model" | "fill-surface" }>;
interface Job extends ProgressListener {
  readonly request: RunRequest;
  /** Of the given surface; the request itself is handed to the worker. */
  readonly triangles: number;
  /** When it was sent to the worker, in milliseconds. */
  began: number | undefined;
  /** The latest heard of. */
  progress: Progress | undefined;
  readonly resolve: (result: EngineResult | Cancelled) => void;
}

/** Ended without a word of the worker. */
interface Cancelled {
  readonly cancelledAfterSeconds: number;
}

/** Why a call is rejected, a run with where it stood, as far as that was heard of. */
type FailureAt = (progress: Progress | undefined) => MesherError;

interface OpenQuestion extends ProgressListener {
  readonly question: Question;
  readonly receive: (reply: Answer) => void;
}

class WorkerMesher implements Mesher {
  readonly ready: Promise<void>;
  #settleReady: { resolve: () => void; reject: (failure: MesherError) => void } | undefined;
  #worker: EngineWorker;
  #lastId = 0;
  #active: Job | undefined;
  readonly #waiting: Job[] = [];
  readonly #questions = new Map<number, OpenQuestion>();
  #forceTimer: ReturnType<typeof setTimeout> | undefined;
  /** Why there will be no more answers; undefined as long as there will. */
  #closed: (() => MesherError) | undefined;

  constructor() {
    this.ready = new Promise((resolve, reject) => {
      this.#settleReady = { resolve, reject };
    });
    this.#worker = this.#startWorker();
  }

  async meshProject(project: Project, options: MeshOptions = {}, control: RunControl = {}) {
    const early = this.#endedEarly(control);
    if (early !== undefined) return early;
    const unusable = [...checkProject(project), ...checkOptions(options)];
    if (unusable.length > 0) return emptyResult("invalid-input", unusable);
    const settled = withSettings(options, project);
    const wrong = checkOptions(settled);
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    const { background } = settled;
    const drawn = projectArrays(project);
    const request = {
      kind: "mesh-model",
      id: this.#nextId(),
      showFront: control.onFront !== undefined,
      model: background === undefined ? drawn : { ...drawn, grid: withNodes(drawn.grid, background) },
      options: engineOptions(settled),
    } as const;
    const name = projectNamer(project);
    return this.#run(request, control, background === undefined ? name : gridByIndex(name));
  }

  async fillSurface(surface: SurfaceInput, options: MeshOptions = {}, control: RunControl = {}) {
    const early = this.#endedEarly(control);
    if (early !== undefined) return early;
    const wrong = [...checkSurface(surface), ...checkOptions(options)];
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    const { background } = options;
    // Copies: transferring the caller's own arrays would empty them.
    const request = {
      kind: "fill-surface",
      id: this.#nextId(),
      showFront: control.onFront !== undefined,
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      grid: background === undefined ? emptyGrid() : withNodes(emptyGrid(), background),
      options: engineOptions(options),
    } as const;
    return this.#run(request, control, surfaceNamer(surface));
  }

  async previewProject(
    project: Project,
    options: PreviewOptions = {},
    control: RunControl = {},
  ): Promise<ProjectPreview> {
    this.#begin(control);
    const unusable = checkPreviewOptions(options);
    const drawn = drawnArrays(project);
    const { size, innerShells, background } = withSettings(unusable.length > 0 ? {} : options, project);
    const wrong = unusable.length > 0 ? unusable : checkPreviewOptions({ size, innerShells, background });
    const hasGrid = background !== undefined && wrong.length === 0;
    const question = {
      kind: "preview",
      id: this.#nextId(),
      model: hasGrid ? { ...drawn, grid: withNodes(drawn.grid, background) } : drawn,
      options: engineOptions(wrong.length > 0 ? {} : { size, innerShells }),
    } as const;
    const name = projectNamer(project);
    const answer = await this.#ask(question, control);
    const preview = describedPreview(answer, hasGrid ? gridByIndex(name) : name);
    const named = hasGrid ? { ...project, background: undefined } : project;
    const told = preview.diagnostics.map((found) => withMissingId(found, named));
    return { ...preview, diagnostics: [...wrong, ...told] };
  }

  async coverProject(
    project: Project,
    options: CoverOptions = {},
    control: RunControl = {},
  ): Promise<ProjectBackground> {
    this.#begin(control);
    refuse([...checkProject(project), ...checkCoverOptions(options)]);
    const model = projectArrays(project);
    const id = this.#nextId();
    const question = { kind: "cover", id, model, ...engineCoverOptions(options) } as const;
    const grid = await this.#ask(question, control);
    if (grid.tetrahedra.length === 0) refuse([nothingToCover()]);
    const { sources } = backgroundOf(project);
    return { ...projectBackground(grid), ...(sources && { sources }) };
  }

  async proposeSizes(
    project: Project,
    options: ProposalOptions = {},
    control: RunControl = {},
  ): Promise<SizeProposal> {
    this.#begin(control);
    refuse([...checkProject(project), ...checkProposalOptions(options)]);
    const model = projectArrays(project);
    const id = this.#nextId();
    const question = { kind: "propose", id, model, options: engineProposalOptions(options) } as const;
    const answer = await this.#ask(question, control);
    return { size: answer.size, sources: projectSources(answer.sourceTypes, answer.sourceValues) };
  }

  async backgroundFromMesh(
    mesh: Pick<VolumeMesh, "points" | "tetrahedra">,
    options: { readonly sizes?: Float64Array | undefined } = {},
    control: RunControl = {},
  ): Promise<BackgroundArrays> {
    this.#begin(control);
    refuse(checkGridOptions(options));
    const { sizes } = options;
    refuse(checkVolume(mesh, sizes));
    const { points, tetrahedra } = mesh;
    const id = this.#nextId();
    const question = {
      kind: "background-from-mesh",
      id,
      points: points.slice(),
      tetrahedra: tetrahedra.slice(),
      sizes: sizes?.slice() ?? new Float64Array(),
    } as const;
    return this.#ask(question, control);
  }

  async inspectSurface(
    surface: SurfaceInput,
    options: InspectionOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceInspection> {
    this.#begin(control);
    refuse([...checkSurface(surface), ...checkInspectionOptions(options)]);
    const question = {
      kind: "inspect-surface",
      id: this.#nextId(),
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      ...engineInspectionOptions(options),
    } as const;
    const found = await this.#ask(question, control);
    return inSteps(describedInspection(found, surface, surfaceNamer(surface)), control.signal);
  }

  async repairSurface(
    surface: SurfaceInput,
    options: RepairOptions = {},
    control: RunControl = {},
  ): Promise<SurfaceRepair> {
    this.#begin(control);
    refuse([...checkSurface(surface), ...checkRepairOptions(options)]);
    refuse(checkWeld(surface, options.weld));
    const [points, triangles] = [surface.points.slice(), surface.triangles.slice()];
    const id = this.#nextId();
    const question = {
      kind: "repair-surface",
      id,
      points,
      triangles,
      options: engineRepairOptions(options),
    } as const;
    const repair = await this.#ask(question, control);
    refuse(changeDiagnostics(repair));
    return describedRepair(repair, points.length / 3);
  }

  async refineSurface(
    surface: SurfaceInput,
    options: RefineOptions,
    control: RunControl = {},
  ): Promise<SurfaceRefinement> {
    this.#begin(control);
    refuse([...checkSurface(surface), ...checkRefineOptions(options)]);
    const { volume = 0, ...withoutVolume } = options;
    const { background } = withoutVolume;
    const question = {
      kind: "refine-surface",
      id: this.#nextId(),
      points: surface.points.slice(),
      triangles: surface.triangles.slice(),
      grid: background === undefined ? emptyGrid() : withNodes(emptyGrid(), background),
      options: engineOptions(withoutVolume),
      volume,
    } as const;
    const refinement = await this.#ask(question, control);
    refuse(changeDiagnostics(refinement));
    return describedRefinement(refinement);
  }

  async inspectMesh(mesh: MeshInput, control: RunControl = {}): Promise<MeshInspection> {
    this.#begin(control);
    refuse(checkMesh(mesh));
    const { points, tetrahedra, regions = new Uint32Array() } = mesh;
    const question = {
      kind: "inspect-mesh",
      id: this.#nextId(),
      points: points.slice(),
      tetrahedra: tetrahedra.slice(),
      regions: regions.slice(),
    } as const;
    const found = await this.#ask(question, control);
    if (!found.isReadable) refuse([unreadableMesh()]);
    return describedMesh(found, mesh.invertedTetrahedra?.length);
  }

  dispose(): void {
    this.#close(
      () => disposedError(true),
      () => disposedError(false),
    );
  }

  /** `failure` is of the calls under way, `afterwards` of those still to come. */
  #close(failure: () => MesherError, afterwards = failure): void {
    if (this.#closed !== undefined) return;
    this.#closed = afterwards;
    clearTimeout(this.#forceTimer);
    this.#worker.terminate();
    this.#settleReady?.reject(failure());
    this.#settleReady = undefined;
    this.#rejectUnderWay(failure);
    for (const job of this.#waiting.splice(0)) job.reject(failure());
  }

  /** Before anything is looked at and copied, which takes its time where it is large: throws where that would be in vain. */
  #begin(control: RunControl): void {
    refuse(checkControl(control));
    if (this.#closed !== undefined) throw this.#closed();
    throwIfCancelled(control.signal);
  }

  /** As `#begin` for runs: the result of one that would be in vain. */
  #endedEarly(control: RunControl): MeshResult | undefined {
    const wrong = checkControl(control);
    if (wrong.length > 0) return emptyResult("invalid-input", wrong);
    if (this.#closed !== undefined) throw this.#closed();
    return control.signal?.aborted === true ? emptyResult("cancelled") : undefined;
  }

  /** The arrays are copies of the caller's, and are not transferred: a new worker may have to be asked again. */
  async #ask<Kind extends keyof Answers>(
    question: Question & { readonly kind: Kind },
    { signal, onProgress }: RunControl,
  ): Promise<Answers[Kind]> {
    const onAbort = () => signal && this.#abandon(question.id, cancelledError(signal));
    try {
      return await new Promise((resolve, reject) => {
        signal?.addEventListener("abort", onAbort, { once: true });
        this.#questions.set(question.id, {
          question,
          onProgress,
          receive: (reply) => isAnswerTo(question.kind, reply) && resolve(reply.answer),
          reject,
        });
        this.#worker.post(question, []);
        this.#updateKeepAlive();
      });
    } finally {
      signal?.removeEventListener("abort", onAbort);
    }
  }

  /** Nobody waits for the answer any more. */
  #abandon(id: number, reason: unknown): void {
    const open = this.#questions.get(id);
    if (open === undefined) return;
    this.#questions.delete(id);
    open.reject(reason);
    this.#worker.post({ kind: "cancel", id }, []);
    this.#updateKeepAlive();
  }

  async #run(
    request: RunRequest,
    { signal, onProgress, onFront }: RunControl,
    name: EntityNamer,
  ): Promise<MeshResult> {
    let onAbort: (() => void) | undefined;
    try {
      const result = await new Promise<EngineResult | Cancelled>((resolve, reject) => {
        const triangles = trianglesIn(request);
        const told = { began: undefined, progress: undefined };
        const job: Job = { request, triangles, onProgress, onFront, ...told, resolve, reject };
        onAbort = () => this.#cancel(job);
        signal?.addEventListener("abort", onAbort, { once: true });
        this.#waiting.push(job);
        this.#startNext();
      });
      return "cancelledAfterSeconds" in result
        ? emptyResult("cancelled", [], result.cancelledAfterSeconds)
        : describedResult(result, name);
    } finally {
      if (onAbort !== undefined) signal?.removeEventListener("abort", onAbort);
    }
  }

  #startNext(): void {
    if (this.#active === undefined && this.#closed === undefined) {
      this.#active = this.#waiting.shift();
      if (this.#active !== undefined) {
        const { request } = this.#active;
        this.#active.began = performance.now();
        const holder = request.kind === "mesh-model" ? request.model : request;
        this.#worker.post(request, buffersOf(holder, holder.grid));
      }
    }
    this.#updateKeepAlive();
  }

  #cancel(job: Job): void {
    if (this.#active !== job) {
      const place = this.#waiting.indexOf(job);
      if (place >= 0) this.#waiting.splice(place, 1);
      return job.resolve({ cancelledAfterSeconds: 0 });
    }
    this.#worker.post({ kind: "cancel", id: job.request.id }, []);
    clearTimeout(this.#forceTimer);
    this.#forceTimer = setTimeout(() => {
      this.#forceTimer = setTimeout(() => this.#cancelByForce(job), LAST_HEARING_MS);
    }, CANCEL_GRACE_MS);
  }

  #cancelByForce(job: Job): void {
    this.#worker.terminate();
    this.#worker = this.#startWorker();
    const now = performance.now();
    try {
      for (const { question } of this.#questions.values()) this.#worker.post(question, []);
    } finally {
      this.#finish(() => job.resolve({ cancelledAfterSeconds: (now - (job.began ?? now)) / 1000 }));
    }
  }

  /** The active job is over, in whatever way `settle` says; the next one begins. */
  #finish(settle: () => void): void {
    clearTimeout(this.#forceTimer);
    this.#active = undefined;
    settle();
    this.#startNext();
  }

  #startWorker(): EngineWorker {
    return new EngineWorker({
      onReady: () => {
        this.#settleReady?.resolve();
        this.#settleReady = undefined;
        this.#updateKeepAlive();
      },
      onReply: (reply) => this.#receive(reply),
      onCrash: (failure) => this.#replaceWorker(failure),
      onUnusable: (failure) => this.#close(failure),
    });
  }

  #receive(reply: WorkReply): void {
    switch (reply.kind) {
      case "failure":
        return this.#failAll(reply);
      case "answer":
        return this.#receiveAnswer(reply);
      case "progress":
      case "front":
      case "stopping":
      case "result":
        return this.#receiveForRun(reply);
    }
  }

  #receiveAnswer(reply: Answer): void {
    const open = this.#questions.get(reply.id);
    if (open?.question.kind !== reply.question) return;
    this.#questions.delete(reply.id);
    open.receive(reply);
    this.#updateKeepAlive();
  }

  /** The failure of a call that nobody waits for is ignored, unless it takes the engine with it. */
  #failAll(reply: Extract<WorkReply, { kind: "failure" }>): void {
    const isAwaited = this.#active?.request.id === reply.id || this.#questions.has(reply.id);
    if (!isAwaited && !reply.isEngineLost) return;
    const question = this.#questions.get(reply.id)?.question;
    const triangles = question === undefined ? (this.#active?.triangles ?? 0) : trianglesIn(question);
    this.#replaceWorker((progress) => failureError(reply, progress, triangles));
  }

  #receiveForRun(reply: Extract<WorkReply, { kind: "progress" | "front" | "stopping" | "result" }>): void {
    const open = this.#questions.get(reply.id);
    if (open !== undefined && reply.kind === "progress") {
      return notify(open, open.onProgress, reply.progress, (failure) => this.#abandon(reply.id, failure));
    }
    const job = this.#active;
    if (job?.request.id !== reply.id) return;
    const onFailure = (failure: unknown): void => {
      job.reject(failure);
      this.#cancel(job);
    };
    switch (reply.kind) {
      case "progress":
        job.progress = reply.progress;
        return notify(job, job.onProgress, reply.progress, onFailure);
      case "front":
        return notify(job, job.onFront, reply.corners, onFailure);
      case "stopping":
        return clearTimeout(this.#forceTimer);
      case "result":
        return this.#finish(() => job.resolve(reply.result));
    }
  }

  /** What was under way is rejected, for it may be the cause; what waits gets a fresh worker. */
  #replaceWorker(failure: FailureAt): void {
    clearTimeout(this.#forceTimer);
    this.#worker.terminate();
    this.#worker = this.#startWorker();
    this.#rejectUnderWay(failure);
    this.#startNext();
  }

  #rejectUnderWay(failure: FailureAt): void {
    this.#active?.reject(failure(this.#active.progress));
    this.#active = undefined;
    for (const question of this.#questions.values()) question.reject(failure(undefined));
    this.#questions.clear();
  }

  #updateKeepAlive(): void {
    const isBusy = this.#active !== undefined || this.#questions.size > 0 || this.#settleReady !== undefined;
    this.#worker.keepAlive(isBusy);
  }

  #nextId(): number {
    return ++this.#lastId;
  }
}

function isAnswerTo<Kind extends keyof Answers>(kind: Kind, reply: Answer): reply is Answer & AnswerTo<Kind> {
  return reply.question === kind;
}

/** Of the surface that a request brings; 0 without one. */
function trianglesIn(request: Request): number {
  return "triangles" in request ? request.triangles.length / 3 : 0;
}
