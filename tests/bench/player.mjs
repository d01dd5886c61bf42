// Measures the player of the front in a browser with a trace of 100 000 steps: how long reading it blocks the page, how long
// it takes to show a state anywhere, frames per second while it plays, and processor time of the page per frame, with and without
// the lens. The goals are 50 ms, 100 ms, 30 frames/s and 33 ms: a machine that draws in software reaches fewer frames than its page.
// CHROMIUM is the path of a browser; without it, the one of Playwright is used.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { chromium } from "@playwright/test";
import { createMesher } from "tetrafront";
import { readProject } from "tetrafront/project";
import { recordTrace } from "tetrafront/trace";
import { preview } from "vite";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

/** Target size in the unit cube: about 100 000 tetrahedra. */
const SIZE = 0.0405;
const SCRUBS = 60;
const PLAYED_SECONDS = 5;
/** Steps whose time under the lens is measured, and the time between them, in which the lens has followed. */
const STEPS = 20;
const SETTLED_MS = 400;

const file = path.join(mkdtempSync(path.join(tmpdir(), "tetrafront-")), "cube.tft");
writeFileSync(file, await cubeTrace());
const server = await preview({ root: inRoot("web"), preview: { port: 0, host: "127.0.0.1" } });
const browser = await chromium.launch(config.use.launchOptions);
try {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  await page.goto(`${server.resolvedUrls.local[0]}?example=unit-cube`);
  await page.getByTestId("tab-front").click();
  await page.evaluate(watchTasks);
  const chooser = page.waitForEvent("filechooser");
  await page.getByTestId("player-open").click();
  await page.waitForTimeout(3000);
  await page.evaluate(() => void (globalThis.longest = globalThis.reading = 0));
  // Tasks of the page's thread, with their processor time: it does not depend on other work, as pauses do.
  await browser.startTracing(page, { categories: ["toplevel"] });
  await (await chooser).setFiles(file);
  await page.getByTestId("player-reading").waitFor();
  await page.getByTestId("player-reading").waitFor({ state: "hidden" });
  await page.getByTestId("player-scrub").waitFor();
  await page.waitForTimeout(3000);
  const longestTask = longestTaskIn(await browser.stopTracing());
  const { reading, longest } = await page.evaluate(() => ({
    reading: globalThis.reading,
    longest: globalThis.longest,
  }));
  const steps = Number(await page.getByTestId("viewport").getAttribute("data-steps"));
  console.log(`steps                             ${steps}`);
  console.log(`longest pause while reading       ${reading.toFixed(0)} ms`);
  console.log(`longest pause when it is shown    ${longest.toFixed(0)} ms`);
  console.log(`longest task, processor time       ${longestTask.toFixed(0)} ms`);
  const times = (await page.evaluate(scrub, SCRUBS)).sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(0);
  console.log(
    `scrub to the next frame           median ${at(0.5)} ms, 95 % below ${at(0.95)} ms, longest ${at(1)} ms`,
  );
  const processor = await processorTime(page);
  for (const speed of ["25", "500", "10000"]) {
    await page.getByTestId("player-scrub").press("Home");
    await page.getByTestId("player-speed").selectOption(speed);
    for (const [name, tab] of [
      ["with", "tab-front"],
      ["without", "tab-history"],
    ]) {
      await page.getByTestId("player-play").click();
      await page.getByTestId(tab).click();
      const begin = await processor();
      const { frames, seconds } = await page.evaluate(watchFrames, PLAYED_SECONDS);
      const spent = (await processor()) - begin;
      console.log(
        `at ${speed.padStart(5)} steps/s ${name.padEnd(7)} the lens   ${(frames / seconds).toFixed(1)} frames/s, ${(spent / frames).toFixed(1)} ms a frame`,
      );
      await page.getByTestId("tab-front").click();
      const isPlaying = (await page.getByTestId("player-play").getAttribute("aria-label")) === "Pause";
      if (isPlaying) await page.getByTestId("player-play").click();
    }
  }
  const repeated = async (name, repeat) => {
    const begin = await processor();
    for (let i = 0; i < STEPS; i++) {
      await repeat(i);
      await page.waitForTimeout(SETTLED_MS);
    }
    console.log(`${name.padEnd(34)}${(((await processor()) - begin) / STEPS).toFixed(1)} ms`);
  };
  const forward = () => page.getByTestId("player-forward").click();
  await page.getByTestId("player-scrub").press("Home");
  await repeated("a step under the lens", forward);
  const bar = page.getByTestId("player-scrub");
  const { width, height } = await bar.boundingBox();
  await bar.click({ position: { x: width / 2, y: height / 2 } });
  await page.waitForTimeout(SETTLED_MS);
  await repeated("a step in the middle", forward);
  const beats = page.getByTestId("player-beat");
  await repeated("a beat in the middle", (i) => beats.fill(String(1 + (i % 5))));
} finally {
  await browser.close();
  await server.close();
  rmSync(path.dirname(file), { recursive: true });
}

/** Returns the trace of the unit cube's front. */
async function cubeTrace() {
  const project = readProject(readFileSync(inRoot("public", "models", "unit-cube.json"), "utf8"));
  const mesher = await createMesher();
  const options = { size: SIZE, optimization: "none" };
  const { trace } = await recordTrace(mesher, project.value, options);
  mesher.dispose();
  return trace;
}

/** Returns the processor time of the longest task of the page's thread in a recording of the browser, in milliseconds. */
function longestTaskIn(recording) {
  const { traceEvents } = JSON.parse(recording.toString());
  const threads = new Set(
    traceEvents
      .filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain")
      .map(({ pid, tid }) => `${pid}:${tid}`),
  );
  const tasks = traceEvents.filter(
    ({ name, ph, pid, tid }) => ph === "X" && name.endsWith("RunTask") && threads.has(`${pid}:${tid}`),
  );
  return tasks.reduce((most, { tdur = 0 }) => Math.max(most, tdur / 1000), 0);
}

/** In the page: keeps the longest pauses of the page, in milliseconds: while a trace is read, and at other times. */
function watchTasks() {
  globalThis.longest = globalThis.reading = 0;
  let last = performance.now();
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => {
    const now = performance.now();
    const isReading = globalThis.document.querySelector('[data-testid="player-reading"]') !== null;
    if (isReading) globalThis.reading = Math.max(globalThis.reading, now - last);
    else globalThis.longest = Math.max(globalThis.longest, now - last);
    last = now;
    setTimeout(() => port2.postMessage(0), 1);
  };
  port2.postMessage(0);
}

/** In the page: returns the times from a press on the scrub bar to the frame after the one that draws the state. */
async function scrub(count) {
  const bar = globalThis.document.querySelector('[data-testid="player-scrub"]');
  const { left, width, top } = bar.getBoundingClientRect();
  const frame = () => new Promise((resolve) => globalThis.requestAnimationFrame(resolve));
  const times = [];
  for (let i = 0; i < count; i++) {
    const clientX = left + (((i * 37) % count) / count) * width;
    await frame();
    const begin = performance.now();
    const options = { clientX, clientY: top + 2, buttons: 1, bubbles: true, pointerId: 1 };
    bar.dispatchEvent(new globalThis.PointerEvent("pointermove", options));
    await frame();
    await frame();
    times.push(performance.now() - begin);
  }
  return times;
}

/** Returns a function that tells how much processor time the page's thread has spent so far, in milliseconds. */
async function processorTime(page) {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  return async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "TaskDuration").value;
  };
}

/** In the page: counts the frames of the view for some seconds, or until playing ends. */
async function watchFrames(seconds) {
  const view = globalThis.document.querySelector('[data-testid="viewport"]');
  const [begin, before] = [performance.now(), Number(view.dataset.frames)];
  const elapsed = () => (performance.now() - begin) / 1000;
  while (elapsed() < seconds && Number(view.dataset.step) < Number(view.dataset.steps))
    await new Promise((resolve) => setTimeout(resolve, 50));
  return { frames: Number(view.dataset.frames) - before, seconds: elapsed() };
}
