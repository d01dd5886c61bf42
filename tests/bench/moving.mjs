// Measures moving in a browser: a point of the largest model of the gallery, and all its points, are dragged in the view.
// Prints frames per second, how many previews of lines and patches the worker makes, and the longest time
// for which the page did not answer, and the processor time of the page and of the process that draws, which depend less on
// other work. The goals are 30 frames/s and 50 ms. CHROMIUM is the path of a browser; without it,
// the one of Playwright is used. The site must be built.
import { readdirSync, readFileSync } from "node:fs";
import { chromium } from "@playwright/test";
import { readProject } from "tetrafront/project";
import { preview } from "vite";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

const SECONDS = 5;

const models = readdirSync(inRoot("public", "models")).map((file) => {
  const read = readProject(readFileSync(inRoot("public", "models", file), "utf8"));
  return { id: file.replace(/\.json$/, ""), project: read.value };
});
const sizeOf = ({ points, lines, patches }) => points.length + lines.length + patches.length;
const { id, project } = models.reduce((best, one) =>
  sizeOf(one.project) > sizeOf(best.project) ? one : best,
);
console.log(`model                          ${id}, ${sizeOf(project)} entities`);

const server = await preview({ root: inRoot("web"), preview: { port: 0, host: "127.0.0.1" } });
const browser = await chromium.launch(config.use.launchOptions);
try {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  const session = await page.context().newCDPSession(page);
  const system = await browser.newBrowserCDPSession();
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await page.addInitScript(countPreviews);
  const open = async (query) => {
    await page.goto(`${server.resolvedUrls.local[0]}?${query}model=${id}`);
    await page.locator('[data-testid="viewport"][data-status="done"][data-busy="false"]').waitFor();
  };
  await open("test=1&");
  const at = await screenPlace(page, project.points[0].position);
  // Without `test`, a slow motion is drawn in a lower resolution, as for users.
  await open("");
  await page.waitForTimeout(2000);
  // Software draws a mesh too slowly to measure anything else.
  await page.getByRole("tab", { name: "Display" }).click();
  await page.getByRole("switch", { name: "Mesh", exact: true }).uncheck();
  await page.getByTestId("tool-move").click();
  for (const { what, prepare } of [
    { what: "one point", prepare: () => Promise.resolve() },
    { what: "all entities", prepare: () => page.keyboard.press("Control+a") },
  ]) {
    await prepare();
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 6, at.y + 2, { steps: 3 });
    const before = await workOf(session);
    const drawnBefore = await drawingOf(system);
    const { frames, rate, previews, longest } = await page.evaluate(drag, { ...at, seconds: SECONDS });
    const work = (1000 * ((await workOf(session)) - before)) / frames;
    const drawing = (1000 * ((await drawingOf(system)) - drawnBefore)) / frames;
    await page.mouse.up();
    const changed = await page.getByTestId("undo").getAttribute("aria-label");
    console.log(
      `${what.padEnd(14)} frames/s ${rate.toFixed(1)}, work per frame: page ${work.toFixed(1)} ms, drawing ${drawing.toFixed(1)} ms; previews of the worker/s ${previews.toFixed(1)}, longest pause ${longest.toFixed(0)} ms (${changed})`,
    );
    await page.keyboard.press("Control+z");
  }
} finally {
  await browser.close();
  await server.close();
}

/** Returns where a position is drawn on the page. */
async function screenPlace(page, position) {
  const { left, top } = await page.getByTestId("viewport").evaluate((element) => {
    const box = element.getBoundingClientRect();
    return { left: box.left, top: box.top };
  });
  const { x, y } = await page.evaluate((given) => globalThis.tetrafrontPosition(given), position);
  return { x: left + x, y: top + y };
}

/** Returns for how long the page's thread has worked so far, in seconds of processor time. */
async function workOf(session) {
  const { metrics } = await session.send("Performance.getMetrics");
  return metrics.find(({ name }) => name === "TaskDuration").value;
}

/** Returns for how long the process that draws has worked so far, in seconds of processor time. */
async function drawingOf(system) {
  const { processInfo } = await system.send("SystemInfo.getProcessInfo");
  return processInfo.find(({ type }) => type === "GPU").cpuTime;
}

/** In the page: counts the answers to questions for previews. */
function countPreviews() {
  globalThis.previews = 0;
  const asked = new Set();
  const { Worker } = globalThis;
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (message?.call === "previewModel") {
      if (asked.size === 0) {
        this.addEventListener("message", ({ data }) => {
          if (data?.kind === "answer" && asked.has(data.id)) ++globalThis.previews;
        });
      }
      asked.add(message.id);
    }
    return post.call(this, message, ...rest);
  };
}

/** In the page: moves the pointer in a circle for some seconds, once per frame. */
async function drag({ x, y, seconds }) {
  const canvas = globalThis.document.querySelector('[data-testid="viewport-canvas"]');
  const frame = () => new Promise((resolve) => globalThis.requestAnimationFrame(resolve));
  let [frames, longest] = [0, 0];
  let last = performance.now();
  const { port1, port2 } = new MessageChannel();
  let isOver = false;
  port1.onmessage = () => {
    const now = performance.now();
    longest = Math.max(longest, now - last);
    last = now;
    if (!isOver) setTimeout(() => port2.postMessage(0), 1);
  };
  port2.postMessage(0);
  const begin = performance.now();
  const before = globalThis.previews;
  while (performance.now() - begin < 1000 * seconds) {
    const angle = (frames / 30) * 2 * Math.PI;
    const [clientX, clientY] = [x + 40 * Math.sin(angle), y + 40 * (1 - Math.cos(angle))];
    const options = {
      clientX,
      clientY,
      buttons: 1,
      bubbles: true,
      pointerId: 1,
      pointerType: "mouse",
      isPrimary: true,
    };
    canvas.dispatchEvent(new globalThis.PointerEvent("pointermove", options));
    await frame();
    ++frames;
  }
  isOver = true;
  const elapsed = (performance.now() - begin) / 1000;
  return { frames, rate: frames / elapsed, previews: (globalThis.previews - before) / elapsed, longest };
}
