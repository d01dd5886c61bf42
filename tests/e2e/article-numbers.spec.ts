/** The numbers that are written in the lessons: those that their figures show in the beginning. */
import { expect, test } from "@playwright/test";
import { ArticlePage } from "./article-page";

for (const number of [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11])
  test(`lesson ${number}: what is written is what its figures show when they are loaded`, async ({
    page,
  }) => {
    const lesson = new ArticlePage(page, false);
    const source = await (await page.request.get(`./lessons/${number}/`)).text();
    await lesson.open(number);
    const letters = await page
      .locator("[data-figure]")
      .evaluateAll((figures) => figures.map(({ id }) => id.replace("figure-", "")));
    expect(letters.length).toBeGreaterThan(0);
    for (const letter of letters) {
      await lesson.see(letter);
      const [written, shown] = await page.evaluate(
        ([html, figure]): readonly [readonly string[], readonly string[]] => {
          /** What the figure sets in the text, as `A.size 0.12`. */
          const tiedIn = (root: Document): readonly string[] =>
            [...root.querySelectorAll<HTMLElement>("[data-show], [data-drag]")].flatMap((node) => {
              const name = node.dataset["show"] ?? node.dataset["drag"] ?? "";
              // What follows a task is shown after the reader has changed the figure.
              // Of a choice, one text stands: the one that is written first.
              const isOther =
                !name.startsWith(`${figure}.`) || node.closest(".because, [data-if][hidden]") !== null;
              return isOther ? [] : [`${name} ${node.textContent.replace("-", "−")}`];
            });
          return [tiedIn(new DOMParser().parseFromString(html, "text/html")), tiedIn(document)];
        },
        [source, letter] as const,
      );
      expect(shown).toEqual(written);
    }
    expect(lesson.errors).toEqual([]);
  });
