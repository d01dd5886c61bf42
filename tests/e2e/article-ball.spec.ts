/** The ball of lesson 1: the front in space, played, cut and pulled apart. */
import { expect, test } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 1: the ball is closed, opened and pulled apart", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(1);
      await lesson.see("B");
      await lesson.isUndone();
      const figure = lesson.figure("B");
      expect(await lesson.values("B")).toMatchObject({ front: 320, filled: 0, finished: 0, cut: 0, open: 0 });

      // A turn of the view changes the drawing, not the values.
      const scene = figure.locator(".scene");
      const before = await scene.screenshot();
      await scene.focus();
      for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowLeft");
      await expect.poll(async () => (await scene.screenshot()).equals(before)).toBe(false);

      const history = figure.getByRole("slider", { name: "Step" });
      await history.focus();
      for (let i = 0; i < 40; i++) await page.keyboard.press("PageUp");
      expect(await lesson.value("B", "filled")).toBe(400);
      await page.keyboard.press("End");
      const { filled, elements, front } = await lesson.values("B");
      expect(front).toBe(0);
      expect(filled).toBe(elements);
      await expect(lesson.task(4)).not.toHaveAttribute("data-done");
      await figure.getByRole("button", { name: "Pulled apart" }).click();
      await expect.poll(() => lesson.value("B", "open")).toBeCloseTo(0.6, 6);
      await lesson.done(4);
      await figure.getByRole("button", { name: "Whole" }).click();
      await expect.poll(() => lesson.value("B", "cut")).toBeCloseTo(-1.1, 6);
      await isSound(lesson);
    });

    test("lesson 1: a word leads to a refused candidate of the ball", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(1);
      await lesson.see("B");
      await page.locator('[data-go^="B step=first-refused"]').click();
      await expect.poll(() => lesson.value("B", "atrefusal")).toBe(1);
      await expect(lesson.figure("B").locator(".label", { hasText: "crosses this face" })).toBeVisible();
      await expect(page.locator(".task[data-done]")).toHaveCount(0);
      expect(lesson.errors).toEqual([]);
    });
  });
}
