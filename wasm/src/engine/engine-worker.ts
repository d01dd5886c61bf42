/** A worker with an engine. Reports once if the engine cannot be used; a terminated worker reports nothing. */
import { loadRemedies, startWorker } from "#worker-host";
import { sharedCode, type CodeLoader } from "./shared-code.js";
import { crashError, type MesherError, notLoadedError } from "../diagnostics/mesher-error.js";
import { MODULE_NAMES, type ModuleName, type Reply, type Request } from "./protocol.js";
import type { WorkerHandle } from "./worker-host.js";

/** Replies of a worker that is ready. */
export type WorkReply = Exclude<Reply, { kind: "wanted" | "ready" | "unusable" | "unanswerable" }>;

export interface EngineWorkerEvents {
  onReady(): void;
  onReply(reply: WorkReply): void;
  /** The call with this id failed, because the part of the engine that it needs could not be loaded. */
  onUnanswerable(id: number, failure: MesherError): void;
  /** The worker ended after it was ready; a new one may work. */
  onCrash(failure: () => MesherError): void;
  /** The worker never became ready; a new one would fail in the same way. */
  onUnusable(failure: () => MesherError): void;
}

export class EngineWorker {
  readonly #events: EngineWorkerEvents;
  readonly #handle: WorkerHandle | undefined;
  readonly #loaders: { readonly [Name in ModuleName]: CodeLoader } = {
    engine: { load: (module) => this.#handle?.post({ kind: "load", name: "engine", module }, []) },
    tools: { load: (module) => this.#handle?.post({ kind: "load", name: "tools", module }, []) },
    trace: { load: (module) => this.#handle?.post({ kind: "load", name: "trace", module }, []) },
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
    sharedCode.engine.request(this.#loaders.engine);
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
    for (const name of MODULE_NAMES) sharedCode[name].settle(this.#loaders[name], undefined);
  }

  #receive(reply: Reply): void {
    if (this.#isOver) return;
    switch (reply.kind) {
      case "wanted":
        return sharedCode[reply.name].request(this.#loaders[reply.name]);
      case "ready":
        sharedCode[reply.name].settle(this.#loaders[reply.name], reply.module);
        return reply.name === "engine" ? this.#becomeReady() : undefined;
      case "unusable":
        sharedCode[reply.name].settle(this.#loaders[reply.name], undefined);
        return reply.name === "engine" ? this.#end(() => engineError(reply.message)) : undefined;
      case "unanswerable":
        return this.#events.onUnanswerable(reply.id, engineError(reply.message));
      default:
        return this.#events.onReply(reply);
    }
  }

  #becomeReady(): void {
    this.#isReady = true;
    this.#events.onReady();
  }

  #end(failure: () => MesherError): void {
    if (this.#isOver) return;
    this.terminate();
    if (this.#isReady) this.#events.onCrash(failure);
    else this.#events.onUnusable(failure);
  }
}

function engineError(reason: string): MesherError {
  return notLoadedError("engine", reason, loadRemedies.engine);
}
