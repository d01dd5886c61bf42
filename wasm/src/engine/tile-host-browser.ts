import { watchedWorker } from "../calls/watched-worker.js";
import type { TileHost } from "./tile-host.js";
import type { TileReply, TileRequest } from "./tile-protocol.js";

export const tileHost: TileHost = {
  isAvailable: typeof Worker !== "undefined",
  cores: () => navigator.hardwareConcurrency,
  start: (events) =>
    watchedWorker<TileRequest, TileReply>(
      // Bundlers recognize the worker by exactly this expression.
      new Worker(new URL("./tile-worker.js", import.meta.url), {
        type: "module",
        name: "tetrafront-tiles",
      }),
      events,
      import.meta.url,
    ),
};
