import { watchedWorker } from "../calls/watched-worker.js";
import type { Reply, Request } from "./protocol.js";
import type { LoadRemedies, StartWorker } from "./worker-host.js";

export const loadRemedies: LoadRemedies = {
  worker:
    "Serve worker.js of the package, and the scripts that it imports, from the page's own origin, and let its Content-Security-Policy allow workers without trusted types.",
  engine:
    "Serve engine.wasm, tools.wasm and tools.js of the package (to record traces, trace.wasm and trace.js too), and let the Content-Security-Policy allow 'wasm-unsafe-eval' and to connect to them.",
};

export const startWorker: StartWorker = (events) => {
  const worker = watchedWorker<Request, Reply>(
    // Bundlers recognize the worker by exactly this expression.
    new Worker(new URL("./worker.js", import.meta.url), {
      type: "module",
      name: "tetrafront-mesher",
    }),
    events,
    import.meta.url,
  );
  return { ...worker, keepAlive: () => undefined };
};
