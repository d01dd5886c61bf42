import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { readMesh } from "tetrafront";
import { readProject } from "tetrafront/project";
import { parseMsh, parseVtu } from "../support/mesh-files";
import { measured } from "../support/mesh-measures";
import { plateSurface, plateVolume } from "../support/plate";
import { stlBinary, stlText } from "../support/surface-files";
import { boxSurface, steppedBlock } from "../support/surfaces";
import { AppPage } from "./app-page";
import { downloaded, downloadMesh } from "./downloads";
import { dropBytes, dropFiles } from "./drop-bytes";
import { generateButton, redoButton } from "./controls";
import { sharedTest } from "./shared-page";

const plate = { half: 5, thickness: 1, radius: 2, corners: 24 } as const;
const surface = plateSurface(plate);
const triangleCount = surface.triangles.length / 3;

async function openPlate(page: Page, fileName = "plate.stl"): Promise<AppPage> {
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, stlBinary(surface), fileName);
  await expect(page.getByTestId("body-triangles")).toHaveText(triangleCount.toLocaleString("en-US"));
  return app;
}

const previewed = (page: Page): Promise<void> =>
  expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");

sharedTest("a binary STL becomes a mesh: card, preview, mesh, download", async ({ page }) => {
  const app = await openPlate(page);
  await expect(page.getByTestId("project-name")).toBeHidden();
  await expect(page.getByTestId("entity-name")).toHaveValue("plate");
  await expect(page.getByTestId("body-size")).toContainText("10 × 10 × 1");
  await expect(page.getByTestId("body-shells")).toHaveText("1");
  const volume = parseFloat((await page.getByTestId("body-volume").textContent()) ?? "");
  expect(Math.abs(volume / plateVolume(plate) - 1)).toBeLessThan(1e-3);
  await previewed(page);
  const prepared = Number((await page.getByTestId("prepared-triangles").textContent())?.replaceAll(",", ""));
  expect(prepared).toBeGreaterThan(3 * triangleCount);
  expect(await app.viewport.getAttribute("data-tets")).toBe("0");

  await page.getByTestId("body-generate").click();
  const { tets } = await app.meshed();
  const mesh = parseVtu(await downloadMesh(page, /VTU/));
  expect(mesh.tetrahedra).toHaveLength(tets);
  const { volume: filled, ...defects } = measured(mesh);
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(Math.abs(filled / plateVolume(plate) - 1)).toBeLessThan(5e-3);

  const second = await downloadMesh(page, /VTU/, { secondOrder: true });
  const read = await readMesh(second, { fileName: "second.vtu" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(read.value.tetrahedra).toHaveLength(4 * tets);
  expect(read.value.notes?.[0]).toMatch(/second-order elements read by the corners, as linear elements$/);
});

test("the treatment of a body is undone and redone with its mesh, and a reload restores everything", async ({
  page,
}) => {
  const app = await openPlate(page);
  await previewed(page);
  await app.type("remeshing-size", "1.5");
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "false");
  await page.getByTestId("body-preview-make").click();
  await previewed(page);
  const coarse = await app.generate();
  // A run clears the selection.
  await page.getByTestId("tree-body-1").click();
  await page.getByTestId("body-treatment").getByText("Keep", { exact: true }).click();
  await expect(app.viewport).toHaveAttribute("data-stale", "true");
  const kept = await app.generate();
  expect(kept.tets).toBeLessThan(coarse.tets);
  await page.keyboard.press("Control+z");
  expect(await app.meshed()).toEqual(coarse);
  await page.keyboard.press("Control+Shift+z");
  expect(await app.meshed()).toEqual(kept);

  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  await page.reload();
  expect(await app.meshed()).toEqual(coarse);
  await page.getByTestId("tree-body-1").click();
  await expect(page.getByTestId("remeshing-size")).toHaveValue("1.5");
  await expect(page.getByTestId("body-triangles")).toHaveText(triangleCount.toLocaleString("en-US"));
  await page.getByRole("button", { name: "Redo: Change treatment of body 1" }).click();
  await expect(page.getByTestId("body-treatment").getByRole("radio", { name: "Keep" })).toBeChecked();
});

test("a broken STL shows its problems and is repaired", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const [a = 0, b = 0, c = 0] = surface.triangles.subarray(30, 33);
  // Two triangles are missing, and one faces inward.
  const triangles = Uint32Array.from([
    ...surface.triangles.subarray(6, 30),
    a,
    c,
    b,
    ...surface.triangles.subarray(33),
  ]);
  await dropBytes(page, stlBinary({ ...surface, triangles }), "broken.stl");
  const problems = page.getByTestId("body-problems");
  await expect(problems.locator("[data-code=open-edge]").first()).toBeVisible();
  await expect(page.getByTestId("body-generate")).toBeEnabled();
  await expect(page.getByTestId("repair-filled-hole")).toContainText("fills");
  await expect(page.getByTestId("repair-flipped-triangle")).toHaveText("flips 1 triangle");
  await expect(page.getByTestId("repair-outcome")).toHaveText(
    "No node moves. Afterwards, the surface can be meshed.",
  );
  const before = await app.viewport.screenshot();
  await problems.getByRole("button", { name: "Show", exact: true }).first().click();
  await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
  // Each change is listed and shown.
  await page.getByTestId("repair-flipped-triangle").click();
  const shown = await app.viewport.screenshot();
  await page
    .getByTestId("body-repair")
    .getByRole("button", { name: /^Triangle \d+$/ })
    .first()
    .click();
  await expect.poll(async () => (await app.viewport.screenshot()).equals(shown)).toBe(false);
  await page.getByTestId("body-repair-apply").click();
  await expect(problems).toBeHidden();
  await previewed(page);
  const { tets } = await app.generate();
  const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(Math.abs(volume / plateVolume(plate) - 1)).toBeLessThan(5e-3);
  expect(tets).toBeGreaterThan(0);
  // What was repaired stays listed, also in the saved project.
  await page.getByTestId("tree-body-1").click();
  const repairs = page.getByTestId("body-repairs");
  await expect(repairs.getByTestId("repaired-filled-hole")).toContainText("filled");
  await repairs.getByTestId("repaired-flipped-triangle").click();
  await expect(page.getByTestId("position-marker")).toBeHidden();
  await repairs.getByRole("button", { name: "Flipped triangle 1" }).click();
  await expect(page.getByTestId("position-marker")).toBeInViewport();
  const saved = await downloaded(page, () => page.keyboard.press("Control+s"));
  const read = readProject(Buffer.from(saved).toString());
  if (!read.success) throw new Error(read.errors[0].message);
  const [flipped] = read.value.bodies?.[0]?.repairs?.filter(({ kind }) => kind === "flipped-triangle") ?? [];
  expect(flipped).toMatchObject({ count: 1, positions: [expect.any(Array)] });
  await page.getByRole("button", { name: /^Undo: Repair/ }).click();
  await expect(problems).toBeVisible();
  await expect(repairs).toBeHidden();
  await redoButton(page).click();
  await page.reload();
  await page.getByTestId("tree-body-1").click();
  await expect(repairs.getByTestId("repaired-flipped-triangle")).toHaveText("1 triangle flipped");
});

sharedTest(
  "dropped details are listed and shown, and problems name the controls of the app",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropBytes(page, stlBinary(steppedBlock(0.004)), "step.stl");
    await previewed(page);
    await expect(page.getByTestId("dropped-details")).toBeHidden();
    await page.getByTestId("remeshing-options").getByText("Remeshing options").click();
    await page.getByTestId("remeshing-dropDetails").fill("0.01");
    await page.getByTestId("remeshing-dropDetails").press("Enter");
    await page.getByTestId("body-preview-make").click();
    await previewed(page);
    await expect(page.getByTestId("dropped-details")).toHaveText(/^\d+ details dropped$/);
    await expect(page.getByTestId("prepared-warning")).toContainText("because details were dropped");
    await page.getByTestId("dropped-details").click();
    const before = await app.viewport.screenshot();
    await page.getByRole("button", { name: "Detail 1", exact: true }).click();
    await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
    await page.getByTestId("body-treatment").getByText("Keep", { exact: true }).click();
    const needles = page.locator("[data-code=needle-surface]").first();
    await expect(needles).toContainText("Select Remesh for the body");
    await app.generate();
    await expect(page.getByTestId("log")).toContainText("Select Remesh for bodies with needles");
    await expect(page.getByText(/--surface|remeshSurface/)).toHaveCount(0);
  },
);

sharedTest("a damaged file is rejected with its name, the reason and the remedy", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await dropBytes(page, stlBinary(surface).subarray(0, 1000), "cut.stl");
  const dialog = page.getByRole("dialog", { name: "cut.stl could not be opened" });
  await expect(dialog).toContainText(/triangles/);
  await dialog.getByRole("button", { name: "Close" }).last().click();
  expect(await app.meshed()).toEqual(before);
});

sharedTest(
  "patches of a body are in the tree, are renamed and picked in the view, and name the boundaries of the mesh",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const half = surface.triangles.length / 2;
    const [lower, upper] = [surface.triangles.subarray(0, half), surface.triangles.subarray(half)];
    const solids = [
      stlText({ ...surface, triangles: lower }, "first"),
      stlText({ ...surface, triangles: upper }, "second"),
    ];
    await dropBytes(page, Buffer.concat(solids), "two.stl");
    await expect(page.getByTestId("body-patches")).toHaveText("2");
    await expect(page.getByTestId("tree-body-patch-1")).toContainText("first");
    await page.getByTestId("tree-body-patch-2").click();
    await app.type("entity-name", "inlet");
    await expect(page.getByTestId("tree-body-patch-2")).toContainText("inlet");

    // A click on a triangle of the second solid selects its patch.
    await page.getByTestId("tree-body-1").click();
    await page.keyboard.press("5");
    const nodes = [...upper.subarray(0, 3)];
    const centroid = [0, 1, 2].map((axis) =>
      nodes.reduce((sum, node) => sum + (surface.points[3 * node + axis] ?? 0) / 3, 0),
    );
    const at = await page.evaluate((position) => {
      const { tetrafrontPosition } = window as unknown as {
        tetrafrontPosition: (at: unknown) => { x: number; y: number };
      };
      return tetrafrontPosition(position);
    }, centroid);
    await app.viewport.click({ position: at });
    await expect(page.getByTestId("entity-name")).toHaveValue(/inlet|first/);

    await page.getByTestId("tree-body-1").click();
    await previewed(page);
    await app.generate();
    const names = parseMsh(await downloadMesh(page, /MSH 4/)).triangles.map(({ name }) => name);
    expect(names.toSorted()).toEqual(["first", "inlet"]);
  },
);

sharedTest(
  "a part with one colour: patches are split, and the mesh is shown and has their names",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const colored = stlBinary(surface);
    for (let t = 0; t < triangleCount; ++t) colored.set([0x1f, 0x80], 84 + 50 * t + 48);
    await dropBytes(page, colored, "plate.stl");
    await previewed(page);
    await page.getByTestId("split-patches").locator("summary").click();
    await page.getByText("Given", { exact: true }).click();
    const before = await app.colours();
    await page.getByTestId("split-preview").click();
    await expect(page.getByTestId("split-result")).toHaveText("Gives 7 patches.");
    // Pieces are shown in colours of their own, not in that of the file.
    await expect.poll(() => app.colours()).not.toBe(before);
    await page.getByTestId("split-apply").click();
    await expect(page.getByTestId("body-patches")).toHaveText("7");
    await page.getByTestId("tree-body-patch-7").click();
    await app.type("entity-name", "top");
    await page.getByTestId("tree-body-1").click();
    // The split shows the given triangles; a generated mesh takes their place.
    await app.generate();
    await page.getByTestId("tree-body-1").click();
    await expect(
      page.getByRole("radiogroup", { name: "Show" }).getByRole("radio", { name: "Mesh" }),
    ).toBeChecked();
    const names = parseMsh(await downloadMesh(page, /MSH 4/)).triangles.map(({ name }) => name);
    expect(names.toSorted()).toEqual([...[1, 2, 3, 4, 5, 6].map((id) => `patch ${id}`), "top"]);
  },
);

sharedTest(
  "an imported surface joins the open document, is moved and deleted, each as one step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const choosing = page.waitForEvent("filechooser");
    await page.getByTestId("add-body").click();
    await (
      await choosing
    ).setFiles({
      name: "plate.stl",
      mimeType: "model/stl",
      buffer: Buffer.from(stlBinary(surface)),
    });
    await expect(page.getByTestId("tree-body-1")).toBeVisible();
    await expect(page.getByTestId("tree-patch-1")).toBeVisible();
    await page.getByTestId("body-placement").locator("summary").click();
    await app.type("placement-position-z", "20");
    await app.type("placement-rotation-x", "90");
    await expect(page.getByTestId("placement-rotation-x")).toHaveValue("90");
    const saved = await downloaded(page, () => page.keyboard.press("Control+s"));
    const read = readProject(new TextDecoder().decode(saved));
    expect(read.success && read.value.bodies?.[0]?.placement?.position).toEqual([0, 0, 20]);
    expect(read.success && read.value.bodies?.[0]?.patches[0]?.id).toBe(7);
    await page.getByTestId("tree-body-1").press("Delete");
    await expect(page.getByTestId("tree-body-1")).toBeHidden();
    for (let step = 0; step < 4; ++step) await page.keyboard.press("Control+z");
    await expect(page.getByTestId("tree-body-1")).toBeHidden();
    await expect(page.getByTestId("tree-patch-1")).toBeVisible();
  },
);

for (const scheme of ["dark", "light"] as const) {
  test(`on a phone a dropped surface shows its card, without violations in the ${scheme} theme`, async ({
    page,
  }) => {
    await page.setViewportSize({ width: 390, height: 844 });
    const app = new AppPage(page);
    await app.open(scheme, "unit-cube");
    await dropBytes(page, stlBinary(surface), "plate.stl");
    await expect(page.getByTestId("body-volume")).toBeVisible();
    await previewed(page);
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    expect(overflow).toBeLessThanOrEqual(0);
    await page.getByTestId("remeshing-options").locator("summary").click();
    const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
    const { violations } = await axe.analyze();
    expect(violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`)).toEqual([]);
  });
}

sharedTest(
  "patches are split by angle after a preview and merged again, and a click in the view picks one",
  async ({ page }) => {
    const app = await openPlate(page);
    await previewed(page);
    await page.getByTestId("split-patches").locator("summary").click();
    const before = await app.colours();
    await page.getByTestId("split-preview").click();
    await expect(page.getByTestId("split-result")).toHaveText("Gives 7 patches.");
    // The view shows each patch in a colour of its own before the split is applied.
    await expect.poll(() => app.colours()).not.toBe(before);
    await expect(page.getByTestId("body-patches")).toHaveText("1");
    await page.getByTestId("split-apply").click();
    await expect(page.getByTestId("body-patches")).toHaveText("7");
    // The tree shows the name that files of the mesh use.
    await expect(page.getByTestId("tree-body-patch-7")).toHaveText("patch 7");

    const at = await page.evaluate(() => {
      const { tetrafrontPosition } = window as unknown as {
        tetrafrontPosition: (at: unknown) => { x: number; y: number };
      };
      return tetrafrontPosition([4, 4, 1]);
    });
    await app.viewport.click({ position: at });
    // The top is the patch whose lowest corner is highest, so it comes last.
    await expect(page.getByTestId("tree-body-patch-7")).toHaveAttribute("aria-selected", "true");
    await app.type("entity-name", "top");

    await page.getByTestId("tree-body-patch-5").click();
    await app.type("entity-name", "hole");
    await page.getByTestId("split-patches").locator("summary").click();
    await app.type("split-angle", "5");
    await page.getByTestId("split-preview").click();
    await expect(page.getByTestId("split-result")).toHaveText("Gives 30 patches.");
    await page.getByTestId("split-apply").click();
    await expect(page.getByTestId("tree-body-patch-8")).toContainText("hole 2");
    await expect(page.getByTestId("tree-body-patch-7")).toContainText("top");
    await page.getByRole("button", { name: /^Undo: Split patch 5/ }).click();
    await expect(page.getByTestId("tree-body-patch-8")).toBeHidden();
    await page.keyboard.press("Control+z");

    await page.getByTestId("tree-body-patch-1").click();
    await page.getByTestId("tree-body-patch-2").click({ modifiers: ["Control"] });
    await page.getByTestId("merge-patches").click();
    await expect(page.getByTestId("tree-body-patch-2")).toBeHidden();
    await page.getByRole("button", { name: "Undo: Merge 2 patches" }).click();
    await expect(page.getByTestId("tree-body-patch-2")).toBeVisible();
    await page.keyboard.press("Control+z");
    await page.getByRole("button", { name: /^Undo: Split plate/ }).click();
    await expect(page.getByTestId("tree-body-patch-2")).toBeHidden();
  },
);

const screenPosition = (page: Page, position: readonly number[]): Promise<{ x: number; y: number }> =>
  page.evaluate((at) => {
    const { tetrafrontPosition } = window as unknown as {
      tetrafrontPosition: (at: unknown) => { x: number; y: number };
    };
    return tetrafrontPosition(at);
  }, position);

/** Drags the left button in the view. */
async function drag(
  app: AppPage,
  from: { x: number; y: number },
  to: { x: number; y: number },
): Promise<void> {
  const { x = 0, y = 0 } = (await app.viewport.boundingBox()) ?? {};
  const { mouse } = app.page;
  await mouse.move(x + from.x, y + from.y);
  await mouse.move(x + from.x + 1, y + from.y);
  await mouse.down();
  await mouse.move(x + (from.x + to.x) / 2, y + (from.y + to.y) / 2, { steps: 4 });
  await mouse.move(x + to.x, y + to.y, { steps: 4 });
  await mouse.up();
}

sharedTest(
  "a stroke of the brush paints sources that refine the preview, as one step of undo",
  async ({ page }) => {
    const app = await openPlate(page);
    await previewed(page);
    const coarse = Number((await page.getByTestId("prepared-triangles").textContent())?.replaceAll(",", ""));
    await page.getByTestId("body-brush").locator("summary").click();
    await app.type("brush-size", "0.1");
    await page.getByTestId("brush-toggle").click();
    await expect(page.getByTestId("brush-toggle")).toHaveAttribute("aria-pressed", "true");
    const withoutReach = await app.viewport.screenshot();
    const { x, y } = await screenPosition(page, [3, -4, 1]);
    await app.viewport.hover({ position: { x, y } });
    await expect.poll(async () => (await app.viewport.screenshot()).equals(withoutReach)).toBe(false);
    await drag(app, await screenPosition(page, [3, -4, 1]), await screenPosition(page, [4, 3, 1]));
    await expect(page.getByTestId("tree-source-2")).toBeVisible();
    await page.keyboard.press("Escape");
    await expect(page.getByTestId("brush-toggle")).toHaveAttribute("aria-pressed", "false");
    await page.getByTestId("body-preview-make").click();
    await previewed(page);
    const fine = Number((await page.getByTestId("prepared-triangles").textContent())?.replaceAll(",", ""));
    expect(fine).toBeGreaterThan(1.5 * coarse);
    await page.getByRole("button", { name: "Undo: Paint size" }).click();
    await expect(page.getByTestId("tree-source-1")).toBeHidden();
    await previewed(page);
  },
);

sharedTest(
  "the palette splits patches, takes the brush, and the card of a patch has its area and normal",
  async ({ page }) => {
    const app = await openPlate(page);
    await previewed(page);
    const choose = async (command: string) => {
      await page.keyboard.press("Control+k");
      await page.keyboard.type(command);
      await expect(page.getByRole("dialog").getByText(command)).toBeVisible();
      await page.keyboard.press("Enter");
    };
    await choose("Paint size on the body");
    await expect(page.getByTestId("brush-toggle")).toHaveAttribute("aria-pressed", "true");
    await choose("Paint size on the body");
    await expect(page.getByTestId("brush-toggle")).toHaveAttribute("aria-pressed", "false");
    await choose("Split patches of the body by angle");
    await expect(page.getByTestId("split-result")).toBeVisible();
    await page.getByTestId("split-apply").click();
    await app.viewport.click({ position: await screenPosition(page, [3, -4, 1]) });
    const facts = page.getByTestId("body-patch-facts");
    await expect(facts).toContainText("Normal");
    await expect(facts).toContainText("0, 0, 1");
  },
);

sharedTest("a box that touches a body selects it", async ({ page }) => {
  const app = await openPlate(page);
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Escape");
  await expect(page.getByTestId("tree-body-1")).toHaveAttribute("aria-selected", "false");
  const box = await app.viewport.boundingBox();
  if (!box) throw new Error("The view has no box");
  // Drawn to the left, the box selects what it touches.
  const [x, y] = [box.x + box.width - 150, box.y + box.height - 20];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 6 });
  await page.mouse.up();
  await expect(page.getByTestId("tree-body-1")).toHaveAttribute("aria-selected", "true");
});

sharedTest("handles move a body, a drag as one step of undo", async ({ page }) => {
  const app = await openPlate(page);
  await previewed(page);
  await page.getByTestId("body-placement").locator("summary").click();
  const handles = page.getByTestId("body-placement").getByRole("radiogroup", { name: "Handles" });
  const before = await app.viewport.screenshot();
  await handles.getByText("Move", { exact: true }).click();
  await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
  const middle = await screenPosition(page, [0, 0, 0.5]);
  // The arrow along z points up in the view.
  await drag(app, { x: middle.x, y: middle.y - 50 }, { x: middle.x, y: middle.y - 150 });
  const z = page.getByTestId("placement-position-z");
  await expect.poll(async () => Number(await z.inputValue())).toBeGreaterThan(1);
  expect(Math.abs(Number(await page.getByTestId("placement-position-x").inputValue()))).toBeLessThan(1e-6);
  await page.getByRole("button", { name: "Undo: Move body 1" }).click();
  await expect(z).toHaveValue("0");
  await page.keyboard.press("Escape");
  await expect(handles.getByRole("radio", { name: "None" })).toBeChecked();
});

/** Adds a box beside the unit cube of the opening project, at its first corner. */
async function importBox(page: Page, low: number): Promise<AppPage> {
  const app = new AppPage(page);
  await app.openCube();
  const choosing = page.waitForEvent("filechooser");
  await page.getByTestId("add-body").click();
  const box = boxSurface(2, [low, low, low], [low + 0.5, low + 0.5, low + 0.5]);
  const file = { name: "box.stl", mimeType: "model/stl", buffer: Buffer.from(stlBinary(box)) };
  await (await choosing).setFiles(file);
  await expect(page.getByTestId("body-triangles")).toHaveText("48");
  return app;
}

sharedTest(
  "a body that crosses a drawn patch is a problem before a mesh is generated, until it is moved",
  async ({ page }) => {
    const app = await importBox(page, 0.7);
    await page.getByText("Keep", { exact: true }).click();
    await page.getByTestId("body-preview-make").click();
    await page.getByRole("tab", { name: /Problems/ }).click();
    const crossing = page.getByTestId("problems-self-intersection");
    await expect(crossing.first()).toBeVisible();
    await expect(crossing.first()).toContainText("box");
    await expect(app.viewport).toHaveAttribute("data-busy", "false");
    await crossing.getByRole("button", { name: "Show", exact: true }).first().click();
    await page.getByTestId("tree-body-1").click();
    await page.getByTestId("body-placement").locator("summary").click();
    for (const axis of ["x", "y", "z"]) await app.type(`placement-position-${axis}`, "-0.45");
    await expect(crossing).toHaveCount(0);
    await page.getByTestId("body-preview-make").click();
    await previewed(page);
    await expect(page.getByTestId("problem-list")).toHaveAttribute("data-bodies-checked", "true");
    await expect(crossing).toHaveCount(0);
  },
);

sharedTest("a body outside the background grid is a problem before a mesh is generated", async ({ page }) => {
  await importBox(page, 5);
  await page.getByRole("tab", { name: /Problems/ }).click();
  const outside = page.getByTestId("problems-outside-background-grid");
  await expect(outside.first()).toContainText("box");
  await expect(page.getByTestId("body-preview").getByRole("alert")).toContainText(
    "outside the background grid",
  );
});

sharedTest(
  "a body with a hole that overlaps another is repaired and joined by one Generate mesh, pressed at once",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const { points, triangles } = boxSurface(4);
    const whole = boxSurface(4, [0.8, 0.125, 0.125], [1.8, 0.875, 0.875]);
    await dropFiles(page, {
      "open.stl": stlBinary({ points, triangles: triangles.subarray(9) }),
      "whole.stl": stlBinary(whole),
    });
    await expect(page.getByTestId("tree-body-2")).toContainText("whole");
    await generateButton(page).click();
    await expect(app.viewport).toHaveAttribute("data-busy", "true");
    await app.meshed();
    await expect(page.getByTestId("log")).toContainText("they became one body with 2 regions");
    const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    expect(volume).toBeCloseTo(1 + 0.8 * 0.75 ** 2, 3);
    for (const step of ["Join open and whole", "Repair open"]) {
      await page.getByRole("button", { name: `Undo: ${step}` }).click();
    }
    await expect(page.getByTestId("tree-body-2")).toContainText("whole");
  },
);
