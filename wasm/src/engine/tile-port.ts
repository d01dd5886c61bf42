/** The creator of a worker that optimizes tiles as the worker sees it, the same in browsers and Node. */
import type { TileReply, TileRequest } from "./tile-protocol.js";

export interface TilePort {
  onRequest(handle: (request: TileRequest) => void): void;
  post(reply: TileReply, transfer: readonly ArrayBuffer[]): void;
}
