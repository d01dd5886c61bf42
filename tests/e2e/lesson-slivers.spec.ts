/** Lesson 11: slivers, and the sweeps of the optimizer; by drags, fingers and keys. */
import { expect, test } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 11: its four tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(11);
      await lesson.see("A");
      await lesson.isUndone();
      expect(await lesson.value("A", "least")).toBeCloseTo(70.53, 2);

      // Two points are lowered by the number in the text: by a drag, then by keys.
      const number = page.getByTestId("number-lift");
      await number.scrollIntoViewIfNeeded();
      const at = await lesson.middle(number);
      await lesson.drag(at, [at[0] - 60, at[1]]);
      expect(await lesson.value("A", "lift")).toBeLessThan(0.88);
      await number.focus();
      for (let i = 0; i < 100 && (await lesson.value("A", "least")) >= 5; i++)
        await page.keyboard.press("ArrowLeft");
      expect(await lesson.values("A")).toMatchObject({ kind: "This is a sliver." });
      await lesson.done(1);

      for (const [word, kind] of [
        ["A needle", "needle"],
        ["a wedge", "wedge"],
        ["A cap", "cap"],
      ] as const) {
        await page.getByRole("button", { name: word, exact: true }).click();
        await expect.poll(async () => (await lesson.values("A"))["kind"]).toBe(`This is a ${kind}.`);
      }
      // The point of the cap is pulled up; keys then do the rest.
      await page.waitForTimeout(900);
      await lesson.see("A");
      const point = await lesson.middle(lesson.handle("A", "point-4"));
      await lesson.drag(point, [point[0], point[1] - 50]);
      expect(await lesson.value("A", "moved")).toBe(1);
      await lesson.handle("A", "point-4").focus();
      for (let i = 0; i < 20 && (await lesson.value("A", "least")) < 30; i++)
        await page.keyboard.press("ArrowUp");
      await lesson.done(2);

      await lesson.see("B");
      const history = lesson.figure("B").getByRole("slider", { name: "Step" });
      await expect.poll(() => lesson.value("B", "poor")).toBe(41);
      await history.focus();
      for (let i = 0; i < 47 && (await lesson.value("B", "poor")) > 0; i++)
        await page.keyboard.press("ArrowRight");
      expect(await lesson.value("B", "sweep")).toBe(12);
      await lesson.done(3);
      await lesson.done(4);
      await page.keyboard.press("End");
      expect(await lesson.values("B")).toMatchObject({ sweep: 47, poor: 0 });
      await lesson.figure("B").getByRole("button", { name: "One step back" }).click();
      expect(await lesson.value("B", "sweep")).toBe(46);
      await isSound(lesson);
    });
  });
}

test("words lead through the sweeps, and the chart says what it shows", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(11);
  await lesson.see("B");
  await page.getByRole("button", { name: "Split" }).click();
  await expect.poll(() => lesson.values("B")).toMatchObject({ sweep: 4, added: 75 });
  await expect(lesson.figure("B").getByRole("img")).toHaveAttribute(
    "aria-label",
    /2084 elements; 10 elements are poor/,
  );
  await expect(page.locator(".task[data-done]")).toHaveCount(0);
});
