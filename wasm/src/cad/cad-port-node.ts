import { createRequire } from "node:module";
import { parentPort } from "node:worker_threads";
import type { CadPort } from "./cad-port.js";
import { loadKernel } from "./kernel-node.js";
import type { CreateOpenCascade } from "./opencascade.js";
import type { CadRequest } from "./protocol.js";

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
