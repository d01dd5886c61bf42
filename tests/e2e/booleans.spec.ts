import { expect, type Page } from "@playwright/test";
import { parseVtu } from "../support/mesh-files";
import { measured } from "../support/mesh-measures";
import { expectActions } from "./actions";
import type { AppPage } from "./app-page";
import { downloadMesh } from "./downloads";
import { DrawPage } from "./draw-page";
import { acceptOperation, startOperation } from "./operations";
import { sharedTest } from "./shared-page";

async function openEmpty(page: Page): Promise<AppPage> {
  const app = new DrawPage(page);
  await app.openNew();
  return app;
}

/** Meshes, downloads, and checks the mesh without the engine. Returns its volume. */
async function checkedVolume(app: AppPage, task?: string): Promise<number> {
  await app.page.getByTestId("viewport-canvas").focus();
  await app.page.keyboard.press("Control+Enter");
  await app.meshed();
  if (task !== undefined) await expectActions(app.page, task);
  const { volume, ...defects } = measured(parseVtu(await downloadMesh(app.page, /VTU/)));
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  return volume;
}

/** Makes a solid with these dimensions, in the panel of its command. */
async function makeSolid(
  page: Page,
  command: string,
  dimensions: Readonly<Record<string, string>>,
): Promise<void> {
  await startOperation(page, command);
  for (const [key, text] of Object.entries(dimensions)) await page.getByTestId(`operation-${key}`).fill(text);
  await acceptOperation(page);
}

/** Begins to subtract the second of two solids from the first one. */
async function beginDifference(page: Page): Promise<void> {
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await startOperation(page, "Difference of two bodies");
}

sharedTest(
  "a wing is subtracted from a box: the result is said to be a body, is meshed and downloaded",
  async ({ page }) => {
    const app = await openEmpty(page);
    await makeSolid(page, "Box…", { width: "3", depth: "3", height: "3" });
    await makeSolid(page, "NACA wing…", { chord: "1", tipChord: "0.6", span: "1.5" });
    await beginDifference(page);
    await expect(page.getByTestId("operation-note")).toContainText("triangulated boundary");
    await acceptOperation(page);
    await expect(app.viewport).toHaveAttribute("data-patches", "0");
    const volume = await checkedVolume(app, "Wing cut out of a box");
    expect(volume).toBeLessThan(27);
    expect(volume).toBeGreaterThan(26.8);
    // Without its body, the mesh is hidden with its legend.
    const legend = page.getByTestId("legend");
    await expect(legend).toBeVisible();
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+z");
    await expect(legend).toBeHidden();
    await page.keyboard.press("Control+Shift+z");
    await expect(legend).toBeVisible();
  },
);

sharedTest(
  "a box is cut out of a box: points, lines and patches again, as one step of undo",
  async ({ page }) => {
    const app = await openEmpty(page);
    await makeSolid(page, "Box…", {});
    await makeSolid(page, "Box…", { width: "1/2", depth: "1/2", height: "1" });
    await beginDifference(page);
    await expect(page.getByTestId("operation-note")).toContainText("planar patches again");
    // The chosen operation has the focus, and no name of one is cut off.
    await expect(page.getByRole("radio", { name: "Difference" })).toBeFocused();
    const clipped = await page
      .getByTestId("operation")
      .locator("label")
      .evaluateAll((labels) => labels.filter((label) => label.scrollWidth > label.clientWidth).length);
    expect(clipped).toBe(0);
    await acceptOperation(page);
    await expect(app.viewport).toHaveAttribute("data-points", "16");
    await expect(app.viewport).toHaveAttribute("data-lines", "24");
    await expect(app.viewport).toHaveAttribute("data-patches", "10");
    expect(await checkedVolume(app, "Box cut out of a box")).toBeCloseTo(0.75, 9);
    await page.getByRole("button", { name: "Undo: Subtract body" }).click();
    await expect(app.viewport).toHaveAttribute("data-patches", "12");
    await page.keyboard.press("Control+Shift+z");
    await expect(app.viewport).toHaveAttribute("data-patches", "10");
  },
);
