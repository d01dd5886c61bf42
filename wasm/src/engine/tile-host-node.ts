import { availableParallelism } from "node:os";
import { Worker } from "node:worker_threads";
import type { TileHost } from "./tile-host.js";
import type { TileReply } from "./tile-protocol.js";

export const tileHost: TileHost = {
  isAvailable: true,
  cores: availableParallelism,
  start: (events) => {
    const worker = new Worker(new URL("./tile-worker.js", import.meta.url), {
      name: "tetrafront-tiles",
      // Some options of the process, such as --input-type, are errors in a worker, which needs none.
      execArgv: [],
    });
    let isTerminated = false;
    worker.on("message", (reply: TileReply) => events.onReply(reply));
    worker.on("error", (failure: unknown) => events.onCrash(String(failure)));
    worker.on("exit", (code) => {
      if (!isTerminated) events.onCrash(`the worker ended with code ${code}`);
    });
    return {
      post: (request, transfer) => worker.postMessage(request, transfer),
      terminate: () => {
        isTerminated = true;
        void worker.terminate();
      },
    };
  },
};
