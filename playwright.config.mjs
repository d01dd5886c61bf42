import { defineConfig } from "@playwright/test";
import { jobs } from "./scripts/lib/run.mjs";
import { slowness } from "./scripts/lib/slowness.mjs";
import { findChromium } from "./scripts/lib/tools.mjs";

const port = Number(process.env.TETRAFRONT_E2E_PORT ?? 4179);

/** How slow the machine is, measured once when the run begins. The test processes inherit it. */
const slow = Number(process.env.TETRAFRONT_SLOWNESS ?? slowness());
process.env.TETRAFRONT_SLOWNESS = String(slow);

/** End-to-end tests: the system's Chromium against the built site, worker and all. */
export default defineConfig({
  testDir: "tests/e2e",
  outputDir: "test-results",
  // Files side by side; more of them than two get in each other's way, each with a worker and a renderer of its own.
  workers: Math.min(jobs, 2),
  fullyParallel: false,
  forbidOnly: true,
  // Nothing lets a user wait longer. What takes its time, as a large mesh, is waited for in steps that can be seen.
  timeout: 120_000 * slow,
  expect: { timeout: 10_000 * slow },
  // While the engine is compiled beside them, a test can miss a short moment in the page. `npm test` lists such tests.
  retries: 1,
  reporter: [["list"]],
  use: {
    // By default, a click waits for its element until the test ends, and nothing says for which.
    actionTimeout: 30_000 * slow,
    baseURL: `http://127.0.0.1:${port}/`,
    browserName: "chromium",
    viewport: { width: 1440, height: 900 },
    deviceScaleFactor: 1,
    locale: "en-GB",
    timezoneId: "UTC",
    // Recording traces takes a third of the processor time: `--trace on` records them.
    screenshot: "only-on-failure",
    launchOptions: {
      executablePath: findChromium(),
      args: [
        "--no-sandbox",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        // Software rendering: the same pictures on every machine, with or without a GPU.
        "--use-gl=angle",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        // Only the view needs WebGL; the page around it is drawn in half the time without.
        "--disable-gpu-rasterization",
        "--disable-gpu-compositing",
      ],
    },
  },
  webServer: {
    command: "node scripts/preview.mjs",
    url: `http://127.0.0.1:${port}/`,
    env: { PORT: String(port), TETRAFRONT_STRICT_PORT: "1" },
    reuseExistingServer: false,
    timeout: 30_000,
  },
});
