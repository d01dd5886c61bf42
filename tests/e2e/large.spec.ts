import { expect, test, type Route } from "@playwright/test";
import { readFileSync } from "node:fs";
import { writeProject, type Project } from "tetrafront/project";
import { gridMesh } from "../unit/web/grid-mesh";
import { AppPage, sampleProject } from "./app-page";
import { chooseFormat } from "./downloads";
import { flipButton } from "./controls";

/** Script of the worker that finds the faces and quality of large meshes; the tests delay it or make it fail. */
const queryWorkerScript = /mesh-query-worker-.*\.js$/;

test("the page stays responsive until the faces of the mesh are found, and then shows the latest cut", async ({
  page,
}) => {
  const held: Route[] = [];
  await page.route(queryWorkerScript, (route) => void held.push(route));
  const app = new AppPage(page);
  await page.goto("./?test=1&model=unit-cube");
  await expect(app.viewport).toHaveAttribute("data-status", "done");
  await expect(app.viewport).toHaveAttribute("data-drawn", "false");
  await expect(app.viewport).toHaveAttribute("data-faces", "0");
  // The statistics of the report are shown, those that need all elements are not shown yet.
  await expect(page.getByTestId("count-tetrahedra")).toContainText(/[1-9]/);
  await expect(page.getByTestId("quality-histogram-facts")).toContainText("min –");
  await page.keyboard.press("x");
  await page.keyboard.press("z");
  await flipButton(page).click();
  await page.getByRole("tab", { name: "Display" }).click();
  await expect(page.getByRole("switch", { name: "Mesh", exact: true })).toBeChecked();

  for (const route of held) await route.continue();
  await app.drawn();
  const cut = Number(await app.viewport.getAttribute("data-faces"));
  expect(cut).toBeGreaterThan(0);
  await flipButton(page).click();
  await app.drawn();
  await flipButton(page).click();
  await app.drawn();
  expect(Number(await app.viewport.getAttribute("data-faces"))).toBe(cut);
  await page.getByRole("tab", { name: "Inspector" }).click();
  await expect(page.getByTestId("quality-histogram-facts")).toContainText(/min 0\.\d/);
});

test("a mesh that cannot be drawn is reported and can still be saved", async ({ page }) => {
  await page.route(queryWorkerScript, (route) => route.abort());
  const app = new AppPage(page);
  const { tets } = await app.openCube();
  expect(tets).toBeGreaterThan(0);
  const dialog = page.getByRole("dialog", { name: "The mesh could not be shown" });
  await expect(dialog).toBeVisible();
  await dialog.getByRole("button", { name: "Close" }).last().click();
  await expect(app.viewport).toHaveAttribute("data-faces", "0");
  await expect(page.getByTestId("download")).toBeEnabled();
});

test("a failure to write a mesh is reported, and the next attempt can succeed", async ({ page }) => {
  const writeScript = /mesh-file-worker-.*\.js$/;
  await page.route(writeScript, (route) => route.abort());
  await new AppPage(page).openCube();
  const save = async (): Promise<void> => {
    await chooseFormat(page, /SU2/);
    await page.getByTestId("export-apply").click();
  };
  await save();
  const dialog = page.getByRole("dialog", { name: "The mesh could not be written" });
  await expect(dialog).toContainText("could not be loaded");
  await dialog.getByRole("button", { name: "Close" }).last().click();
  await page.unroute(writeScript);
  const [file] = await Promise.all([page.waitForEvent("download"), save()]);
  expect(file.suggestedFilename()).toBe("unit-cube.su2");
});

test("nothing is animated during a run, because every frame costs the mesher time", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.evaluate(() => {
    const moving: number[] = [];
    const status = document.querySelector("[data-testid=status]");
    const look = (): void => {
      // Force a layout: animations begin with it.
      status?.getBoundingClientRect();
      moving.push(document.getAnimations().length);
    };
    const changes = { subtree: true, childList: true, characterData: true, attributes: true };
    if (status) new MutationObserver(() => requestAnimationFrame(look)).observe(status, changes);
    Object.assign(window, { moving });
  });
  const cube = sampleProject("unit-cube");
  const nodes = cube.background.nodes.map((node) => ({ ...node, size: 0.06 }));
  const before = await app.mesh();
  await app.openFile("fine.json", writeProject({ ...cube, background: { ...cube.background, nodes } }));
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
  await app.meshed();
  const moving = await page.evaluate(() => Reflect.get(window, "moving") as number[]);
  expect(moving.length).toBeGreaterThan(2);
  expect(Math.max(...moving)).toBe(0);
});

test("a worker reads and writes a project with a large background grid without changing it", async ({
  page,
}) => {
  const cube = sampleProject("unit-cube");
  const background = blockGrid(14);
  const text = writeProject({ ...cube, name: "Large grid", background });
  expect(text.length).toBeGreaterThan(200_000);
  const app = new AppPage(page);
  await app.openCube();
  const started: string[] = [];
  page.on("worker", (worker) => started.push(worker.url()));
  const before = await app.mesh();
  await app.openFile("large.json", text);
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
  await app.meshed();
  expect(started.filter((url) => url.includes("project-worker"))).toHaveLength(1);
  const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
  expect(readFileSync(await saved.path(), "utf8")).toBe(text);
  expect(started.filter((url) => url.includes("project-worker"))).toHaveLength(2);

  await page.route(/project-worker-.*\.js$/, (route) => route.abort());
  await app.openFile("large.json", text);
  const dialog = page.getByRole("dialog", { name: /large\.json/ });
  await expect(dialog).toContainText("could not be loaded");
});

/** Returns a background grid of n × n × n cubes around the unit cube, with six tetrahedra each. */
function blockGrid(n: number): Project["background"] {
  const { points, tetrahedra } = gridMesh(n);
  const at = (node: number, axis: number): number => -0.1 + (1.2 * (points[3 * node + axis] ?? 0)) / n;
  return {
    nodes: Array.from({ length: points.length / 3 }, (_, i) => ({
      id: i + 1,
      position: [at(i, 0), at(i, 1), at(i, 2)],
      size: 0.3,
    })),
    tetrahedra: Array.from({ length: tetrahedra.length / 4 }, (_, t) => {
      const id = (k: number): number => (tetrahedra[4 * t + k] ?? 0) + 1;
      return [id(0), id(1), id(2), id(3)];
    }),
  };
}
