/** Lesson 10: the pocket that no order of faces closes, and the node that sees all faces; by drags, fingers and keys. */
import { expect, test } from "@playwright/test";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, settings } from "./article-settings";

/** Returns the middle of a figure's drawing. */
async function middleOf(lesson: ArticlePage, letter: string): Promise<Pixel> {
  return lesson.middle(lesson.figure(letter).locator("canvas").first());
}

/** Turns the view of a figure by a quarter, by keys. */
async function turnView(lesson: ArticlePage, letter: string): Promise<void> {
  await lesson.figure(letter).getByRole("group", { name: "View" }).focus();
  for (let i = 0; i < 13; i++) await lesson.page.keyboard.press("ArrowLeft");
}

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 10: its four tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(10);
      await lesson.see("A");
      await lesson.isUndone();
      expect(await lesson.values("A")).toMatchObject({ twist: -20, trials: 15, fits: 15, ways: 6 });

      // A corner of the upper end turns it; the task is done once the walls bend inward.
      const corner = lesson.handle("A", "corner-5");
      const from = await lesson.middle(corner);
      await lesson.drag(from, [from[0] + 90, from[1] + 30]);
      expect(await lesson.value("A", "twist")).toBeGreaterThan(-20);
      await corner.focus();
      for (let i = 0; i < 60 && (await lesson.value("A", "twist")) < 20; i++)
        await page.keyboard.press("ArrowRight");
      expect(await lesson.values("A")).toMatchObject({ fits: 0, ways: 0, closes: "cannot be filled" });
      await lesson.done(1);
      await lesson.figure("A").locator("[data-tile='1']").click();
      await expect(lesson.figure("A").locator(".status")).toContainText("runs outside");
      await lesson.figure("A").getByRole("button", { name: "Filled with its own corners" }).click();
      await expect(lesson.figure("A").locator(".notice")).toHaveText(
        "No tetrahedron on its own corners fits.",
      );

      // The node to the middle, from two sides: across the view, then across another view.
      const number = page.getByTestId("number-twist-B");
      await number.focus();
      while ((await lesson.value("B", "twist")) < 20) await page.keyboard.press("ArrowRight");
      await lesson.see("B");
      await lesson.dragHandle("B", "node", await middleOf(lesson, "B"));
      await turnView(lesson, "B");
      await lesson.dragHandle("B", "node", await middleOf(lesson, "B"));
      expect(await lesson.value("B", "seen")).toBe(8);
      await lesson.done(2);
      await lesson.figure("B").getByRole("button", { name: "Its star" }).click();
      expect(await lesson.value("B", "shown")).toBe(1);
      await lesson.figure("B").getByRole("button", { name: "The pocket", exact: true }).click();
      await number.focus();
      while ((await lesson.value("B", "twist")) < 45) await page.keyboard.press("ArrowRight");
      await lesson.see("B");
      const node = lesson.handle("B", "node");
      await node.focus();
      await page.keyboard.press("ArrowUp");
      await lesson.done(3);

      await lesson.see("C");
      await lesson.figure("C").getByRole("button", { name: "Third pocket" }).click();
      await findSight(lesson, 34);
      await lesson.done(4);
      await lesson.figure("C").getByRole("button", { name: "As Tetrafront closed it" }).click();
      expect(await lesson.values("C")).toMatchObject({ elements: 61, faces: 42, room: 0, shown: 1 });
      await isSound(lesson);
    });
  });
}

/** Moves the node of the third pocket by its keys, row by row downwards, until it sees enough faces. */
async function findSight(lesson: ArticlePage, wanted: number): Promise<void> {
  const { keyboard } = lesson.page;
  await lesson.handle("C", "node").focus();
  for (let row = 0; row < 12; row++) {
    await keyboard.press("Shift+ArrowDown");
    for (let i = 0; i < 30; i++) {
      if ((await lesson.value("C", "seen")) >= wanted) return;
      await keyboard.press(row % 2 === 0 ? "ArrowRight" : "ArrowLeft");
    }
  }
}

test("a word leads to the filling of the pocket, and to the star of the engine", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(10);
  await lesson.see("A");
  await page.getByRole("button", { name: "have a look" }).click();
  await expect.poll(() => lesson.value("A", "shown")).toBe(1);
  await page.getByRole("button", { name: "Not twisted at all" }).click();
  await expect.poll(() => lesson.value("A", "twist")).toBe(0);
  expect(await lesson.values("A")).toMatchObject({ fits: 0, shown: 0 });
  await lesson.see("C");
  await page.getByRole("button", { name: "a star of eight elements" }).click();
  await expect.poll(() => lesson.value("C", "shown")).toBe(1);
  expect(await lesson.values("C")).toMatchObject({ seen: 8, faces: 8, elements: 8 });
});
