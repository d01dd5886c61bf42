import { ENDED, watchLife, type LifeReply } from "../calls/worker-life.js";
import type { Reply } from "./protocol.js";
import type { LoadRemedies, StartWorker } from "./worker-host.js";

export const loadRemedies: LoadRemedies = {
  worker:
    "Serve worker.js of the package, and the scripts that it imports, from the page's own origin, and let its Content-Security-Policy allow workers without trusted types.",
  engine:
    "Serve engine.wasm, tools.wasm and tools.js of the package (to record traces, trace.wasm and trace.js too), and let the Content-Security-Policy allow 'wasm-unsafe-eval' and to connect to them.",
};

export const startWorker: StartWorker = (events) => {
  // Bundlers recognize the worker by exactly this expression.
  const worker = new Worker(new URL("./worker.js", import.meta.url), {
    type: "module",
    name: "tetrafront-mesher",
  });
  const life = watchLife(() => events.onCrash(ENDED));
  worker.onmessage = ({ data }: MessageEvent<Reply | LifeReply>) =>
    data.kind === "lives" ? life?.begin() : events.onReply(data);
  if (life !== undefined) worker.postMessage(life.request);
  worker.onmessageerror = () => events.onCrash("a reply could not be received");
  worker.onerror = (event) => {
    event.preventDefault();
    // If the script could not be loaded, the event has no message. Only the bundler knows the script's address.
    const message = event instanceof ErrorEvent ? event.message : "";
    events.onCrash(
      message || `the browser could not load its script, or a script that it imports, for ${import.meta.url}`,
    );
  };
  return {
    post: (request, transfer) => worker.postMessage(request, [...transfer]),
    keepAlive: () => undefined,
    terminate: () => {
      life?.stop();
      worker.terminate();
    },
  };
};
