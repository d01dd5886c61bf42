import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { tab } from "./controls";

/** Runs axe in the page only, which has no frames; otherwise axe opens another tab for each analysis. */
async function violations(page: Page, scheme: "dark" | "light"): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  // The themes differ in colours alone.
  if (scheme === "light") axe.withRules("color-contrast");
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) =>
    nodes.map(({ html, failureSummary }) => `${id}: ${html} ${failureSummary}`),
  );
}

for (const scheme of ["dark", "light"] as const) {
  test(`axe finds no violations in the ${scheme} theme`, async ({ page }) => {
    const app = new AppPage(page);
    await app.open(scheme);
    expect(await violations(page, scheme)).toEqual([]);
    await page.getByTestId("mesh-settings").locator("summary").click();
    expect(await violations(page, scheme)).toEqual([]);
    await tab(page, "Quality").click();
    await page.getByTestId("worst-0").click();
    expect(await violations(page, scheme)).toEqual([]);
    await page.getByRole("tab", { name: "Inspector" }).click();
    await page.keyboard.press("x");
    await app.select("line-1");
    expect(await violations(page, scheme)).toEqual([]);
    await app.select("background-node-3");
    await app.type("node-stretching", "2");
    await expect(page.getByTestId("mesh-badge")).toBeVisible();
    await page.getByRole("tab", { name: "Display" }).click();
    expect(await violations(page, scheme)).toEqual([]);
    await tab(page, "Examples").click();
    await page.getByRole("tab", { name: "Problems" }).click();
    expect(await violations(page, scheme)).toEqual([]);
  });

  test(`axe finds no violations in menus, palette, help and errors in the ${scheme} theme`, async ({
    page,
  }) => {
    const app = new AppPage(page);
    await app.open(scheme);
    await page.getByRole("menuitem", { name: "View" }).click();
    await expect(page.getByRole("menuitemcheckbox", { name: "Mesh" })).toBeVisible();
    expect(await violations(page, scheme)).toEqual([]);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Control+k");
    await expect(page.getByRole("textbox", { name: "Search commands" })).toBeVisible();
    expect(await violations(page, scheme)).toEqual([]);
    await page.keyboard.press("Escape");
    await page.keyboard.press("Shift+?");
    await expect(page.getByRole("dialog", { name: "Keyboard and mouse" })).toBeVisible();
    expect(await violations(page, scheme)).toEqual([]);
    await page.keyboard.press("Escape");
    await app.openExample("unit-cube");
    await app.select("point-7");
    await app.type("position-x", "1.5");
    await expect(page.getByTestId("marker-0")).toBeVisible();
    await page.getByTestId("tree-patch-2").click();
    await page.getByRole("tab", { name: "Problems" }).click();
    expect(await violations(page, scheme)).toEqual([]);
  });

  test(`axe finds no violations on a phone in the ${scheme} theme`, async ({ page }) => {
    await page.setViewportSize({ width: 390, height: 844 });
    const app = new AppPage(page);
    await app.open(scheme);
    expect(await violations(page, scheme)).toEqual([]);
    for (const drawer of ["left", "right", "bottom"]) {
      await page.getByTestId(`drawer-${drawer}`).click();
      await expect(page.getByRole("dialog")).toBeVisible();
      expect(await violations(page, scheme)).toEqual([]);
      await page.keyboard.press("Escape");
      await expect(page.getByRole("dialog")).toBeHidden();
    }
  });
}
