/** Fields of a mesh: solved in the page, in cycles, or read from a file. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { createMesher, writeMesh } from "tetrafront";
import { sphereSurface } from "../support/surfaces";
import { AppPage } from "./app-page";
import { undoButton } from "./controls";
import { dropBytes } from "./drop-bytes";
import { sharedTest } from "./shared-page";

async function violations(page: Page): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
}

const numbersOf = async (page: Page, column: number): Promise<number[]> => {
  const rows = page.getByTestId("cycle-list").locator("tbody tr");
  const texts = await rows.locator(`td:nth-child(${column})`).allTextContents();
  return texts.map((text) => Number(text.replaceAll(",", "")));
};

sharedTest("one click solves heat in an L-shaped body in five cycles whose errors fall", async ({ page }) => {
  test.slow();
  const app = new AppPage(page);
  await app.openCube();
  await page.getByRole("tab", { name: "Examples" }).click();
  await page.getByTestId("solved-l-shape").click();
  const last = page.getByTestId("cycle-5");
  await expect(last).toBeVisible({ timeout: 120_000 });
  await expect(app.viewport).toHaveAttribute("data-busy", "false");
  await app.drawn();
  const errors = await numbersOf(page, 3);
  expect(errors).toHaveLength(6);
  errors.slice(1).forEach((error, i) => expect(error).toBeLessThan(errors[i] ?? 0));
  const counts = await numbersOf(page, 2);
  expect(counts[5]).toBeGreaterThan(8000);
  await expect(page.getByTestId("field-legend")).toContainText("temperature");
  await expect(page.getByTestId("error-chart").getByRole("img")).toHaveCount(6);
  expect(await violations(page), "dark").toEqual([]);
  await page.getByTestId("theme").click();
  await expect(page.locator("html")).toHaveAttribute("data-mantine-color-scheme", "light");
  expect(await violations(page), "light").toEqual([]);

  // Step through the list, with keys too.
  await page.getByTestId("cycle-0").getByRole("button").click();
  await expect(app.viewport).toHaveAttribute("data-tets", String(counts[0]));
  await page.getByTestId("cycle-next").focus();
  await page.keyboard.press("Enter");
  await expect(app.viewport).toHaveAttribute("data-tets", String(counts[1]));
  await app.drawn();
  const coloured = await app.colours();
  await page.getByTestId("field").click();
  await page.getByRole("option", { name: "None" }).click();
  await expect(page.getByTestId("field-legend")).toBeHidden();
  expect(coloured).toBeGreaterThan(60);

  // The cycles are one step of undo.
  await undoButton(page).click();
  await expect(app.viewport).toHaveAttribute("data-tets", String(counts[0]));
});

sharedTest(
  "cycles can be stopped and keep what is solved; a problem without a held patch says so",
  async ({ page }) => {
    test.slow();
    const app = new AppPage(page);
    await app.openCube();
    await page.getByRole("tab", { name: "Solution" }).click();
    await page.getByTestId("solve").click();
    await expect(page.getByTestId("solve-failure")).toContainText("no unique solution");
    await page.getByTestId("add-condition").click();
    await page.getByRole("option").first().click();
    await page.getByRole("spinbutton", { name: "Source" }).fill("5");
    await page.keyboard.press("Enter");
    await page.getByTestId("solve").click();
    await expect(page.getByTestId("cycle-0")).toBeVisible();
    await expect(page.getByTestId("solve-failure")).toBeHidden();
    await page.getByTestId("cycle-elements").fill("60000");
    await page.keyboard.press("Enter");
    await page.getByTestId("run-cycles").click();
    await expect(page.getByTestId("cycle-1")).toBeVisible({ timeout: 60_000 });
    await page.keyboard.press("Shift+Escape");
    await expect(app.viewport).toHaveAttribute("data-busy", "false");
    const count = await page.getByTestId("cycle-list").locator("tbody tr").count();
    expect(count).toBeGreaterThanOrEqual(2);
    expect(count).toBeLessThan(6);
    await expect(page.getByTestId("cycle-0")).toBeVisible();

    // The problem is kept with the project.
    await page.reload();
    await page.getByRole("tab", { name: "Solution" }).click();
    await expect(page.getByRole("spinbutton", { name: "Source" })).toHaveValue("5");
    await expect(page.getByRole("group", { name: /^Condition on/ })).toHaveCount(1);
  },
);

sharedTest(
  "a mesh file with values at its nodes and of its elements is coloured by them and adapted to them",
  async ({ page }) => {
    test.slow();
    const mesher = await createMesher();
    const { mesh } = await mesher.fillSurface(sphereSurface(8), { size: 0.3 });
    mesher.dispose();
    const heights = mesh.points.filter((_, i) => i % 3 === 2).map((z) => Math.tanh(5 * z));
    const nodeData = new Map([
      ["layer", { components: 1, values: heights }],
      ["position", { components: 3, values: mesh.points.slice() }],
    ]);
    const power = Float64Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => t);
    const elementData = new Map([["power", { components: 1, values: power }]]);
    const [file] = await writeMesh({ ...mesh, nodeData, elementData }, "ball.vtu");
    const app = new AppPage(page);
    await app.openCube();
    await dropBytes(page, file?.bytes ?? new Uint8Array(), "ball.vtu");
    const before = mesh.tetrahedra.length / 4;
    await expect(app.viewport).toHaveAttribute("data-tets", String(before));
    await expect(page.getByRole("region", { name: "Notices" })).toContainText(
      "fields: layer, position, power",
    );
    await page.getByRole("tab", { name: "Solution" }).click();
    await page.getByTestId("field").click();
    await page.getByRole("option", { name: "position" }).click();
    await expect(page.getByTestId("field-legend")).toContainText("position");
    await page.getByTestId("field-component").click();
    await page.getByRole("option", { name: "z" }).click();
    await expect(page.getByTestId("field-legend")).toContainText("position, z");
    // Values of elements have flat colours, and no lines.
    await page.getByTestId("field").click();
    await page.getByRole("option", { name: "power (elements)" }).click();
    await expect(page.getByTestId("field-legend")).toContainText("power");
    await expect(page.getByTestId("field-lines")).toBeHidden();
    await app.drawn();
    expect(await app.colours()).toBeGreaterThan(60);
    await page.getByTestId("field").click();
    await page.getByRole("option", { name: "layer" }).click();
    await expect(page.getByTestId("field-lines")).toBeVisible();

    await page.getByTestId("adapt-to-field").click();
    const dialog = page.getByRole("dialog");
    await expect(page.getByTestId("adapt-forecast")).toHaveText(/About [\d,]+ elements, expected error/);
    expect(await violations(page)).toEqual([]);
    await dialog.getByTestId("adapt-elements").fill("4000");
    await expect(page.getByTestId("adapt-forecast")).toContainText(/About (3,[89]|4,[012])00 elements/);
    await dialog.getByTestId("adapt-apply").click();
    await expect(app.viewport).not.toHaveAttribute("data-tets", String(before));
    await expect(app.viewport).toHaveAttribute("data-busy", "false");
    expect((await app.mesh()).tets).toBeGreaterThan(2500);
    await expect(page.getByTestId("field-legend")).toContainText("layer");
    await page.getByTestId("field").click();
    await expect(page.getByRole("option", { name: "power (elements)" })).toBeVisible();
  },
);

sharedTest(
  "isosurface, arrows, lines and the deformed shape change the picture, on a phone too",
  async ({ page }) => {
    test.slow();
    await page.setViewportSize({ width: 390, height: 844 });
    const app = new AppPage(page);
    await app.openCube();
    await page.keyboard.press("Control+k");
    await page.getByRole("textbox", { name: "Search commands" }).fill("loaded bracket");
    await page.keyboard.press("Enter");
    await expect(page.getByTestId("cycle-5")).toBeVisible({ timeout: 120_000 });
    await expect(app.viewport).toHaveAttribute("data-busy", "false");
    await expect(page.getByTestId("field")).toHaveValue("von Mises stress");
    for (const name of ["field-lines", "field-deformed", "field-arrows", "field-isosurface"]) {
      const before = await app.viewport.screenshot();
      await page.getByTestId(name).click({ force: true });
      await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
    }
    const slider = page.getByRole("slider", { name: "Value of the isosurface" });
    await expect(slider).toBeVisible();
    // The picture is that of the first value as soon as it stays the same.
    let middle = await app.viewport.screenshot();
    await expect
      .poll(async () => {
        const before = middle;
        middle = await app.viewport.screenshot();
        return middle.equals(before);
      })
      .toBe(true);
    await slider.focus();
    for (let step = 0; step < 30; ++step) await page.keyboard.press("ArrowLeft");
    await expect.poll(async () => (await app.viewport.screenshot()).equals(middle)).toBe(false);
    expect(await violations(page)).toEqual([]);
  },
);
