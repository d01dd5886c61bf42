/** A front in class: presenter mode and the laser pointer. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Locator, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { button, choice, playButton, slider } from "./controls";

/** Fronts to talk about, by their model and step. */
const fronts = {
  cube: "unit-cube&step=0",
  ideal: "unit-cube&step=99",
  candidates: "unit-cube&step=1223",
  crossing: "unit-cube&step=258&candidate=0",
  patch: "square-to-circle&step=-900&color=size",
} as const;

async function openFront(page: Page, front: keyof typeof fronts): Promise<void> {
  await page.goto(`./?test=1&model=${fronts[front]}`);
  const step = new URLSearchParams(`model=${fronts[front]}`).get("step") ?? "";
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", step);
}

const heightOf = async (page: Page): Promise<number> =>
  (await page.getByTestId("player-counter").boundingBox())?.height ?? 0;

test("presenter mode has larger type and a laser pointer that takes no clicks", async ({ page }) => {
  await openFront(page, "cube");
  const before = await heightOf(page);
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  await expect(page.getByRole("menuitemcheckbox")).toHaveCount(0);
  await expect(page.getByTestId("presenter")).toBeVisible();
  expect(await heightOf(page)).toBeGreaterThan(1.3 * before);
  await page.getByTestId("presenter-laser").click();
  await page.mouse.move(500, 400);
  const dot = await page.getByTestId("laser").boundingBox();
  expect((dot?.x ?? 0) + (dot?.width ?? 0) / 2).toBeCloseTo(500, 0);
  expect((dot?.y ?? 0) + (dot?.height ?? 0) / 2).toBeCloseTo(400, 0);
  // The scrub bar goes where it is clicked, although its panel is enlarged.
  const bar = await slider(page, "Step of the front").boundingBox();
  const viewport = page.getByTestId("viewport");
  await page.mouse.click((bar?.x ?? 0) + (bar?.width ?? 0) - 1, (bar?.y ?? 0) + 5);
  const last = Number(await viewport.getAttribute("data-steps"));
  await expect
    .poll(async () => Number(await viewport.getAttribute("data-step")))
    .toBeGreaterThan(0.97 * last);
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  expect((await axe.analyze()).violations.map(({ id }) => id)).toEqual([]);
  await page.getByTestId("presenter-end").click();
  await expect(page.getByTestId("laser")).toHaveCount(0);
  expect(await heightOf(page)).toBe(before);
});

test("on a phone, the button that ends presenter mode covers nothing of the view", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Presenter mode");
  await page.keyboard.press("Enter");
  const end = page.getByTestId("presenter-end");
  await expect(end).toBeInViewport({ ratio: 1 });
  const view = await boxOf(page.getByTestId("viewport-canvas"));
  expect((await boxOf(end)).y).toBeGreaterThanOrEqual(view.y + view.height);
  await end.click();
  await expect(page.getByTestId("presenter")).toHaveCount(0);
});

test("presenter mode enlarges the labels of the view, and knows the keys of a clicker", async ({ page }) => {
  await openFront(page, "ideal");
  const labels = page.getByTestId("lens-labels").locator("span");
  const heightOfLabel = async (): Promise<number> => (await labels.first().boundingBox())?.height ?? 0;
  const legend = async (): Promise<number> =>
    (await page.getByTestId("lens-legend").boundingBox())?.height ?? 0;
  const before = [await heightOfLabel(), await legend()];
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  await expect(page.getByTestId("presenter")).toBeVisible();
  expect(await heightOfLabel()).toBeGreaterThan(1.3 * (before[0] ?? 0));
  expect(await legend()).toBeGreaterThan(1.3 * (before[1] ?? 0));
  const step = async () => Number(await page.getByTestId("viewport").getAttribute("data-step"));
  const first = await step();
  await page.keyboard.press("PageDown");
  await expect.poll(step).toBe(first + 1);
  await page.keyboard.press("PageUp");
  await page.keyboard.press("PageUp");
  await expect.poll(step).toBe(first - 1);
  await page.keyboard.press("b");
  await expect(page.getByTestId("presenter-blank")).toBeVisible();
  await page.keyboard.press("PageDown");
  await expect(page.getByTestId("presenter-blank")).toHaveCount(0);
  await expect.poll(step).toBe(first);
  // Some clickers send arrows. A button or a list that was used last keeps the focus.
  await page.keyboard.press("ArrowRight");
  await expect.poll(step).toBe(first + 1);
  await button(page, "Step back").click();
  await page.keyboard.press("ArrowLeft");
  await expect.poll(step).toBe(first - 1);
  await page.getByTestId("player-more").click();
  await choice(page, "Speed").selectOption({ index: 0 });
  await choice(page, "Speed").focus();
  await page.keyboard.press("PageDown");
  await expect.poll(step).toBe(first);
  await page.keyboard.press("F5");
  await expect(playButton(page)).toHaveAttribute("aria-label", /Pause/);
});

async function present(page: Page): Promise<void> {
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  await expect(page.getByTestId("presenter")).toBeVisible();
}

const boxOf = async (part: Locator) =>
  (await part.boundingBox()) ?? { x: NaN, y: NaN, width: NaN, height: NaN };

const screens = [
  [1280, 720],
  [1440, 900],
  [1920, 1080],
] as const;

test("an audience sees the player in two rows, a large plane, and no label under a bar or the cube", async ({
  page,
}) => {
  await openFront(page, "patch");
  await present(page);
  for (const [width, height] of screens)
    await test.step(`at ${width} × ${height}`, async () => {
      await page.setViewportSize({ width, height });
      await expect.poll(async () => (await boxOf(page.locator("body"))).width).toBe(width);
      await new AppPage(page).rest();
      const player = page.getByTestId("player");
      const rows = new Set<number>();
      for (const part of [
        ...(await player.getByRole("button").all()),
        player.getByTestId("player-counter"),
      ]) {
        const { y, height } = await boxOf(part);
        rows.add(Math.round((y + height / 2) / 10));
      }
      expect(rows.size).toBe(1);
      await expect(slider(player, "Step of the front")).toBeInViewport({ ratio: 1 });
      const view = await boxOf(page.getByRole("main"));
      expect((await boxOf(page.getByTestId("presenter"))).y).toBeGreaterThanOrEqual(view.y + view.height);
      await expect
        .poll(async () => (await boxOf(page.getByTestId("plane-view").locator("svg g").first())).height)
        .toBeGreaterThan(0.55 * view.height);
      const canvas = await boxOf(page.getByTestId("viewport-canvas"));
      const cube = { left: canvas.x + canvas.width - 102, bottom: canvas.y + 102 };
      const cut = await boxOf(page.getByRole("group", { name: "Cut" }));
      expect(cut.x + cut.width).toBeLessThan(cube.left);
      for (const label of await page.getByTestId("lens-labels").locator("span").all()) {
        const { x, y, width } = await boxOf(label);
        const text = await label.innerText();
        // Dots of candidates without a letter.
        if (text === "") continue;
        expect(x + width < cube.left || y > cube.bottom, `${text} beside the cube`).toBe(true);
        expect(x > cut.x + cut.width || y > cut.y + cut.height, `${text} beside the bar`).toBe(true);
      }
    });
});

test("no formula of the lens is broken across lines", async ({ page }) => {
  await openFront(page, "patch");
  const lens = page.getByTestId("lens");
  const broken = () =>
    lens.locator(".katex-html").evaluateAll((formulas) =>
      formulas
        .filter((formula) => {
          const middles = [...formula.children].map((part) => {
            const { top, bottom } = part.getBoundingClientRect();
            return (top + bottom) / 2;
          });
          return Math.max(...middles) - Math.min(...middles) > 12;
        })
        .map(({ textContent }) => textContent),
    );
  await expect(lens.locator(".katex").first()).toBeVisible();
  for (let step = 0; step < 12; ++step) {
    expect(await broken()).toEqual([]);
    const widths = await lens
      .locator("p:has(.katex)")
      .evaluateAll((all) => all.map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth));
    expect(Math.max(0, ...widths)).toBe(0);
    await button(page, "Step forward").click();
  }
});

for (const front of ["ideal", "candidates", "crossing"] as const)
  test(`presenter mode shows the formulas of a step without scrolling: ${front}`, async ({ page }) => {
    await page.setViewportSize({ width: 1440, height: 900 });
    await openFront(page, front);
    await page.getByRole("menuitem", { name: "Help" }).click();
    await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
    await expect(page.getByTestId("presenter")).toBeVisible();
    const lens = page.getByTestId("lens");
    await expect(lens.locator("section .katex").first()).toBeVisible();
    const test = lens.getByTestId("lens-formula").or(lens.getByTestId("lens-ideal")).first();
    for (const formula of await test.locator(".katex").all())
      await expect(formula).toBeInViewport({ ratio: 1 });
    // Verdicts take more lines rather than being cut.
    const verdicts = lens.getByRole("cell");
    for (const cell of await verdicts.all())
      expect(await cell.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBe(0);
    expect(await lens.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBe(0);
  });

test("Escape ends presenter mode, but first a menu, a selection or text in a field", async ({ page }) => {
  await openFront(page, "cube");
  const presenter = page.getByTestId("presenter");
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  await expect(presenter).toBeVisible();
  await page.getByRole("menuitem", { name: "Help" }).click();
  await expect(page.getByRole("menuitemcheckbox")).toHaveCount(1);
  await page.keyboard.press("Escape");
  await expect(page.getByRole("menuitemcheckbox")).toHaveCount(0);
  await expect(presenter).toBeVisible();
  await page.getByPlaceholder("p1").fill("width");
  await page.keyboard.press("Escape");
  await expect(presenter).toBeVisible();
  // Everything is selected, and the first Escape clears this.
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Escape");
  await expect(presenter).toBeVisible();
  // A list stays focused after a choice.
  await page.getByTestId("player-more").click();
  await choice(page, "Jump to").selectOption("crosses");
  await choice(page, "Jump to").focus();
  await page.keyboard.press("Escape");
  await expect(presenter).toHaveCount(0);
  await page.keyboard.press("Escape");
  await expect(presenter).toHaveCount(0);
});

test("on a phone, presenter mode cuts off no button of the header", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto("./?test=1&new=1");
  await expect(page.getByRole("banner")).toBeVisible();
  await page.keyboard.press("Control+k");
  await page.getByRole("textbox", { name: "Search commands" }).fill("Presenter mode");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("presenter")).toBeVisible();
  const buttons = await page.getByRole("banner").getByRole("button").all();
  expect(buttons.length).toBeGreaterThan(3);
  for (const button of buttons) {
    const box = await button.boundingBox();
    expect((box?.x ?? NaN) + (box?.width ?? NaN), await button.innerText()).toBeLessThanOrEqual(390);
  }
});

test("presenter mode keeps the view, and gives its room to the panels", async ({ page }) => {
  await openFront(page, "candidates");
  const viewport = page.getByTestId("viewport");
  const step = (await viewport.getAttribute("data-step")) ?? "";
  const canvas = viewport.locator("canvas").first();
  // If presenter mode made a new view, its canvas and camera would be others.
  await canvas.evaluate((element) => element.setAttribute("data-seen", "before"));
  const width = (await page.getByTestId("lens").boundingBox())?.width ?? 0;
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  await expect(page.getByTestId("presenter")).toBeVisible();
  await expect(canvas).toHaveAttribute("data-seen", "before");
  await expect(viewport).toHaveAttribute("data-step", step);
  await expect(page.getByRole("complementary", { name: "Model", exact: true })).toBeHidden();
  expect((await page.getByTestId("lens").boundingBox())?.width).toBeGreaterThan(1.2 * width);
  await page.getByTestId("presenter-end").click();
  await expect(canvas).toHaveAttribute("data-seen", "before");
  await expect(page.getByRole("complementary", { name: "Model", exact: true })).toBeVisible();
  expect((await page.getByTestId("lens").boundingBox())?.width).toBeCloseTo(width, 0);
});

test("the panel of an operation is enlarged, and the model keeps clear of it", async ({ page }) => {
  const app = new AppPage(page);
  await app.open("dark", "unit-cube");
  const panel = page.getByTestId("operation");
  const runCommand = async (name: string): Promise<void> => {
    await page.keyboard.press("Control+k");
    await page.getByRole("textbox", { name: "Search commands" }).fill(name);
    await page.keyboard.press("Enter");
  };
  const box = async (): Promise<{ x: number; width: number }> =>
    (await panel.boundingBox()) ?? { x: NaN, width: NaN };
  const width = async (): Promise<number> => (await box()).width;
  /** Distance between the panel and the model. */
  const gap = async (): Promise<number> => {
    const { x, width } = await box();
    return (await edgeOfModel()) - x - width;
  };
  const edgeOfModel = async (): Promise<number> => {
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => app.at([i & 1, (i >> 1) & 1, i >> 2]));
    return Math.min(...(await Promise.all(corners)).map(({ x }) => x));
  };
  await runCommand("Box…");
  await expect(panel).toBeVisible();
  const before = await width();
  await expect.poll(gap).toBeGreaterThan(0);
  await runCommand("Presenter mode");
  await expect.poll(width).toBeGreaterThan(1.3 * before);
  await expect.poll(gap).toBeGreaterThan(0);
  // Its last button can be reached, and nothing is half covered by it.
  await expect(panel.getByTestId("accept")).toBeInViewport({ ratio: 1 });
  await expect(page.getByTestId("mesh-badge")).toHaveCount(0);
  await page.getByTestId("presenter-end").click();
  await expect.poll(width).toBe(before);
  await expect.poll(gap).toBeGreaterThan(0);
  await page.keyboard.press("Escape");
  await expect(panel).toBeHidden();
});

test("on a phone, the lens shows the formulas of a crossing without scrolling, and no label of further candidates", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await openFront(page, "crossing");
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Log and problems" }).click();
  const formulas = page.getByTestId("lens-formula").locator(".katex");
  await expect(formulas.first()).toBeVisible();
  for (const formula of await formulas.all()) await expect(formula).toBeInViewport({ ratio: 1 });
  await expect(page.getByTestId("player-counter")).toBeInViewport({ ratio: 1 });
  const labels = page.getByTestId("lens-labels").locator("span").filter({ visible: true });
  await expect
    .poll(async () => (await labels.allInnerTexts()).filter((text) => /^node/.test(text)))
    .toHaveLength(1);
  // What is used less is behind a button.
  await page.getByTestId("player-more").click();
  await expect(choice(page, "Speed")).toBeVisible();
  await expect(choice(page, "Jump to")).toBeVisible();
});

test("presenter mode enlarges notices, which cover no legend", async ({ page }) => {
  await openFront(page, "ideal");
  const notices = page.getByRole("region", { name: "Notices" });
  const shownNotice = async (): Promise<{
    readonly top: number;
    readonly bottom: number;
    readonly type: number;
  }> => {
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+k");
    await page.keyboard.type("Keep for offline use");
    await page.keyboard.press("Enter");
    const notice = notices.locator("p").first();
    await expect(notice).toBeVisible();
    const heightOfLine = (): Promise<number> =>
      notice.evaluate((text) => {
        const range = document.createRange();
        range.selectNodeContents(text);
        return range.getClientRects()[0]?.height ?? 0;
      });
    // A notice that is replaced by its next text has none for a moment.
    let line = 0;
    await expect.poll(async () => (line = await heightOfLine())).toBeGreaterThan(0);
    const { y = 0, height = 0 } = (await notices.boundingBox()) ?? {};
    await notices.getByRole("button", { name: "Dismiss" }).first().click();
    return { top: y, bottom: y + height, type: line };
  };
  const usual = await shownNotice();
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitemcheckbox", { name: "Presenter mode" }).click();
  const presented = await shownNotice();
  expect(presented.type).toBeGreaterThan(1.3 * usual.type);
  const legend = await page.getByTestId("lens-legend").boundingBox();
  expect(presented.bottom).toBeLessThan(legend?.y ?? 0);
});
