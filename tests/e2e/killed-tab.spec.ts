import { expect, test, type BrowserContext, type Page } from "@playwright/test";
import { randomSource } from "../support/random";

/** Moments at which the tab is killed. */
const moments = 6;
/** Longest time between the first edit and the end of the tab, in milliseconds. */
const longest = 900;

/** Opens the document that was used last, in a tab of its own. */
async function openLast(context: BrowserContext): Promise<Page> {
  const page = await context.newPage();
  await page.goto("./?test=1");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-frames", /./);
  return page;
}

const pointsOf = async (page: Page): Promise<number> =>
  Number(await page.getByTestId("viewport").getAttribute("data-points"));

/** Ends the process of a tab: the page gets no event, and no warning is shown. */
async function kill(page: Page): Promise<void> {
  const crashed = page.waitForEvent("crash");
  const session = await page.context().newCDPSession(page);
  session.send("Page.crash").catch(() => undefined);
  await crashed;
  await page.close();
}

/** Adds points at (n, 0, 0), as fast as the keys can be pressed, and reports how many were typed and stored. */
async function addPoints(
  page: Page,
  count: { typed: number; stored: number },
  isOver: () => boolean,
): Promise<void> {
  while (!isOver()) {
    await page.keyboard.type(`${count.typed + 1},0,0`);
    await page.keyboard.press("Enter");
    count.typed += 1;
    const saved = await page.getByTestId("viewport").getAttribute("data-autosaved");
    // The attribute may be older than the point; what it calls stored is at least the points before it.
    if (saved === "true") count.stored = Math.max(count.stored, (await pointsOf(page)) - 1);
  }
}

test(`a tab that is killed at ${moments} random moments loses nothing that was stored`, async ({
  context,
}) => {
  test.setTimeout(600_000);
  const random = randomSource(20);
  let page = await context.newPage();
  await page.goto("./?test=1&new=1");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-points", "0");
  let before = 0;
  for (let moment = 0; moment < moments; ++moment) {
    await page.getByTestId("tool-point").click();
    const count = { typed: before, stored: before };
    const end = Date.now() + (longest * random()) / 2 ** 32;
    await addPoints(page, count, () => Date.now() >= end);
    await kill(page);
    page = await openLast(context);
    await expect
      .poll(() => pointsOf(page), { message: `moment ${moment}` })
      .toBeGreaterThanOrEqual(count.stored);
    const found = await pointsOf(page);
    expect(found).toBeLessThanOrEqual(count.typed);
    // Nothing is stored in part, and the document can be edited on.
    await page.getByLabel("Filter (name, type, id)").fill(`point ${found}`);
    if (found > 0) await expect(page.getByTestId(`tree-point-${found}`)).toBeVisible();
    await page.getByLabel("Filter (name, type, id)").fill("");
    before = found;
  }
  // How many were stored depends on how fast the machine is; without one the test would show nothing.
  expect(before).toBeGreaterThan(0);
});
