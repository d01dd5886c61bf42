// npm run preview: serves the built site. PORT (default 4173) and HOST (default 127.0.0.1) select the address. If
// the port is busy, the next free one is used, unless TETRAFRONT_STRICT_PORT is set.
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { inRoot } from "./lib/paths.mjs";
import { main, UserError } from "./lib/run.mjs";

const kDefaultPort = 4173;

export async function preview() {
  if (!existsSync(inRoot("web", "dist", "index.html"))) {
    throw new UserError("The site is not built yet: npm run build (or npm start, which does both)");
  }
  const port = Number(process.env.PORT ?? kDefaultPort);
  if (!Number.isInteger(port) || port < 0 || port > 65535) {
    throw new UserError(`PORT=${process.env.PORT} is not a port number`);
  }
  const { preview: serve } = await import("vite");
  const server = await serve({
    root: inRoot("web"),
    preview: {
      port,
      host: process.env.HOST ?? "127.0.0.1",
      strictPort: process.env.TETRAFRONT_STRICT_PORT !== undefined,
    },
  });
  const url = server.resolvedUrls?.local[0] ?? server.resolvedUrls?.network[0];
  process.stdout.write(`Tetrafront runs at ${url}  (Ctrl+C stops it)\n`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main(preview);
