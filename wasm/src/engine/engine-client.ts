/**
 * The client of the worker: any number of questions at once, one run at a time; progress, cancellation, and a new worker
 * if it has failed or does not answer.
 */
import type { CallProgress } from "../base/progress.js";
import type { PartialControl } from "./control.js";
import { notify, type ProgressListener, type RunListeners } from "./progress-listener.js";
import {
  cancelledError,
  disposedError,
  failureError,
  type MesherError,
} from "../diagnostics/mesher-error.js";
import { EngineWorker, type WorkReply } from "./engine-worker.js";
import { type AnswerOf, type ArgumentsOf, type CallName, trianglesIn } from "./calls.js";
import type { Answer, BlockRequest, EngineResult, Question, Request } from "./protocol.js";
import { buffersOf } from "./transfer.js";

type RunReply = Extract<
  WorkReply,
  { kind: "progress" | "front" | "trace" | "unoptimized" | "stopping" | "result" }
>;

/** Time for the worker to confirm a cancellation. Then it is terminated, within the promised half second. */
const CANCEL_GRACE_MS = 450;
/** Time to receive replies that the worker sent before this thread, if busy, could handle them. */
const LAST_REPLIES_MS = 5;

export type RunRequest = Extract<Request, { kind: "mesh-model" | "fill-surface" }>;
interface Job extends ProgressListener {
  readonly request: RunRequest;
  /** Number of triangles of the given surface; the arrays of the request are transferred. */
  readonly triangles: number;
  /** Time at which it was sent to the worker, in milliseconds. */
  began: number | undefined;
  /** Latest reported progress. */
  progress: CallProgress | undefined;
  readonly resolve: (result: EngineResult | Cancelled) => void;
}

/** End of a run that the worker did not confirm. */
export interface Cancelled {
  readonly cancelledAfterSeconds: number;
}

/** Returns the error with which a call rejects; `progress` is the latest of a run. */
type FailureAt = (progress: CallProgress | undefined) => MesherError;

interface OpenQuestion extends ProgressListener {
  readonly question: Question | BlockRequest;
  /** Whether it is to be answered with what has been made so far. */
  isStopped: boolean;
  readonly receive: (reply: Answer) => void;
}

/** One worker with an engine, and the calls that wait for it. */
export class EngineClient {
  readonly ready: Promise<void>;
  #settleReady: { resolve: () => void; reject: (failure: MesherError) => void } | undefined;
  #worker: EngineWorker;
  #lastId = 0;
  #active: Job | undefined;
  readonly #waiting: Job[] = [];
  readonly #questions = new Map<number, OpenQuestion>();
  #forceTimer: ReturnType<typeof setTimeout> | undefined;
  /** Returns why calls are rejected; undefined while the client is open. */
  #closed: (() => MesherError) | undefined;

  constructor() {
    this.ready = new Promise((resolve, reject) => {
      this.#settleReady = { resolve, reject };
    });
    this.#worker = this.#startWorker();
  }

  dispose(): void {
    this.#close(
      () => disposedError(true),
      () => disposedError(false),
    );
  }

  /** Throws if the client is closed. */
  assertOpen(): void {
    if (this.#closed !== undefined) throw this.#closed();
  }

  /** `failure`: for pending calls. `afterwards`: for later calls. */
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

  /** Resolves with the answer. The arrays are not transferred, because the question may have to be sent to a new worker. */
  async ask<Name extends CallName>(
    call: Name,
    given: ArgumentsOf<Name>,
    { signal, onProgress, partial: isPartial = false }: PartialControl,
  ): Promise<AnswerOf<Name>> {
    const question: Question = { kind: "question", id: this.nextId(), call, given };
    const onAbort = () => {
      if (isPartial) this.#stop(question.id);
      else if (signal) this.#abandon(question.id, cancelledError(signal));
    };
    try {
      return await new Promise<AnswerOf<Name>>((resolve, reject) => {
        signal?.addEventListener("abort", onAbort, { once: true });
        this.#questions.set(question.id, {
          question,
          isStopped: false,
          onProgress,
          receive: ({ answer }) => resolve(answer as AnswerOf<Name>),
          reject,
        });
        this.#worker.post(question, []);
        this.#updateKeepAlive();
        if (signal?.aborted === true) onAbort();
      });
    } finally {
      signal?.removeEventListener("abort", onAbort);
    }
  }

  /** Resolves with a part of a mesh that stays in the engine. */
  read<Values>(request: Omit<BlockRequest, "kind" | "id">): Promise<Values> {
    this.assertOpen();
    const question: BlockRequest = { kind: "read", id: this.nextId(), ...request };
    return new Promise<Values>((resolve, reject) => {
      const receive = ({ answer }: Answer) => resolve(answer as Values);
      this.#questions.set(question.id, {
        question,
        isStopped: false,
        onProgress: undefined,
        receive,
        reject,
      });
      this.#worker.post(question, []);
      this.#updateKeepAlive();
    });
  }

  /** Ends the life of the mesh of a run that stays in the engine. */
  release(run: number): void {
    if (this.#closed === undefined) this.#worker.post({ kind: "release", id: run }, []);
  }

  /** Rejects a question whose answer is no longer needed, and cancels its work. */
  #abandon(id: number, reason: unknown): void {
    if (this.#refuse(id, reason)) this.#worker.post({ kind: "cancel", id }, []);
  }

  /** Asks for what has been made so far. */
  #stop(id: number): void {
    const open = this.#questions.get(id);
    if (open === undefined) return;
    open.isStopped = true;
    this.#worker.post({ kind: "stop", id }, []);
  }

  /** Rejects a question; returns false if it is not open. */
  #refuse(id: number, reason: unknown): boolean {
    const open = this.#questions.get(id);
    if (open === undefined) return false;
    this.#questions.delete(id);
    open.reject(reason);
    this.#updateKeepAlive();
    return true;
  }

  /** Resolves when the run ends; the arrays of the request are transferred. */
  async run(
    request: RunRequest,
    { signal, onProgress, onFront, onUnoptimized, onTrace }: RunListeners,
  ): Promise<EngineResult | Cancelled> {
    let onAbort: (() => void) | undefined;
    try {
      return await new Promise<EngineResult | Cancelled>((resolve, reject) => {
        const triangles = trianglesOfRun(request);
        const state = { began: undefined, progress: undefined };
        const listener = { onProgress, onFront, onUnoptimized, onTrace };
        const job: Job = { request, triangles, ...listener, ...state, resolve, reject };
        // The caller may have prepared the run meanwhile.
        if (signal?.aborted === true) return resolve({ cancelledAfterSeconds: 0 });
        onAbort = () => this.#cancel(job);
        signal?.addEventListener("abort", onAbort, { once: true });
        this.#waiting.push(job);
        this.#startNext();
      });
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
        this.#worker.post(request, buffersOf(request));
      }
    }
    this.#updateKeepAlive();
  }

  #cancel(job: Job): void {
    if (this.#active !== job) {
      const index = this.#waiting.indexOf(job);
      if (index >= 0) this.#waiting.splice(index, 1);
      return job.resolve({ cancelledAfterSeconds: 0 });
    }
    this.#worker.post({ kind: "cancel", id: job.request.id }, []);
    clearTimeout(this.#forceTimer);
    this.#forceTimer = setTimeout(() => {
      this.#forceTimer = setTimeout(() => this.#cancelByForce(job), LAST_REPLIES_MS);
    }, CANCEL_GRACE_MS);
  }

  #cancelByForce(job: Job): void {
    this.#worker.terminate();
    this.#worker = this.#startWorker();
    const now = performance.now();
    try {
      for (const { question, isStopped } of this.#questions.values()) {
        this.#worker.post(question, []);
        if (isStopped) this.#worker.post({ kind: "stop", id: question.id }, []);
      }
    } finally {
      this.#finish(() => job.resolve({ cancelledAfterSeconds: (now - (job.began ?? now)) / 1000 }));
    }
  }

  /** Settles the active run and starts the next one. */
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
      onUnanswerable: (id, failure) => this.#refuse(id, failure),
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
      case "trace":
      case "unoptimized":
      case "stopping":
      case "result":
        return this.#receiveForRun(reply);
    }
  }

  #receiveAnswer(reply: Answer): void {
    const open = this.#questions.get(reply.id);
    if (open === undefined) return;
    this.#questions.delete(reply.id);
    open.receive(reply);
    this.#updateKeepAlive();
  }

  /** Ignores the failure of an abandoned call unless the engine is lost. */
  #failAll(reply: Extract<WorkReply, { kind: "failure" }>): void {
    const isAwaited = this.#active?.request.id === reply.id || this.#questions.has(reply.id);
    if (!isAwaited && !reply.isEngineLost) return;
    const question = this.#questions.get(reply.id)?.question;
    const triangles =
      question?.kind !== "question"
        ? (this.#active?.triangles ?? 0)
        : trianglesIn(question.call, question.given);
    this.#replaceWorker((progress) => failureError(reply, progress, triangles));
  }

  #receiveForRun(reply: RunReply): void {
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
      case "trace":
        return notify(job, job.onTrace, reply.events, onFailure);
      case "unoptimized":
        return notify(job, job.onUnoptimized, reply.mesh, onFailure);
      case "stopping":
        return clearTimeout(this.#forceTimer);
      case "result":
        return this.#finish(() => job.resolve(reply.result));
    }
  }

  /** Rejects pending calls, because one of them may be the cause. Waiting runs get the new worker. */
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

  /** Returns a new id for a request. */
  nextId(): number {
    return ++this.#lastId;
  }
}

/** Returns the number of triangles of the surface or the bodies of a run. */
function trianglesOfRun(request: RunRequest): number {
  const { triangles } = request.kind === "mesh-model" ? (request.bodies ?? noBodies) : request;
  return triangles.length / 3;
}

const noBodies = { triangles: new Uint32Array() };
