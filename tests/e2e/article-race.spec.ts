/** Lesson 7 as an article: every task by real drags, fingers and keys, in three settings. */
import { expect, test, type Locator } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 7: its three tasks, and the one scrubber", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(7);
      await lesson.see("A");
      await lesson.isUndone();
      const growth = page.getByTestId("number-growth");
      const timeline = lesson.figure("A").getByRole("slider", { name: "Share of the steps" });

      // A word of the text leads to the state of the second task, and does not do it.
      await page.getByRole("button", { name: "Let the sizes grow slowly" }).click();
      await expect.poll(() => lesson.value("A", "share")).toBe(1);
      const led = await lesson.values("A");
      expect(led["growth"]).toBe(0.2);
      expect(Number(led["random"])).toBeLessThan(Number(led["smallest"]));
      await lesson.isUndone();
      await growth.focus();
      for (let i = 0; i < 8; i++) await page.keyboard.press("ArrowRight");
      await lesson.see("A");

      // The line across the refusals: by a drag to the left, then by keys to the end.
      await timeline.focus();
      await page.keyboard.press("End");
      expect(await lesson.value("A", "share")).toBe(1);
      const box = await timeline.boundingBox();
      if (!box) throw new Error("The timeline is not visible");
      const y = box.y + box.height / 2;
      await lesson.drag([box.x + box.width * 0.6, y], [box.x + box.width * 0.3, y]);
      const share = await lesson.value("A", "share");
      expect(share).toBeGreaterThan(0.1);
      expect(share).toBeLessThan(0.6);
      await page.keyboard.press("End");
      await expect(refusedIn(lesson, 2)).toHaveText(`${await lesson.value("A", "oldest")} refused`);

      // The wing, by a drag of any of the four pictures; its angle by the tail.
      const before = await lesson.values("A");
      const wing = await lesson.middle(lesson.handle("A", "wing-2"));
      await lesson.drag(wing, [wing[0] + 24, wing[1] - 12]);
      expect(await lesson.value("A", "x")).toBeGreaterThan(Number(before["x"]));
      const turn = await lesson.middle(lesson.handle("A", "turn-3"));
      await lesson.drag(turn, [turn[0], turn[1] - 14]);
      expect(await lesson.value("A", "angle")).toBeLessThan(Number(before["angle"]));

      await growth.focus();
      await page.keyboard.press("End");
      for (let i = 0; i < 20 && !(await isDone(lesson, 1)); i++) await page.keyboard.press("ArrowLeft");
      await lesson.done(1);
      for (let i = 0; i < 20 && !(await isDone(lesson, 3)); i++) await page.keyboard.press("ArrowLeft");
      await page.keyboard.press("Home");
      expect(await lesson.value("A", "growth")).toBe(0.2);
      await moveUntilDone(lesson, 2);
      await lesson.done(2);
      await growth.focus();
      for (let i = 0; i < 8; i++) await page.keyboard.press("ArrowRight");
      await moveUntilDone(lesson, 3);
      await lesson.done(3);
      await isSound(lesson);
    });
  });
}

const refusedIn = (lesson: ArticlePage, panel: number): Locator =>
  lesson
    .figure("A")
    .locator(".race-panel")
    .nth(panel - 1)
    .locator("b.refused");

const isDone = async (lesson: ArticlePage, task: number): Promise<boolean> =>
  (await lesson.task(task).getAttribute("data-done")) === "true";

/** Moves the wing by keys until a task is done. */
async function moveUntilDone(lesson: ArticlePage, task: number): Promise<void> {
  await lesson.handle("A", "wing-1").focus();
  const keys = ["ArrowLeft", "ArrowLeft", "ArrowUp", "ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown"];
  for (let i = 0; i < 40 && !(await isDone(lesson, task)); i++)
    await lesson.page.keyboard.press(keys[i % keys.length] ?? "ArrowLeft");
}
