/** Lesson 2 as an article: every task by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 2: the walk leads from the first guess to the finished division", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(2);
      await lesson.see("A");
      await lesson.isUndone();
      const stops = page.locator(".stop");
      const line = viewport.width <= 1000 ? 0.68 : 0.46;
      const read = async (index: number): Promise<void> => {
        await stops.nth(index).evaluate((stop, share) => {
          const { top, height } = stop.getBoundingClientRect();
          window.scrollBy(0, top + Math.min(height, 240) / 2 - window.innerHeight * share);
        }, line);
      };
      await read(4);
      await expect.poll(() => lesson.value("A", "beat")).toBe(4);
      expect(await lesson.value("A", "rounds")).toBeGreaterThan(3);

      // The beginning of the line, by a drag: the first side is another one.
      const before = await lesson.values("A");
      const begin = await lesson.middle(lesson.handle("A", "begin"));
      await lesson.drag(begin, [begin[0] + 40, begin[1]]);
      expect(await lesson.value("A", "x0")).toBeGreaterThan(0.2);
      expect(await lesson.value("A", "length")).toBeLessThan(Number(before["length"]));

      // A knot of the curve, by keys: the side becomes longer.
      const length = await lesson.value("A", "length");
      await lesson.handle("A", "size-1").focus();
      for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowUp");
      expect(await lesson.value("A", "length")).toBeGreaterThan(length);

      await read((await stops.count()) - 1);
      await expect.poll(() => lesson.value("A", "finished")).toBe(1);
      const { lambda = 0, count = 0, factor = 0 } = await lesson.values("A");
      expect(Math.round(Number(lambda))).toBe(count);
      expect(Number(factor)).toBeCloseTo(Number(lambda) / Number(count), 12);
      expect(lesson.errors).toEqual([]);
    });

    test("lesson 2: its three tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(2);
      await lesson.see("B");
      await lesson.isUndone();

      // A side that strides over a valley: its right edge is pulled in, then its ground down.
      await lesson.figure("B").getByRole("button", { name: "The start counts" }).click();
      expect(await lesson.value("B", "excess")).toBeGreaterThan(1.05);
      const [second, third] = [
        await lesson.middle(lesson.handle("B", "size-2")),
        await lesson.middle(lesson.handle("B", "size-3")),
      ];
      const scale = (third[0] - second[0]) / 1.9;
      // In a small window, the curve is stretched upwards until it fills the stage.
      const stage = await lesson.figure("B").locator(".scene").boundingBox();
      const scaleY = hasTouch ? (stage?.height ?? 0) / 3.8 : scale;
      await lesson.dragHandle("B", "size-3", [second[0] + 0.5 * scale, third[1] + 0.5 * scaleY]);
      const fourth = await lesson.middle(lesson.handle("B", "size-4"));
      await lesson.drag(fourth, [fourth[0] - 0.8 * scale, fourth[1] + 0.8 * scaleY]);
      await lesson.done(1);
      await lesson.figure("B").getByRole("button", { name: "The middle counts" }).click();
      expect(await lesson.value("B", "excess")).toBeLessThan(1.0011);

      // To the foot of the slope by a drag; then the tolerance by keys.
      await lesson.see("C");
      expect(await lesson.value("C", "rounds")).toBe(13);
      const begin = await lesson.middle(lesson.handle("C", "begin"));
      const knot = await lesson.middle(lesson.handle("C", "size-2"));
      await lesson.drag(begin, [knot[0] + 6, begin[1]]);
      expect(await lesson.value("C", "rounds")).toBeGreaterThan(3);
      const tolerance = page.getByTestId("number-tolerance-C");
      await tolerance.focus();
      for (let i = 0; i < 199 && (await lesson.value("C", "rounds")) > 3; i++)
        await page.keyboard.press(i < 19 ? "PageUp" : "ArrowRight");
      await lesson.done(2);

      await lesson.see("D");
      await lesson.handle("D", "begin").focus();
      for (let i = 0; i < 80 && (await lesson.value("D", "factor")) < 1.05; i++)
        await page.keyboard.press("ArrowRight");
      await lesson.done(3);
      await isSound(lesson);
    });
  });
}
