import { expect, type Page } from "@playwright/test";
import { measured } from "../support/mesh-measures";
import { parseVtu } from "../support/mesh-files";
import { drilledSolid, stepFile } from "../support/step-files";
import { downloadMesh } from "./downloads";
import { DrawPage } from "./draw-page";
import { acceptOperation, startOperation } from "./operations";
import { sharedTest } from "./shared-page";

/** Waits until the solid is computed, which begins with loading the kernel. */
async function computed(page: Page): Promise<void> {
  await expect(page.getByTestId("operation")).not.toHaveAttribute("data-pending", "true", {
    timeout: 60_000,
  });
}

async function fill(page: Page, values: Readonly<Record<string, string>>): Promise<void> {
  for (const [key, value] of Object.entries(values)) {
    await page.getByTestId(`operation-${key}`).fill(value);
    await page.getByTestId(`operation-${key}`).press("Tab");
  }
}

async function accept(page: Page): Promise<void> {
  await computed(page);
  await acceptOperation(page);
}

const volume = async (page: Page): Promise<number> =>
  parseFloat((await page.getByTestId("body-volume").textContent()) ?? "");

sharedTest(
  "the numbers of features follow parameters, with what fails said at the feature",
  async ({ page }) => {
    const app = new DrawPage(page);
    await app.openNew();
    for (const [name, expression] of [
      ["w", "2"],
      ["r", "w/10"],
    ] as const) {
      await page.getByTestId("new-parameter-name").fill(name);
      await page.getByTestId("new-parameter-expression").fill(expression);
      await page.getByTestId("new-parameter-expression").press("Enter");
    }
    await startOperation(page, "Box…");
    await page.getByTestId("piece-operation").getByText("New").click();
    await fill(page, { width: "w", depth: "w", height: "1" });
    await accept(page);
    await startOperation(page, "Fillet…");
    await fill(page, { radius: "r" });
    await accept(page);
    const filleted = await volume(page);
    expect(filleted).toBeLessThan(4);
    expect(filleted).toBeGreaterThan(3.5);

    // Nothing is selected, so that the table of parameters is shown.
    const set = async (name: string, expression: string): Promise<void> => {
      await page.keyboard.press("Escape");
      await page.keyboard.press("Escape");
      await page.getByTestId(`parameter-${name}`).fill(expression);
      await page.getByTestId(`parameter-${name}`).press("Enter");
      await page.getByTestId("tree-body-1").click();
    };
    await set("w", "4");
    await expect.poll(() => volume(page)).toBeGreaterThan(14);
    expect(await volume(page)).toBeLessThan(16);
    await set("r", "w");
    await expect(page.getByTestId("feature-2").getByRole("alert")).toContainText("smaller radius");
    await expect.poll(() => volume(page)).toBeCloseTo(16, 6);
    await page.reload();
    await page.getByTestId("tree-body-1").click();
    await expect(page.getByTestId("feature-2").getByRole("alert")).toContainText("smaller radius");
    await page.getByTestId("feature-2").dblclick();
    await expect(page.getByTestId("operation-radius")).toHaveValue("r");
  },
);

sharedTest("a part of a file gets a hole, and another solid is cut from it", async ({ page }) => {
  const app = new DrawPage(page);
  await app.openNew();
  const choosing = page.waitForEvent("filechooser");
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Import part as solid…");
  await page.keyboard.press("Enter");
  const bytes = stepFile([drilledSolid("plate", [0, 0, 0], [4, 4, 1], [2, 2], 1)]);
  await (await choosing).setFiles({ name: "plate.step", mimeType: "model/step", buffer: Buffer.from(bytes) });
  await expect(app.viewport).toHaveAttribute("data-solids", "1", { timeout: 60_000 });
  await expect.poll(() => volume(page)).toBeCloseTo(16 - Math.PI, 1);
  const before = await volume(page);
  await startOperation(page, "Box…");
  await page.getByTestId("piece-operation").getByText("New").click();
  await fill(page, { width: "1", depth: "1", height: "1" });
  await accept(page);
  await expect(app.viewport).toHaveAttribute("data-solids", "2");
  await page.getByTestId("tree-body-1").click();
  await page.getByTestId("tree-body-2").click({ modifiers: ["Control"] });
  await startOperation(page, "Difference of two bodies…");
  await accept(page);
  await expect(app.viewport).toHaveAttribute("data-solids", "1");
  await expect.poll(() => volume(page)).toBeCloseTo(before - 0.25, 6);
  await page.getByTestId("feature-2").dblclick();
  await page.getByTestId("operation-kind").getByText("Union").click();
  await accept(page);
  await expect.poll(() => volume(page)).toBeCloseTo(before + 0.75, 6);
});

sharedTest(
  "a box, a hole cut by a cylinder and rounded edges are features that stay editable",
  async ({ page }) => {
    const app = new DrawPage(page);
    await app.openNew();
    await startOperation(page, "Box…");
    await page.getByTestId("piece-operation").getByText("New").click();
    await computed(page);
    await fill(page, { width: "2", depth: "2", height: "1" });
    await accept(page);
    await expect(app.viewport).toHaveAttribute("data-solids", "1");
    await expect(app.viewport).toHaveAttribute("data-patches", "0");
    await expect.poll(() => volume(page)).toBeCloseTo(4, 9);

    await startOperation(page, "Cylinder…");
    await page.getByTestId("piece-operation").getByText("Cut").click();
    await fill(page, { radius: "0.5", height: "1" });
    await accept(page);
    const list = page.getByTestId("feature-list");
    await expect(list.getByRole("listitem")).toHaveCount(2);
    const hole = Math.PI * 0.25;
    await expect.poll(() => volume(page)).toBeCloseTo(4 - hole, 2);

    // The cylinder still knows its radius; the top face keeps its name.
    await page.getByTestId("feature-2").dblclick();
    await expect(page.getByTestId("operation-radius")).toHaveValue("0.5");
    await fill(page, { radius: "0.25" });
    await accept(page);
    await expect.poll(() => volume(page)).toBeCloseTo(4 - hole / 4, 2);

    await startOperation(page, "Fillet…");
    await fill(page, { radius: "0.1" });
    await accept(page);
    await expect(list.getByRole("listitem")).toHaveCount(3);
    const rounded = await volume(page);
    expect(rounded).toBeLessThan(4 - hole / 4 - 0.01);

    await page.getByTestId("feature-3").dblclick();
    await fill(page, { radius: "5" });
    await computed(page);
    await expect(page.getByTestId("operation").getByRole("status")).toContainText("smaller radius");
    await expect(page.getByTestId("accept")).toBeDisabled();
    await page.keyboard.press("Escape");

    // What fails after a change of another feature is said there, and the rest stays.
    await page.getByTestId("feature-1").dblclick();
    await fill(page, { height: "0.1" });
    await computed(page);
    await expect(page.getByTestId("operation-note")).toContainText("Fillet 1");
    await accept(page);
    await expect(page.getByTestId("feature-3").getByRole("alert")).toContainText("smaller radius");
    await expect.poll(() => volume(page)).toBeCloseTo((4 - hole / 4) / 10, 2);
    await page.keyboard.press("Control+z");
    await expect.poll(() => volume(page)).toBeCloseTo(rounded, 6);

    await page.getByTestId("feature-2").getByRole("checkbox").click();
    await expect.poll(() => volume(page)).toBeGreaterThan(rounded + 0.1);
    await page.keyboard.press("Control+z");
    await expect.poll(() => volume(page)).toBeCloseTo(rounded, 6);

    await app.generate();
    const mesh = parseVtu(await downloadMesh(page, /VTU/));
    const { points } = mesh;
    const { volume: filled, ...defects } = measured(mesh);
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    expect(Math.abs(filled / rounded - 1)).toBeLessThan(5e-3);
    // The nodes of the hole lie on the cylinder itself.
    const radii: number[] = [];
    for (let n = 0; n < points.length; n += 3) {
      const [x = 0, y = 0, z = 0] = points.subarray(n, n + 3);
      const radius = Math.hypot(x, y);
      if (radius < 0.3 && z > 0.15 && z < 0.85) radii.push(radius);
    }
    expect(radii.length).toBeGreaterThan(10);
    expect(
      Math.max(...radii.map((radius) => Math.abs(radius - 0.25)).filter((gap) => gap < 1e-3)),
    ).toBeLessThan(1e-9);
  },
);
