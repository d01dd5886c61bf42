/** Links that hold a project, and pictures of the view in any size. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { linkTo, type LinkedProject } from "../../web/commands/project-link";
import { AppPage, countColours, forEachPixel, nextFrame, sampleProject } from "./app-page";
import { downloaded } from "./downloads";
import { button } from "./controls";
import { sharedTest } from "./shared-page";

const forTest = (link: string): string => link.replace("/#", "/?test=1#");

/** Returns a link to a project, relative to the site. */
async function testLink({ project, ...seen }: Partial<LinkedProject> & Pick<LinkedProject, "project">) {
  const link = await linkTo("http://site/", { project, camera: null, cut: null, front: null, ...seen });
  return forTest(link.replace("http://site", "."));
}

/** Opens the link to the present view and returns it. */
async function linkOf(page: Page): Promise<string> {
  await page.getByTestId("share-link").click();
  const field = page.getByTestId("share-link-text");
  await expect(field).toHaveValue(/#project=/);
  const link = await field.inputValue();
  await page.keyboard.press("Escape");
  await expect(field).toBeHidden();
  return link;
}

/** The project that the app would save, without the texts of its file format. */
async function savedProject(page: Page): Promise<unknown> {
  const bytes = await downloaded(page, async () => {
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+Shift+S");
  });
  return JSON.parse(new TextDecoder().decode(bytes));
}

/** Where four positions appear: the same camera shows them at the same places. */
const seen = (page: Page): Promise<readonly unknown[]> =>
  page.evaluate(() => {
    const { tetrafrontPosition } = window as unknown as {
      tetrafrontPosition: (position: readonly number[]) => { x: number; y: number } | null;
    };
    return [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ].map((position) => {
      const at = tetrafrontPosition(position);
      return at && { x: Math.round(at.x * 100) / 100, y: Math.round(at.y * 100) / 100 };
    });
  });

// Smooth lines and holes, stretched elements, sources, and two regions. Links to all models are unit tests.
const linked = ["engine-intake", "wing-in-a-tunnel", "bracket", "pipe-and-flow"];

for (const id of linked) {
  test(`a link leads to the same model and camera: ${id}`, async ({ page }) => {
    await page.addInitScript(() => {
      Reflect.deleteProperty(window, "showOpenFilePicker");
      Reflect.deleteProperty(window, "showSaveFilePicker");
    });
    const project = sampleProject(id);
    await page.goto(await testLink({ project }));
    await expect(page.getByTestId("project-name")).toHaveValue(project.name);
    await expect(page.getByTestId("viewport")).toHaveAttribute("data-frames", /./);
    await page.getByTestId("viewport-canvas").focus();
    for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "+"]) await page.keyboard.press(key);
    await nextFrame(page.getByTestId("viewport"), () => page.keyboard.press("Shift+ArrowRight"));
    const link = await linkOf(page);
    const before = await seen(page);
    expect(link.length).toBeLessThan(8000);
    await page.goto("about:blank");
    await page.goto(forTest(link));
    await expect(page.getByTestId("project-name")).toHaveValue(project.name);
    await expect.poll(() => seen(page)).toEqual(before);
    expect(await savedProject(page)).toEqual(JSON.parse(JSON.stringify(project)));
  });
}

test("a link holds the cut and the step of the front, also of a changed model", async ({ page }) => {
  const project = { ...sampleProject("unit-cube"), name: "My cube" };
  const cut = { enabled: true, axis: "y", position: 0.4, flipped: true } as const;
  const shown = { coloring: "layer", faces: "all", elements: "all" } as const;
  const front = { step: 258, order: "layered", candidate: 0, ...shown } as const;
  await page.goto(await testLink({ project, cut, front }));
  const viewport = page.getByTestId("viewport");
  await expect(viewport).toHaveAttribute("data-step", "258");
  await expect(page.getByTestId("lens-sentence")).toContainText("Node 286 was refused");
  // No run was begun and cancelled for it.
  await expect(page.getByTestId("status")).toContainText("Front after step 258 of");
  await expect(page.getByTestId("status")).not.toContainText(/cancelled|\b0 tetrahedra/);
  await button(page, "Step forward").click();
  const link = await linkOf(page);
  await page.goto("about:blank");
  await page.goto(forTest(link));
  await expect(viewport).toHaveAttribute("data-step", "259");
  await expect(page.getByTestId("player-coloring")).toHaveValue("layer");
  await expect(page.getByTestId("player-elements")).toHaveValue("all");
  await expect(page.getByTestId("player-faces")).toHaveValue("all");
  await expect(page.getByTestId("cut-button")).toHaveAttribute("aria-pressed", "true");
});

test("a link opens a project beside one's own, and a damaged one says so and leaves it open", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  const name = page.getByTestId("project-name");
  await name.fill("Mine");
  await name.press("Enter");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  const link = await testLink({ project: { ...sampleProject("unit-cube"), name: "Theirs" } });
  const enter = (hash: string) => page.evaluate((value) => void (window.location.hash = value), hash);

  // In the open page, as when a link is pasted into the address.
  const hash = link.slice(link.indexOf("#"));
  for (const damaged of [
    hash.slice(0, hash.length / 2),
    "#project=",
    "#project=%C3%A4",
    `${hash}AAAA`.replace("=", "=B"),
  ]) {
    await enter(damaged);
    await expect(page.getByRole("dialog", { name: "The link cannot be opened" })).toContainText(
      "missing or changed",
    );
    await page.keyboard.press("Escape");
    await expect(name).toHaveValue("Mine");
  }
  await enter(hash);
  await expect(name).toHaveValue("Theirs");
  await expect(page.getByTestId("notice-document-left")).toContainText("“Mine” is available");

  // In a new page; a reload then continues with the project as it was edited.
  await name.fill("Changed");
  await name.press("Enter");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  await page.goto("about:blank");
  await page.goto(link);
  await expect(name).toHaveValue("Theirs");
  await page.reload();
  await expect(name).toHaveValue("Theirs");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+Shift+O");
  const rows = page.getByRole("dialog", { name: "Open recent" }).getByRole("listitem");
  await expect(rows).toHaveText([/^Changed/, /^Mine/]);
});

sharedTest("the length of a link is told; a file is offered if it is too long", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("share-link").click();
  const link = await page.getByTestId("share-link-text").inputValue();
  await expect(page.getByTestId("share-link-length")).toContainText(
    `${link.length.toLocaleString("en-US")} characters`,
  );
  const axe = await new AxeBuilder({ page }).setLegacyMode(true).analyze();
  expect(axe.violations.flatMap(({ nodes }) => nodes.map(({ html }) => html))).toEqual([]);
  await page.keyboard.press("Escape");
  // Text without repetition cannot be compressed.
  const noise = Array.from({ length: 5000 }, (_, i) => Math.sin(i).toString(36)).join("");
  await app.openFile("long.json", JSON.stringify({ ...sampleProject("unit-cube"), description: noise }));
  await expect(page.getByTestId("notice-document-left")).toBeHidden();
  await page.getByTestId("share-link").click();
  await expect(page.getByTestId("share-link-too-long")).toContainText("more than 32,000");
  await expect(page.getByTestId("share-link-text")).toHaveCount(0);
  const file = await downloaded(page, () => page.getByRole("button", { name: "Save project file" }).click());
  expect(JSON.parse(new TextDecoder().decode(file))).toMatchObject({ description: noise });
});

sharedTest(
  "a picture of the view has the size asked for, with or without background, and is the same again",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const picture = async (
      size: readonly [number, number],
      uncheck: readonly string[] = [],
      check: readonly string[] = [],
    ) =>
      Buffer.from(
        await downloaded(page, async () => {
          await page.getByTestId("export-image").click();
          await page.getByTestId("image-width").fill(String(size[0]));
          await page.getByTestId("image-height").fill(String(size[1]));
          for (const option of uncheck) await page.getByTestId(`image-${option}`).uncheck();
          for (const option of check) await page.getByTestId(`image-${option}`).check();
          await page.getByTestId("image-save").click();
        }),
      );
    const sizeOf = (png: Buffer) => [png.readUInt32BE(16), png.readUInt32BE(20)];
    const square = await picture([700, 700]);
    expect(sizeOf(square)).toEqual([700, 700]);
    expect(countColours(square)).toBeGreaterThan(60);
    expect((await picture([700, 700])).equals(square)).toBe(true);

    // In whichever tiles, the model is where it is.
    const extent = (png: Buffer): readonly number[] => {
      const [width = 1, height = 1] = sizeOf(png);
      const [xs, ys]: [number[], number[]] = [[], []];
      let at = 0;
      forEachPixel(png, (_r, g, b) => {
        if (g > b + 40) {
          xs.push((at % width) / height);
          ys.push(Math.floor(at / width) / height);
        }
        at += 1;
      });
      const low = (values: readonly number[]) => values.reduce((a, b) => Math.min(a, b), Infinity);
      const high = (values: readonly number[]) => values.reduce((a, b) => Math.max(a, b), -Infinity);
      return [high(xs) - low(xs), low(ys), high(ys)];
    };
    const plain = { uncheck: ["legend", "axes"], check: ["transparent"] } as const;
    const small = extent(await picture([1050, 300], plain.uncheck, plain.check));
    // Wider than a buffer of the graphics processor: it is drawn in tiles.
    const wide = await picture([4200, 1200], plain.uncheck, plain.check);
    expect(sizeOf(wide)).toEqual([4200, 1200]);
    const large = extent(wide);
    for (const [i, value] of small.entries()) expect(large[i]).toBeCloseTo(value, 1.7);

    // What is asked for and impossible is refused.
    await page.getByTestId("export-image").click();
    await page.getByTestId("image-width").fill("20000");
    await page.getByTestId("image-save").click();
    await expect(page.getByText("1 to 16,384 whole pixels a side")).toBeVisible();
  },
);

test("a link that was entered and cannot be followed says so", async ({ page }) => {
  await new AppPage(page).openCube();
  await page.route(/\/assets\/share-actions-[^/]*\.js$/, (route) => route.abort());
  await page.evaluate(() => void (window.location.hash = "#project=x"));
  const message = page.getByRole("dialog", { name: "What the address asks for could not be shown" });
  await expect(message).toContainText("share-actions");
});
