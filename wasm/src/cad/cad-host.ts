/** The worker of a CAD file as its creator sees it, the same in browsers and Node. */
import type { CadCrash, CadLoaded, CadReply, CadRequest } from "./protocol.js";

export interface CadWorker {
  post(request: CadRequest): void;
  terminate(): void;
}

export interface CadWorkerEvents {
  onReply(reply: CadReply | CadLoaded): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(crash: CadCrash): void;
}

export interface CadHost {
  readonly start: (events: CadWorkerEvents) => CadWorker;
  /** What to do if the worker or the library cannot be loaded. */
  readonly remedy: string;
}
