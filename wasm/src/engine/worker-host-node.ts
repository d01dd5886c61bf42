import { Worker } from "node:worker_threads";
import type { Reply } from "./protocol.js";
import type { LoadRemedies, StartWorker } from "./worker-host.js";

export const loadRemedies: LoadRemedies = {
  worker: "Install the package again; a bundle of it for Node needs worker.js beside it.",
  engine:
    "Install the package again; a bundle of it for Node needs engine.wasm and tools.wasm beside worker.js.",
};

export const startWorker: StartWorker = (events) => {
  const worker = new Worker(new URL("./worker.js", import.meta.url), {
    name: "tetrafront-mesher",
    // Some options of the process, such as --input-type, are errors in a worker, which needs none.
    execArgv: [],
  });
  let terminated = false;
  worker.on("message", (reply: Reply) => events.onReply(reply));
  worker.on("error", (failure: unknown) => events.onCrash(String(failure)));
  worker.on("exit", (code) => {
    if (!terminated) events.onCrash(`the worker ended with code ${code}`);
  });
  return {
    post: (request, transfer) => worker.postMessage(request, transfer),
    keepAlive: (isBusy) => (isBusy ? worker.ref() : worker.unref()),
    terminate: () => {
      terminated = true;
      void worker.terminate();
    },
  };
};
