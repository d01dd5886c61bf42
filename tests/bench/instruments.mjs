// Measures drags in the figures of the lessons, in a browser: processor time of the page's scripts per move of the pointer, from
// the move until the frame that shows its answer. The goal is 50 ms at about 150 triangles. The time in brackets is that of all
// work of the page; a browser that draws in software spends most of it on the pixels of the canvases. CHROMIUM is the path of a
// browser; without it, the one of Playwright is used. The site must be built.
import { chromium } from "@playwright/test";
import { preview } from "vite";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

const MOVES = 60;
/** Radius of the circle on which a handle is dragged, in pixels. */
const RADIUS = 26;
/** Lesson, figure, handle, the word of the text that sets the state before, and the value that counts what is filled. */
const drags = [
  { lesson: 0, figure: "A", handle: "high", count: "evencount" },
  { lesson: 1, figure: "A", handle: "corner-1", count: "triangles" },
  { lesson: 3, figure: "B", handle: "corner-B", ruler: "square", count: "triangles" },
  { lesson: 3, figure: "B", handle: "corner-B", ruler: "space", count: "triangles" },
  { lesson: 8, figure: "A", handle: "circle-quadtree", count: "nodes" },
  { lesson: 8, figure: "B", handle: "ball", count: "nodes" },
  { lesson: 9, figure: "A", handle: "along", count: "triangles" },
  { lesson: 9, figure: "A", handle: "across", count: "triangles" },
  { lesson: 9, figure: "B", handle: "along-1", count: "triangles" },
];

const server = await preview({ root: inRoot("web"), preview: { port: 0, host: "127.0.0.1" } });
const browser = await chromium.launch(config.use.launchOptions);
try {
  for (const { lesson, figure, handle, ruler, count } of drags) {
    const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    const session = await page.context().newCDPSession(page);
    await session.send("Performance.enable", { timeDomain: "threadTicks" });
    await page.goto(`${server.resolvedUrls.local[0]}lessons/${lesson}/`);
    const host = page.getByTestId(`figure-${figure}`);
    await host.evaluate((node) => node.scrollIntoView({ block: "center", behavior: "instant" }));
    await page.locator(`[data-testid="figure-${figure}"][data-ready="true"]`).waitFor();
    if (ruler) await host.locator(`[data-ruler="${ruler}"]`).click();
    await page.waitForTimeout(1500);
    const { x, y, width, height } = await host.locator(`[data-handle="${handle}"]`).boundingBox();
    const [left, top] = [x + width / 2, y + height / 2];
    await page.mouse.move(left, top);
    await page.mouse.down();
    const times = [];
    for (let i = 1; i <= MOVES; i++) {
      const angle = (2 * Math.PI * i) / 30;
      const before = await workOf(session);
      await page.mouse.move(left + RADIUS * Math.sin(angle), top + RADIUS * (1 - Math.cos(angle)));
      await page.evaluate(twoFrames);
      const after = await workOf(session);
      times.push({ script: 1000 * (after.script - before.script), all: 1000 * (after.all - before.all) });
    }
    const value = await page.evaluate(
      ([letter, name]) => globalThis.lesson.values()[letter][name],
      [figure, count],
    );
    await page.mouse.up();
    // The first moves compile the code.
    const sorted = (kind) =>
      times
        .slice(5)
        .map((time) => time[kind])
        .sort((a, b) => a - b);
    const [scripts, all] = [sorted("script"), sorted("all")];
    const at = (share) => {
      const i = Math.floor(share * (scripts.length - 1));
      return `${scripts[i].toFixed(0).padStart(3)} ms (${all[i].toFixed(0)})`;
    };
    const name = `lesson ${lesson}, ${figure}: ${handle}${ruler ? ` (${ruler})` : ""}`;
    console.log(
      `${name.padEnd(36)} ${value} ${count}: median ${at(0.5)}, 95 % below ${at(0.95)}, longest ${at(1)}`,
    );
    await page.close();
  }
} finally {
  await browser.close();
  await server.close();
}

/** Returns for how long the page's thread has worked so far, and its scripts alone, in seconds of processor time. */
async function workOf(session) {
  const { metrics } = await session.send("Performance.getMetrics");
  const of = (wanted) => metrics.find(({ name }) => name === wanted).value;
  return { script: of("ScriptDuration"), all: of("TaskDuration") };
}

/** In the page: waits until the next frame has been drawn. */
function twoFrames() {
  const { requestAnimationFrame } = globalThis;
  return new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
}
