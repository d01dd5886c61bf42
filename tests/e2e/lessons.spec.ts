/** The lessons: all tasks of all ten, wrong answers, the address, progress, and what axe says. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Locator, type Page } from "@playwright/test";
import { readFileSync } from "node:fs";
import { parseLesson, type Lesson, type LessonTask } from "../../web/teach/lessons/lesson";
import { listOf } from "../../web/teach/lessons/lesson-files";
import { button, choice, nextStop, playButton, stopBefore, tab } from "./controls";

const folder = new URL("../../public/lessons/", import.meta.url);
const fileText = (name: string): string => readFileSync(new URL(name, folder), "utf8");
const lessons = listOf(fileText("index.json")).map((file): Lesson => {
  const parsed = parseLesson(file, fileText(file));
  if (!parsed.success) throw new Error(parsed.errors.join("\n"));
  return parsed.lesson;
});

async function violations(page: Page): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
}

async function open(page: Page, address: string, scheme: "dark" | "light" = "dark"): Promise<void> {
  await page.addInitScript((value) => localStorage.setItem("mantine-color-scheme-value", value), scheme);
  await page.goto(`./?test=1${address}`);
}

const front = (page: Page): Locator => page.getByTestId("lesson-front");
const task = (page: Page, number: number): Locator => page.getByTestId(`lesson-task-${number}`);

const stepOf = async (page: Page): Promise<number> =>
  Number(await page.getByTestId("viewport").getAttribute("data-step"));

/** Goes to the last state: the button leads to the end of lines, of patches, and of the volume in turn. */
async function playToEnd(page: Page): Promise<void> {
  const steps = Number(await page.getByTestId("viewport").getAttribute("data-steps"));
  await expect(async () => {
    await button(page, "Last state of the phase").click();
    expect(await stepOf(page)).toBe(steps);
  }).toPass();
}

/** Does what a task asks for, with the controls that a reader would use. */
async function complete(page: Page, asked: LessonTask, number: number): Promise<void> {
  switch (asked.kind) {
    case "step":
      if (asked.reach === "end") return playToEnd(page);
      await choice(page, "Jump to").selectOption(asked.reach);
      // Lines and patches come before the volume.
      if (["line", "patch"].includes(asked.reach) && (await stepOf(page)) >= 0) {
        await stopBefore(page).click();
        return;
      }
      await nextStop(page).click();
      return;
    case "color":
      await page.getByTestId("player-coloring").selectOption(asked.coloring);
      return;
    case "number":
      await page.getByTestId(`lesson-answer-${number}`).fill(String(asked.answer));
      await page.getByTestId(`lesson-answer-${number}`).press("Enter");
      return;
    case "choice":
      await page.getByTestId(`lesson-choice-${number}-${1 + asked.choices.indexOf(asked.answer)}`).check();
      await page.getByTestId(`lesson-check-${number}`).click();
      return;
    case "compare":
      await page.getByTestId(`lesson-compare-${number}`).click();
      await expect(page.getByTestId(`lesson-run-${number}-${asked.order}`)).toHaveAttribute(
        "aria-pressed",
        "true",
      );
  }
}

lessons.forEach((lesson, index) => {
  test(`lesson ${index + 1}, ${lesson.title}, is completed`, async ({ page }) => {
    await open(page, `&lesson=${index + 1}`);
    await expect(front(page)).toHaveAttribute("data-shown", "true");
    const viewport = page.getByTestId("viewport");
    await expect(viewport).toHaveAttribute("data-step", String(lesson.step));
    await expect(page.getByTestId("lesson-page").getByRole("link").first()).toContainText("Parikh");
    expect(await page.locator(".katex-error").count()).toBe(0);
    for (const [i] of lesson.tasks.entries())
      await expect(task(page, i + 1)).toHaveAttribute("data-done", "false");
    await expect(page.getByTestId("lesson-finished")).toHaveCount(0);
    expect(await violations(page)).toEqual([]);
    for (const [i, asked] of lesson.tasks.entries()) {
      await complete(page, asked, i + 1);
      await expect(task(page, i + 1)).toHaveAttribute("data-done", "true");
    }
    await expect(page.getByTestId("lesson-finished")).toBeVisible();
    expect(await violations(page)).toEqual([]);
    // Progress survives a reload.
    await page.goto("./?test=1&new=1");
    await tab(page, "Lessons").click();
    await expect(page.getByTestId(`lesson-${index + 1}`)).toContainText("done");
  });
});

test("a formula that its font makes too wide can be scrolled with the keys", async ({ page }) => {
  let release = (): void => undefined;
  const isReleased = new Promise<void>((resolve) => (release = resolve));
  await page.route("**/*.woff2", async (route) => {
    await isReleased;
    await route.continue();
  });
  await open(page, "&lesson=10");
  const formulas = page.getByTestId("lens-formula").locator("p");
  await expect(formulas.first()).toBeVisible();
  // The formulas fit into the panel as it is.
  await page
    .getByTestId("lens")
    .evaluate((lens: HTMLElement) => lens.style.setProperty("width", "150px", "important"));
  release();
  const areWideReached = () =>
    formulas.evaluateAll((all) => {
      const wide = all.filter((one) => one.scrollWidth > one.clientWidth) as HTMLElement[];
      return wide.length > 0 && wide.every(({ tabIndex }) => tabIndex === 0);
    });
  await expect.poll(areWideReached).toBe(true);
});

test("the list opens lessons, the address follows, and the buttons lead to the next one", async ({
  page,
}) => {
  await open(page, "&new=1", "light");
  await page.getByRole("menuitem", { name: "Help" }).click();
  await page.getByRole("menuitem", { name: "Lessons" }).click();
  for (let number = 1; number <= 10; number++)
    await expect(page.getByTestId(`lesson-${number}`)).toContainText(lessons[number - 1]?.title ?? "");
  expect(await violations(page)).toEqual([]);
  await page.getByTestId("lesson-1").click();
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await expect(page).toHaveURL(/[?&]lesson=1(&|$)/);
  await expect(page.getByTestId("lesson-previous")).toBeDisabled();
  await page.getByTestId("lesson-next").click();
  await expect(page.getByTestId("lesson-page")).toHaveAttribute("data-lesson", "2");
  await expect(page).toHaveURL(/[?&]lesson=2(&|$)/);
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await page.getByTestId("lesson-all").click();
  await expect(page).not.toHaveURL(/lesson=/);
  await expect(page.getByTestId("lesson-list")).toBeVisible();
});

test("the runs of a lesson travel in its address", async ({ page }) => {
  const number = 1 + lessons.findIndex(({ tasks }) => tasks.some(({ kind }) => kind === "compare"));
  await open(page, `&lesson=${number}`);
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await page.getByTestId("lesson-compare-1").click();
  const other = page.getByTestId("lesson-run-1-first-in");
  await expect(other).toHaveAttribute("aria-pressed", "true");
  await expect(page).toHaveURL(/[?&]runs=first-in(&|$)/);
  const table = page.getByRole("table", { name: "Runs to compare" });
  const rows = await table.innerText();
  expect(rows.split("\n").length).toBeGreaterThan(2);

  await page.reload();
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await expect(other).toHaveAttribute("aria-pressed", "false");
  expect(await table.innerText()).toBe(rows);
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", String(lessons[number - 1]?.step));
  await page.getByTestId("lesson-all").click();
  await expect(page).not.toHaveURL(/runs=/);
});

test("lesson 8 draws the heap of the front at every step, with the next base face on top", async ({
  page,
}) => {
  await open(page, "&lesson=8");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const queue = page.getByTestId("queue-figure");
  await expect(page.getByTestId("lesson-page").getByRole("table")).toContainText("14,855");
  for (const move of ["forward", "forward", "back"]) {
    const next = (await queue.getAttribute("data-first")) ?? "";
    const step = await stepOf(page);
    await page.getByTestId(`player-${move}`).click();
    await expect.poll(() => stepOf(page)).not.toBe(step);
    if (move === "forward")
      await expect(page.getByTestId("lens")).toContainText(
        `Base face ${Number(next).toLocaleString("en-US")}`,
      );
  }
  await expect(queue.locator("figcaption")).toContainText("compared faces");
});

test("the lens has the numbers of the ideal point and of a distance that is too short", async ({ page }) => {
  await open(page, "&lesson=4");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await button(page, "Step forward").click();
  // Those that the lesson states for step 100.
  await expect(page.getByTestId("lens-ideal")).toContainText("R=0.091");
  await expect(page.getByTestId("lens-ideal")).toContainText("=0.126");
  await choice(page, "Jump to").selectOption("too-close");
  await nextStop(page).click();
  await expect(page.getByTestId("lens-refusal")).toContainText("<0.35");
});

test("the lens shows a node behind its base face, and the volume that is not positive", async ({ page }) => {
  await open(page, "&lesson=10");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await tab(page, "Front").click();
  await choice(page, "Jump to").selectOption("behind");
  await nextStop(page).click();
  const sentence = page.getByTestId("lens-sentence");
  await expect(sentence).toContainText("was refused: it is behind the base face, or in its plane");
  const name = /Node ([\d,]+)/.exec((await sentence.textContent()) ?? "")?.[1] ?? "none";
  await expect(page.getByTestId("lens-labels").locator("[data-kind=failing]").last()).toHaveText(
    `node ${name}`,
  );
  await expect(page.getByTestId("lens-refusal")).toContainText("The volume must be positive");
});

test("a task is done by a step that a fast player has passed", async ({ page }) => {
  await open(page, "&lesson=6");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await choice(page, "Speed").selectOption("10000");
  await playButton(page).click();
  await expect(task(page, 1)).toHaveAttribute("data-done", "true");
});

test("wrong answers get a hint, and the right one counts after them", async ({ page }) => {
  await open(page, "&lesson=1");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const answer = page.getByTestId("lesson-answer-1");
  const verdict = page.getByTestId("lesson-verdict-1");
  for (const [typed, said] of [
    ["", "Type a number."],
    ["many", "Type a number."],
    ["491", "Not yet. Go to the beginning"],
  ] as const) {
    await answer.fill(typed);
    await answer.press("Enter");
    await expect(verdict).toContainText(said);
    await expect(task(page, 1)).toHaveAttribute("data-done", "false");
  }
  await page.getByTestId("lesson-check-2").click();
  await expect(page.getByTestId("lesson-verdict-2")).toHaveText("Choose an answer.");
  await page.getByTestId("lesson-choice-2-3").check();
  await page.getByTestId("lesson-check-2").click();
  await expect(page.getByTestId("lesson-verdict-2")).toContainText("Not yet.");
  await answer.fill("492");
  await answer.press("Enter");
  await expect(verdict).toHaveText("Right.");
  await expect(task(page, 1)).toHaveAttribute("data-done", "true");
});

test("another model ends the front of the lesson, and the lesson brings it back", async ({ page }) => {
  await open(page, "&lesson=4");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await button(page, "Show the model").click();
  await expect(front(page)).toHaveAttribute("data-shown", "false");
  await page.getByTestId("lesson-show").click();
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await button(page, "First state of the phase").click();
  await page.getByTestId("lesson-show").click();
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", String(lessons[3]?.step));
});

test("an address with a lesson that does not exist shows the list", async ({ page }) => {
  await open(page, "&lesson=99");
  await expect(page.getByTestId("lesson-list")).toBeVisible();
  await expect(page.getByTestId("lesson-10")).toBeVisible();
  await expect(page.getByTestId("notice-address")).toContainText("There is no lesson “99”");
});

test("a lesson with errors is named in the list, and does not hide the others", async ({ page }) => {
  await page.route("**/lessons/front.md", (route) => route.fulfill({ body: "---\ntitle: A\n---\nText." }));
  await open(page, "&new=1");
  await tab(page, "Lessons").click();
  await expect(page.getByTestId("lesson-errors")).toContainText(
    'front.md: field "model" is missing; add it.',
  );
  await expect(page.getByTestId("lesson-9")).toBeVisible();
});

test("a lesson is completed on a phone", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, "&lesson=6");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await expect(page.getByTestId("viewport")).toBeVisible();
  expect(await violations(page)).toEqual([]);
  const overflow = await page
    .getByTestId("lesson-page")
    .evaluate((panel) => panel.scrollWidth - panel.clientWidth);
  expect(overflow).toBeLessThanOrEqual(0);
  for (const [i, asked] of (lessons[5]?.tasks ?? []).entries()) {
    await complete(page, asked, i + 1);
    await expect(task(page, i + 1)).toHaveAttribute("data-done", "true");
  }
});

test("on a phone, a lesson has the lens and the colours of the front", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, "&lesson=2");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await page.getByTestId("lesson-lens").locator("summary").click();
  await expect(page.getByTestId("lens")).toContainText("The front before the first step");
  const overflow = await page
    .getByTestId("lesson-page")
    .evaluate((panel) => panel.scrollWidth - panel.clientWidth);
  expect(overflow).toBeLessThanOrEqual(0);
  expect(await violations(page)).toEqual([]);
  for (const [i, asked] of (lessons[1]?.tasks ?? []).entries()) {
    await complete(page, asked, i + 1);
    await expect(task(page, i + 1)).toHaveAttribute("data-done", "true");
  }
  await expect(page.getByTestId("lens")).toContainText("It is divided into 3 sides");
});

test("on a phone, a notice lies above the drawer, and the player above the fields of the experiments", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, "&lesson=5&runs=sideways");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const notice = page.getByTestId("notice-address");
  await expect(notice).toContainText("“sideways”");
  // A press reaches the button only if nothing lies above it.
  await notice.getByRole("button", { name: "OK" }).click();
  await expect(notice).toHaveCount(0);
  await page.getByTestId("experiments").locator("summary").click();
  const layerOf = (element: Element): number => Number(getComputedStyle(element).zIndex) || 0;
  const field = page.getByTestId("experiments").locator("div", { has: page.getByTestId("experiment-order") });
  const layers = await field
    .last()
    .locator("*")
    .evaluateAll((parts) => parts.map((part) => Number(getComputedStyle(part).zIndex) || 0));
  const player = await page.getByTestId("lesson-player").evaluate(layerOf);
  expect(Math.max(...layers)).toBeGreaterThan(0);
  expect(player).toBeGreaterThan(Math.max(...layers));
});

test("a wrong answer after the right one is not marked as right", async ({ page }) => {
  await open(page, "&lesson=2");
  const verdict = page.getByTestId("lesson-verdict-2");
  const answer = page.getByTestId("lesson-answer-2");
  await answer.fill("9");
  await answer.press("Enter");
  await expect(verdict).toHaveAttribute("data-right", "true");
  await answer.fill("8");
  await answer.press("Enter");
  await expect(verdict).toContainText("Divide the length by the size");
  await expect(verdict).not.toHaveAttribute("data-right");
  await expect(task(page, 2)).toHaveAttribute("data-done", "true");
});

test("experiments: runs by other rules stand side by side, and the link opens them again", async ({
  page,
}) => {
  await page.goto("./?test=1&lesson=5");
  await expect(page.getByTestId("lesson-front")).toHaveAttribute("data-shown", "true");
  await page.getByTestId("experiments").locator("summary").click();
  await page.getByTestId("experiment-tolerance").selectOption("2");
  await page.getByTestId("experiment-run").click();
  await expect(page.getByTestId("experiment-tolerance-2")).toBeVisible();
  await page.getByTestId("experiment-search").selectOption("linear");
  await page.getByTestId("experiment-run").click();
  await expect(page.getByTestId("experiment-tolerance-2+linear")).toBeVisible();
  // A linear search looks at more faces, and changes nothing else.
  const cells = async (run: string): Promise<string[]> =>
    page.getByTestId(`experiment-${run}`).getByRole("cell").allTextContents();
  const changed = await cells("tolerance-2");
  const slow = await cells("tolerance-2+linear");
  expect(slow.slice(1)).toEqual(changed.slice(1));
  expect(parseFloat(slow[0] ?? "")).toBeGreaterThan(2 * parseFloat(changed[0] ?? ""));
  expect(changed).not.toEqual(await cells("usual"));
  await expect(page).toHaveURL(/runs=tolerance-2(%2C|,)tolerance-2%2Blinear/);
  await page.reload();
  await page.getByTestId("experiments").locator("summary").click();
  await expect(page.getByTestId("experiment-tolerance-2+linear")).toBeVisible();
  expect(await cells("tolerance-2+linear")).toEqual(slow);
  await page.getByTestId("experiment-tolerance-2").getByRole("button").click();
  await expect(page.getByTestId("experiment-tolerance-2").getByRole("button")).toHaveAttribute(
    "aria-pressed",
    "true",
  );
});

/** Runs an experiment, and presses *Stop* from within the page as soon as that is possible: the run may end before a click from outside. */
function runAndStop(page: Page): Promise<void> {
  return page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        const button = (id: string): HTMLButtonElement | null =>
          document.querySelector<HTMLButtonElement>(`[data-testid="${id}"]`);
        const observer = new MutationObserver(() => {
          const stop = button("experiment-stop");
          if (!stop || stop.disabled) return;
          observer.disconnect();
          stop.focus();
          stop.click();
          resolve();
        });
        observer.observe(document.body, { subtree: true, childList: true, attributes: true });
        button("experiment-run")?.click();
      }),
  );
}

test("an experiment that is stopped is not compared, and the front before it is shown again", async ({
  page,
}) => {
  await open(page, "&lesson=8");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const step = await stepOf(page);
  await page.getByTestId("experiments").locator("summary").click();
  await page.getByTestId("experiment-search").selectOption("linear");
  await runAndStop(page);
  await expect(page.getByTestId("experiment-run")).toBeEnabled();
  await expect(page.getByTestId("experiment-stop")).toHaveCount(0);
  await expect(page.getByTestId("experiment-run")).toBeFocused();
  await expect(page.getByTestId("experiment-linear")).toHaveCount(0);
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  expect(await stepOf(page)).toBe(step);
  await expect(page).not.toHaveURL(/runs=/);
  // The next one is not stopped.
  await page.getByTestId("experiment-run").click();
  await expect(page.getByTestId("experiment-linear")).toBeVisible();
  await expect(page).toHaveURL(/runs=linear/);
});

test("the runs of an address can be stopped on a phone, and the address names those that are complete", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, "&lesson=8&runs=strict,linear,random%2Blinear,first-in%2Blinear,smallest-first%2Blinear");
  await page.getByTestId("lesson-stop").click();
  await expect(page.getByTestId("lesson-stop")).toHaveCount(0);
  await expect(front(page)).toBeVisible();
  await expect(page.getByTestId("lesson-show")).toBeFocused();
  await expect(page).not.toHaveURL(/smallest-first/);
  await page.getByTestId("lesson-show").click();
  await expect(front(page)).toHaveAttribute("data-shown", "true");
});

test("the model of a lesson is not edited, and the app says why", async ({ page }) => {
  await open(page, "&lesson=1");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  const notice = page.getByText("The model of a lesson is not edited");
  await expect(notice).toBeVisible();
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const undo = page.getByRole("button", { name: /^Undo/ });
  await expect(undo).toBeDisabled();
  await page.getByRole("button", { name: "Edit it nevertheless" }).click();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await expect(undo).toBeEnabled();
});

test("the lens shows its formulas without scrolling", async ({ page }) => {
  await open(page, "&lesson=6");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await choice(page, "Jump to").selectOption("crosses");
  await nextStop(page).click();
  const formula = page.getByTestId("lens-formula");
  await expect(formula.locator(".katex").last()).toBeInViewport({ ratio: 1 });
  await expect(formula.getByRole("heading")).toBeInViewport({ ratio: 1 });
});

test("the lens shows its formulas without scrolling, however long its sentences are", async ({ page }) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await open(page, "&lesson=10");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  await choice(page, "Jump to").selectOption("crosses");
  const formula = page.getByTestId("lens").locator(".katex").last();
  await expect(formula).toBeInViewport({ ratio: 1 });
  for (let i = 0; i < 24; i++) {
    const before = (await page.getByTestId("lens").textContent()) ?? "";
    await nextStop(page).click();
    await expect(page.getByTestId("lens")).not.toHaveText(before);
    await expect(formula).toBeInViewport({ ratio: 1 });
  }
});

test("the status bar counts the steps of patches as the player does, and the last step says that the volume is full", async ({
  page,
}) => {
  await open(page, "&lesson=3");
  await expect(front(page)).toHaveAttribute("data-shown", "true");
  const status = page.getByTestId("status");
  await expect(status).toContainText("Fronts of the patches after step 274 of 1,173");
  await open(page, "&lesson=1&step=99999");
  await expect(page.getByTestId("notice-address")).toContainText("The front has no step 99999");
  await expect(status).toContainText("Front after step 1,743 of 1,743");
  await expect(page.getByTestId("lens-end")).toContainText("no faces left: 1,736 elements");
  await expect(page.getByTestId("lens-end")).toContainText("elements made last");
  await page.getByTestId("player-elements").selectOption("cut");
  await expect(page.getByTestId("lens-end")).not.toContainText("elements made last");
});

test("a lesson that begins at a step which its front does not have says so", async ({ page }) => {
  await page.route("**/lessons/front.md", async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: (await response.text()).replace("step: 0", "step: 99999") });
  });
  await open(page, "&lesson=1");
  await expect(page.getByTestId("lesson-errors")).toContainText(
    'front.md: field "step" must be from -709 to 1743, the states of the front of "unit-cube", but is 99999',
  );
});
