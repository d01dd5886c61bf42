/** The worker as its maker sees it, the same in browsers and Node. */
import type { Reply, Request } from "./protocol.js";

export interface WorkerHandle {
  post(request: Request, transfer: readonly ArrayBuffer[]): void;
  /** Whether a process may end although the worker lives. Browsers have no use for it. */
  keepAlive(wanted: boolean): void;
  terminate(): void;
}

export interface WorkerEvents {
  onReply(reply: Reply): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(message: string): void;
}

/** What to do where the one or the other cannot be had. */
export interface LoadRemedies {
  readonly worker: string;
  readonly engine: string;
}

export type StartWorker = (events: WorkerEvents) => WorkerHandle;
