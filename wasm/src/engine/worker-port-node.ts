import { parentPort } from "node:worker_threads";
import { compile } from "#compile";
import type { Request } from "./protocol.js";
import type { WorkerPort } from "./worker-port.js";

export const workerPort: WorkerPort = {
  compile,
  post: (reply, transfer = []) => parentPort?.postMessage(reply, transfer),
  onRequest: (handle) => {
    parentPort?.on("message", (request: Request) => handle(request));
  },
  letRequestsIn: () => new Promise((resolve) => setImmediate(resolve)),
};
