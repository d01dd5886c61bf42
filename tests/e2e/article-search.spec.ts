/** Lesson 8 as an article: its tasks by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 8: its five tasks, three searches in plane and space, and the heap", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(8);
      await lesson.see("A");
      await lesson.isUndone();

      // One circle in three pictures: dragged in two of them, its radius in the third.
      const before = await lesson.values("A");
      await dragBy(lesson, "circle-list", [-20, -6]);
      await dragBy(lesson, "circle-grid", [-10, -4]);
      expect(await lesson.value("A", "x")).toBeLessThan(Number(before["x"]));
      await dragBy(lesson, "radius-quadtree", [-14, 0]);
      expect(await lesson.value("A", "radius")).toBeGreaterThan(0.07);
      const visits = lesson.figure("A").locator(".head b.active");
      await expect(visits.nth(1)).toHaveText(String(await lesson.value("A", "quadtree")));

      // The searches run at the same pace, or are there at once.
      await lesson.figure("A").getByRole("button", { name: "Search" }).click();
      if (reducedMotion !== "reduce")
        await expect.poll(async () => Number(await visits.first().textContent())).toBeLessThan(240);
      await expect(visits.first()).toHaveText("240");

      const radius = page.getByTestId("number-radius");
      await radius.focus();
      await page.keyboard.press("Home");
      const nodes = page.getByTestId("number-nodes");
      await nodes.focus();
      await page.keyboard.press("End");
      expect(await lesson.value("A", "nodes")).toBe(960);
      await lesson.done(1);

      // Into the bay, where the cells of the grid are crowded.
      await lesson.see("A");
      const box = await lesson.figure("A").locator(".scene").first().boundingBox();
      if (!box) throw new Error("The picture is not visible");
      const scale = Math.min(box.width / 0.94, box.height / 0.88);
      const at = (x: number, y: number): Pixel => [
        box.x + box.width / 2 + (x - 0.5) * scale,
        box.y + box.height / 2 - (y - 0.5) * scale,
      ];
      await lesson.dragHandle("A", "circle-list", at(0.3, 0.64));
      await lesson.handle("A", "circle-list").focus();
      for (let i = 0; i < 4 && !(await isDone(lesson, 2)); i++) await page.keyboard.press("ArrowRight");
      await lesson.done(2);

      // In space: the ball goes into the hollow of the front and grows there.
      await lesson.see("B");
      const wall = await lesson.values("B");
      await page.getByRole("button", { name: "the hollow" }).click();
      await expect.poll(() => lesson.value("B", "found")).toBe(0);
      await lesson.see("B");
      await expect(lesson.figure("B").locator('[data-structure="grid"]')).toHaveAttribute(
        "aria-pressed",
        "true",
      );
      await expect(lesson.task(3)).not.toHaveAttribute("data-done");
      const ball = await lesson.middle(lesson.handle("B", "ball"));
      await lesson.drag(ball, [ball[0] + 3, ball[1] - 2]);
      expect(await lesson.value("B", "x")).not.toBe(wall["x"]);
      const ballRadius = await lesson.middle(lesson.handle("B", "radius"));
      await lesson.drag(ballRadius, [ballRadius[0] + 6, ballRadius[1]]);
      expect(await lesson.value("B", "radius")).toBeGreaterThan(0.12);
      await lesson.handle("B", "radius").focus();
      for (let i = 0; i < 24 && !(await isDone(lesson, 3)); i++) await page.keyboard.press("ArrowRight");
      await lesson.done(3);
      await lesson.figure("B").locator('[data-structure="list"]').click();
      await expect(lesson.figure("B").locator('[data-structure="list"] b')).toHaveText("642");

      // A large circle and a short front: the list has less to do.
      await radius.focus();
      await page.keyboard.press("End");
      await nodes.focus();
      await page.keyboard.press("Home");
      await lesson.done(4);

      await lesson.see("C");
      await lesson.figure("C").getByRole("button", { name: "new sides rise" }).click();
      await expect.poll(() => lesson.value("C", "step")).toBe(6);
      await lesson.figure("C").getByRole("slider", { name: "Step" }).focus();
      await page.keyboard.press("End");
      expect(await lesson.value("C", "sides")).toBe(0);
      for (let i = 0; i < 12 && !(await isDone(lesson, 5)); i++) await page.keyboard.press("ArrowLeft");
      await lesson.done(5);
      await isSound(lesson);
    });
  });
}

async function dragBy(lesson: ArticlePage, handle: string, [dx, dy]: Pixel): Promise<void> {
  const [x, y] = await lesson.middle(lesson.handle("A", handle));
  await lesson.drag([x, y], [x + dx, y + dy]);
}

const isDone = async (lesson: ArticlePage, task: number): Promise<boolean> =>
  (await lesson.task(task).getAttribute("data-done")) === "true";
