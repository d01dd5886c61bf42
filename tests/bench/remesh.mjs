// Prints how long it takes to remesh parts as CAD programs export them into about 50 000 triangles, through the package in
// Node and in a page of Chromium. Seconds are wall-clock time, the shortest of several runs; the first of them also compiles
// the engine. The goal in a browser is 6 s. CHROMIUM is the path of a browser; without it, the one of Playwright is used.
import { chromium } from "@playwright/test";
import { createMesher } from "tetrafront";
import { createServer } from "vite";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";
import { NEEDLE_PARTS } from "./support/needle-parts.mjs";

/** Edge length at which a part gets about 50 000 triangles. */
const SIZES = { "round bar, 200 sectors": 0.045, "thin tube": 0.04, "wheel with a thin web": 0.0235 };
const RUNS = 3;

/** Remeshes a surface several times; also runs in the page. */
async function measure({ createMesher, points, triangles, size, runs }) {
  const mesher = await createMesher();
  const surface = { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
  const seconds = [];
  let made = 0;
  for (let run = 0; run < runs; ++run) {
    const began = performance.now();
    const remesh = await mesher.remeshSurface(surface, { size });
    seconds.push((performance.now() - began) / 1000);
    made = remesh.mesh.triangles.length / 3;
  }
  mesher.dispose();
  return { triangles: made, seconds: Math.min(...seconds) };
}

/** An empty page that may import modules of the project. */
const emptyPage = {
  name: "empty-page",
  configureServer: (server) => {
    server.middlewares.use("/empty", (_, response) => {
      response.setHeader("Content-Type", "text/html");
      response.end("<!doctype html><title>remesh</title>");
    });
  },
};

const server = await createServer({
  root: inRoot(),
  configFile: false,
  appType: "custom",
  logLevel: "error",
  plugins: [emptyPage],
  server: { port: 0, host: "127.0.0.1", hmr: false, ws: false },
  optimizeDeps: { noDiscovery: true },
});
await server.listen();
const browser = await chromium.launch(config.use.launchOptions);
try {
  const page = await browser.newPage();
  await page.goto(`${server.resolvedUrls.local[0]}empty`);
  await page.evaluate(`globalThis.measure = ${measure}`);
  console.log(`| part | triangles | Node ${process.version} [s] | Chromium ${browser.version()} [s] |`);
  console.log("| --- | ---: | ---: | ---: |");
  for (const [name, size] of Object.entries(SIZES)) {
    const { points, triangles } = NEEDLE_PARTS[name]();
    const given = { points: [...points], triangles: [...triangles], size, runs: RUNS };
    const inNode = await measure({ createMesher, ...given });
    const inPage = await page.evaluate(async (given) => {
      const { createMesher } = await import("/wasm/dist/index.js");
      return globalThis.measure({ createMesher, ...given });
    }, given);
    if (inNode.triangles !== inPage.triangles) throw new Error(`${name}: Node and Chromium disagree`);
    console.log(
      `| ${name} | ${inNode.triangles} | ${inNode.seconds.toFixed(2)} | ${inPage.seconds.toFixed(2)} |`,
    );
  }
} finally {
  await browser.close();
  await server.close();
}
