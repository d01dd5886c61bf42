/** The picture of a step of the front in lesson 1: what the test shows is not covered by the triangle that comes after it. */
import { expect, test, type Page } from "@playwright/test";
import { ArticlePage } from "./article-page";

/** Returns how many pixels of the drawing have exactly a colour. */
async function countPixels(lesson: ArticlePage, colour: readonly number[]): Promise<number> {
  return lesson
    .figure("A")
    .locator(".scene canvas")
    .evaluate((canvas, [r, g, b]) => {
      if (!(canvas instanceof HTMLCanvasElement)) throw new Error("The figure has no canvas");
      const data = canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        if (data[i] === r && data[i + 1] === g && data[i + 2] === b) count++;
      return count;
    }, colour);
}

/** Returns a colour of the style sheet as red, green and blue. */
async function colourOf(page: Page, name: string): Promise<readonly number[]> {
  return page.evaluate((property) => {
    const probe = document.body.appendChild(document.createElement("span"));
    probe.style.color = `var(${property})`;
    const numbers = getComputedStyle(probe).color.match(/[\d.]+/g) ?? [];
    probe.remove();
    return numbers.slice(0, 3).map(Number);
  }, name);
}

test.use({ colorScheme: "light" });

test("a refused candidate is shown without the triangle that is accepted after it", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(1);
  await lesson.see("A");
  const history = lesson.figure("A").getByRole("slider", { name: "Step" });
  await history.focus();
  await page.keyboard.press("Home");
  for (let i = 0; i < 400 && (await lesson.value("A", "refusedsofar")) === 0; i++)
    await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowLeft");
  const [gold, red] = [await colourOf(page, "--new"), await colourOf(page, "--refused")];
  await lesson.figure("A").getByRole("button", { name: "test" }).click();
  await expect.poll(() => lesson.value("A", "beat")).toBe(4);
  await expect.poll(() => countPixels(lesson, red)).toBeGreaterThan(200);
  expect(await countPixels(lesson, gold)).toBe(0);
  await lesson.figure("A").getByRole("button", { name: "new triangle" }).click();
  await expect.poll(() => lesson.value("A", "beat")).toBe(5);
  await expect.poll(() => countPixels(lesson, gold)).toBeGreaterThan(200);
  expect(await countPixels(lesson, red)).toBe(0);
});
