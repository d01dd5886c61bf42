/** The worker as its creator sees it, the same in browsers and Node. */
import type { Reply, Request } from "./protocol.js";

export interface WorkerHandle {
  post(request: Request, transfer: readonly ArrayBuffer[]): void;
  /** False lets the process end although the worker lives. Has no effect in browsers. */
  keepAlive(isBusy: boolean): void;
  terminate(): void;
}

export interface WorkerEvents {
  onReply(reply: Reply): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(message: string): void;
}

/** Remedies if the worker's script or the engine cannot be loaded. */
export interface LoadRemedies {
  readonly worker: string;
  readonly engine: string;
}

export type StartWorker = (events: WorkerEvents) => WorkerHandle;
