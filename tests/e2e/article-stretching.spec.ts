/** Lesson 9 as an article: its tasks by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 9: its two tasks, and the front seen twice", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(9);
      await lesson.see("A");
      await lesson.isUndone();

      // The front in both spaces: words of the text, then the player.
      await page.locator(".go", { hasText: "ideal point" }).click();
      await expect.poll(() => lesson.value("A", "beat")).toBe(2);
      await lesson.see("A");
      await lesson.figure("A").getByRole("slider", { name: "Step" }).focus();
      await page.keyboard.press("End");
      expect(await lesson.value("A", "step")).toBe(await lesson.value("A", "triangles"));

      // The short axis by a drag, the long one by keys; then the number of the text.
      const before = await lesson.values("A");
      const across = await lesson.middle(lesson.handle("A", "across"));
      await lesson.drag(across, [across[0], across[1] - 8]);
      expect(await lesson.value("A", "size")).toBeGreaterThan(Number(before["size"]));
      expect(await lesson.value("A", "stretching")).toBeLessThan(3);
      await page.getByTestId("number-size").focus();
      await page.keyboard.press("Home");
      expect(await lesson.value("A", "size")).toBe(0.05);
      await lesson.see("A");
      const short = await lesson.value("A", "along");
      const along = await lesson.middle(lesson.handle("A", "along"));
      await lesson.drag(along, [along[0] + 24, along[1]]);
      expect(await lesson.value("A", "along")).toBeGreaterThan(short);
      await lesson.handle("A", "along").focus();
      for (let i = 0; i < 12 && !(await isDone(lesson, 1)); i++) await page.keyboard.press("ArrowRight");
      // Some triangles are less even than others: the dot chooses another one.
      await lesson.handle("A", "dot").focus();
      for (let i = 0; i < 12 && !(await isDone(lesson, 1)); i++) await page.keyboard.press("ArrowRight");
      await lesson.done(1);

      // The ellipse in the middle across the one at the right and below, and the dot between both.
      await lesson.see("B");
      const { at, scale } = await scaleOf(lesson);
      const [x, y] = at(0.95, 0.45);
      const length = 0.165 * scale + (viewport.width < 500 ? 16 : 0);
      const turn = (50 * Math.PI) / 180;
      await lesson.dragHandle("B", "along-5", [x + length * Math.cos(turn), y - length * Math.sin(turn)]);
      expect(await lesson.value("B", "least")).toBeGreaterThan(2.7);
      await lesson.dragHandle("B", "dot", at(1.37, 0.252));
      await lesson.done(2);
      await isSound(lesson);
    });
  });
}

const isDone = async (lesson: ArticlePage, task: number): Promise<boolean> =>
  (await lesson.task(task).getAttribute("data-done")) === "true";

/** Returns where points of figure B are in the window, and its pixels per unit. */
async function scaleOf(
  lesson: ArticlePage,
): Promise<{ readonly at: (x: number, y: number) => Pixel; readonly scale: number }> {
  const box = await lesson.figure("B").locator(".scene").first().boundingBox();
  if (!box) throw new Error("The field is not visible");
  const scale = Math.min(
    box.width / (1.9 + 2 * (box.width < 450 ? 0.42 : 0.24)),
    box.height / (0.9 + 2 * 0.2),
  );
  const middle: Pixel = [box.x + box.width / 2, box.y + box.height / 2];
  return { at: (x, y) => [middle[0] + (x - 0.95) * scale, middle[1] - (y - 0.45) * scale], scale };
}
