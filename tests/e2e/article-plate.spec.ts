/** Lesson 0 as an article: every task by real drags, fingers and keys, in three settings. */
import { expect, test, type Locator } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 0: the plate beside the truth, and its two tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(0);
      await lesson.see("A");
      await lesson.isUndone();
      const { truth, evenanswer } = await lesson.values("A");
      expect(truth).toBe(3);
      expect(evenanswer).toBeLessThan(2.5);

      // The line between the mesh and the truth, and the hole.
      const curtain = await lesson.middle(lesson.handle("A", "curtain"));
      await lesson.drag(curtain, [curtain[0] + 60, curtain[1]]);
      expect(await lesson.value("A", "curtain")).toBeGreaterThan(0.1);
      const hole = await lesson.middle(lesson.handle("A", "hole"));
      await lesson.drag(hole, [hole[0] - 40, hole[1] + 14]);
      await expect.poll(() => lesson.value("A", "x")).toBeLessThan(-0.03);
      expect(await lesson.value("A", "truth")).toBe(3);

      // More triangles: the number by a drag, then by keys.
      const even = page.getByTestId("number-even");
      await even.scrollIntoViewIfNeeded();
      const at = await lesson.middle(even);
      await lesson.drag(at, [at[0] + 60, at[1]]);
      expect(await lesson.value("A", "even")).toBeGreaterThan(300);
      await even.focus();
      await page.keyboard.press("End");
      await lesson.done(1);
      await expect.poll(() => lesson.value("A", "evenerror")).toBeLessThan(5);

      // The crack, by a drag of the width and keys for the height.
      await page.keyboard.press("Home");
      await lesson.see("A");
      const [from, middle] = [
        await lesson.middle(lesson.handle("A", "wide")),
        await lesson.middle(lesson.handle("A", "hole")),
      ];
      await lesson.drag(from, [middle[0] + 16, from[1]]);
      await lesson.handle("A", "high").focus();
      for (let i = 0; i < 12 && (await lesson.value("A", "truth")) <= 9; i++)
        await page.keyboard.press("ArrowUp");
      await lesson.done(2);
      await expect.poll(() => lesson.value("A", "evenerror")).toBeGreaterThan(50);
      await isSound(lesson);
    });

    test("lesson 0: small triangles where they count", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(0);
      await lesson.see("B");
      await lesson.isUndone();
      const second = lesson.figure("B").locator(".plate-panel").nth(1);
      await expect(second.locator(".head")).toContainText(" % off");
      expect((await lesson.values("B"))["better"]).toBe("worse");

      // A word of the text leads to the place, and does not do the task.
      await lesson.task(3).evaluate((task) => task.querySelector(".because p")?.removeAttribute("hidden"));
      await page.getByRole("button", { name: "At its flank" }).click();
      await expect.poll(() => lesson.value("B", "ownerror")).toBeLessThan(25);
      await lesson.isUndone();

      await lesson.see("B");
      const hole = lesson.handle("B", "high").nth(1);
      const [x, y] = await lesson.middle(hole);
      await lesson.dragHandle("B", "spot", [x, y + 13]);
      await lesson.done(3);
      expect((await lesson.values("B"))["better"]).toBe("better");

      await setByKeys(lesson, page.locator('[data-drag="B.own"]'), "own", 240);
      await setByKeys(lesson, page.locator('[data-drag="B.even"]'), "even", 2200);
      await lesson.done(4);
      await isSound(lesson);
    });

    test("lesson 0: needles spoil the answer", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(0);
      await lesson.see("C");
      await lesson.isUndone();
      const needle = await lesson.middle(lesson.handle("C", "needle"));
      await lesson.drag(needle, [needle[0] + 30, needle[1]]);
      await expect.poll(() => lesson.value("C", "stretch")).toBeGreaterThan(4);
      expect(await lesson.value("C", "angle")).toBeLessThan(50);
      await page.locator('[data-drag="C.stretch"]').focus();
      await page.keyboard.press("End");
      for (let i = 0; i < 12 && !(await isDone(lesson, 5)); i++) {
        await lesson.handle("C", "needle").focus();
        await page.keyboard.press("ArrowDown");
      }
      await lesson.done(5);
      await isSound(lesson);
    });
  });
}

const isDone = async (lesson: ArticlePage, task: number): Promise<boolean> =>
  (await lesson.task(task).getAttribute("data-done")) === "true";

/** Sets a number of figure B by keys. */
async function setByKeys(lesson: ArticlePage, number: Locator, name: string, goal: number): Promise<void> {
  await number.focus();
  const isUp = (await lesson.value("B", name)) < goal;
  for (let i = 0; i < 200; i++) {
    const left = Math.abs((await lesson.value("B", name)) - goal);
    if (left < 1) return;
    if (left >= 200) await lesson.page.keyboard.press(isUp ? "PageUp" : "PageDown");
    else await lesson.page.keyboard.press(isUp ? "ArrowRight" : "ArrowLeft");
  }
}
