// A million tetrahedra, optimized, in Node and in a tab of Chromium: the unit cube, with a size small enough.
// Seconds are the clock's, of the whole run as its user sees it. In the tab the built site meshes a project
// that was opened from a file; its main thread's longest task tells how long it did not respond.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { chromium } from "@playwright/test";
import { createMesher, readProject, writeProject } from "tetrafront";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

const SIZE = 0.0204; // in a cube of 1: about a million
const WAIT_MS = 600_000;

function load() {
  const read = readProject(readFileSync(inRoot("public", "models", "unit-cube.json"), "utf8"));
  if (!read.success) throw new Error(read.problems[0].message);
  const { background, ...project } = read.value;
  return {
    ...project,
    background: { ...background, nodes: background.nodes.map((node) => ({ ...node, size: SIZE })) },
  };
}

const count = (number) => number.toLocaleString("en-US").replaceAll(",", " ");

async function inNode(project) {
  const mesher = await createMesher();
  try {
    const { report } = await mesher.meshProject(project);
    return { tetrahedra: report.tetrahedra, seconds: report.seconds.total, fingerprint: report.fingerprint };
  } finally {
    mesher.dispose();
  }
}

/** Serves the built site while `work` runs. */
async function withSite(work) {
  const server = spawn(process.execPath, [inRoot("scripts", "preview.mjs")], {
    env: { ...process.env, PORT: "0" },
    stdio: ["ignore", "pipe", "inherit"],
  });
  try {
    const url = await new Promise((resolve, reject) => {
      server.stdout.on("data", (text) => {
        const found = /http:\S+/.exec(String(text));
        if (found) resolve(found[0]);
      });
      server.on("close", () => reject(new Error("the site cannot be served")));
    });
    return await work(url);
  } finally {
    server.kill();
  }
}

async function inTab(project) {
  const browser = await chromium.launch(config.use.launchOptions);
  try {
    return await withSite(async (url) => {
      const page = await browser.newPage();
      await page.addInitScript(() => {
        Reflect.deleteProperty(globalThis, "showOpenFilePicker");
        globalThis.longTasks = [];
        new PerformanceObserver((list) => {
          for (const { startTime, duration } of list.getEntries())
            globalThis.longTasks.push({ startTime, duration });
        }).observe({ type: "longtask", buffered: true });
      });
      await page.goto(`${url}?test=1&model=unit-cube`);
      const viewport = page.getByTestId("viewport");
      const meshed = (least) =>
        page.waitForFunction(
          (wanted) => {
            const shown = globalThis.document.querySelector("[data-testid=viewport]");
            const { busy, stale, status, tets } = shown?.dataset ?? {};
            return busy === "false" && stale === "false" && status === "done" && Number(tets) > wanted;
          },
          least,
          { timeout: WAIT_MS, polling: 100 },
        );
      await meshed(0);
      const choosing = page.waitForEvent("filechooser");
      await page.keyboard.press("Control+o");
      const began = await page.evaluate(() => performance.now());
      await (
        await choosing
      ).setFiles({
        name: "million.json",
        mimeType: "application/json",
        buffer: Buffer.from(writeProject(project)),
      });
      await viewport
        .and(page.locator("[data-stale=true]"))
        .or(page.locator("[data-busy=true]"))
        .first()
        .waitFor();
      if ((await viewport.getAttribute("data-busy")) === "false") await page.getByTestId("generate").click();
      await meshed(500_000);
      const ended = await page.evaluate(() => performance.now());
      const tasks = await page.evaluate(() => globalThis.longTasks);
      const during = tasks.filter(({ startTime }) => startTime >= began).map(({ duration }) => duration);
      return {
        tetrahedra: Number(await viewport.getAttribute("data-tets")),
        fingerprint: await viewport.getAttribute("data-fingerprint"),
        seconds: parseFloat(await page.getByTestId("seconds").innerText()),
        untilShown: (ended - began) / 1000,
        longestTask: Math.max(0, ...during),
        version: browser.version(),
      };
    });
  } finally {
    await browser.close();
  }
}

const project = load();
const node = await inNode(project);
const tab = await inTab(project);
console.log(
  "| a million tetrahedra, optimized | tetrahedra | mesh [s] | on show [s] | longest task of the page |",
);
console.log("| --- | ---: | ---: | ---: | ---: |");
console.log(`| Node ${process.version} | ${count(node.tetrahedra)} | ${node.seconds.toFixed(1)} | – | – |`);
console.log(
  `| Chromium ${tab.version} | ${count(tab.tetrahedra)} | ${tab.seconds.toFixed(1)} | ${tab.untilShown.toFixed(1)} | ${Math.round(tab.longestTask)} ms |`,
);
if (node.fingerprint !== tab.fingerprint) {
  console.error("Node and the tab disagree");
  process.exitCode = 1;
}
