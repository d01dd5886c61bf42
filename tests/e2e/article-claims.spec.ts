/** What the lessons say stays true of what the reader has made: values, texts with a condition, and answers of tasks. */
import { expect, test, type Locator } from "@playwright/test";
import { ArticlePage } from "./article-page";

/** Returns the visible text of the paragraph, or entry of a list, that contains some words. */
const around = (lesson: ArticlePage, words: string): Locator =>
  lesson.page.locator("main :is(p, li)").filter({ hasText: words }).first();

/** Expects words in what is visible of a paragraph, and others not. */
async function says(paragraph: Locator, words: readonly string[], others: readonly string[]): Promise<void> {
  const missing = async (): Promise<readonly string[]> => {
    const visible = (await paragraph.innerText()).replaceAll(/\s+/g, " ");
    return [
      ...words.filter((text) => !visible.includes(text)),
      ...others.filter((text) => visible.includes(text)),
    ];
  };
  await expect.poll(missing).toEqual([]);
}

/** Sets a number of the text, which has the focus, by its keys. */
async function setNumber(lesson: ArticlePage, name: string, value: number): Promise<void> {
  const number = lesson.page.locator(`[data-drag="${name}"]`).first();
  await number.focus();
  await lesson.page.keyboard.press("Home");
  const [min, step] = await number.evaluate((node) => {
    const range = JSON.parse(
      document.querySelector<HTMLElement>(`#figure-${node.dataset["drag"]?.split(".")[0] ?? ""}`)?.dataset[
        "figure"
      ] ?? "{}",
    ) as { ranges: Record<string, { min: number; step: number }> };
    const { min = 0, step = 1 } = range.ranges[node.dataset["drag"]?.split(".")[1] ?? ""] ?? {};
    return [min, step];
  });
  const presses = Math.round((value - min) / step);
  for (let i = 0; i < Math.floor(presses / 10); i++) await lesson.page.keyboard.press("PageUp");
  for (let i = 0; i < presses % 10; i++) await lesson.page.keyboard.press("ArrowRight");
  const [letter = "", input = ""] = name.split(".");
  expect(await lesson.value(letter, input)).toBeCloseTo(value, 9);
}

test("lesson 4: the formula holds under every limit, and an answer keeps the numbers of the solution", async ({
  page,
}) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(4);
  await lesson.see("A");
  const formula = page.locator(".formula.displayed").first();
  for (const size of [0.3, 0.4, 0.6, 1.35, 2.5, 2.8]) {
    await setNumber(lesson, "A.size", size);
    const [h = 0, used = 0, height = 0] = (
      await formula.locator("[data-show]").evaluateAll((nodes) => nodes.map(({ textContent }) => textContent))
    ).map(Number);
    // Two numbers with three digits give the height to within some units of its last one.
    expect(Math.sqrt(h * h - used * used)).toBeCloseTo(height, 2);
    const { wanted, radius, used: counted, held } = await lesson.values("A");
    const aim = around(lesson, "The program aims");
    if (held === 0) await says(aim, [Number(wanted).toFixed(2)], ["holds"]);
    else await says(aim, ["which a limit holds at", Number(wanted).toFixed(2)], []);
    if (Math.abs(Number(radius) - Number(counted)) > 1e-6)
      await says(around(lesson, "makes it count as"), [Number(counted).toFixed(2)], ["as it is here"]);
    // The point stays within the picture.
    const [stage, point] = [
      await lesson.figure("A").locator(".stage").boundingBox(),
      await lesson.middle(lesson.handle("A", "ideal-point")),
    ];
    expect(point[1]).toBeGreaterThan(stage?.y ?? 0);
  }
  await setNumber(lesson, "A.size", 1.2);
  await setNumber(lesson, "A.size", 0.6);
  await lesson.done(3);
  const answer = lesson.task(3).locator(".because p");
  const solved = await answer.innerText();
  await setNumber(lesson, "A.size", 2);
  expect(await answer.innerText()).toBe(solved);
  expect(lesson.errors).toEqual([]);
});

test("lesson 5: the text follows the node that is taken, and the candidate that is first", async ({
  page,
}) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(5);
  await lesson.see("A");
  const winner = around(lesson, "has a place between both");
  await says(winner, ["Yet node d is taken"], ["new node is taken"]);
  const [x, y] = await lesson.middle(lesson.handle("A", "corner-5"));
  await lesson.drag([x, y], [x + 20, y - 150]);
  expect(await lesson.value("A", "takesnew")).toBe(1);
  await says(winner, ["Here the new node is taken"], ["Yet node"]);
  await page.locator('[data-go="A pose=blocked size=1"]').click();
  await expect.poll(async () => (await lesson.values("A"))["accepted"]).toBe("e");
  await says(winner, ["Yet node e is taken"], ["node d"]);

  await lesson.see("B");
  const first = around(lesson, "is the first, with");
  await says(first, ["called new, is the first", "and a comes next"], ["node a is"]);
  await setNumber(lesson, "B.newnode", 0.4);
  await says(first, ["Here node a is the first"], ["called new"]);
  const weight = around(lesson, "by the factor");
  await says(weight, ["less than"], ["more than"]);
  await setNumber(lesson, "B.newnode", 1.3);
  await says(weight, ["more than"], ["less than"]);
  expect(lesson.errors).toEqual([]);
});

test("lessons 0, 2, 3 and 11: texts that do not hold of a state give way to others", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(0);
  await lesson.see("A");
  await lesson.task(2).scrollIntoViewIfNeeded();
  await lesson.see("A");
  const [x, y] = await lesson.middle(lesson.handle("A", "high"));
  await lesson.drag([x, y], [x, y - 90]);
  const truth = await lesson.value("A", "truth");
  expect(truth).toBeGreaterThan(4);
  await expect(around(lesson, "What comes out is a mosaic")).toContainText(
    `the truth is ${truth.toFixed(2)}`,
  );
  await lesson.see("B");
  await setNumber(lesson, "B.factor", 1);
  await says(around(lesson, "The plate called"), ["here, too, they are all alike", "as good"], []);

  await lesson.open(2);
  await lesson.see("C");
  const slope = around(lesson, "Now the slope is");
  await says(slope, ["The first averaging leaves"], ["right at once"]);
  await page.locator('[data-go="C step=0 beat=4 curve=ramp x=4.5"]').click();
  await expect.poll(() => lesson.value("C", "slope")).toBe(0);
  await says(slope, ["The first guess is right at once"], ["averaging leaves"]);

  await lesson.open(3);
  await lesson.see("A");
  const loss = around(lesson, "the stretched square changes an angle by");
  await says(loss, ["much less than"], ["no less than"]);

  await lesson.open(11);
  await lesson.see("A");
  const edges = around(lesson, "Two of the points are above");
  await says(edges, ["They hardly change"], ["In yours"]);
  await page.locator('[data-go="A pose=wedge"]').click();
  await expect.poll(() => lesson.value("A", "uneven")).toBeGreaterThan(5);
  await says(edges, ["In yours it is 11.00 times"], ["They hardly change"]);
  expect(lesson.errors).toEqual([]);
});

test("lesson 9: triangles that nobody stretches have the mean length that the lesson says", async ({
  page,
}) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(9);
  await lesson.see("A");
  await setNumber(lesson, "A.stretching", 1);
  await says(
    around(lesson, "How long is a triangle?"),
    [`about ${(await lesson.value("A", "meanaspect")).toFixed(1)}.`],
    [],
  );
  expect(lesson.errors).toEqual([]);
});

test("lesson 6: a side that starts into the triangle from a common node is refused", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(6);
  await lesson.see("A");
  for (const [pose, crossing, verdict] of [
    ["shared", 0, "They share a node, and nothing else"],
    ["entering", 1, "the side starts into the triangle: refused"],
    ["beside", 0, "One value lies outside"],
  ] as const) {
    await page.locator(`[data-go="A pose=${pose}"]`).click();
    await expect(lesson.figure("A").locator(".layer-card").last()).toContainText(verdict);
    expect(await lesson.value("A", "crossing")).toBe(crossing);
  }
  expect(lesson.errors).toEqual([]);
});
