import { createServer } from "vite";
import { inRoot } from "../../../scripts/lib/paths.mjs";

/** Starts a server that loads TypeScript modules of the project; the caller closes it. */
export const moduleServer = () =>
  createServer({
    root: inRoot(),
    configFile: false,
    appType: "custom",
    logLevel: "error",
    server: { middlewareMode: true, hmr: false, ws: false },
    optimizeDeps: { noDiscovery: true },
  });
