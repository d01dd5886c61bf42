/** A worker with an engine. Reports once if the engine cannot be used; a terminated worker reports nothing. */
import { loadRemedies, startWorker } from "#worker-host";
import { requestEngine, settleEngine, type EngineLoader } from "./shared-engine.js";
import { crashError, type MesherError, notLoadedError } from "../diagnostics/mesher-error.js";
import type { Reply, Request } from "./protocol.js";
import type { WorkerHandle } from "./worker-host.js";

/** Replies of a worker that is ready. */
export type WorkReply = Exclude<Reply, { kind: "ready" | "unusable" }>;

export interface EngineWorkerEvents {
  onReady(): void;
  onReply(reply: WorkReply): void;
  /** The worker ended after it was ready; a new one may work. */
  onCrash(failure: () => MesherError): void;
  /** The worker never became ready; a new one would fail in the same way. */
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

  /** A request sent before the worker is ready waits in it. */
  post(request: Request, transfer: readonly ArrayBuffer[]): void {
    this.#handle?.post(request, transfer);
  }

  /** False lets the process end although the worker lives. */
  keepAlive(isBusy: boolean): void {
    this.#handle?.keepAlive(isBusy);
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
