import { expect, test } from "@playwright/test";
import { createMesher } from "tetrafront";
import { AppPage, sampleProject } from "./app-page";
import { generateButton, redoButton, toggle, undoButton } from "./controls";
import { sharedTest } from "./shared-page";

sharedTest("the app opens with a meshed model and shows its numbers of elements", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const { tets, fingerprint } = await app.mesh();
  expect(tets).toBeGreaterThan(5_000);
  expect(tets).toBeLessThan(30_000);
  expect(fingerprint).toMatch(/^[0-9a-f]{16}$/);
  await expect(page.getByTestId("count-tetrahedra")).toHaveText(`${tets.toLocaleString("en-US")} tetrahedra`);
  await expect(page.getByTestId("count-points")).toHaveText(/^[\d,]+ nodes$/);
  await expect(page.getByTestId("min-dihedral")).toHaveText(/^min dihedral \d+\.\d°$/);
  await expect(page.getByTestId("seconds")).toHaveText(/^\d+\.\d+ s$/);
  await expect(page.getByTestId("log")).toContainText(fingerprint);
  await expect(page.getByRole("img", { name: /Engine intake, meshed with/ })).toBeVisible();
});

for (const id of ["engine-intake", "vault", "wing-in-a-tunnel", "bracket"]) {
  sharedTest(`${id} has the same fingerprint in the browser as in Node`, async ({ page }) => {
    const mesher = await createMesher();
    const { report } = await mesher.meshProject(sampleProject(id));
    mesher.dispose();
    expect(report.status).toBe("done");
    const app = new AppPage(page);
    await app.open();
    const shown = id === "engine-intake" ? await app.mesh() : await app.openExample(id);
    expect(shown).toEqual({ tets: report.tetrahedra, fingerprint: report.fingerprint });
    await expect(page.getByTestId("fingerprint")).toHaveText(report.fingerprint);
  });
}

sharedTest(
  "moving a point makes the mesh stale, meshing again changes it, and undo restores it",
  async ({ page }) => {
    const app = new AppPage(page);
    const before = await app.openCube();
    await app.select("point-7");
    await app.type("position-x", "1 + 1/2");
    await expect(app.viewport).toHaveAttribute("data-stale", "true");
    await expect(page.getByTestId("mesh-badge")).toContainText("Out of date");
    await expect(page.getByTestId("saved-state")).toHaveText("unsaved changes");
    // Moving one corner of a cube makes three faces non-planar: change them to Coons patches.
    for (const patch of [2, 4, 6]) {
      await app.select(`patch-${patch}`);
      await page.getByTestId("patch-type").click();
      await page.getByRole("option", { name: "Coons" }).click();
    }
    const after = await app.generate();
    expect(after.fingerprint).not.toBe(before.fingerprint);
    await expect(page.getByTestId("mesh-badge")).toBeHidden();
    for (const patch of [6, 4, 2]) {
      await expect(page.getByRole("button", { name: `Undo: Change type of patch ${patch}` })).toBeEnabled();
      await undoButton(page).click();
    }
    await page.getByRole("button", { name: "Undo: Move point 7" }).click();
    // The app has kept the old mesh: no second run is needed.
    expect(await app.meshed()).toEqual(before);
    await redoButton(page).click();
    await expect(app.viewport).toHaveAttribute("data-stale", "true");
  },
);

sharedTest("a smaller size in the background grid gives more tetrahedra", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("background-node-1");
  await app.type("node-size", "0.08");
  const finer = await app.generate();
  expect(finer.tets).toBeGreaterThan(1.5 * before.tets);
});

test("the arrow keys step a number, and a held key is one step of undo", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-1");
  const size = page.getByTestId("node-size");
  await size.focus();
  // Delay each key by 0.7 s, as on a slow page: other edits that far apart in time are not merged.
  await page.evaluate(() => {
    const now = performance.now.bind(performance);
    let delay = 0;
    window.addEventListener("keydown", () => (delay += 700), { capture: true });
    performance.now = () => now() + delay;
  });
  // Press the key three times without releasing it: the second and third press count as repeats of a held key.
  for (const value of ["0.15", "0.14", "0.13"]) {
    await page.keyboard.down("ArrowDown");
    await expect(size).toHaveValue(value);
  }
  await page.keyboard.up("ArrowDown");
  await undoButton(page).click();
  await expect(size).toHaveValue("0.16");
  await size.press("Shift+ArrowUp");
  await expect(size).toHaveValue("0.26");
});

sharedTest("a long run shows progress and can be cancelled", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const cube = sampleProject("unit-cube");
  const fine = cube.background.nodes.map((node) => ({ ...node, size: 0.02 }));
  const project = { ...cube, name: "Fine cube", background: { ...cube.background, nodes: fine } };
  await app.openFile("fine.json", JSON.stringify(project));
  await expect(app.viewport).toHaveAttribute("data-busy", "true");
  await expect(page.getByRole("progressbar", { name: "Meshing progress" })).toBeVisible();
  await expect.poll(async () => Number(await app.viewport.getAttribute("data-front"))).toBeGreaterThan(1000);
  await page.getByTestId("cancel").click();
  await expect(app.viewport).toHaveAttribute("data-busy", "false");
  await expect(page.getByTestId("log")).toContainText("Cancelled after");
  await expect(generateButton(page)).toBeEnabled();
});

sharedTest(
  "while a run is active, its Cancel is where Generate mesh was; a double click does not cancel",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const generate = generateButton(page);
    const cancel = page.getByTestId("cancel-run");
    await page.getByText("Uniform", { exact: true }).click();
    await app.type("uniform-size", "0.02");
    const before = await generate.boundingBox();
    await generate.dblclick();
    await expect(cancel).toBeVisible();
    await expect(page.getByTestId("time-left")).toHaveText(/^about \d+ (s|min) left$/);
    expect(await cancel.boundingBox()).toEqual(before);
    await expect(cancel).toHaveAccessibleName("Cancel meshing");
    await cancel.click();
    await expect(generate).toBeVisible();
    await expect(page.getByTestId("status")).toContainText(/cancelled|out of date/i);
  },
);

sharedTest(
  "the mesh just made is seen as such, and the worst element is not buried in it",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByTestId("tree-patch-1").click();
    await page.keyboard.press("Shift+D");
    await generateButton(page).click();
    await app.meshed();
    await expect(page.locator('[aria-selected="true"][role="treeitem"]')).toHaveCount(0);
    await page.getByRole("menuitem", { name: "Mesh", exact: true }).click();
    await expect(page.getByRole("menuitemcheckbox", { name: "Show target sizes" })).not.toBeChecked();
    await page.keyboard.press("Escape");

    await expect(toggle(page, "Cut")).not.toBeChecked();
    await page.keyboard.press("Control+k");
    await page.keyboard.type("worst");
    await page.keyboard.press("Enter");
    await expect(toggle(page, "Cut")).toBeChecked();
    await app.drawn();
    await expect(page.getByTestId("inspector")).toContainText(/tetrahedron|element/i);
  },
);
