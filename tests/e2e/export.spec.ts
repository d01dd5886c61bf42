import { expect } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { parseVtu } from "../support/mesh-files";
import { AppPage, sampleProject } from "./app-page";
import { chooseFormat, downloadMesh } from "./downloads";
import { sharedTest } from "./shared-page";

sharedTest(
  "one dialog exports the mesh: format, order, encoding and what the file keeps",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByRole("menuitem", { name: "File" }).click();
    await expect(page.getByRole("menuitem", { name: /Download mesh as|Export mesh…/ })).toHaveCount(1);
    await page.keyboard.press("Escape");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+Shift+E");
    const dialog = page.getByRole("dialog", { name: "Export mesh" });
    const file = dialog.getByTestId("export-file");
    await expect(file).toContainText("unit-cube.vtu");
    const keeps = dialog.getByTestId("export-keeps");
    await expect(keeps).toContainText("tetrahedra and the triangles of the boundary, linear");
    await dialog.getByText("Second order", { exact: true }).click();
    await expect(keeps).toContainText("second order");

    await dialog.getByRole("radio", { name: /^UGRID/ }).check();
    await expect(keeps).toContainText("linear");
    await expect(keeps).toContainText("numbers only");
    await dialog.getByTestId("export-encoding").getByText("Text", { exact: true }).click();
    await expect(file).toContainText("unit-cube.ugrid");
    await dialog.getByRole("radio", { name: /^STL/ }).check();
    await expect(keeps).toContainText("single precision");
    await expect(keeps).toContainText("numbers only");
    await expect(dialog.getByRole("radio", { name: "Second order" })).toBeDisabled();
    await dialog.getByRole("radio", { name: /^UGRID/ }).check();
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      dialog.getByRole("button", { name: "Export", exact: true }).click(),
    ]);
    await expect(dialog).toBeHidden();
    expect(download.suggestedFilename()).toBe("unit-cube.ugrid");
    const [nodes] = (await readFile(await download.path(), "utf8")).split(/\s+/).map(Number);
    expect(await page.getByTestId("count-points").textContent()).toContain(String(nodes));
  },
);

sharedTest("on a phone, the buttons are in sight however the choices are scrolled", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await new AppPage(page).openCube();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+Shift+E");
  const button = page.getByTestId("export-apply");
  await expect(button).toBeInViewport({ ratio: 1 });
  for (const choice of [page.getByRole("radio").first(), page.getByRole("radio", { name: /^STL/ })]) {
    await choice.focus();
    await expect(button).toBeInViewport({ ratio: 1 });
    const [upper, lower] = [await choice.boundingBox(), await button.boundingBox()];
    expect((upper?.y ?? 0) + (upper?.height ?? 0)).toBeLessThanOrEqual(lower?.y ?? 0);
  }
});

sharedTest("lengths are exported in the unit that is chosen", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const given = parseVtu(await downloadMesh(page, /^VTU/));
  await chooseFormat(page, /^VTU/);
  await page.getByTestId("export-unit").click();
  await page.getByRole("option", { name: "mm", exact: true }).click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByTestId("export-apply").click(),
  ]);
  const converted = parseVtu(new Uint8Array(await readFile(await download.path())));
  expect(converted.tetrahedra).toEqual(given.tetrahedra);
  // The cube is drawn in metres.
  expect(Array.from(converted.points)).toEqual(Array.from(given.points, (x) => x * 1000));
});

for (const width of [1440, 390]) {
  sharedTest(
    `every label of the dialog is whole in a window of ${width} pixels, with and without a unit`,
    async ({ page }) => {
      await page.setViewportSize({ width, height: 844 });
      const app = new AppPage(page);
      await app.openCube();
      const { units: _, ...without } = sampleProject("unit-cube");
      for (const project of [sampleProject("unit-cube"), { ...without, name: "no unit" }]) {
        await app.openFile("model.json", JSON.stringify(project));
        await app.meshed();
        await page.getByTestId("viewport-canvas").focus();
        await page.keyboard.press("Control+Shift+E");
        const dialog = page.getByRole("dialog", { name: "Export mesh" });
        await expect(dialog.getByTestId("export-apply")).toBeVisible();
        const cut = await dialog
          .locator("input, label, button, dd, dt, span, strong")
          .evaluateAll((all) =>
            all
              .filter(({ scrollWidth, clientWidth }) => clientWidth > 0 && scrollWidth > clientWidth + 1)
              .map(({ outerHTML }) => outerHTML),
          );
        expect(cut).toEqual([]);
        await page.keyboard.press("Escape");
        await expect(dialog).toBeHidden();
      }
    },
  );
}
