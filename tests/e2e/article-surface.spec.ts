/** Lesson 3 as an article: its tasks by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 3: its three tasks, one dot in three pictures, and a patch that would fold", async ({
      page,
    }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(3);
      await lesson.see("A");
      await lesson.isUndone();

      // One dot: dragged in each of the three pictures.
      for (const picture of ["square", "plane", "space"]) {
        const before = await lesson.value("A", "xi");
        const [x, y] = await lesson.middle(lesson.handle("A", `dot-${picture}`));
        await lesson.drag([x, y], [x + 20, y]);
        expect(await lesson.value("A", "xi")).toBeGreaterThan(before);
      }

      // More bulge, by keys, and the dot near a corner.
      const bulge = page.getByTestId("number-bulge");
      await bulge.focus();
      await page.keyboard.press("End");
      expect(await lesson.value("A", "bulge")).toBe(1.6);
      await lesson.see("A");
      await lesson.handle("A", "dot-square").focus();
      for (const key of ["ArrowLeft", "ArrowUp"])
        for (let i = 0; i < 32 && !(await isDone(lesson, 1)); i++) await page.keyboard.press(key);
      await lesson.done(1);

      // A corner that is pulled over the opposite one.
      const corner = await lesson.middle(lesson.handle("A", "corner-B"));
      const opposite = await lesson.middle(lesson.handle("A", "corner-D"));
      await lesson.drag(corner, opposite, async () => {
        await expect(lesson.figure("A").locator(".notice")).toContainText("fold over");
      });
      await expect(lesson.figure("A").locator(".notice")).toBeEmpty();

      await page.reload();
      await lesson.see("A");
      await bulge.focus();
      await page.keyboard.press("Home");
      await lesson.handle("A", "dot-square").focus();
      for (const key of ["ArrowDown", "ArrowLeft", "ArrowUp"])
        for (let i = 0; i < 32 && !(await isDone(lesson, 2)); i++) await page.keyboard.press(key);
      await lesson.done(2);

      await lesson.see("B");
      await lesson.figure("B").getByRole("button", { name: "Measure in space" }).click();
      expect((await lesson.values("B"))["ruler"]).toBe("space");
      await lesson.figure("B").getByRole("slider", { name: "Step" }).focus();
      await page.keyboard.press("Home");
      expect(await lesson.value("B", "step")).toBe(0);
      await page.keyboard.press("End");
      expect(await lesson.value("B", "step")).toBe(await lesson.value("B", "triangles"));
      for (const corner of ["B", "A", "C", "B", "A", "C"]) {
        if (await isDone(lesson, 3)) break;
        const [x, y] = await lesson.middle(lesson.handle("B", `corner-${corner}`));
        const by = corner === "A" ? -36 : 36;
        await lesson.drag([x, y], [x + by, y + (corner === "C" ? 0 : 8)]);
      }
      await lesson.done(3);
      await isSound(lesson);
    });
  });
}

const isDone = async (lesson: ArticlePage, task: number): Promise<boolean> =>
  (await lesson.task(task).getAttribute("data-done")) === "true";
