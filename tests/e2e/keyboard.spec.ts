import { expect, test } from "@playwright/test";
import { AppPage } from "./app-page";

test("a model is opened, edited, meshed and undone without a mouse", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const opening = await app.mesh();

  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill("example");
  await page.keyboard.press("Enter");
  const card = page.getByTestId("example-unit-cube");
  await expect(card).toBeVisible();
  await card.focus();
  await page.keyboard.press("Enter");
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", opening.fingerprint);
  const before = await app.meshed();

  await page.getByTestId("tree-point").focus();
  await page.keyboard.press("End");
  await expect(page.getByTestId("tree-source")).toBeFocused();
  await page.keyboard.press("ArrowUp");
  await expect(page.getByTestId("tree-background-node-4")).toBeFocused();
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("tree-background-node-3")).toHaveAttribute("aria-selected", "true");
  await page.getByTestId("node-size").focus();
  await page.keyboard.type("0.11");
  await page.keyboard.press("Control+Enter");
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
  const after = await app.meshed();
  expect(after.tets).toBeGreaterThan(before.tets);

  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+z");
  expect(await app.meshed()).toEqual(before);
  await page.keyboard.press("Control+Shift+z");
  expect(await app.meshed()).toEqual(after);
});

test("menus open, walk and run by keys, and single keys rest while typing", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  await page.getByRole("menuitem", { name: "File" }).focus();
  await page.keyboard.press("ArrowRight");
  await expect(page.getByRole("menuitem", { name: "Edit" })).toBeFocused();
  await page.keyboard.press("ArrowRight");
  await expect(page.getByRole("menuitem", { name: "Create" })).toBeFocused();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("menuitemcheckbox", { name: "Mesh" })).toBeChecked();
  await page.keyboard.press("Escape");
  const cut = page.getByTestId("cut-toggle");
  await page.getByLabel("Filter (name, type, id)").fill("x");
  await expect(cut).not.toBeChecked();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("x");
  await expect(cut).toBeChecked();
});

test("help lists every hotkey", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  await page.keyboard.press("Shift+?");
  const help = page.getByRole("dialog", { name: "Keyboard and mouse" });
  for (const text of ["Generate mesh", "Fit model", "Clear selection", "Save project", "Top view"]) {
    await expect(help).toContainText(text);
  }
  await page.keyboard.press("Escape");
  await expect(help).toBeHidden();
});

test("Ctrl K pressed before the palette is there opens it when it is", async ({ page }) => {
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  // The palette's part of the app arrives late, as over a slow line.
  await page.route(/overlays-.*\.js$/, async (route) => {
    await held;
    await route.continue();
  });
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  const palette = page.getByRole("textbox", { name: "Search commands" });
  await expect(palette).toBeHidden();
  // What is typed meanwhile is meant for the palette: no command may take it for its key.
  await page.keyboard.press("x");
  release();
  await expect(palette).toBeFocused();
  await page.keyboard.press("Control+k");
  await expect(palette).toBeHidden();
  await expect(page.getByRole("switch", { name: "Cut" })).not.toBeChecked();
});

test("keys stay the commands' when the palette's part of the app does not come", async ({ page }) => {
  await page.route(/overlays-.*\.js$/, (route) => route.abort());
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  await expect(page.getByRole("alert")).toContainText("could not be loaded");
  const cut = page.getByRole("switch", { name: "Cut" });
  await page.keyboard.press("x");
  await expect(cut).toBeChecked();
  await page.keyboard.press("Control+k");
  await page.keyboard.press("x");
  await expect(cut).not.toBeChecked();
});

test("the palette finds a command by its words in any order", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  const palette = page.getByRole("textbox", { name: "Search commands" });
  const found = page.getByRole("dialog", { name: "Search commands" }).getByRole("button");
  await palette.fill("Use mesh as background");
  await expect(found).toHaveText(["Use this mesh as background grid"]);
  await palette.fill("mesh and no such word");
  await expect(found).toHaveCount(0);
  await palette.fill("  plain SHAD ");
  await expect(found).toHaveText(["Plain shading"]);
  await palette.press("Enter");
  await expect(palette).toBeHidden();
  await page.getByRole("tab", { name: "Display" }).click();
  await expect(page.getByRole("radio", { name: "Plain" })).toBeChecked();
});
