/** The film of a step in the player: beats, the neighbourhood, candidates in list and view, and the filled volume at the end. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { button, choice, nextStop, slider } from "./controls";
import { isLoaded, sharedTest } from "./shared-page";

const beats = ["active face", "ideal point", "candidates", "test", "new element"] as const;

/** Opens the cube after a step in which a candidate was refused because it crosses a face. */
async function openRefusal(page: Page): Promise<AppPage> {
  const app = new AppPage(page);
  let first = "700";
  if (isLoaded(page)) {
    first = "0";
    await button(page, "First state of the phase").click();
    await page.getByRole("checkbox", { name: "Follow" }).check();
  } else await page.goto("./?test=1&model=unit-cube&step=700");
  await expect(app.viewport).toHaveAttribute("data-step", first);
  await choice(page, "Jump to").selectOption("crosses");
  await nextStop(page).click();
  await expect(app.viewport).not.toHaveAttribute("data-step", first);
  await app.rest();
  return app;
}

const beatBar = (page: Page) => slider(page, "Beat of the step");

sharedTest(
  "the beats of a step are scrubbed by keys and pointer, and each changes the view and the sentence",
  async ({ page }) => {
    const app = await openRefusal(page);
    const bar = beatBar(page);
    await expect(bar).toHaveAttribute("aria-valuetext", "5 of 5: new element");
    const sentence = page.getByTestId("lens-sentence");
    await bar.focus();
    await page.keyboard.press("Home");
    await expect(bar).toHaveAttribute("aria-valuetext", "1 of 5: active face");
    await expect(sentence).toContainText("takes its active face");
    // The list knows no verdict before the test.
    const verdicts = page.getByTestId("lens").getByRole("cell", { name: "not tested yet" });
    const count = await page.getByTestId(/^lens-candidate-/).count();
    expect(count).toBeGreaterThan(1);
    await expect(verdicts).toHaveCount(count);
    await expect(page.getByTestId("lens-layer")).toHaveCount(0);
    const labels = page.getByTestId("lens-labels");
    await expect(labels).toContainText("base");
    await expect(labels).not.toContainText("ideal");
    const pictures: Buffer[] = [];
    const canvas = page.getByTestId("viewport-canvas");
    for (const [i, name] of beats.entries()) {
      await expect(bar).toHaveAttribute("aria-valuetext", `${i + 1} of 5: ${name}`);
      await app.rest();
      pictures.push(await canvas.screenshot());
      await page.keyboard.press("ArrowRight");
    }
    for (const [i, picture] of pictures.entries())
      for (const other of pictures.slice(i + 1)) expect(picture.equals(other)).toBe(false);
    // A click on the name of a beat shows it.
    await page.getByTestId("player-beats").getByText("test", { exact: true }).click({ force: true });
    await expect(bar).toHaveAttribute("aria-valuetext", "4 of 5: test");
    await expect(sentence).toContainText(/was refused: .*face/);
    await expect(verdicts).toHaveCount(0);
    await expect(page.getByTestId("lens-layer")).toBeVisible();
    await expect(labels).toContainText("face");
    // A candidate that is chosen before the test leads to it.
    await bar.fill("3");
    await page.getByTestId("lens-candidate-1").click();
    await expect(bar).toHaveAttribute("aria-valuetext", "4 of 5: test");
    await expect(page.getByTestId("lens-candidate-1")).toHaveAttribute("aria-pressed", "true");
    // The next step begins with its last beat.
    await button(page, "Step forward").click();
    await expect(bar).toHaveAttribute("aria-valuetext", /5 of 5/);
    const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
    expect((await axe.analyze()).violations.map(({ id }) => id)).toEqual([]);
  },
);

sharedTest("the beats of an edge have sentences of their own", async ({ page }) => {
  const app = await openRefusal(page);
  await button(page, "First state of the phase").click();
  await button(page, "First state of the phase").click();
  await button(page, "Step forward").click();
  await app.rest();
  const sentence = page.getByTestId("lens-sentence");
  await expect(sentence).toContainText("makes a triangle over the base edge");
  for (const [beat, text] of [
    ["1", "takes its active edge"],
    ["2", "the best triangle"],
    ["3", /candidates? (is|are) tried/],
    ["5", "makes a triangle over the base edge"],
  ] as const) {
    await beatBar(page).fill(beat);
    await expect(sentence).toContainText(text);
    await expect(page.getByTestId("lens-formula")).toHaveCount(beat === "5" ? 1 : 0);
  }
  await button(page, "Last state of the phase").click();
  // The next test begins within the volume.
  await button(page, "Step forward").click();
  await button(page, "Step forward").click();
  await expect(app.viewport).toHaveAttribute("data-step", "1");
});

sharedTest("slow playing shows every beat, and the film can be switched off", async ({ page }) => {
  const app = await openRefusal(page);
  const step = Number(await app.viewport.getAttribute("data-step"));
  await choice(page, "Speed").selectOption("1 step in 5 s");
  const bar = beatBar(page);
  const seen = page.evaluate(
    () =>
      new Promise<string[]>((resolve) => {
        const texts: string[] = [];
        const input = document.querySelector("[data-testid=player-beat]");
        const look = (): void => {
          const text = input?.getAttribute("aria-valuetext") ?? "";
          if (texts.at(-1) !== text) texts.push(text);
          if (texts.length === 7) resolve(texts);
          else requestAnimationFrame(look);
        };
        look();
      }),
  );
  await button(page, "Play").click();
  const texts = await seen;
  await button(page, "Pause").click();
  expect(texts.slice(1, 6)).toEqual([1, 2, 3, 4, 5].map((beat) => expect.stringContaining(`${beat} of 5`)));
  expect(Number(await app.viewport.getAttribute("data-step"))).toBeGreaterThan(step);
  await page.getByRole("checkbox", { name: "Film of the step" }).uncheck();
  await expect(bar).toHaveCount(0);
  await page.getByRole("checkbox", { name: "Film of the step" }).check();
  await expect(bar).toBeVisible();
});

sharedTest(
  "a candidate is highlighted in the list and in the view, by pointer and keyboard",
  async ({ page }) => {
    await openRefusal(page);
    const first = page.getByTestId("lens-candidate-0");
    const row = first.locator("xpath=ancestor::tr");
    const dot = button(page.getByRole("group", { name: "Candidates in the view" }), /^Candidate 1, /);
    await expect(dot).toHaveAccessibleName(/crosses a face/);
    await dot.hover();
    await expect(row).toHaveAttribute("data-pointed", "true");
    await page.getByTestId("player-counter").hover();
    await expect(row).not.toHaveAttribute("data-pointed");
    await row.hover();
    await expect(dot).toHaveAttribute("data-pointed", "true");
    await page.getByTestId("player-counter").hover();
    await expect(dot).not.toHaveAttribute("data-pointed");
    await first.focus();
    await expect(dot).toHaveAttribute("data-pointed", "true");
    await dot.focus();
    await expect(row).toHaveAttribute("data-pointed", "true");
    await page.keyboard.press("Enter");
    await expect(first).toHaveAttribute("aria-pressed", "true");
    await expect(page.getByTestId("lens-sentence")).toContainText("was refused");
  },
);

sharedTest("the view follows the step until the user moves it", async ({ page }) => {
  const app = await openRefusal(page);
  const follow = page.getByRole("checkbox", { name: "Follow" });
  await expect(follow).toBeChecked();
  const box = await page.getByTestId("viewport-canvas").boundingBox();
  if (!box) throw new Error("the view has no box");
  await page.mouse.move(box.x + box.width / 2, box.y + 60);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + 90, { steps: 4 });
  await page.mouse.up({ button: "right" });
  await expect(follow).not.toBeChecked();
  await button(page, "Step forward").click();
  await app.rest();
  await expect(follow).not.toBeChecked();
});

sharedTest(
  "at the end, the filled volume is cut and pulled apart, and the marks are gone",
  async ({ page }) => {
    const app = await openRefusal(page);
    await expect(slider(page, "Pull apart")).toHaveCount(0);
    await button(page, "Last state of the phase").click();
    await expect(page.getByTestId("lens-end")).toContainText("pull them apart");
    const legend = page.getByTestId("lens-legend");
    await expect(legend).toBeVisible();
    const canvas = page.getByTestId("viewport-canvas");
    const picture = async (): Promise<Buffer> => {
      await app.rest();
      return canvas.screenshot();
    };
    const whole = await picture();
    const apart = slider(page, "Pull apart");
    await apart.focus();
    await page.keyboard.press("PageUp");
    await page.keyboard.press("PageUp");
    await expect(legend).toHaveCount(0);
    await expect(apart).toHaveAttribute("aria-valuetext", /[1-9]\d* %/);
    const opened = await picture();
    expect(opened.equals(whole)).toBe(false);
    await slider(page, "Cut").fill("80");
    expect((await picture()).equals(opened)).toBe(false);
    await apart.fill("0");
    await expect(legend).toBeVisible();
  },
);

test("a link names the beat, in the app and in an embedded front", async ({ page, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const app = await openRefusal(page);
  await beatBar(page).fill("4");
  const step = await app.viewport.getAttribute("data-step");
  await button(page, "Share this step").click();
  await page.getByRole("menuitem", { name: "Copy link to this step" }).click();
  await expect(page.getByTestId("notice-shared")).toBeVisible();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(new URL(link).searchParams.get("beat")).toBe("4");
  const query = `test=1&model=unit-cube&step=${step}&beat=2`;
  await page.goto(`./embed.html?${query}`);
  await expect(beatBar(page)).toHaveAttribute("aria-valuetext", "2 of 5: ideal point");
  await beatBar(page).focus();
  await page.keyboard.press("ArrowRight");
  await expect(beatBar(page)).toHaveAttribute("aria-valuetext", "3 of 5: candidates");
});
