import { Worker } from "node:worker_threads";
import type { CadHost } from "./cad-host.js";
import { crashOf } from "./crash.js";
import type { CadLoaded, CadReply } from "./protocol.js";

export const cadHost: CadHost = {
  remedyFor: (format) =>
    `Install the optional package that reads ${format === "iges" ? "IGES" : "STEP and BREP"} files: npm install ${format === "iges" ? "occt-import-js@0.0.23" : "replicad-opencascadejs@1.1.0"}`,
  start: (events) => {
    const worker = new Worker(new URL("./cad-worker.js", import.meta.url), {
      name: "tetrafront-cad",
      execArgv: [],
    });
    let isOver = false;
    worker.on("message", (reply: CadReply | CadLoaded) => events.onReply(reply));
    worker.on("error", (failure: unknown) => events.onCrash(crashOf(failure)));
    worker.on("exit", (code) => {
      if (!isOver) events.onCrash({ kind: "failed", message: `the worker ended with code ${code}` });
    });
    return {
      post: (request) => worker.postMessage(request),
      terminate: () => {
        isOver = true;
        void worker.terminate();
      },
    };
  },
};
