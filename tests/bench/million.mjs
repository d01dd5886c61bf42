// A million tetrahedra, optimized, in Node and in a tab of Chromium: the unit cube with a small size. Seconds are
// wall-clock time of the whole run. In the tab, the built site meshes a project opened from a file, and the user
// looks at the mesh from all sides. The longest task of the page's main thread shows how long the page did not
// respond; the browser reports tasks of 50 ms and more.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { chromium } from "@playwright/test";
import { createMesher } from "tetrafront";
import { readProject, writeProject } from "tetrafront/project";
import config from "../../playwright.config.mjs";
import { inRoot } from "../../scripts/lib/paths.mjs";

const SIZE = 0.0193; // a little more than a million elements in the unit cube
const ENOUGH = 1_000_000;
const WAIT_MS = 600_000;
/**
 * Milliseconds after which an action's work has begun. Its tasks are counted until the view has been idle for as
 * long.
 */
const SETTLE_MS = 1000;
const LOAD_MS = 3000;

function load() {
  const read = readProject(readFileSync(inRoot("public", "models", "unit-cube.json"), "utf8"));
  if (!read.success) throw new Error(read.errors[0].message);
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

/** Makes the browser record the page's long tasks. */
function noteLongTasks(page) {
  return page.addInitScript(() => {
    Reflect.deleteProperty(globalThis, "showOpenFilePicker");
    globalThis.longTasks = [];
    new PerformanceObserver((list) => {
      for (const { startTime, duration } of list.getEntries())
        globalThis.longTasks.push({ startTime, duration });
    }).observe({ type: "longtask", buffered: true });
  });
}

const now = (page) => page.evaluate(() => performance.now());

/** Returns the longest recorded task since a time, in milliseconds; 0 for none. */
async function longestSince(page, began) {
  const tasks = await page.evaluate(() => globalThis.longTasks);
  const during = tasks.filter(({ startTime }) => startTime >= began).map(({ duration }) => duration);
  return Math.max(0, ...during);
}

/** Resolves when the view shows the project's mesh with more elements. */
function meshed(page, least) {
  return page.waitForFunction(
    (least) => {
      const shown = globalThis.document.querySelector("[data-testid=viewport]");
      const { busy, stale, status, tets } = shown?.dataset ?? {};
      return busy === "false" && stale === "false" && status === "done" && Number(tets) > least;
    },
    least,
    { timeout: WAIT_MS, polling: 100 },
  );
}

async function meshProject(page, project) {
  const choosing = page.waitForEvent("filechooser");
  await page.keyboard.press("Control+o");
  const began = await now(page);
  const file = {
    name: "million.json",
    mimeType: "application/json",
    buffer: Buffer.from(writeProject(project)),
  };
  await (await choosing).setFiles(file);
  await meshed(page, ENOUGH / 2);
  const ended = await now(page);
  await page.waitForTimeout(SETTLE_MS);
  const viewport = page.getByTestId("viewport");
  return {
    tetrahedra: Number(await viewport.getAttribute("data-tets")),
    fingerprint: await viewport.getAttribute("data-fingerprint"),
    seconds: parseFloat(await page.getByTestId("seconds").innerText()),
    untilShown: (ended - began) / 1000,
    longestTask: await longestSince(page, began),
  };
}

/** Actions of a user on the mesh in the view. */
const ACTIONS = [
  ["turn the view", (page) => page.keyboard.press("1")],
  ["switch the cut on", (page) => page.getByTestId("cut-toggle").press("Space")],
  ["drag the cut's plane", dragCut],
  ["cut along another axis", (page) => page.keyboard.press("z")],
  ["turn the cut round", (page) => page.getByTestId("cut-flip").click()],
  ["point at the cut", (page) => overView(page, (x, y) => page.mouse.move(x, y, { steps: 5 }))],
  ["pick an element", (page) => overView(page, (x, y) => page.mouse.click(x, y))],
  ["open the display panel", (page) => page.getByRole("tab", { name: "Display" }).click()],
  ["shade by angles", (page) => page.getByText("Dihedral", { exact: true }).click()],
  ["hide the mesh", toggleMesh],
  ["show the mesh", toggleMesh],
  ["open the inspector", (page) => page.getByRole("tab", { name: "Inspector" }).click()],
  ["open the quality report", (page) => page.getByTestId("tab-quality").click()],
  ["go to the worst element", (page) => page.getByTestId("worst-0").click()],
  ["download the mesh as VTU", (page) => download(page, /VTU/)],
];

async function dragCut(page) {
  const slider = page.getByRole("slider", { name: "Position" }).first();
  const { x, y, width, height } = await slider.locator("xpath=..").boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  for (let step = 1; step <= 30; ++step) {
    await page.mouse.move(x + width / 2 - 2 * step, y + height / 2);
    await page.waitForTimeout(30);
  }
  await page.mouse.up();
}

async function overView(page, act) {
  const { x, y, width, height } = await page.getByTestId("viewport-canvas").boundingBox();
  await act(x + width / 2, y + height / 2);
}

function toggleMesh(page) {
  return page.getByRole("switch", { name: "Mesh", exact: true }).press("Space");
}

async function download(page, format) {
  await page.getByTestId("download").click();
  const dialog = page.getByRole("dialog", { name: "Export mesh" });
  await dialog.getByRole("radio", { name: format }).check();
  const downloading = page.waitForEvent("download", { timeout: WAIT_MS });
  await dialog.getByRole("button", { name: "Export", exact: true }).click();
  await (await downloading).path();
}

async function inTab(project) {
  const browser = await chromium.launch(config.use.launchOptions);
  try {
    return await withSite(async (url) => {
      const page = await browser.newPage({ viewport: config.use.viewport });
      await noteLongTasks(page);
      await page.goto(`${url}?test=1&model=unit-cube`);
      await meshed(page, 0);
      // Browsers without a graphics card compile shaders for a while.
      await page.waitForTimeout(LOAD_MS);
      const run = await meshProject(page, project);
      const actions = [];
      for (const [name, act] of ACTIONS) {
        const began = await now(page);
        await act(page);
        const ended = await now(page);
        await page.waitForTimeout(SETTLE_MS);
        actions.push({ name, milliseconds: ended - began, longestTask: await longestSince(page, began) });
      }
      return { ...run, actions, version: browser.version() };
    });
  } finally {
    await browser.close();
  }
}

const taskText = (milliseconds) => (milliseconds === 0 ? "< 50 ms" : `${Math.round(milliseconds)} ms`);

const project = load();
const node = await inNode(project);
const tab = await inTab(project);
console.log(
  "| a million tetrahedra, optimized | tetrahedra | mesh [s] | on show [s] | longest task of the page |",
);
console.log("| --- | ---: | ---: | ---: | ---: |");
console.log(`| Node ${process.version} | ${count(node.tetrahedra)} | ${node.seconds.toFixed(1)} | – | – |`);
console.log(
  `| Chromium ${tab.version} | ${count(tab.tetrahedra)} | ${tab.seconds.toFixed(1)} | ${tab.untilShown.toFixed(1)} | ${taskText(tab.longestTask)} |`,
);
console.log("\n| with the million on show | longest task of the page |");
console.log("| --- | ---: |");
for (const { name, longestTask } of tab.actions) console.log(`| ${name} | ${taskText(longestTask)} |`);
if (node.fingerprint !== tab.fingerprint) {
  console.error("Node and the tab disagree");
  process.exitCode = 1;
}
if (node.tetrahedra < ENOUGH) {
  console.error(`only ${count(node.tetrahedra)} tetrahedra: SIZE is too large`);
  process.exitCode = 1;
}
