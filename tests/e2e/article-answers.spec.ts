/**
 * The numbers in the answers of tasks: those of a solution, which is led to here by keys. The page takes the numbers of the reader
 * when a task is done, so they must then be those that the author has written.
 */
import { expect, test, type Locator } from "@playwright/test";
import { ArticlePage } from "./article-page";

/**
 * What is pressed how often, or until the task is done: `A.size` is a number of the text, `A:corner-1` a handle, `A Step` the
 * history, and `go:…` and `button:…` are a word and a button.
 */
type Press = readonly [target: string, key?: string, times?: number];

/** By lesson and task; of a task without numbers of figures in its answer, nothing is needed. */
const solutions: Readonly<Record<string, Readonly<Record<number, readonly Press[]>>>> = {
  0: {
    1: [["A.even", "PageUp", 6]],
    // The stress is computed in the next frame, so the presses are counted.
    2: [["A:wide", "ArrowLeft", 9]],
    4: [
      ["B:spot", "ArrowLeft", 26],
      ["B:spot", "ArrowDown", 5],
      ["B.own", "ArrowLeft", 8],
      ["B.even", "PageUp", 9],
    ],
  },
  1: {
    1: [["A Step", "Home", 1], ["A Step", "ArrowRight", 12], ["button:A test"]],
    3: [["A.size", "ArrowLeft"]],
    4: [["B Step", "End", 1], ["button:B Pulled apart"]],
  },
  2: {
    1: [["button:B The start counts"], ["B:size-3", "ArrowLeft", 25], ["B:size-3", "ArrowDown"]],
    2: [["C:begin", "ArrowRight"]],
    3: [["D:begin", "ArrowRight"]],
  },
  3: {
    1: [
      ["A.bulge", "End", 1],
      ["A:dot-square", "ArrowLeft", 16],
      ["A:dot-square", "ArrowUp"],
    ],
    2: [
      ["A.bulge", "Home", 1],
      ["A:dot-square", "ArrowDown", 16],
      ["A:dot-square", "ArrowLeft"],
    ],
    3: [["button:B Measure in space"], ["B:corner-B", "ArrowRight", 6], ["B:corner-A", "Shift+ArrowLeft"]],
  },
  4: { 3: [["A.size", "PageDown"]] },
  7: {
    1: [["A.growth", "ArrowRight"]],
    2: [
      ["A.growth", "ArrowLeft", 8],
      ["A:wing-1", "ArrowLeft"],
    ],
    3: [["A.growth", "ArrowLeft"]],
  },
  8: {
    1: [
      ["A.nodes", "End", 1],
      ["A.radius", "ArrowLeft"],
    ],
    2: [["go:A at=bay nodes=960 radius=0.02"], ["A:circle-list", "ArrowRight"]],
    3: [["go:B at=hollow radius=0.12 show=grid"], ["B.radius", "ArrowRight"]],
    4: [["go:A at=bay nodes=960 radius=0.02"], ["A.radius", "End", 1], ["A.nodes", "Home", 1]],
    5: [
      ["C Step", "End", 1],
      ["C Step", "ArrowLeft"],
    ],
  },
  9: {
    1: [
      ["A.stretching", "ArrowRight"],
      ["A:dot", "ArrowRight"],
    ],
  },
  10: {
    4: [
      ["button:C Third pocket"],
      // Row by row downwards.
      ...Array.from({ length: 12 }, (_none, row): readonly Press[] => [
        ["C:node", "Shift+ArrowDown", 1],
        ["C:node", row % 2 === 0 ? "ArrowRight" : "ArrowLeft", 30],
      ]).flat(),
    ],
  },
  11: { 1: [["A.lift", "ArrowLeft"]] },
};

/** Most presses of a key until a task is done. */
const patience = 120;

for (const [number, tasks] of Object.entries(solutions))
  test(`lesson ${number}: the answers have the numbers of solutions`, async ({ page }) => {
    const lesson = new ArticlePage(page, false);
    await lesson.open(number);
    const withNumbers = page.locator(".task:has(.because [data-show])");
    const names = await withNumbers.evaluateAll((all) => all.map(({ dataset }) => dataset["testid"] ?? ""));
    expect(names).toEqual(Object.keys(tasks).map((task) => `task-${task}`));
    for (const [task, presses] of Object.entries(tasks)) {
      await lesson.open(number);
      const written = await answerOf(lesson, Number(task));
      await solve(lesson, Number(task), presses);
      await lesson.done(Number(task));
      expect.soft(await answerOf(lesson, Number(task)), `task ${task}`).toBe(written);
    }
    expect(lesson.errors).toEqual([]);
  });

/** Returns the text of an answer without the branches of choices that do not hold. */
const answerOf = (lesson: ArticlePage, task: number): Promise<string> =>
  lesson
    .task(task)
    .locator(".because p")
    .evaluate((answer) => {
      const copy = answer.cloneNode(true) as HTMLElement;
      for (const other of copy.querySelectorAll("[data-if][hidden]")) other.remove();
      return copy.textContent.replaceAll(/\s+/g, " ");
    });

async function solve(lesson: ArticlePage, task: number, presses: readonly Press[]): Promise<void> {
  const { page } = lesson;
  const isDone = async (): Promise<boolean> => (await lesson.task(task).getAttribute("data-done")) === "true";
  for (const [target, key, times = patience] of presses) {
    const letter = /[A-Z]/.exec(target.replace(/^(go|button):/, ""))?.[0] ?? "";
    await lesson.see(letter);
    const place = placeOf(lesson, target).first();
    if (key === undefined) {
      await place.click();
      await atRest(lesson, letter);
      await lesson.see(letter);
      continue;
    }
    // Until its stage has its size, a step of a handle is another one.
    await lesson.middle(place);
    await place.focus();
    for (let i = 0; i < times && !(await isDone()); i++) await page.keyboard.press(key);
  }
}

/** Waits until a figure has moved to where a word or a button has led it. */
async function atRest(lesson: ArticlePage, letter: string): Promise<void> {
  let before = "";
  await expect
    .poll(
      async () => {
        const values = JSON.stringify(await lesson.values(letter));
        const isSame = values === before;
        before = values;
        return isSame;
      },
      { intervals: [400] },
    )
    .toBe(true);
}

function placeOf(lesson: ArticlePage, target: string): Locator {
  const [, kind = "", rest = ""] = /^(go:|button:)(.*)$/.exec(target) ?? [];
  if (kind === "go:") return lesson.page.locator(`[data-go="${rest}"]`);
  if (kind === "button:") return lesson.figure(rest[0] ?? "").getByRole("button", { name: rest.slice(2) });
  const [, letter = "", mark = "", name = ""] = /^([A-Z])([.: ])(.*)$/.exec(target) ?? [];
  if (mark === ".") return lesson.page.locator(`[data-drag="${letter}.${name}"]`);
  if (mark === ":") return lesson.handle(letter, name);
  return lesson.figure(letter).getByRole("slider", { name });
}

test("the game: the smallest angle of the program's boot is the one in the answer", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open("mesher");
  await lesson.see("A");
  const written = await lesson.task(2).locator('.because [data-show="A.programangle"]').textContent();
  await lesson.figure("A").getByRole("button", { name: "A boot" }).click();
  await expect.poll(() => lesson.value("A", "stage")).toBe(2);
  expect((await lesson.value("A", "programangle")).toFixed(0)).toBe(written);
});
