import { expect, type Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { readProject } from "tetrafront/project";
import { AppPage, nextFrame, sampleProject } from "./app-page";
import { generateButton, tab, undoButton } from "./controls";
import { sharedTest } from "./shared-page";

async function command(page: Page, name: string): Promise<void> {
  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill(name);
  await page.keyboard.press("Enter");
}

sharedTest(
  "a source can be added, edited and deleted; it is drawn and refines the mesh",
  async ({ page }) => {
    const app = new AppPage(page);
    const before = await app.openCube();
    const bare = await app.viewport.screenshot();
    await nextFrame(app.viewport, () => page.getByTestId("add-source").click());
    await expect(page.getByTestId("tree-source-1")).toHaveAttribute("aria-selected", "true");
    expect((await app.viewport.screenshot()).equals(bare)).toBe(false);
    await expect(page.getByTestId("position-0-x")).toHaveValue("0.5");
    await app.type("source-size", "0.05");
    await app.type("source-distance", "0.2");
    await app.type("position-0-x", "1");
    await app.type("source-growth", "-1");
    await expect(page.getByText("Must not be below 0")).toBeVisible();
    await page.getByTestId("source-growth").press("Escape");
    const finer = await app.generate();
    expect(finer.tets).toBeGreaterThan(1.5 * before.tets);
    // A run clears the selection.
    await page.getByTestId("tree-source-1").click();
    await page.keyboard.press("Delete");
    await expect(page.getByTestId("tree-source-1")).toBeHidden();
    // Without the source, the app shows the earlier mesh, which it has kept.
    expect(await app.meshed()).toEqual(before);
    await undoButton(page).click();
    expect(await app.meshed()).toEqual(finer);
  },
);

sharedTest("sources of each type can be created from selected points", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("tree-point").click();
  await page.getByTestId("tree-point-1").click();
  await page.getByTestId("tree-point-3").click({ modifiers: ["ControlOrMeta", "Shift"] });
  await page.getByTestId("create-source-triangle").click();
  await expect(page.getByTestId("position-2-z")).toBeVisible();
  await page.getByTestId("tree-line-1").click();
  await command(page, "Segment source");
  await expect(page.getByTestId("tree-source-2")).toHaveAttribute("aria-selected", "true");
  await expect(page.getByTestId("position-1-x")).toBeVisible();
  await expect(page.getByTestId("position-2-x")).toBeHidden();
});

for (const [type, points] of [
  ["segment", [1, 2]],
  ["triangle", [1, 2, 3]],
] as const) {
  sharedTest(
    `a ${type} source can be edited, refines the mesh and is saved in the file`,
    async ({ page }) => {
      const app = new AppPage(page);
      const before = await app.openCube();
      await page.getByTestId("tree-point").click();
      for (const [index, id] of points.entries()) {
        await page.getByTestId(`tree-point-${id}`).click(index === 0 ? {} : { modifiers: ["ControlOrMeta"] });
      }
      await page.getByTestId(`create-source-${type}`).click();
      const last = points.length - 1;
      await app.type(`position-${last}-z`, "0.5");
      await app.type("source-size", "0.05");
      await app.type("source-distance", "0.1");
      const finer = await app.generate();
      expect(finer.tets).toBeGreaterThan(1.4 * before.tets);
      await app.select("source-1");
      await app.type("source-distance", "0.2");
      expect((await app.generate()).tets).toBeGreaterThan(1.2 * finer.tets);
      const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
      const read = readProject(await readFile(await download.path(), "utf8"));
      const [source] = (read.success && read.value.background.sources) || [];
      expect(source).toMatchObject({ type, size: 0.05, distance: 0.2 });
      expect(source?.positions[last]?.[2]).toBe(0.5);
    },
  );
}

sharedTest(
  "the dialog for proposed sizes warns before it applies sizes that ask for millions of elements",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    // A thin plate: three elements through its thickness require very many elements.
    const cube = sampleProject("unit-cube");
    const points = cube.points.map(({ position: [x, y, z], ...point }) => ({
      ...point,
      position: [100 * x, 100 * y, 0.2 * z],
    }));
    const background = { nodes: [], tetrahedra: [] };
    const plate = { ...cube, name: "Plate", points, background, meshing: { size: 20 } };
    await app.openFile("plate.json", JSON.stringify(plate));
    await expect(page.getByTestId("project-name")).toHaveValue("Plate");
    await command(page, "Propose sizes");
    await app.type("propose-uniform", "10");
    await app.type("propose-smallest", "0.05");
    const warning = page.getByTestId("proposal-too-many");
    await expect(warning).toBeVisible();
    await expect(page.getByTestId("propose-apply")).toHaveText("Apply anyway");
    await page.getByTestId("propose-coarser").click();
    await expect(page.getByTestId("propose-apply")).toHaveText("Apply");
    const count = page.getByTestId("proposal-count");
    await expect(count).toContainText(/about [\d,]+ tetrahedra/);
    expect(Number((await count.textContent())?.replaceAll(/\D/g, ""))).toBeLessThanOrEqual(500_000);
    await expect(warning).toBeHidden();
  },
);

sharedTest("a covering grid solves the problem of a model outside the background grid", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-2");
  await app.type("position-x", "1");
  await page.getByRole("tab", { name: "Problems" }).click();
  const group = page.getByTestId("problems-outside-background-grid");
  await expect(group).toContainText("Outside background grid");
  // While it is being built, the background grid need not cover the model.
  await expect(page.getByTestId("marker-0")).toBeHidden();
  await generateButton(page).click();
  await expect(page.getByTestId("marker-0")).toBeVisible();
  await command(page, "Create covering grid");
  const dialog = page.getByRole("dialog", { name: "Create covering grid" });
  await dialog.getByText("One tetrahedron").click();
  await dialog.getByTestId("cover-size").fill("0.2");
  await dialog.getByTestId("cover-apply").click();
  await expect(dialog).toBeHidden();
  await expect(page.getByText("No problems found.")).toBeVisible();
  await expect(page.getByTestId("marker-0")).toBeHidden();
  await app.generate();
  await expect(page.getByTestId("tree-background-node").getByText("4", { exact: true })).toBeVisible();
});

sharedTest(
  "a quick fix enlarges a covering grid around a model that has grown, as one step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByRole("tab", { name: "Problems" }).click();
    await app.select("point-2");
    await app.type("position-x", "40");
    const group = page.getByTestId("problems-outside-background-grid");
    await expect(group).toBeVisible();
    await page.getByTestId("fix-outside-background-grid").first().click();
    await expect(group).toBeHidden();
    await undoButton(page).click();
    await expect(group).toBeVisible();
  },
);

sharedTest("a uniform size replaces the background grid and removes its problems", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("background-node-2");
  await app.type("position-x", "1");
  await page.getByRole("tab", { name: "Problems" }).click();
  await expect(page.getByTestId("problems-outside-background-grid")).toBeVisible();
  await command(page, "Uniform size");
  await expect(page.getByText("No problems found.")).toBeVisible();
  await app.type("uniform-size", "0.1");
  const finer = await app.generate();
  expect(finer.tets).toBeGreaterThan(1.4 * before.tets);
  const sizes = page.getByTestId("element-size");
  await sizes.getByText("Background grid").click();
  await expect(page.getByTestId("problems-outside-background-grid")).toBeVisible();
  await undoButton(page).click();
  expect(await app.meshed()).toEqual(finer);
  // The size is remembered.
  await sizes.getByText("Background grid").click();
  await sizes.getByText("Uniform").click();
  await expect(page.getByTestId("uniform-size")).toHaveValue("0.1");
});

sharedTest(
  "proposed sizes show the expected number of tetrahedra before they are applied",
  async ({ page }) => {
    const app = new AppPage(page);
    const before = await app.open("dark", "plate-with-hole");
    await command(page, "Propose sizes");
    const dialog = page.getByRole("dialog", { name: "Propose sizes" });
    await expect(dialog.getByTestId("proposal-count")).toHaveText(/^about [\d,]+ tetrahedra$/);
    await expect(dialog.getByTestId("proposal-sources")).not.toHaveText("0");
    const expected = async (): Promise<number> =>
      Number((await dialog.getByTestId("proposal-count").textContent())?.replaceAll(/\D/g, ""));
    const first = await expected();
    await dialog.getByTestId("propose-elementsPerCircle").fill("48");
    await dialog.getByTestId("propose-elementsPerCircle").press("Enter");
    await expect.poll(expected).toBeGreaterThan(first);
    const second = await expected();
    await dialog.getByTestId("propose-elementsPerCircle").fill("12");
    await dialog.getByTestId("propose-elementsPerCircle").press("Enter");
    await expect.poll(expected).toBeLessThan(second);
    const last = await expected();
    expect(await app.mesh()).toEqual(before);
    await dialog.getByTestId("propose-apply").click();
    await expect(page.getByRole("button", { name: "Undo: Propose sizes" })).toBeEnabled();
    const after = await app.generate();
    expect(after.tets / last).toBeGreaterThan(0.6);
    expect(after.tets / last).toBeLessThan(1.6);
    await page.getByRole("button", { name: "Undo: Propose sizes" }).click();
    expect(await app.meshed()).toEqual(before);
  },
);

sharedTest("a mesh can be used as the background grid of the next mesh", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await command(page, "Use this mesh as background");
  const points = Number((await page.getByTestId("count-points").textContent())?.replaceAll(/\D/g, ""));
  await expect(page.getByTestId("tree-background-node")).toContainText(points.toLocaleString("en-US"));
  // The grid has hundreds of nodes, but the page contains only the visible rows.
  expect(await page.getByRole("treeitem").count()).toBeLessThan(120);
  const after = await app.generate();
  expect(after.tets / before.tets).toBeGreaterThan(0.5);
  expect(after.tets / before.tets).toBeLessThan(2);
  await page.getByRole("button", { name: "Undo: Use this mesh as background grid" }).click();
  expect(await app.meshed()).toEqual(before);
});

sharedTest(
  "a node and a tetrahedron can be added to the background grid, and a stretched node shows its direction",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByTestId("add-background-node").click();
    const dialog = page.getByRole("dialog", { name: "New background node" });
    for (const axis of ["x", "y", "z"]) await dialog.getByTestId(`new-${axis}`).fill("6");
    await dialog.getByTestId("new-size").fill("0.3");
    await dialog.getByTestId("add").click();
    await expect(page.getByTestId("tree-background-node-5")).toHaveAttribute("aria-selected", "true");
    await page.getByTestId("tree-background-node-2").click();
    for (const id of [3, 4, 5]) {
      await page.getByTestId(`tree-background-node-${id}`).click({ modifiers: ["ControlOrMeta"] });
    }
    await page.keyboard.press("t");
    await expect(page.getByRole("button", { name: "Undo: Add background tetrahedron" })).toBeEnabled();
    await page.getByTestId("tree-background-node-1").click();
    await nextFrame(app.viewport, () => page.keyboard.press("Shift+F"));
    const plain = await app.viewport.screenshot();
    await nextFrame(app.viewport, () => app.type("node-stretching", "6"));
    await expect(page.getByTestId("direction-x")).toHaveValue("1");
    expect((await app.viewport.screenshot()).equals(plain)).toBe(false);
  },
);

sharedTest("the table of patches and the inspector show the same statistics of a patch", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await tab(page, "Patches").click();
  const table = page.getByTestId("patch-table");
  await expect(table.locator("tbody tr")).toHaveCount(6);
  await table.getByRole("button", { name: "top" }).click();
  await expect(page.getByTestId("tree-patch-6")).toHaveAttribute("aria-selected", "true");
  const shown = await table.getByTestId("patch-row-6").locator("td").allTextContents();
  const facts = page.getByTestId("patch-facts").locator("dd");
  await expect(facts).toHaveText(shown);
  const [triangles, angle, ratio] = shown.map((text) => Number(text.replace("°", "")));
  expect(triangles).toBeGreaterThan(20);
  expect(angle).toBeGreaterThan(20);
  expect(ratio).toBeGreaterThan(0.85);
  await app.select("background-node-1");
  await app.type("node-size", "0.2");
  await expect(page.getByText("No statistics: mesh the current model.")).toBeVisible();
});
