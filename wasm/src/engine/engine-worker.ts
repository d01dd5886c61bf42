/** A worker with an engine in it, or why there is none: told once, and nothing more of a worker that is ended. */
import { loadRemedies, startWorker } from "#worker-host";
import { requestEngine, settleEngine, type EngineLoader } from "./shared-engine.js";
import { crashError, type MesherError, notLoadedError } from "../diagnostics/mesher-error.js";
import type { Reply, Request } from "./protocol.js";
import type { WorkerHandle } from "./worker-host.js";

/** Of a worker that is ready. */
export type WorkReply = Exclude<Reply, { kind: "ready" | "unusable" }>;

export interface EngineWorkerEvents {
  onReady(): void;
  onReply(reply: WorkReply): void;
  /** It has ended, after it was ready; another one may do better. */
  onCrash(failure: () => MesherError): void;
  /** It never was ready, and another one would do no better. */
  onUnusable(failure: () => MesherError): void;
}

export class EngineWorker {
  readonly #events: EngineWorkerEvents;
  readonly #handle: WorkerHandle | undefined;
  readonly #loader: EngineLoader = {
    load: (module) => this.#handle?.post({ kind: "load", module }, []),
  };
  #isReady = false;
  #isOver = false;

  constructor(events: EngineWorkerEvents) {
    this.#events = events;
    try {
      this.#handle = startWorker({
        onReply: (reply) => this.#receive(reply),
        onCrash: (message) =>
          this.#end(() =>
            this.#isReady ? crashError(message) : notLoadedError("worker", message, loadRemedies.worker),
          ),
      });
    } catch (failure) {
      queueMicrotask(() => this.#end(() => notLoadedError("worker", String(failure), loadRemedies.worker)));
      return;
    }
    requestEngine(this.#loader);
  }

  /** Requests sent before it is ready wait for that. */
  post(request: Request, transfer: readonly ArrayBuffer[]): void {
    this.#handle?.post(request, transfer);
  }

  /** Whether a process may end although the worker lives. */
  keepAlive(wanted: boolean): void {
    this.#handle?.keepAlive(wanted);
  }

  terminate(): void {
    this.#isOver = true;
    this.#handle?.terminate();
    settleEngine(this.#loader, undefined);
  }

  #receive(reply: Reply): void {
    if (this.#isOver) return;
    switch (reply.kind) {
      case "ready":
        this.#isReady = true;
        settleEngine(this.#loader, reply.module);
        return this.#events.onReady();
      case "unusable":
        return this.#end(() => notLoadedError("engine", reply.message, loadRemedies.engine));
      default:
        return this.#events.onReply(reply);
    }
  }

  #end(failure: () => MesherError): void {
    if (this.#isOver) return;
    this.terminate();
    if (this.#isReady) this.#events.onCrash(failure);
    else this.#events.onUnusable(failure);
  }
}
