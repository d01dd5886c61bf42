import { createRequire } from "node:module";
import { parentPort, Worker } from "node:worker_threads";
import type { CadPort } from "./cad-port.js";
import { USAGE_PIPE } from "./cad-process.js";
import { crashOf } from "./crash.js";
import { loadKernel } from "./kernel-node.js";
import type { CreateOpenCascade } from "./opencascade.js";
import type { CadRequest } from "./protocol.js";

/**
 * Ends this process when its creator is gone. It runs in a thread, because the library is busy for long, with some damaged files
 * forever: until it returns, no event reaches the thread that called it. On Windows, a process keeps the number of a creator that is gone.
 * A byte to the creator stands for each second of processor time.
 */
const WATCH = `
const { writeSync } = require("node:fs");
const { workerData: creator } = require("node:worker_threads");
function isThere() {
  if (process.platform !== "win32") return process.ppid === creator;
  try {
    return process.kill(creator, 0);
  } catch {
    return false;
  }
}
let reported = 0;
function report() {
  const { user, system } = process.cpuUsage();
  try {
    for (; reported + 1 <= (user + system) / 1e6; reported++) writeSync(${USAGE_PIPE}, ".");
  } catch {
    // Nobody reads it any more; this thread must still end the process.
    reported = Infinity;
  }
}
setInterval(() => (isThere() ? report() : process.kill(process.pid, "SIGKILL")), 1000);
`;

// As a process: a thread reports its errors by itself, and ends with its process.
if (parentPort === null) {
  // The exit code alone would not tell what failed.
  process.on("uncaughtException", (failure) => process.send?.(crashOf(failure)));
  process.on("disconnect", () => process.exit());
  new Worker(WATCH, { eval: true, workerData: process.ppid }).unref();
}

export const cadPort: CadPort = {
  onRequest: (handle) => {
    (parentPort ?? process).on("message", (request: CadRequest) => handle(request));
  },
  post: (reply, transfer) => {
    if (parentPort === null) process.send?.(reply);
    else parentPort.postMessage(reply, transfer);
  },
  library: () =>
    Promise.resolve({
      create: createRequire(import.meta.url)("occt-import-js") as CreateOpenCascade,
      options: {},
    }),
  kernel: loadKernel,
};
