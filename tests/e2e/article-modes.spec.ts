/** What is around a figure: the dock beside the text, a frame in a course page, and slides. */
import { expect, test, type Page } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

const lessons = [1, 2, 4, 6, 7, 10, 11];

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("the first figure is largely in the first view", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      for (const number of lessons) {
        await lesson.open(number);
        const figure = lesson.figure("A");
        await expect(figure).toHaveAttribute("data-ready", "true");
        const share = await figure
          .locator(number === 7 ? ".race-panels" : ".scene")
          .first()
          .evaluate((scene) => {
            const { top, height } = scene.getBoundingClientRect();
            return (window.innerHeight - top) / height;
          });
        expect(share, `lesson ${number}`).toBeGreaterThan(0.75);
      }
    });

    test("a reader can have the answer of a task, with the numbers of a solution", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(3);
      await lesson.see("A");
      const task = lesson.task(1);
      const answer = task.locator(".because p");
      await expect(answer).toBeHidden();
      await task.getByRole("button", { name: "Show the answer" }).click();
      await expect(answer).toBeVisible();
      await expect(answer).toContainText("It is 27° there");
      await lesson.isUndone();
      expect(lesson.errors).toEqual([]);
    });

    test("a word in the text docks a figure that is out of view", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(4);
      await lesson.see("A");
      const figure = lesson.figure("A");
      const word = page.getByRole("button", { name: "This blunt face" });
      await word.evaluate((node) => node.scrollIntoView({ block: "center" }));
      await word.click();
      await expect(figure).toHaveAttribute("data-docked", "true");
      const stage = figure.locator(".stage");
      await expect(stage).toBeInViewport({ ratio: 0.99 });
      await expect.poll(() => lesson.value("A", "inside")).toBe(0);
      // The word is beside the figure, or below it.
      const [box, at] = [await stage.boundingBox(), await word.boundingBox()];
      if (!box || !at) throw new Error("Both are visible");
      expect(at.x + at.width <= box.x || at.y >= box.y + box.height).toBe(true);

      // The docked figure is the figure: its points are dragged there.
      const point = await lesson.middle(lesson.handle("A", "ideal-point"));
      const height = await lesson.value("A", "height");
      await lesson.drag(point, [point[0], point[1] - 40]);
      await expect.poll(() => lesson.value("A", "height")).toBeGreaterThan(height);
      await isSound(lesson);

      await page.getByRole("button", { name: "Close the small figure" }).click();
      await expect(figure).not.toHaveAttribute("data-docked");
      await word.click();
      await expect(figure).toHaveAttribute("data-docked", "true");
      await page.getByRole("button", { name: "To the figure" }).click();
      await expect(figure).not.toHaveAttribute("data-docked");
      await expect(figure.locator(".scene")).toBeInViewport({ ratio: 0.5 });
    });

    test("a task calls for its figure, and the page does not move", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(7);
      await lesson.see("A");
      const before = await page.evaluate(() => document.documentElement.scrollHeight);
      await lesson.task(1).evaluate((node) => {
        const { top } = node.getBoundingClientRect();
        window.scrollBy(0, top - 0.6 * window.innerHeight);
      });
      await expect(lesson.figure("A")).toHaveAttribute("data-docked", "true");
      expect(await page.evaluate(() => document.documentElement.scrollHeight)).toBe(before);
    });
  });
}

test("a docked list of candidates keeps its scores", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(5);
  await lesson.see("A");
  await lesson.task(1).evaluate((node) => {
    const { top } = node.getBoundingClientRect();
    window.scrollBy(0, top - 0.6 * window.innerHeight);
  });
  const figure = lesson.figure("A");
  await expect(figure).toHaveAttribute("data-docked", "true");
  await expect(figure.locator(".candidate .score").first()).toBeVisible();
  // Of two lines at most: more would reach into the next candidate.
  const verdict = await figure.locator(".candidate .verdict").first().boundingBox();
  expect(verdict?.height ?? Infinity).toBeLessThan(42);
});

/** Opens a course page that has one figure of a lesson in a frame, by the one line of the documentation. */
async function openCourse(page: Page, address: string): Promise<void> {
  const html = `<!doctype html><title>Course</title><body style="margin:0"><div style="height:300px">Text</div>
    <iframe src="${address}" title="Figure" style="width:100%;height:900px;border:0"></iframe><div style="height:1500px"></div>
    <script>window.heard = []; addEventListener("message", ({ data }) => window.heard.push(data));</script>`;
  await page.route("**/course.html", (route) => route.fulfill({ contentType: "text/html", body: html }));
  await page.goto("./course.html");
}

const heard = (page: Page, type: string): Promise<readonly Record<string, unknown>[]> =>
  page.evaluate(
    (wanted) =>
      (window as unknown as { heard: Record<string, unknown>[] }).heard.filter(
        (each) => each["type"] === wanted,
      ),
    type,
  );

test("a figure in a frame scrolls with the page, and tells it of finished tasks", async ({ page }) => {
  await openCourse(page, "./lessons/4/?figure=A");
  const frame = page.frameLocator("iframe");
  const figure = frame.getByTestId("figure-A");
  await expect(figure).toHaveAttribute("data-ready", "true");
  await expect(frame.locator("h1, h2, .lead")).toHaveCount(0);
  await expect(frame.locator(".task")).toHaveCount(3);
  await expect
    .poll(() => heard(page, "ready"))
    .toMatchObject([{ source: "tetrafront", lesson: 4, figure: "A", done: 0, total: 3 }]);

  const scene = await figure.locator(".scene").boundingBox();
  if (!scene) throw new Error("The scene is visible");
  await page.mouse.move(scene.x + scene.width - 30, scene.y + 30);
  await page.mouse.wheel(0, 400);
  await expect.poll(() => page.evaluate(() => window.scrollY)).toBeGreaterThan(200);

  const size = frame.getByTestId("number-size");
  await size.focus();
  await page.keyboard.press("Home");
  await expect
    .poll(() => heard(page, "task"))
    .toMatchObject([{ lesson: 4, figure: "A", task: 3, done: 1, total: 3 }]);
  const [message] = await heard(page, "task");
  expect(String(message?.["ask"])).toContain("lowest height");
  expect(Number(message?.["height"])).toBeGreaterThan(300);
});

test("the keys of a clicker turn the slides", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await page.goto("./lessons/1/?slides");
  const { keyboard } = page;
  const count = page.locator(".slide-count");
  await expect(count).toHaveText(/^1 \//);
  await expect(page.getByRole("heading", { level: 1 })).toBeVisible();
  await keyboard.press("PageDown");
  await expect(page.locator(".stop:visible")).toHaveCount(1);
  await expect(lesson.figure("A")).toHaveAttribute("data-ready", "true");
  for (let i = 0; i < 7; i++) await keyboard.press("PageDown");
  await expect(count).toHaveText(/^9 \//);
  await keyboard.press("PageUp");
  await expect(count).toHaveText(/^8 \//);
  await expect.poll(() => lesson.value("A", "atrefusal")).toBe(1);
  const size = await page
    .locator(".stop:visible p")
    .first()
    .evaluate((node) => parseFloat(getComputedStyle(node).fontSize));
  expect(size).toBeGreaterThanOrEqual(26);

  // Page Down turns the slide even from a number that has the focus.
  await page.keyboard.press("Home");
  for (let i = 0; i < 2; i++) await keyboard.press("PageDown");
  const value = await lesson.value("A", "size");
  await page.locator(".stop:visible .drag").first().focus();
  await keyboard.press("PageDown");
  await expect(count).toHaveText(/^4 \//);
  expect(await lesson.value("A", "size")).toBe(value);

  await keyboard.press("b");
  await expect(page.locator("html")).toHaveAttribute("data-black");
  await keyboard.press("PageDown");
  await expect(page.locator("html")).not.toHaveAttribute("data-black");
  await keyboard.press("Escape");
  await expect(page.locator("html")).not.toHaveAttribute("data-slides");
  await expect(page).not.toHaveURL(/slides/);
  await expect(page.locator(".stop").nth(3)).toBeInViewport();
  await page.getByRole("button", { name: "Slides" }).click();
  await expect(count).toHaveText(/\d+ \/ \d+/);
  await isSound(lesson);
});

test("printing loads every figure and keeps the proportions of its drawing on paper", async ({ page }) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await page.addInitScript(() => {
    window.print = () => {
      document.documentElement.dataset["printed"] = "true";
    };
  });
  const lesson = new ArticlePage(page, false);
  await lesson.open(3);
  await page.keyboard.press("Control+p");
  await expect(page.locator("html")).toHaveAttribute("data-printed", "true");
  const canvases = page.locator(".figure .scene canvas");
  const shapes = (): Promise<number[]> =>
    canvases.evaluateAll((all) => all.map((canvas) => canvas.clientWidth / canvas.clientHeight));
  await expect(canvases).toHaveCount(6);
  const before = await shapes();
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: 688, height: 1000 });
  const after = await shapes();
  // A canvas, with two pixels per pixel of the page, is printed in whole 64ths: labels lie on the drawing only in such a size.
  const zoom = await lesson.figure("A").evaluate((figure) => Number(getComputedStyle(figure).zoom));
  expect(zoom).toBeGreaterThan(0.6);
  expect((32 * zoom) % 1).toBeCloseTo(0.08, 3);
  after.forEach((shape, i) => expect(shape).toBeCloseTo(before[i] ?? 0, 1));
  const excess = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  expect(excess).toBeLessThanOrEqual(0);
  // Points stay, without the rings around them that are only there to be dragged.
  await expect(lesson.handle("A", "dot-square")).toBeVisible();
  await expect(lesson.handle("A", "corner-A")).toBeHidden();
  await expect(page.locator(".round, .figure .beats").first()).toBeHidden();
  await expect(page.locator(".because p").first()).toBeVisible();
  // A light page, and after printing the reader's own.
  await expect(page.locator("html")).toHaveAttribute("data-theme", "light");
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  await expect(page.locator("html")).not.toHaveAttribute("data-theme", "light");
  expect(lesson.errors).toEqual([]);
});

test("formulas on slides are not wider than their column", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  for (const number of [3, 4, 9]) {
    await page.goto(`./lessons/${number}/?slides`);
    const count = page.locator(".slide-count");
    await expect(count).toHaveText(/^1 \/ \d+$/);
    const slides = Number((await count.textContent())?.split("/")[1]);
    let formulas = 0;
    for (let i = 0; i < slides; i++) {
      const shown = page.locator(".formula.displayed:visible");
      formulas += await shown.count();
      const excess = (): Promise<number[]> =>
        shown.evaluateAll((all) => all.map((formula) => formula.scrollWidth - formula.clientWidth));
      // Columns of KaTeX have an empty margin of 2 pixels.
      await expect.poll(async () => Math.max(0, ...(await excess()))).toBeLessThanOrEqual(2);
      await page.keyboard.press("PageDown");
    }
    expect(formulas).toBeGreaterThan(0);
  }
  expect(lesson.errors).toEqual([]);
});
