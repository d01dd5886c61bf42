import { expect, type Page } from "@playwright/test";
import { AppPage, sampleProject } from "./app-page";
import { undoButton } from "./controls";
import { sharedTest } from "./shared-page";

/** Runs a command by its name. */
async function run(page: Page, name: string): Promise<void> {
  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill(name);
  await page.keyboard.press("Enter");
}

sharedTest("a patch becomes smooth with its lines, and undo restores both", async ({ page }) => {
  const app = new AppPage(page);
  await app.open("dark", "engine-intake");
  const project = sampleProject("engine-intake");
  const keyOf = (kind: "lines" | "patches", named: string): number =>
    project[kind].find(({ name }) => name === named)?.id ?? 0;
  await app.select(`patch-${keyOf("patches", "duct side")}`);
  await expect(page.getByTestId("patch-type")).toHaveValue("Coons");
  await run(page, "Make patches smooth");
  await expect(page.getByTestId("patch-type")).toHaveValue("smooth quadrilateral (Gregory)");
  await expect(page.getByTestId("inspector").locator("[data-code]")).toHaveCount(0);
  await app.select(`line-${keyOf("lines", "upper edge")}`);
  await expect(page.getByTestId("line-type")).toHaveValue("Hermite line");
  await page.getByTestId("give-start-tangent").click();
  await expect(page.getByTestId("start-tangent-x")).toBeVisible();
  await undoButton(page).click();
  await expect(page.getByTestId("give-start-tangent")).toBeVisible();
  await undoButton(page).click();
  await expect(page.getByTestId("line-type")).toHaveValue("cubic spline");
});

sharedTest("zebra stripes and curvatures replace the mesh, with a legend", async ({ page }) => {
  const app = new AppPage(page);
  await app.open("dark", "smooth-intake");
  await run(page, "Zebra stripes on patches");
  await expect(page.getByTestId("zebra-legend")).toBeVisible();
  await run(page, "Patches by largest curvature");
  await expect(page.getByTestId("curvature-legend")).toContainText("largest curvature");
  await page.getByRole("tab", { name: "Display" }).click();
  await page.getByTestId("smoothness").getByText("Gaussian").click();
  await expect(page.getByTestId("curvature-legend")).toContainText("Gaussian curvature");
  await page.getByTestId("smoothness").getByText("Off").click();
  await expect(page.getByTestId("curvature-legend")).toHaveCount(0);
  await app.drawn();
});
