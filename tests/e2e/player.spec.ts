/** The player of the front: recording, playing, scrubbing, and the lens. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { readTrace } from "tetrafront/trace";
import { boxSurface } from "../support/surfaces";
import { starSurface, starTrace } from "../support/traces";
import { AppPage, sampleProject } from "./app-page";
import { button, choice, nextStop, playButton, recordButton, slider, stopBefore, tab } from "./controls";
import { sharedTest } from "./shared-page";

const star = Buffer.from(
  starTrace({
    ...starSurface(boxSurface(3, [0, 0, 0], [1, 1, 1])),
    postponeEvery: 7,
    reopenAfter: 20,
  }).bytes,
);

async function violations(page: Page): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
}

/** Hides the labels of the view. The policy of the page refuses a style element, also one for a screenshot. */
function hideLabels(page: Page): Promise<void> {
  return page.evaluate(() => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync("[data-testid=lens-labels] { visibility: hidden; }");
    document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
  });
}

/** Opens the tab of the front with a trace from a file. */
async function openTrace(page: Page, content: Buffer): Promise<AppPage> {
  const app = new AppPage(page);
  await app.openCube();
  await tab(page, "Front").click();
  await chooseTrace(page, content);
  return app;
}

/** Opens a trace from a file in the tab of the front. */
async function chooseTrace(page: Page, content: Buffer): Promise<void> {
  const chooser = page.waitForEvent("filechooser");
  await page.getByTestId("player-open").click();
  await (await chooser).setFiles({ name: "a.tft", mimeType: "application/octet-stream", buffer: content });
}

sharedTest("an incomplete mesh is not spoken of while a trace is shown in its place", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const cube = sampleProject("unit-cube");
  const fine = cube.background.nodes.map((node) => ({ ...node, size: 0.02 }));
  await app.openFile(
    "fine.json",
    JSON.stringify({ ...cube, background: { ...cube.background, nodes: fine } }),
  );
  await expect.poll(async () => Number(await app.viewport.getAttribute("data-front"))).toBeGreaterThan(1000);
  await page.getByTestId("cancel").click();
  const badge = page.getByTestId("mesh-badge");
  await expect(badge).toContainText(/Cancelled (at|before)/);
  await tab(page, "Front").click();
  await chooseTrace(page, star);
  await expect(app.viewport).toHaveAttribute("data-step", "0");
  await expect(badge).toHaveCount(0);
  await button(page, "Show the model").click();
  await expect(badge).toContainText(/Cancelled (at|before)/);
});

sharedTest("the front of the unit cube is recorded, played, and stepped through", async ({ page }) => {
  const app = new AppPage(page);
  const { fingerprint } = await app.openCube();
  await tab(page, "Front").click();
  await recordButton(page).click();
  const { viewport } = app;
  await expect(viewport).toHaveAttribute("data-step", "0");
  const steps = Number(await viewport.getAttribute("data-steps"));
  const faces = Number(await viewport.getAttribute("data-front-faces"));
  expect(steps).toBeGreaterThan(100);
  expect(faces).toBeGreaterThan(100);

  await button(page, "Step forward").click();
  await button(page, "Step forward").click();
  await expect(viewport).toHaveAttribute("data-step", "2");
  await button(page, "Step back").click();
  await expect(viewport).toHaveAttribute("data-step", "1");
  await expect(page.getByTestId("lens-sentence")).toContainText("element 0 over the base face");

  const scrub = slider(page, "Step of the front");
  await scrub.focus();
  await page.keyboard.press("PageUp");
  await expect(scrub).toHaveAttribute("aria-valuenow", "101");
  await page.keyboard.press("ArrowLeft");
  await expect(viewport).toHaveAttribute("data-step", "100");
  await page.keyboard.press("End");
  await expect(viewport).toHaveAttribute("data-step", String(steps));
  await expect(viewport).toHaveAttribute("data-front-faces", "0");
  await page.keyboard.press("Home");
  await expect(viewport).toHaveAttribute("data-front-faces", String(faces));

  await choice(page, "Jump to").selectOption("crosses");
  await nextStop(page).click();
  await expect(page.getByTestId("lens-sentence")).toContainText(/would cut/);
  await expect(page.getByTestId("lens-what-if")).toContainText("it would cross face");
  // Its front is shown, without what the step has made, until the accepted candidate is chosen.
  const change = page.getByTestId("lens-front-change");
  await expect(change).toContainText(/^The view shows the front with it: face.* left, .* joined\.$/);
  const canvas = page.getByTestId("viewport-canvas");
  await hideLabels(page);
  const supposed = await canvas.screenshot();
  await page.getByTestId("lens-candidate-1").click();
  await expect(change).toContainText(/^The front: face.* leave, .* joins? \(steps F6 and F8\)\.$/);
  await expect.poll(async () => (await canvas.screenshot()).equals(supposed)).toBe(false);
  await page.getByTestId("lens-candidate-0").click();
  await expect(page.getByTestId("lens-formula").locator("math").first()).toBeAttached();
  await expect(page.getByTestId("lens-layer")).toContainText(
    "Layer (c) finds the crossing: the side from node",
  );

  await choice(page, "Speed").selectOption("10000");
  await playButton(page).click();
  await expect(viewport).toHaveAttribute("data-step", String(steps));
  expect(await violations(page)).toEqual([]);

  const download = page.waitForEvent("download");
  await button(page, "Save trace").click();
  expect((await download).suggestedFilename()).toBe("unit-cube.tft");

  await button(page, "Show the model").click();
  await expect(viewport).not.toHaveAttribute("data-steps");
  // Recording leaves the mesh as it is.
  expect((await app.mesh()).fingerprint).toBe(fingerprint);
});

sharedTest(
  "lines and patches are played before the volume, with the plane beside space",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await tab(page, "Front").click();
    await recordButton(page).click();
    const { viewport } = app;
    await expect(viewport).toHaveAttribute("data-step", "0");
    const phase = page.getByTestId("player-phase");
    const sentence = page.getByTestId("lens-sentence");
    const plane = page.getByTestId("plane-view");
    await expect(phase).toHaveText("Volume");
    await expect(plane).toHaveCount(0);

    await button(page, "First state of the phase").click();
    await expect(phase).toHaveText("Patches");
    await expect(plane).toBeVisible();
    await expect(plane).toContainText("Plane of patch “left”");
    // The search region is the ellipse in the plane.
    await expect(page.getByTestId("player-region")).toBeDisabled();
    await expect(sentence).toContainText("Patch “left” begins");
    const edges = Number(await viewport.getAttribute("data-front-faces"));
    expect(edges).toBeGreaterThan(8);
    const width = (await page.getByTestId("viewport-canvas").boundingBox())?.width ?? 0;
    await button(page, "Step forward").click();
    await expect(sentence).toContainText("makes a triangle over the base edge");
    await expect(page.getByTestId("lens-formula").locator("math").first()).toBeAttached();
    // Fronts of patches have edges, not faces.
    await choice(page, "Jump to").selectOption({ label: "new node too close to an edge" });
    await nextStop(page).click();
    await expect(sentence).toContainText(/would be too close to edge \d+/);
    await expect(page.getByTestId("lens-front-change")).toContainText("the front before the step");
    // The view names the same edges in space.
    const failing = /edge \d+/.exec((await sentence.textContent()) ?? "")?.[0] ?? "no edge";
    await expect(page.getByTestId("lens-labels")).toContainText(failing);
    await expect(page.getByTestId("lens-labels")).toContainText(/base \d+/);
    await page.getByTestId("plane-zoom").getByText("Base edge").click();
    expect(await violations(page)).toEqual([]);

    await choice(page, "Jump to").selectOption("patch");
    await nextStop(page).click();
    await expect(sentence).toContainText("Patch “right” begins");
    await button(page, "First state of the phase").click();
    await expect(sentence).toContainText("Patch “left” begins");
    await button(page, "First state of the phase").click();
    await expect(phase).toHaveText("Lines");
    await expect(page.getByTestId("lens")).toContainText("the lines are not divided yet");
    await expect(plane).toHaveCount(0);
    const canvas = page.getByTestId("viewport-canvas");
    await expect.poll(async () => (await canvas.boundingBox())?.width ?? 0).toBeGreaterThan(1.8 * width);
    await choice(page, "Jump to").selectOption("line");
    await nextStop(page).click();
    await expect(sentence).toContainText(/Line 1 is .* target sizes long/);

    // One slider leads through all phases.
    const scrub = slider(page, "Step of the front");
    await scrub.focus();
    await page.keyboard.press("End");
    await page.keyboard.press("ArrowRight");
    await expect(phase).toHaveText("Patches");
    await page.keyboard.press("End");
    await page.keyboard.press("ArrowRight");
    await expect(viewport).toHaveAttribute("data-step", "0");
    expect(await violations(page)).toEqual([]);
  },
);

sharedTest("the keys play, step and jump, but not in fields and buttons", async ({ page }) => {
  const { viewport } = await openTrace(page, star);
  const read = readTrace(star);
  const steps = read.success ? read.value.stepCount : 0;
  await expect(viewport).toHaveAttribute("data-steps", String(steps));
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press(".");
  await page.keyboard.press(".");
  await page.keyboard.press(",");
  await expect(viewport).toHaveAttribute("data-step", "1");
  await page.keyboard.press("Shift+>");
  await expect(viewport).toHaveAttribute("data-step", "101");
  await page.keyboard.press("Shift+<");
  await expect(viewport).toHaveAttribute("data-step", "1");
  await page.keyboard.press("End");
  await expect(viewport).toHaveAttribute("data-step", String(steps));
  await page.keyboard.press("Home");
  await expect(viewport).toHaveAttribute("data-step", "0");
  await choice(page, "Speed").selectOption("10000");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Space");
  await expect(viewport).toHaveAttribute("data-step", String(steps));
  await button(page, "Step back").focus();
  await page.keyboard.press("Space");
  await expect(viewport).toHaveAttribute("data-step", String(steps - 1));
});

sharedTest(
  "the lens says why a candidate was refused, with the numbers of the crossing test",
  async ({ page }) => {
    await openTrace(page, star);
    const lens = page.getByTestId("lens");
    await expect(lens).toContainText("before the first step");
    await choice(page, "Jump to").selectOption("crosses");
    await nextStop(page).click();
    await expect(page.getByTestId("lens-sentence")).toContainText(/was refused: .*face/);
    const canvas = page.getByTestId("viewport-canvas");
    // Without the labels: the edges of their lines can differ by a shade when they are painted again.
    await hideLabels(page);
    const picture = (): Promise<Buffer> => canvas.screenshot();
    await expect(page.getByTestId("lens-legend")).toBeVisible();
    await new AppPage(page).stillView();
    const before = await picture();
    await page.getByTestId("player-region").check();
    await expect.poll(async () => (await picture()).equals(before)).toBe(false);
    await page.getByTestId("player-region").uncheck();
    await expect.poll(async () => (await picture()).equals(before)).toBe(true);
    // What fails is named in the view by the numbers of the sentence, and the rest is faded.
    const face = /face ([\d,]+)/.exec((await page.getByTestId("lens-sentence").textContent()) ?? "")?.[0];
    await expect(page.getByTestId("lens-labels")).toContainText(face ?? "no face");
    await expect(page.getByTestId("lens-legend")).toContainText("why refused");
    await page.getByRole("checkbox", { name: "Film of the step" }).uncheck();
    await expect.poll(async () => (await picture()).equals(before)).toBe(false);
    const faded = await picture();
    await page.getByRole("checkbox", { name: "Fade the rest" }).uncheck();
    await expect.poll(async () => (await picture()).equals(faded)).toBe(false);
    await page.getByRole("checkbox", { name: "Fade the rest" }).check();
    await page.getByRole("checkbox", { name: "Film of the step" }).check();
    await choice(page, "Jump to").selectOption("recovery");
    await nextStop(page).click();
    await expect(lens).toContainText("elements around a pocket are removed");
    await choice(page, "Jump to").selectOption("postponed");
    await stopBefore(page).click();
    await expect(lens).toContainText("comes again under rule class 1");
    expect(await violations(page)).toEqual([]);
  },
);

sharedTest("a damaged trace is refused with the byte and a remedy", async ({ page }) => {
  const app = await openTrace(page, star.subarray(0, star.length / 2));
  await expect(page.getByTestId("player-failure")).toContainText(/byte \d+: .*Record the trace again/);
  await expect(app.viewport).not.toHaveAttribute("data-steps");
});

/** Promises that reading a trace has shown progress. `stops`: presses *Stop* in the same moment. */
function readingShown(page: Page, stops: boolean): Promise<void> {
  return page.evaluate(
    (stops) =>
      new Promise<void>((resolve) => {
        const observer = new MutationObserver(() => {
          const bar = document.querySelector('[data-testid="player-reading"] [role="progressbar"]');
          if (!(Number(bar?.getAttribute("aria-valuenow")) > 0)) return;
          observer.disconnect();
          if (stops) document.querySelector<HTMLElement>('[data-testid="player-stop-reading"]')?.click();
          resolve();
        });
        observer.observe(document.body, { subtree: true, childList: true, attributes: true });
      }),
    stops,
  );
}

sharedTest(
  "a large trace is read with progress, and reading it can be cancelled: what was shown stays",
  async ({ page }) => {
    const large = Buffer.from(starTrace(starSurface(boxSurface(72, [0, 0, 0], [1, 1, 1]))).bytes);
    const { viewport } = await openTrace(page, star);
    await expect(viewport).toHaveAttribute("data-steps", /[1-9]/);
    const steps = (await viewport.getAttribute("data-steps")) ?? "";
    await button(page, "Step forward").click();

    const reading = page.getByTestId("player-reading");
    const stopped = readingShown(page, true);
    await chooseTrace(page, large);
    await stopped;
    await expect(reading).toHaveCount(0);
    await expect(viewport).toHaveAttribute("data-steps", steps);
    await expect(viewport).toHaveAttribute("data-step", "1");

    const shown = readingShown(page, false);
    await chooseTrace(page, large);
    await shown;
    await expect(reading).toHaveCount(0);
    await expect(viewport).not.toHaveAttribute("data-steps", steps);
    await expect(viewport).toHaveAttribute("data-step", "0");
  },
);

test("with reduced motion, playing shows one picture per second, with a note", async ({ page }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  const { viewport } = await openTrace(page, star);
  await expect(viewport).toHaveAttribute("data-steps", /[1-9]/);
  await expect(page.getByTestId("player-stills")).toBeEmpty();
  const shown = page.evaluate(
    () =>
      new Promise<readonly { readonly step: number; readonly at: number }[]>((resolve) => {
        const view = document.querySelector<HTMLElement>('[data-testid="viewport"]');
        const seen: { step: number; at: number }[] = [];
        new MutationObserver((_, observer) => {
          seen.push({ step: Number(view?.dataset["step"]), at: performance.now() });
          if (seen.length < 3) return;
          observer.disconnect();
          resolve(seen);
        }).observe(view ?? document.body, { attributeFilter: ["data-step"] });
      }),
  );
  await playButton(page).click();
  await expect(page.getByTestId("player-stills")).toHaveText("Reduced motion: one picture per second");
  const pictures = await shown;
  pictures.forEach(({ step, at }, i) => {
    const before = pictures[i - 1];
    if (!before) return;
    expect(step - before.step).toBeGreaterThanOrEqual(20);
    expect(at - before.at).toBeGreaterThan(900);
  });
  await button(page, "Step forward").click();
  await expect(page.getByTestId("player-stills")).toBeEmpty();
});

sharedTest(
  "the steps that are repeated are typed, and a number that does not fit is refused",
  async ({ page }) => {
    const { viewport } = await openTrace(page, star);
    await expect(viewport).toHaveAttribute("data-steps", /[1-9]/);
    const steps = Number(await viewport.getAttribute("data-steps"));
    const from = page.getByTestId("player-loop-from");
    const to = page.getByTestId("player-loop-to");
    await expect(from).toHaveCount(0);
    await page.getByTestId("player-loop").click();
    await expect(from).toHaveValue("0");
    await expect(to).toHaveValue(String(Math.min(50, steps)));
    await from.fill("2");
    await from.press("Enter");
    await to.fill(String(steps + 1));
    await to.press("Enter");
    await expect(to).toHaveAttribute("aria-invalid", "true");
    await to.fill("3");
    await to.press("Enter");
    await to.press("ArrowUp");
    await expect(to).toHaveValue("4");
    await expect(page.getByTestId("player-loop")).toHaveAccessibleName("Repeat steps 2 to 4");
    expect(await violations(page)).toEqual([]);
    await page.getByTestId("player-loop").click();
    await expect(from).toHaveCount(0);
  },
);

sharedTest("a condition is typed, corrected, jumped to and paused at, by keyboard", async ({ page }) => {
  const { viewport } = await openTrace(page, star);
  await choice(page, "Jump to").selectOption("condition");
  const field = page.getByTestId("player-condition");
  const hint = page.getByTestId("player-condition-hint");
  await field.fill("refused: ugly");
  await expect(hint).toHaveRole("alert");
  await expect(hint).toContainText("At character 10");
  await expect(field).toHaveAttribute("aria-invalid", "true");
  await expect(nextStop(page)).toBeDisabled();
  expect(await violations(page)).toEqual([]);

  await field.fill("refused: crosses and postponed");
  await field.press("Enter");
  await expect(page.getByTestId("lens-sentence")).toContainText(/would (cut|cross)/);
  const first = Number(await viewport.getAttribute("data-step"));
  expect(first).toBeGreaterThan(0);
  await field.press("Enter");
  await expect.poll(async () => Number(await viewport.getAttribute("data-step"))).toBeGreaterThan(first);
  await field.press("Shift+Enter");
  await expect(viewport).toHaveAttribute("data-step", String(first));

  await field.fill("recovery");
  const pauses = page.getByTestId("player-stop-at");
  await pauses.check();
  await field.fill("recover");
  await expect(hint).toHaveRole("alert");
  await expect(pauses).toBeChecked();
  await field.fill("recovery");
  await choice(page, "Speed").selectOption("500");
  await playButton(page).click();
  await expect(playButton(page)).toHaveAccessibleName("Play");
  await expect(page.getByTestId("lens")).toContainText("pocket");
  await field.fill("front < 0");
  await field.press("Enter");
  await expect(page.getByTestId("player-no-step")).toHaveText("No further step");
});

sharedTest(
  "after the last step come the sweeps of the optimizer, whose poor elements the view shows",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await tab(page, "Front").click();
    await recordButton(page).click();
    await expect(app.viewport).toHaveAttribute("data-step", "0");
    const sweeps = page.getByTestId("sweeps");
    await expect(sweeps).toHaveCount(0);
    await button(page, "Last state of the phase").click();
    const count = Number(await sweeps.getAttribute("data-sweeps"));
    expect(count).toBeGreaterThan(10);
    await expect(sweeps.getByRole("row")).toHaveCount(count + 2);
    const poorAfter = async (sweep: number): Promise<number> => {
      await page.getByTestId(`sweep-${sweep}`).click();
      await expect(sweeps).toHaveAttribute("data-sweep", String(sweep));
      const text = (await page.getByTestId("sweeps-hint").textContent()) ?? "";
      return text.startsWith("No element") ? 0 : Number(text.replace(/ .*/, "").replaceAll(",", ""));
    };
    expect(await poorAfter(0)).toBeGreaterThan(20);
    expect(await poorAfter(count)).toBe(0);
    expect(await violations(page)).toEqual([]);
    // The same row again, or another step, shows the front.
    await page.getByTestId(`sweep-${count}`).click();
    await expect(sweeps).toHaveAttribute("data-sweep", "");
    await button(page, "Step back").click();
    await expect(sweeps).toHaveCount(0);
    await expect(page.getByTestId("lens-sentence")).toBeVisible();
  },
);
