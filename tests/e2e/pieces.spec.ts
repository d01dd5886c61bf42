import { expect, test, type Page } from "@playwright/test";
import { AppPage } from "./app-page";

/** Opens an empty project. */
async function openNew(page: Page): Promise<AppPage> {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "New project" }).click();
  await expect(page.getByTestId("project-name")).toHaveValue("Untitled");
  return app;
}

/** Runs a command by the palette. */
async function runByPalette(page: Page, name: string): Promise<void> {
  await page.keyboard.press("Control+k");
  await page
    .getByRole("searchbox")
    .or(page.getByPlaceholder(/command/i))
    .fill(name);
  await page.keyboard.press("Enter");
}

test("a box is created by keyboard only and meshed", async ({ page }) => {
  const app = await openNew(page);
  await runByPalette(page, "Box…");
  const panel = page.getByTestId("operation");
  await expect(panel.getByTestId("operation-width")).toBeFocused();
  await page.keyboard.type("2");
  await page.keyboard.press("Tab");
  await page.keyboard.type("3/2");
  await page.keyboard.press("Enter");
  await expect(panel).toBeHidden();
  const mesh = await app.generate();
  expect(mesh.tets).toBeGreaterThan(20);
});
