import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { tab } from "./controls";

/** Runs axe in the page only, which has no frames; otherwise axe opens another tab for each analysis. */
async function violationsIn(page: Page, rules: readonly string[]): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  if (rules.length > 0) axe.withRules([...rules]);
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) =>
    nodes.map(({ html, failureSummary }) => `${id}: ${html} ${failureSummary}`),
  );
}

/** Violations in the dark theme, and those of contrast in the light one: the themes differ in colours alone. */
async function violations(page: Page): Promise<string[]> {
  const root = page.locator("html");
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "dark");
  const dark = await violationsIn(page, []);
  await page.emulateMedia({ colorScheme: "light" });
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "light");
  const light = await violationsIn(page, ["color-contrast"]);
  await page.emulateMedia({ colorScheme: "dark" });
  return [...dark.map((text) => `dark: ${text}`), ...light.map((text) => `light: ${text}`)];
}

/** Opens the app with the colours of the system, which are dark at first. */
async function openApp(page: Page): Promise<AppPage> {
  await page.emulateMedia({ colorScheme: "dark" });
  const app = new AppPage(page);
  await app.open("auto");
  return app;
}

test("axe finds no violations in the dark theme and in the light one", async ({ page }) => {
  const app = await openApp(page);
  expect(await violations(page)).toEqual([]);
  await page.getByTestId("mesh-settings").locator("summary").click();
  expect(await violations(page)).toEqual([]);
  await tab(page, "Quality").click();
  await page.getByTestId("worst-0").click();
  expect(await violations(page)).toEqual([]);
  await page.getByRole("tab", { name: "Inspector" }).click();
  await page.keyboard.press("x");
  await app.select("line-1");
  expect(await violations(page)).toEqual([]);
  await app.select("background-node-3");
  await app.type("node-stretching", "2");
  await expect(page.getByTestId("mesh-badge")).toBeVisible();
  await page.getByRole("tab", { name: "Display" }).click();
  expect(await violations(page)).toEqual([]);
  await tab(page, "Examples").click();
  await page.getByRole("tab", { name: "Problems" }).click();
  expect(await violations(page)).toEqual([]);
});

test("axe finds no violations in menus, palette, help and errors, in both themes", async ({ page }) => {
  const app = await openApp(page);
  await page.getByRole("menuitem", { name: "View" }).click();
  await expect(page.getByRole("menuitemcheckbox", { name: "Mesh" })).toBeVisible();
  expect(await violations(page)).toEqual([]);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+k");
  await expect(page.getByRole("textbox", { name: "Search commands" })).toBeVisible();
  expect(await violations(page)).toEqual([]);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Shift+?");
  await expect(page.getByRole("dialog", { name: "Keyboard and mouse" })).toBeVisible();
  expect(await violations(page)).toEqual([]);
  await page.keyboard.press("Escape");
  await app.openExample("unit-cube");
  await app.select("point-7");
  await app.type("position-x", "1.5");
  await expect(page.getByTestId("marker-0")).toBeVisible();
  await page.getByTestId("tree-patch-2").click();
  await page.getByRole("tab", { name: "Problems" }).click();
  expect(await violations(page)).toEqual([]);
});

test("axe finds no violations on a phone, in both themes", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await openApp(page);
  expect(await violations(page)).toEqual([]);
  for (const drawer of ["left", "right", "bottom"]) {
    await page.getByTestId(`drawer-${drawer}`).click();
    await expect(page.getByRole("dialog")).toBeVisible();
    expect(await violations(page)).toEqual([]);
    await page.keyboard.press("Escape");
    await expect(page.getByRole("dialog")).toBeHidden();
  }
});
