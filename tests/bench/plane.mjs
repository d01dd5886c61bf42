// Measures fillPlane() while a corner of a polygon is dragged: one fill per position, record included, in Node and in the main thread
// of a page of Chromium. The goal is 50 ms for 150 triangles. Milliseconds are wall-clock time. CHROMIUM is the path of a browser;
// without it, the one of Playwright is used.
import { chromium } from "@playwright/test";
import { loadPlaneFront } from "tetrafront/trace";
import { createServer } from "vite";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

const CASES = [
  { size: 0.31, improve: false },
  { size: 0.31, improve: true },
  { size: 0.086, improve: false },
  { size: 0.086, improve: true },
];

/** Drags a corner; also runs in the page. */
async function measure({ loadPlaneFront, cases }) {
  const began = performance.now();
  const front = await loadPlaneFront();
  const load = performance.now() - began;
  const rows = [];
  for (const { size, improve } of cases) {
    const times = [];
    let filled;
    for (let i = 0; i < 100; ++i) {
      const corners = [
        [0, 0],
        [3.2, 0],
        [3.4, 0.7 + 0.003 * i],
        [2.1, 1.1],
        [1.5, 2.9],
        [0.4, 3.1],
      ];
      const start = performance.now();
      filled = front.fill([corners], size, { improve });
      times.push(performance.now() - start);
    }
    const [first] = times;
    times.sort((a, b) => a - b);
    const triangles = filled.mesh.triangles.length / 3;
    rows.push({
      triangles,
      improve,
      first,
      median: times[50],
      most: times[95],
      fingerprint: filled.fingerprint,
    });
  }
  return { load, rows };
}

/** An empty page that may import modules of the project. */
const emptyPage = {
  name: "empty-page",
  configureServer: (server) => {
    server.middlewares.use("/empty", (_, response) => {
      response.setHeader("Content-Type", "text/html");
      response.end("<!doctype html><title>plane</title>");
    });
  },
};

const print = (where, { load, rows }) => {
  console.log(`${where}: loaded in ${load.toFixed(0)} ms`);
  for (const { triangles, improve, first, median, most } of rows) {
    const what = `${triangles} triangles${improve ? ", improved" : ""}`.padEnd(26);
    const times = `first ${first.toFixed(1)}, median ${median.toFixed(1)}, 95 % below ${most.toFixed(1)} ms`;
    console.log(`  ${what} ${times}`);
  }
};

const inNode = await measure({ loadPlaneFront, cases: CASES });
print(`Node ${process.version}`, inNode);
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
  const inPage = await page.evaluate(async (cases) => {
    const { loadPlaneFront } = await import("/wasm/dist/trace.js");
    return globalThis.measure({ loadPlaneFront, cases });
  }, CASES);
  print(`Chromium ${browser.version()}`, inPage);
  if (inNode.rows.some((row, i) => row.fingerprint !== inPage.rows[i].fingerprint))
    throw new Error("Node and Chromium disagree");
} finally {
  await browser.close();
  await server.close();
}
