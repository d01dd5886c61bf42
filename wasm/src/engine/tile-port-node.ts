import { parentPort } from "node:worker_threads";
import type { TilePort } from "./tile-port.js";
import type { TileRequest } from "./tile-protocol.js";

export const tilePort: TilePort = {
  onRequest: (handle) => {
    parentPort?.on("message", (request: TileRequest) => handle(request));
  },
  post: (reply, transfer) => parentPort?.postMessage(reply, transfer),
};
