/** "Be the mesher": fronts in the plane and in space by mouse, finger and keys, until they close or stall. */
import { expect, test } from "@playwright/test";
import { loadLevel } from "../../web/teach/article/figures/mesher/levels";
import { playWell } from "../support/good-mesher";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, settings } from "./article-settings";

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("its tasks, in the plane and in space, and two meshes side by side", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open("mesher");
      await lesson.see("A");
      await lesson.isUndone();
      const figure = lesson.figure("A");
      const pick = (choice: number | string) => figure.locator(`[data-choice="${choice}"]`);

      // Five corners by keys: a new node, and then Enter is enough.
      await pick("new").focus();
      await page.keyboard.press("Enter");
      for (let i = 0; i < 40 && (await lesson.value("A", "closed")) === 0; i++) {
        const before = await lesson.value("A", "front");
        const elements = await lesson.value("A", "elements");
        for (const button of await figure.locator('.picks button:not([data-choice="wait"])').all()) {
          await button.focus();
          await page.keyboard.press("Enter");
          if ((await lesson.value("A", "elements")) > elements) break;
        }
        expect(await lesson.value("A", "elements"), `front of ${before}`).toBeGreaterThan(elements);
      }
      await lesson.done(1);
      await expect(figure.locator("[data-row=worst] td").first()).toContainText("°");

      // A new node that is dragged behind the side is refused, with its reason.
      await figure.locator('[data-result="again"]').click();
      await lesson.see("A");
      const from = await lesson.middle(lesson.handle("A", "new"));
      const scene = await figure.locator(".scene").boundingBox();
      const corner: Pixel = [(scene?.x ?? 0) + 8, (scene?.y ?? 0) + 8];
      await lesson.drag(from, corner);
      await pick("new").click();
      await expect(figure.locator(".status")).toContainText("Refused");
      expect(await lesson.value("A", "refused")).toBe(1);
      // A press without a drag takes the golden point, and undo takes it back.
      await figure.locator('[data-tool="hint"]').click();
      await expect(figure.locator(".picks [data-lit]")).toHaveCount(1);
      await figure.locator(".picks [data-lit]").click();
      expect(await lesson.value("A", "elements")).toBe(1);
      await figure.locator('[data-tool="undo"]').click();
      expect(await lesson.value("A", "elements")).toBe(0);
      // Whatever waits, waits: the front stalls.
      while ((await lesson.value("A", "stalled")) === 0) await pick("wait").click();
      await lesson.done(4);
      await expect(figure.locator(".verdict")).toContainText("pocket");

      // The boot, in good triangles.
      await figure.locator('[data-level="boot"]').click();
      await expect.poll(async () => (await lesson.values("A"))["level"]).toBe("boot");
      for (const choice of playWell(await loadLevel("boot")).choices) await pick(choice).click();
      expect(await lesson.value("A", "angle")).toBeGreaterThan(15);
      await lesson.done(2);

      // A cube, in space.
      await figure.locator('[data-level="cube"]').click();
      await expect.poll(async () => (await lesson.values("A"))["level"]).toBe("cube");
      for (let i = 0; i < 40 && (await lesson.value("A", "closed")) === 0; i++) {
        const elements = await lesson.value("A", "elements");
        for (const button of await figure.locator('.picks button:not([data-choice="wait"])').all()) {
          await button.click();
          if ((await lesson.value("A", "elements")) > elements) break;
        }
      }
      await lesson.see("A");
      await lesson.done(3);

      // The prism of the recorded run: one new node, and all faces to it.
      await figure.locator('[data-level="prism"]').click();
      await expect.poll(async () => (await lesson.values("A"))["level"]).toBe("prism");
      for (let i = 0; i < 12 && (await lesson.value("A", "closed")) === 0; i++) {
        await figure.locator('[data-tool="hint"]').click();
        await figure.locator(".picks [data-lit]").click();
      }
      expect(await lesson.value("A", "closed")).toBe(1);
      expect(await lesson.value("A", "elements")).toBe(8);
      expect(await lesson.value("A", "newnodes")).toBe(1);
      await isSound(lesson);
    });
  });
}

test("a node lights in the list and in the picture, and a click in the picture takes it", async ({
  page,
}) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open("mesher");
  await lesson.see("A");
  const figure = lesson.figure("A");
  const label = figure.locator(".label.spot", { hasText: /^A$/ });
  const at = await lesson.middle(label);
  const button = figure.getByRole("button", { name: "Node A" });
  await page.mouse.move(at[0], at[1]);
  await expect(button).toHaveAttribute("data-lit", "");
  await button.hover();
  await expect(label).toHaveClass(/lit/);
  const refused = await lesson.value("A", "refused");
  await page.mouse.click(at[0], at[1]);
  const after = (await lesson.value("A", "elements")) + (await lesson.value("A", "refused"));
  expect(after).toBe(refused + 1);
});

test("on paper, the verdict and both meshes stay, and what can only be pressed goes", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open("mesher");
  await lesson.see("A");
  const figure = lesson.figure("A");
  while ((await lesson.value("A", "stalled")) === 0) await figure.locator('[data-choice="wait"]').click();
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  await page.emulateMedia({ media: "print" });
  await expect(figure.locator(".verdict")).toBeVisible();
  await expect(figure.locator(".score table")).toBeVisible();
  for (const press of ['[data-result="again"]', '[data-tool="undo"]', '[data-level="boot"]'])
    await expect(figure.locator(press)).toBeHidden();
});
