import { expect, test, type Locator, type Page } from "@playwright/test";
import { parseVtu } from "../support/mesh-files";
import { measured } from "../support/mesh-measures";
import { countActions, expectActions, forgetActions } from "./actions";
import { AppPage } from "./app-page";
import { downloadMesh } from "./downloads";
import { undoButton } from "./controls";
import { sharedTest } from "./shared-page";

/** Opens an empty project, and counts the actions of the user from then on. */
class PiecesPage {
  readonly app: AppPage;
  readonly panel: Locator;
  readonly #page: Page;

  constructor(page: Page) {
    this.#page = page;
    this.app = new AppPage(page);
    this.panel = page.getByTestId("operation");
  }

  async open(scheme: "dark" | "light" = "dark"): Promise<void> {
    if (await this.app.openEmptyAgain()) return forgetActions(this.#page);
    await this.#page.addInitScript((chosen) => {
      localStorage.setItem("mantine-color-scheme-value", chosen);
    }, scheme);
    await countActions(this.#page);
    await this.#page.goto("./?new=1&test=1");
    await expect(this.app.viewport).toHaveAttribute("data-status", "none");
  }

  /** As `open`, and adds a box, whose patches are then selected. */
  async openBox(): Promise<void> {
    await this.open();
    await this.start("Box…");
    await this.accept();
    await expect(this.row("patch-6")).toHaveAttribute("aria-selected", "true");
  }

  async press(...keys: readonly string[]): Promise<void> {
    for (const key of keys) await this.#page.keyboard.press(key);
  }

  async type(text: string): Promise<void> {
    await this.#page.keyboard.type(text);
  }

  async click(locator: Locator): Promise<void> {
    await locator.click();
  }

  /** Opens the panel of a command by the palette. */
  async start(command: string): Promise<void> {
    await this.press("Control+k");
    const search = this.#page.getByRole("dialog").getByRole("textbox", { name: "Search commands" });
    await expect(search).toBeFocused();
    await this.type(command);
    await this.press("Enter");
    await expect(this.panel).toBeVisible();
    await expect(this.panel.locator(":focus")).toHaveCount(1);
  }

  /** Accepts the values of the panel. */
  async accept(): Promise<void> {
    await this.press("Enter");
    await expect(this.panel).toBeHidden();
  }

  /** Meshes the model and returns the measures of the file that the app downloads. */
  async mesh(task?: string) {
    await this.press("Control+Enter");
    await this.app.meshed();
    if (task !== undefined) await expectActions(this.#page, task);
    const { volume, ...defects } = measured(parseVtu(await downloadMesh(this.#page, /VTU/)));
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    return volume;
  }

  /** A row of the tree. */
  row(key: string): Locator {
    return this.#page.getByTestId(`tree-${key}`);
  }
}

for (const { command, expected } of [
  { command: "Box…", expected: 2 },
  { command: "Cylinder…", expected: 4 * Math.PI },
  { command: "Sphere…", expected: (32 * Math.PI) / 3 },
]) {
  sharedTest(
    `${command} makes a piece by keyboard only, which is meshed and downloaded`,
    async ({ page }) => {
      const pieces = new PiecesPage(page);
      await pieces.open();
      await pieces.start(command);
      await pieces.type("4/2");
      await pieces.accept();
      const share = (await pieces.mesh("Box, cylinder or sphere")) / expected;
      expect(share).toBeGreaterThan(0.95);
      expect(share).toBeLessThan(1 + 1e-9);
    },
  );
}

sharedTest("a cube with a hole through takes few actions", async ({ page }) => {
  const pieces = new PiecesPage(page);
  await pieces.openBox();
  await pieces.click(pieces.row("patch-2"));
  await pieces.start("Hole through…");
  await pieces.type("0.5");
  await pieces.accept();
  const volume = await pieces.mesh("Cube with a hole through");
  expect(volume).toBeGreaterThan(1 - Math.PI / 16);
  expect(volume).toBeLessThan(1 - 0.9 * (Math.PI / 16));
});

sharedTest(
  "a cylinder on a face of a box shares the face with it: one watertight mesh of two regions",
  async ({ page }) => {
    const pieces = new PiecesPage(page);
    await pieces.openBox();
    await pieces.click(pieces.row("patch-2"));
    await pieces.start("Cylinder…");
    await pieces.type("0.25");
    const note = page.getByTestId("operation-note");
    await expect(note).toContainText("Overlaps 1 face");
    await pieces.click(page.getByTestId("operation-share"));
    await expect(note).toContainText("Shares 1 face");
    await pieces.click(page.getByTestId("accept"));
    const pin = (await pieces.mesh("Cylinder that shares a face of a box")) - 1;
    const [radius, height] = [0.25, 0.5];
    expect(pin / (Math.PI * radius ** 2 * height)).toBeGreaterThan(0.85);
    expect(pin / (Math.PI * radius ** 2 * height)).toBeLessThan(1);
  },
);

test("copies, a mirror image and an array are one step of undo each", async ({ page, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const pieces = new PiecesPage(page);
  await pieces.openBox();
  for (const { open, value, step } of [
    { open: () => pieces.start("Mirror…"), value: "1/2", step: "Mirror selection" },
    { open: () => pieces.start("Circular array…"), value: "3", step: "Add circular array" },
    { open: () => pieces.press("Control+d"), value: "2", step: "Copy selection" },
    { open: () => pieces.press("Control+c", "Control+v"), value: "3", step: "Paste" },
  ]) {
    await open();
    await expect(pieces.panel.locator(":focus")).toHaveCount(1);
    await pieces.type(value);
    await pieces.accept();
    await expect(pieces.row("patch-7")).toBeVisible();
    await page.getByRole("button", { name: `Undo: ${step}` }).click();
    await expect(page.getByRole("button", { name: "Undo: Add box" })).toBeEnabled();
    await expect(pieces.row("patch-7")).toBeHidden();
    await pieces.row("patch-1").click();
    for (let id = 2; id <= 6; ++id) await pieces.row(`patch-${id}`).click({ modifiers: ["ControlOrMeta"] });
  }
});

sharedTest(
  "a rotation begins with the angle and a scale with the factors, so that they can be typed at once",
  async ({ page }) => {
    const pieces = new PiecesPage(page);
    await pieces.openBox();
    await pieces.start("Rotate…");
    await expect(page.getByTestId("operation-angle")).toBeFocused();
    await pieces.type("45");
    await pieces.press("Enter");
    await expect(page.getByRole("button", { name: "Undo: Rotate selection" })).toBeEnabled();
    await pieces.start("Scale…");
    await expect(page.getByTestId("operation-factors-x")).toBeFocused();
    await pieces.type("2");
    await pieces.press("Enter");
    await expect(page.getByRole("button", { name: "Undo: Scale selection" })).toBeEnabled();
    // The longer diagonal of the base lies along x, from -√2 to √2.
    await page.getByLabel("Filter (name, type, id)").fill("point");
    const rows = await page.getByTestId(/^tree-point-/).allInnerTexts();
    expect(rows.some((text) => text.includes("1.414"))).toBe(true);
  },
);

sharedTest(
  "a sphere is placed by its centre; the digits of a wing are four, and typed without a click",
  async ({ page }) => {
    const pieces = new PiecesPage(page);
    await pieces.open();
    await pieces.start("Sphere…");
    await expect(pieces.panel.getByText("Centre", { exact: true })).toBeVisible();
    await expect(pieces.panel.getByText("Base centre")).toBeHidden();
    await pieces.press("Escape");
    await pieces.start("NACA wing…");
    const digits = page.getByTestId("operation-digits");
    await expect(digits).toHaveValue("0012");
    await pieces.type("0009");
    await pieces.press("Tab", "Shift+Tab");
    await expect(digits).toHaveValue("0009");
    await pieces.press("ArrowUp");
    await expect(digits).toHaveValue("0010");
  },
);

test("Escape closes the panel and restores the project", async ({ page }) => {
  const pieces = new PiecesPage(page);
  await pieces.open();
  await pieces.start("Box…");
  await expect(pieces.row("patch-6")).toBeVisible();
  await pieces.press("Escape");
  await expect(pieces.panel).toBeHidden();
  await expect(pieces.row("patch-6")).toBeHidden();
  await expect(undoButton(page)).toBeDisabled();

  await pieces.start("Box…");
  const width = page.getByTestId("operation-width");
  await width.fill("2+");
  await page.keyboard.press("Escape");
  await expect(width).toHaveValue("1");
  // A number that the view already shows cannot be discarded any more.
  await width.fill("2");
  await page.keyboard.press("Escape");
  await expect(pieces.panel).toBeHidden();
  await expect(undoButton(page)).toBeDisabled();
});
