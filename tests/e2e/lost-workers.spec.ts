/** Workers that end without a word, as when memory runs out: the app says so and starts others. */
import { expect, test, type Page } from "@playwright/test";
import { drilledSolid, stepFile } from "../support/step-files";
import { AppPage, sampleProject } from "./app-page";
import { dropBytes } from "./drop-bytes";

/** Ends the workers whose script has this name; the page gets no event. Returns how many there were. */
async function kill(page: Page, script: RegExp): Promise<number> {
  const workers = page.workers().filter((worker) => script.test(worker.url()));
  await Promise.all(
    workers.map((worker) => worker.evaluate(() => globalThis.close()).catch(() => undefined)),
  );
  return workers.length;
}

const mesher = /\/worker-[^/]*\.js$/;

test("a mesher that is killed during a run is replaced, and the run is reported", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const cube = sampleProject("unit-cube");
  const fine = cube.background.nodes.map((node) => ({ ...node, size: 0.025 }));
  // A run of some seconds: it must not end before its worker does.
  await app.openFile(
    "fine.json",
    JSON.stringify({ ...cube, background: { ...cube.background, nodes: fine } }),
  );
  await expect.poll(async () => Number(await app.viewport.getAttribute("data-front"))).toBeGreaterThan(1000);
  expect(await kill(page, mesher)).toBeGreaterThan(0);
  await expect(page.getByTestId("log")).toContainText("Another one was started");
  await expect(app.viewport).toHaveAttribute("data-busy", "false");
  await app.openFile("cube.json", JSON.stringify(cube));
  await expect(app.viewport).toHaveAttribute("data-busy", "false");
  expect((await app.generate()).tets).toBeGreaterThan(1000);
});

test("an idle worker for the view that is killed is replaced, and a notice says so", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  expect(await kill(page, /mesh-query-worker/)).toBe(1);
  await expect(page.getByTestId("notice-worker")).toContainText("Another one was started");
  const faces = Number(await app.viewport.getAttribute("data-faces"));
  await page.getByTestId("cut-button").click();
  await expect(app.viewport).not.toHaveAttribute("data-faces", String(faces));
  await app.drawn();
});

test("a reader of files that is killed is reported, and the file is read again", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const drilled = Array.from({ length: 40 }, (_, i) =>
    drilledSolid(`Plate ${i}`, [30 * i, 0, 0], [30 * i + 20, 10, 8], [30 * i + 8, 5], 3),
  );
  const read = dropBytes(page, stepFile(drilled), "plates.step");
  await expect
    .poll(() => page.workers().filter((worker) => /surface-worker/.test(worker.url())).length)
    .toBe(1);
  await kill(page, /surface-worker/);
  await read;
  await expect(page.getByRole("dialog")).toContainText("worker of the app has ended");
  await page.keyboard.press("Escape");
  await dropBytes(page, stepFile(drilled.slice(0, 1)), "plate.step");
  await expect(page.getByTestId("entity-name")).toHaveValue("Plate 0");
});
