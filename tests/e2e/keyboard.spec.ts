import { expect, test } from "@playwright/test";
import { AppPage } from "./app-page";
import { toggle } from "./controls";
import { sharedTest } from "./shared-page";

sharedTest("a model can be opened, edited, meshed and undone without a mouse", async ({ page }) => {
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

sharedTest(
  "menus work with the keyboard, and single-key hotkeys do nothing while the user types",
  async ({ page }) => {
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
    const cut = toggle(page, "Cut");
    await page.getByLabel("Filter (name, type, id)").fill("x");
    await expect(cut).not.toBeChecked();
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("x");
    await expect(cut).toBeChecked();
  },
);

sharedTest("no menu is taller than the screen of a laptop", async ({ page }) => {
  await page.setViewportSize({ width: 1366, height: 768 });
  await new AppPage(page).openCube();
  for (const menu of await page.getByRole("menubar").getByRole("menuitem").all()) {
    await menu.click();
    const opened = page.getByRole("menu");
    await expect(opened).toBeVisible();
    const { y, height } = (await opened.boundingBox()) ?? { y: 0, height: Infinity };
    expect(y + height).toBeLessThanOrEqual(768);
    await page.keyboard.press("Escape");
    await expect(opened).toBeHidden();
  }
});

sharedTest("help lists every hotkey", async ({ page }) => {
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

test("Ctrl K pressed before the palette has loaded opens it as soon as it has", async ({ page }) => {
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  // Delay the palette's script, as a slow connection would.
  await page.route(/overlays-.*\.js$/, async (route) => {
    await held;
    await route.continue();
  });
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  const palette = page.getByRole("textbox", { name: "Search commands" });
  await expect(palette).toBeHidden();
  // Keys pressed meanwhile are meant for the palette; no command must run.
  await page.keyboard.press("x");
  release();
  await expect(palette).toBeFocused();
  await expect(palette).toHaveValue("x");
  await page.keyboard.type("yz");
  await expect(palette).toHaveValue("xyz");
  await page.keyboard.press("Control+k");
  await expect(palette).toBeHidden();
  await expect(page.getByRole("switch", { name: "Cut" })).not.toBeChecked();
});

sharedTest(
  "what is typed right after Ctrl K finds and runs a command, from a field, too",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByRole("tab", { name: "Display" }).click();
    const plain = page.getByRole("radio", { name: "Plain" });
    await expect(plain).not.toBeChecked();
    const filter = page.getByLabel("Filter (name, type, id)");
    await filter.focus();
    // In one task, so that the palette cannot have the focus.
    await page.evaluate(() => {
      const press = (key: string, ctrlKey = false) =>
        document.activeElement?.dispatchEvent(
          new KeyboardEvent("keydown", { key, code: key, ctrlKey, bubbles: true, cancelable: true }),
        );
      press("k", true);
      for (const key of ["p", "l", "a", "x", "Backspace", "i", "n", " ", "s", "h", "Enter"]) press(key);
    });
    await expect(plain).toBeChecked();
    await expect(filter).toHaveValue("");
    await expect(page.getByRole("dialog", { name: "Search commands" })).toBeHidden();
  },
);

test("a second Ctrl K leaves a palette open that has not appeared yet, and its keys are no commands", async ({
  page,
}) => {
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route(/overlays-.*\.js$/, async (route) => {
    await held;
    await route.continue();
  });
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  await page.keyboard.press("x");
  await page.keyboard.press("Control+k");
  await page.keyboard.press("x");
  release();
  await expect(page.getByRole("textbox", { name: "Search commands" })).toHaveValue("xx");
  await expect(toggle(page, "Cut")).not.toBeChecked();
});

sharedTest("keys are the palette's even if the focus returns to where it was before", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  const palette = page.getByRole("textbox", { name: "Search commands" });
  await expect(palette).toBeFocused();
  // As a menu or a dialog does that closes meanwhile.
  const stealFocus = (): Promise<void> =>
    page.evaluate(() => document.querySelector<HTMLElement>('[data-testid="fit"]')?.focus());
  await stealFocus();
  await page.keyboard.type("plain x");
  await expect(palette).toHaveValue("plain x");
  await stealFocus();
  await page.keyboard.press("Backspace");
  await page.keyboard.type("shading");
  await expect(palette).toHaveValue("plain shading");
  await stealFocus();
  await page.keyboard.press("Enter");
  await expect(palette).toBeHidden();
  await page.getByRole("tab", { name: "Display" }).click();
  await expect(page.getByRole("radio", { name: "Plain" })).toBeChecked();
  await expect(toggle(page, "Cut")).not.toBeChecked();
});

sharedTest(
  "hotkeys win over the button that has the focus, also after a command of a menu",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const menu = page.getByRole("menu");
    const choose = async (): Promise<void> => {
      await page.getByRole("menuitem", { name: "View" }).focus();
      await page.keyboard.press("Enter");
      await page.getByRole("menuitem", { name: "Top view" }).click();
    };
    const isMeshing = async (): Promise<boolean> =>
      page.evaluate(() => document.querySelector('[data-testid="log"]')?.textContent !== "");
    await choose();
    await page.getByRole("menuitem", { name: "View" }).focus();
    await page.keyboard.press("Control+Enter");
    await expect(menu).toHaveCount(0);
    expect(await isMeshing()).toBe(true);
    await app.meshed();
    // In an open menu, too; the menu then closes.
    await page.getByRole("menuitem", { name: "View" }).focus();
    await page.keyboard.press("Enter");
    await expect(page.getByRole("menuitemcheckbox", { name: "Mesh" })).toBeVisible();
    await page.keyboard.press("Control+k");
    await expect(page.getByRole("textbox", { name: "Search commands" })).toBeFocused();
    await page.keyboard.press("Escape");
    await expect(menu).toHaveCount(0);
    // The letters of hotkeys do not search the names of closed menus.
    await page.getByRole("menuitem", { name: "View" }).focus();
    await page.keyboard.press("x");
    await expect(toggle(page, "Cut")).toBeChecked();
    await page.keyboard.press("e");
    await expect(page.getByRole("menuitem", { name: "View" })).toBeFocused();
    // Ctrl Enter opens no list, and closes one.
    const unit = page.getByRole("combobox", { name: "Length unit" });
    await unit.focus();
    await page.keyboard.press("Control+Enter");
    await app.meshed();
    await expect(page.getByRole("option")).toHaveCount(0);
    await unit.click();
    await expect(page.getByRole("option").first()).toBeVisible();
    await page.keyboard.press("Control+Enter");
    await app.meshed();
    await expect(page.getByRole("option")).toHaveCount(0);
    // It presses no button, either.
    await page.getByTestId("cut-button").focus();
    await page.keyboard.press("Control+Enter");
    await app.meshed();
    await expect(toggle(page, "Cut")).toBeChecked();
  },
);

test("hotkeys keep working if the palette cannot be loaded", async ({ page }) => {
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

sharedTest("the palette finds a command by words in any order", async ({ page }) => {
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

test("the palette finds disabled commands with what they need, and does not run them", async ({ page }) => {
  const app = new AppPage(page);
  await page.goto("./?test=1&new=1");
  await expect(app.viewport).toHaveAttribute("data-points", "0");
  await page.keyboard.press("Control+k");
  const box = page.getByRole("dialog", { name: "Search commands" });
  await page.keyboard.type("export mesh");
  const first = box.getByRole("button", { name: /Export mesh…/ });
  await expect(first).toContainText("Generate a mesh first.");
  await expect(first).toHaveAttribute("aria-disabled", "true");
  await page.keyboard.press("Enter");
  await expect(box).toBeVisible();
  await page.keyboard.press("Escape");
  await expect(box).toBeHidden();
});

sharedTest("a numeric setting that is chosen in the palette has its field focused", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const choose = async (words: string): Promise<void> => {
    await page.keyboard.press("Control+k");
    await page.getByRole("textbox", { name: "Search commands" }).fill(words);
    await page.keyboard.press("Enter");
    await expect(page.getByRole("textbox", { name: "Search commands" })).toBeHidden();
  };
  await choose("Gradation");
  await expect(page.getByTestId("gradation")).toBeFocused();
  await page.keyboard.type("1.2");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("gradation")).toHaveValue("1.2");
  const sizes = page.getByTestId("element-size");
  await sizes.getByText("Uniform", { exact: false }).first().click();
  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill("Element size");
  await page.getByRole("dialog").getByRole("button", { name: "Element size", exact: true }).click();
  await expect(page.getByTestId("uniform-size")).toBeFocused();
});

test("the palette sets the theme, snapping and the mouse; F2 renames the project and a selected group", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  const root = page.locator("html");
  const run = async (words: string): Promise<void> => {
    await page.keyboard.press("Control+k");
    await page.getByRole("textbox", { name: "Search commands" }).fill(words);
    await page.keyboard.press("Enter");
    await expect(page.getByRole("textbox", { name: "Search commands" })).toBeHidden();
  };
  await run("light theme");
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "light");
  await run("night");
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "dark");
  // The button and the commands agree.
  await page.getByTestId("theme").click();
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "light");
  await run("dark colours");
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "dark");
  await page.keyboard.press("p");
  await expect(page.getByTestId("snap-grid")).toHaveAttribute("aria-pressed", "true");
  await run("snap grid");
  await expect(page.getByTestId("snap-grid")).toHaveAttribute("aria-pressed", "false");
  await page.keyboard.press("Escape");

  await page.keyboard.press("F2");
  await expect(page.getByTestId("project-name")).toBeFocused();
  await page.keyboard.type("Renamed cube");
  await page.keyboard.press("Enter");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await page.getByTestId("group-selection").click();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("F2");
  await expect(page.getByTestId("group-name")).toBeFocused();
  await page.keyboard.type("everything");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("tree-group-1")).toContainText("everything");
});

sharedTest(
  "a dialog that a menu has opened returns the focus to the menu, and the share dialog takes it",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const dialog = page.getByRole("dialog");
    const menu = (name: string) => page.getByRole("menuitem", { name, exact: true });
    const opened = async (name: string, item: string | RegExp): Promise<void> => {
      await menu(name).click();
      await page.getByRole("menuitem", { name: item }).click();
      await expect(dialog).toBeVisible();
    };
    // The first time, a dialog is mounted open.
    for (const [name, item] of [
      ["Help", /^Help:/],
      ["File", /^Open recent/],
      ["Help", /^Help:/],
    ] as const) {
      await opened(name, item);
      await expect(dialog.locator(":focus")).toHaveCount(1);
      await page.keyboard.press("Escape");
      await expect(dialog).toBeHidden();
      await expect(menu(name)).toBeFocused();
    }
    await opened("File", /^Share/);
    await expect(page.getByTestId("share-link-copy")).toBeFocused();
    await page.keyboard.press("Escape");
    await expect(menu("File")).toBeFocused();
  },
);

test("the start page is reached by Tab, and returns the focus to the view or to what had it", async ({
  page,
}) => {
  await page.goto("./?test=1");
  const start = page.getByTestId("start-page");
  await expect(start).toBeVisible();
  await page.keyboard.press("Tab");
  await expect(start.getByRole("button", { name: "Close start page" })).toBeFocused();
  await page.keyboard.press("Escape");
  await expect(start).toBeHidden();
  await expect(page.getByTestId("viewport-canvas")).toBeFocused();
  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill("welcome");
  await page.keyboard.press("Enter");
  await expect(start).toBeVisible();
  await expect(start.locator("#start-title")).toBeFocused();
  await page.keyboard.press("Escape");
  await expect(page.getByTestId("viewport-canvas")).toBeFocused();
});
