import { ENDED, watchLife, type LifeReply } from "../calls/worker-life.js";
import type { CadHost } from "./cad-host.js";
import { crashOf } from "./crash.js";
import type { CadProgress, CadReply } from "./protocol.js";

const ADDRESSES =
  "pass their addresses to setCadLibrary(), and let the Content-Security-Policy allow 'unsafe-eval'.";

export const cadHost: CadHost = {
  remedyFor: (format) =>
    format === "iges"
      ? `Serve occt-import-js.js and occt-import-js.wasm of the package occt-import-js 0.0.23, ${ADDRESSES}`
      : `Serve replicad_single.js and replicad_single.wasm of the package replicad-opencascadejs 1.1.0 (\`kernel\`) and occt-import-js 0.0.23, ${ADDRESSES}`,
  start: (events) => {
    // Bundlers recognize the worker by exactly this expression.
    const worker = new Worker(new URL("./cad-worker.js", import.meta.url), {
      type: "module",
      name: "tetrafront-cad",
    });
    const life = watchLife(() => events.onCrash({ kind: "out-of-memory", message: ENDED }));
    worker.onmessage = ({ data }: MessageEvent<CadReply | CadProgress | LifeReply>) =>
      data.kind === "lives" ? life?.begin() : events.onReply(data);
    if (life !== undefined) worker.postMessage(life.request);
    worker.onmessageerror = () =>
      events.onCrash({ kind: "failed", message: "a reply could not be received" });
    worker.onerror = (event) => {
      event.preventDefault();
      const message = event instanceof ErrorEvent ? event.message : "";
      if (message !== "") return events.onCrash(crashOf(new Error(message)));
      // An event without a message is about the script of the worker.
      const unloaded = `the browser could not load its script for ${import.meta.url}`;
      events.onCrash({ kind: "not-loaded", message: unloaded });
    };
    return {
      post: (request) => worker.postMessage(request),
      terminate: () => {
        life?.stop();
        worker.terminate();
      },
    };
  },
};
