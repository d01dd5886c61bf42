/** The lessons as articles: every task by real drags, fingers and keys, in three settings. */
import { expect, test } from "@playwright/test";
import { ArticlePage, type Pixel } from "./article-page";
import { isSound, part, settings } from "./article-settings";
import { recordRefusals } from "./policy";

/** Compressed bytes of what a page fetches before the reader does anything. */
const firstViewLimit = 300_000;

for (const [name, { viewport, colorScheme, reducedMotion, hasTouch }] of Object.entries(settings)) {
  test.describe(name, () => {
    test.use({ viewport, colorScheme, hasTouch, contextOptions: { reducedMotion } });

    test("lesson 1: its three tasks, and an impossible shape that springs back", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(1);
      await lesson.see("A");
      await lesson.isUndone();
      const history = lesson.figure("A").getByRole("slider", { name: "Step" });

      // The first refusal, by the history and the beat "test".
      const ticks = await firstRefusal(lesson);
      await history.focus();
      await page.keyboard.press("Home");
      for (let i = 0; i < ticks; i++) await page.keyboard.press("ArrowRight");
      await lesson.figure("A").getByRole("button", { name: "test" }).click();
      await lesson.done(1);

      // A corner that is pulled across the shape makes the boundary cross itself.
      await lesson.see("A");
      const before = await lesson.values("A");
      const [from, across] = [
        await lesson.middle(lesson.handle("A", "corner-1")),
        await lesson.middle(lesson.handle("A", "corner-5")),
      ];
      await lesson.drag(from, part(from, across, 1.06), async () => {
        await expect(lesson.figure("A").locator(".notice")).toContainText("crosses itself");
      });
      const offset = async (): Promise<number> => {
        const [x, y] = await lesson.middle(lesson.handle("A", "corner-1"));
        return Math.hypot(x - from[0], y - from[1]);
      };
      await expect.poll(offset).toBeLessThan(1);
      await expect(lesson.figure("A").locator(".notice")).toBeEmpty();
      expect(await lesson.value("A", "triangles")).toBe(before["triangles"]);

      const number = page.getByTestId("number-size");
      await number.focus();
      await page.keyboard.press("Home");
      expect(await lesson.value("A", "size")).toBe(0.06);
      await lesson.done(3);
      for (let i = 0; i < 25 && (await lesson.value("A", "refused")) > 2; i++)
        await page.keyboard.press("ArrowRight");
      await lesson.done(2);
      await isSound(lesson);
    });

    test("lesson 1: the walk leads the figure, and drags change it", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(1);
      await lesson.see("A");
      // It opens with a front: something is filled, and something is empty.
      const { filled = 0, triangles: all = 0 } = await lesson.values("A");
      expect(Number(filled) / Number(all)).toBeGreaterThan(0.3);
      expect(Number(filled) / Number(all)).toBeLessThan(0.7);
      const stops = page.locator(".stop");
      const read = async (index: number): Promise<void> => {
        const line = viewport.width <= 1000 ? 0.68 : 0.46;
        await stops.nth(index).evaluate((stop, share) => {
          const { top, height } = stop.getBoundingClientRect();
          window.scrollBy(0, top + Math.min(height, 240) / 2 - window.innerHeight * share);
        }, line);
      };
      await read((await stops.count()) - 1);
      await expect.poll(() => lesson.value("A", "finished")).toBe(1);
      await read(6);
      await expect.poll(() => lesson.value("A", "atrefusal")).toBe(1);
      const triangles = await lesson.value("A", "triangles");
      const from = await lesson.middle(lesson.handle("A", "corner-4"));
      await lesson.drag(from, [from[0] - 40, from[1] - 10]);
      expect(await lesson.value("A", "triangles")).not.toBe(triangles);
      expect(await lesson.value("A", "touched")).toBe(1);
      // A change of the shape is a state that the reader has made, but no place in the history.
      expect(await lesson.value("A", "handled")).toBe(1);
      expect(await lesson.value("A", "scrubbed")).toBe(0);
      await lesson.isUndone();
      const corners = await lesson.value("A", "corners");
      const middle = await lesson.middle(lesson.handle("A", "middle-2"));
      await lesson.drag(middle, [middle[0], middle[1] - 14]);
      expect(await lesson.value("A", "corners")).toBe(corners + 1);
      expect(lesson.errors).toEqual([]);
    });

    test("lesson 4: its three tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(4);
      await lesson.see("A");
      await lesson.isUndone();
      const number = page.getByTestId("number-size");

      // By a drag first, then by keys.
      await number.scrollIntoViewIfNeeded();
      const at = await lesson.middle(number);
      await lesson.drag(at, [at[0] - 24, at[1]]);
      expect(await lesson.value("A", "size")).toBeLessThan(1.35);
      await number.focus();
      for (let i = 0; i < 60 && (await lesson.value("A", "size")) > 1.04; i++)
        await page.keyboard.press("ArrowLeft");
      await lesson.done(1);

      await lesson.see("A");
      const height = await lesson.value("A", "height");
      const point = await lesson.middle(lesson.handle("A", "ideal-point"));
      await lesson.drag(point, [point[0], point[1] - 50]);
      expect(await lesson.value("A", "height")).toBeGreaterThan(height);

      await lesson.figure("A").getByRole("button", { name: "Over the centre" }).click();
      const [first, second, third] = await Promise.all(
        [1, 2, 3].map((i) => lesson.middle(lesson.handle("A", `corner-${i}`))),
      );
      if (!first || !second || !third) throw new Error("A corner is missing");
      await lesson.dragHandle("A", "corner-1", part(first, part(second, third, 0.5), 0.75));
      await lesson.done(2);

      await number.focus();
      await page.keyboard.press("Home");
      await lesson.done(3);
      await isSound(lesson);
    });

    test("lesson 6: its four tasks", async ({ page }) => {
      const lesson = new ArticlePage(page, hasTouch);
      await lesson.open(6);
      await lesson.see("A");
      await lesson.isUndone();

      // In units of the drawing, the active side goes from (0.32, 0.2) to (0.86, 0.2).
      const [a, b] = [
        await lesson.middle(lesson.handle("A", "a")),
        await lesson.middle(lesson.handle("A", "b")),
      ];
      const scale = (b[0] - a[0]) / 0.54;
      const to = (x: number, y: number): Pixel => [a[0] + (x - 0.32) * scale, a[1] - (y - 0.2) * scale];
      await lesson.dragHandle("A", "q", to(0.72, 0.74));
      await lesson.dragHandle("A", "r", to(0.98, 0.3));
      await lesson.done(1);
      await lesson.dragHandle("A", "q", to(0.42, 0.69));
      await lesson.dragHandle("A", "r", to(0.86, 0.664));
      await lesson.done(2);
      await lesson.dragHandle("A", "r", to(0.66, 0.34));
      await lesson.dragHandle("A", "q", to(0.52, 0.3));
      await lesson.done(3);

      const tolerance = page.getByTestId("number-t");
      await tolerance.focus();
      await page.keyboard.press("End");
      expect(await lesson.value("A", "t")).toBe(0.3);

      await lesson.see("B");
      expect(await lesson.value("B", "hits")).toBeGreaterThan(0);
      await moveBeyondLongSide(lesson);
      await lesson.done(4);
      await isSound(lesson);
    });
  });
}

/** Returns the step of the first red tick, found by the keys of the history. */
async function firstRefusal(lesson: ArticlePage): Promise<number> {
  const history = lesson.figure("A").getByRole("slider", { name: "Step" });
  await history.focus();
  await lesson.page.keyboard.press("Home");
  for (let step = 0; step < 400; step++) {
    await lesson.page.keyboard.press("ArrowRight");
    if ((await lesson.value("A", "refusedsofar")) > 0) return step;
  }
  throw new Error("Nothing is refused");
}

/** Moves the new face of lesson 6 until only α⁴ says no: each corner by a drag to the right. */
async function moveBeyondLongSide(lesson: ArticlePage): Promise<void> {
  const [left, right] = [
    await lesson.middle(lesson.handle("B", "front-1")),
    await lesson.middle(lesson.handle("B", "front-2")),
  ];
  const by = ((right[0] - left[0]) * 0.5) / 8;
  for (let i = 0; i < 8 && (await lesson.value("B", "onlyfourth")) !== 1; i++)
    for (const corner of ["added-1", "added-2", "added-3"]) {
      const [x, y] = await lesson.middle(lesson.handle("B", corner));
      await lesson.dragHandle("B", corner, [x + by, y]);
    }
}

test.describe("with reduced motion", () => {
  const { viewport, colorScheme, reducedMotion } = settings["reduced motion"];
  test.use({ viewport, colorScheme, contextOptions: { reducedMotion } });

  for (const page of [0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, "mesher"])
    test(`${page === "mesher" ? page : `lesson ${page}`} shows its first figure, and is sound`, async ({
      page: tab,
    }) => {
      const lesson = new ArticlePage(tab, false);
      await lesson.open(page);
      await lesson.see("A");
      await isSound(lesson);
    });
});

test("each first view is under 300 kB, without requests to other hosts", async ({ page, baseURL }) => {
  for (const number of [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]) {
    const session = await page.context().newCDPSession(page);
    await session.send("Network.enable");
    await session.send("Network.setCacheDisabled", { cacheDisabled: true });
    await session.send("Network.setBypassServiceWorker", { bypass: true });
    let bytes = 0;
    session.on("Network.loadingFinished", ({ encodedDataLength }) => (bytes += encodedDataLength));
    const addresses: string[] = [];
    page.on("request", (request) => addresses.push(request.url()));
    await page.goto(`./lessons/${number}/`, { waitUntil: "networkidle" });
    expect(bytes).toBeGreaterThan(50_000);
    expect(bytes, `lesson ${number}`).toBeLessThan(firstViewLimit);
    expect(addresses.filter((address) => !address.startsWith(baseURL ?? ""))).toEqual([]);
    await session.detach();
  }
});

test("the list leads to every lesson, the app and older links to the pages, and the policy refuses nothing", async ({
  page,
}) => {
  const refused = await recordRefusals(page);
  await page.goto("./lessons/");
  await page.getByRole("link", { name: /The ideal point/ }).click();
  await expect(page.getByTestId("figure-A")).toHaveAttribute("data-ready", "true");
  const policy = page.locator('meta[http-equiv="Content-Security-Policy"]');
  await expect(policy).toHaveAttribute(
    "content",
    /^default-src 'none'; script-src 'self' 'wasm-unsafe-eval'/,
  );
  await page.getByRole("link", { name: /Next/ }).click();
  await expect(page.getByTestId("figure-A")).toHaveAttribute("data-ready", "true");
  expect(await refused()).toEqual([]);
  for (const [link, leadsTo] of [
    ["?lesson=4", "lessons/4/"],
    ["?lesson=10&step=12", "lessons/10/"],
    ["?lesson=7&runs=first-in,strict%2Blinear", "lessons/7/"],
    ["?lesson=7.5", "lessons/"],
  ] as const) {
    await page.goto(`./${link}`);
    await expect(page).toHaveURL((url) => url.pathname.endsWith(`/${leadsTo}`) && url.search === "");
    await expect(page.getByRole("heading").first()).toBeVisible();
  }
  await page.goto("./?test=1&new=1");
  await page.getByRole("menuitem", { name: "Help" }).click();
  const opening = page.waitForEvent("popup");
  await page.getByRole("menuitem", { name: "Lessons" }).click();
  await expect(await opening).toHaveURL(/\/lessons\/$/);
});

test("a word lights its part by the mouse and by keys, and a link leads to a state", async ({ page }) => {
  const lesson = new ArticlePage(page, false);
  await lesson.open(4);
  await lesson.see("A");
  const word = page.getByRole("button", { name: "the height" });
  await word.hover();
  await expect(word).toHaveAttribute("aria-pressed", "true");
  await page.getByRole("button", { name: "This blunt face" }).focus();
  await page.keyboard.press("Enter");
  await expect.poll(() => lesson.value("A", "inside")).toBe(0);
  expect(await lesson.value("A", "centred")).toBe(1);
  const radius = page.locator('.formula [data-show="A.used"]').first();
  // The figure moves to the state.
  await expect
    .poll(async () => (await lesson.value("A", "used")).toFixed(3) === (await radius.textContent()))
    .toBe(true);
});
