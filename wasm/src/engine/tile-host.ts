/** A worker that optimizes tiles, as its creator sees it, the same in browsers and Node. */
import type { TileReply, TileRequest } from "./tile-protocol.js";

export interface TileWorker {
  post(request: TileRequest, transfer: readonly ArrayBuffer[]): void;
  terminate(): void;
}

export interface TileWorkerEvents {
  onReply(reply: TileReply): void;
  /** The worker ended by itself; no reply will follow. */
  onCrash(message: string): void;
}

export interface TileHost {
  /** False in browsers whose workers cannot start workers. */
  readonly isAvailable: boolean;
  /** Returns how many threads of the machine this process may use. */
  readonly cores: () => number;
  readonly start: (events: TileWorkerEvents) => TileWorker;
}
