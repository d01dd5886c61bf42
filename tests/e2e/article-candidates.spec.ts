/** Lesson 5 as an article: every task by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 5: nodes are dragged, and an impossible shape springs back", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(5);
      await lesson.see("A");
      await lesson.isUndone();
      const rows = lesson.figure("A").locator(".candidate");
      await expect(rows.and(page.locator('[data-look="accepted"]'))).toContainText("taken");
      expect((await lesson.values("A"))["accepted"]).toBe("d");

      // In units of the drawing, the active side goes from (-0.5, 0) to (0.5, 0).
      const at = async (x: number, y: number): Promise<Pixel> => {
        const [a, b] = [
          await lesson.middle(lesson.handle("A", "corner-0")),
          await lesson.middle(lesson.handle("A", "corner-1")),
        ];
        const scale = b[0] - a[0];
        return [a[0] + (x + 0.5) * scale, a[1] - y * scale];
      };

      // A word of the text shows a refusal, and does not do the task.
      await page.getByRole("button", { name: "Here", exact: true }).click();
      await expect.poll(() => lesson.value("A", "crossed")).toBe(1);
      await expect.poll(async () => (await lesson.values("A"))["accepted"]).toBe("e");
      await lesson.isUndone();

      // Node e is pulled out of the triangle, then d out of the ring: the new node wins.
      await lesson.see("A");
      await lesson.dragHandle("A", "corner-6", await at(-0.42, 1.78));
      expect(await lesson.value("A", "crossed")).toBe(0);
      await lesson.dragHandle("A", "corner-5", await at(0.4, 1.5));
      await lesson.done(1);
      expect((await lesson.values("A"))["accepted"]).toBe("new");

      // The other way round, by keys and a drag: d into the ring, and e into its triangle.
      await lesson.dragHandle("A", "corner-5", await at(0.1, 1.06));
      expect((await lesson.values("A"))["accepted"]).toBe("d");
      await lesson.handle("A", "corner-5").focus();
      await page.keyboard.press("ArrowDown");
      await lesson.dragHandle("A", "corner-6", await at(-0.2, 0.42));
      await lesson.done(2);

      // A side across another one is impossible, and springs back.
      const before = await lesson.middle(lesson.handle("A", "corner-3"));
      await lesson.drag(before, await at(-1.5, 1.9), async () => {
        await expect(lesson.figure("A").locator(".notice")).not.toBeEmpty();
      });
      await expect(lesson.figure("A").locator(".notice")).toBeEmpty();
      await isSound(lesson);
    });

    test("lesson 5: other weights, and a step that takes a poor element", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(5);
      await lesson.see("B");
      await lesson.isUndone();
      expect((await lesson.values("B"))["accepted"]).toBe("new");
      const weight = page.getByTestId("number-newnode");
      await weight.scrollIntoViewIfNeeded();
      const from = await lesson.middle(weight);
      await lesson.drag(from, [from[0] - 40, from[1]]);
      expect(await lesson.value("B", "newnode")).toBeLessThan(0.84);
      await lesson.done(3);
      await expect(lesson.figure("B").locator(".status")).toContainText(
        "With your weights, a would be the first.",
      );

      // The program's own weights again: by the links of the text, which do no task.
      await lesson.task(4).evaluate((task) => task.querySelector(".because p")?.removeAttribute("hidden"));
      await page.getByRole("button", { name: "step 476" }).click();
      await expect.poll(() => lesson.value("B", "step")).toBe(476);
      expect(await lesson.value("B", "ownweights")).toBe(1);
      await expect(lesson.task(4)).not.toHaveAttribute("data-done", "true");
      await page.getByRole("button", { name: "another step" }).click();
      await expect.poll(() => lesson.value("B", "step")).toBe(380);
      await expect(lesson.figure("B").locator(".status")).toContainText("a (crosses a face), then b (taken)");

      // From step to step by keys, until the poor element is there.
      await lesson.see("B");
      await lesson.figure("B").getByRole("slider", { name: "Step" }).focus();
      for (let i = 0; i < 9; i++) await page.keyboard.press("PageUp");
      for (let i = 0; i < 30 && (await lesson.value("B", "step")) < 476; i++)
        await page.keyboard.press("ArrowRight");
      await lesson.done(4);

      // A candidate of the list is shown; the view turns.
      const row = lesson.figure("B").locator(".candidate").last();
      await row.focus();
      await expect(row).toHaveAttribute("data-lit");
      await isSound(lesson);
    });
  });
}
