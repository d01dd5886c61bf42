/** Links to a step of a front, and the page that shows one in other pages. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { countColours } from "./app-page";
import { button, slider } from "./controls";

async function violations(page: Page): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
}

test("an embedded front shows its step without panels, and is played with buttons and keys", async ({
  page,
}) => {
  await page.goto("./embed.html?test=1&model=unit-cube&step=100");
  const viewport = page.getByTestId("viewport");
  await expect(viewport).toHaveAttribute("data-step", "100");
  await expect(viewport).toHaveAttribute("data-steps", "1743");
  await expect(page).toHaveTitle(/Unit cube/);
  await expect(page.getByRole("tab")).toHaveCount(0);
  await expect(page.getByRole("menubar")).toHaveCount(0);
  await button(page, "Step forward").click();
  await expect(viewport).toHaveAttribute("data-step", "101");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press(",");
  await page.keyboard.press(",");
  await expect(viewport).toHaveAttribute("data-step", "99");
  // Keys that change a model do nothing here.
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await expect(viewport).toHaveAttribute("data-points", "8");
  expect(await violations(page)).toEqual([]);
  await expect(page.getByRole("link", { name: "Open in Tetrafront" })).toHaveAttribute(
    "href",
    /model=unit-cube&step=100/,
  );
});

test("an embedded front says that it is shown as it would be with a refused candidate", async ({ page }) => {
  await page.goto("./embed.html?test=1&model=unit-cube&step=258&candidate=0");
  const supposed = page.getByTestId("supposed-front");
  await expect(supposed).toContainText(/^Node 286 was refused: .* The view shows the front with it: face/);
  expect(await violations(page)).toEqual([]);
  await button(page, "Step forward").click();
  await expect(supposed).toBeHidden();
});

test("on a phone, no legend of an embedded front covers a label", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto("./embed.html?test=1&model=unit-cube&step=258&camera=1.15,-1.85,2.02,0.15,0.15,1.22");
  const boxes = (selector: string) =>
    page.locator(selector).evaluateAll((elements) =>
      elements.map((element) => {
        const { left, top, right, bottom } = element.getBoundingClientRect();
        return { left, top, right, bottom };
      }),
    );
  const labelBoxes = () => boxes('[data-testid="lens-labels"] span:not([style*="hidden"])');
  await expect(page.getByTestId("lens-legend")).toBeVisible();
  await expect.poll(async () => (await labelBoxes()).length).toBe(5);
  const covered = async () => {
    const legends = await boxes('[data-testid="lens-legend"], [data-testid="front-legend"]');
    return (await labelBoxes()).filter((label) =>
      legends.some(
        (legend) =>
          legend.left < label.right &&
          label.left < legend.right &&
          legend.top < label.bottom &&
          label.top < legend.bottom,
      ),
    );
  };
  await expect.poll(covered, { timeout: 10_000 }).toEqual([]);
});

test("an embedded front fits into a narrow frame, and is loaded when it is seen", async ({ page }) => {
  await page.goto("./embed.html?model=none");
  await expect(page.getByTestId("embed-failure")).toContainText("names no model");
  // A page of a course, on another host, with a frame far below.
  const site = new URL("./", page.url()).href;
  const host = createServer((_, response) => {
    response.writeHead(200, { "Content-Type": "text/html" });
    response.end(`<html lang="en"><body style="margin: 0"><p style="height: 3000px">Text</p>
      <iframe title="front" width="320" height="300" src="${site}embed.html?test=1&model=unit-cube&step=5"></iframe></body></html>`);
  });
  await new Promise<void>((resolve) => host.listen(0, "127.0.0.1", resolve));
  await page.goto(`http://localhost:${(host.address() as AddressInfo).port}/`);
  host.close();
  const frame = page.frameLocator("iframe");
  await expect(frame.locator("#root")).toBeAttached();
  await expect(frame.getByTestId("embed")).toHaveCount(0);
  await page.locator("iframe").scrollIntoViewIfNeeded();
  await expect(frame.getByTestId("viewport")).toHaveAttribute("data-step", "5");
  const overflow = await frame
    .getByTestId("embed")
    .evaluate((embed) => [embed.scrollWidth - embed.clientWidth, embed.scrollHeight - embed.clientHeight]);
  expect(overflow).toEqual([0, 0]);
  const height = async (): Promise<number> =>
    frame.getByTestId("viewport").evaluate((view) => view.clientHeight);
  expect(await height()).toBeGreaterThanOrEqual(160);
  // With the sentence about a candidate, too.
  await page.locator("iframe").evaluate((element: HTMLIFrameElement, address) => {
    element.src = address;
  }, `${site}embed.html?test=1&model=unit-cube&step=258&candidate=0`);
  await expect(frame.getByTestId("supposed-front")).toContainText("was refused");
  await expect.poll(height).toBeGreaterThan(130);
});

test("a link leads to the same model, step, candidate, colours and camera", async ({ page, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.goto("./?test=1&model=unit-cube&step=258&candidate=0&color=layer&camera=3,-2,1.5,0.5,0.5,0.5");
  const viewport = page.getByTestId("viewport");
  await expect(viewport).toHaveAttribute("data-step", "258");
  await expect(page.getByTestId("lens-sentence")).toContainText("Node 286 was refused");
  await expect(page.getByTestId("player-coloring")).toHaveValue("layer");
  await button(page, "Step forward").click();
  await button(page, "Share this step").click();
  await page.getByTestId("share-step-link").click();
  await expect(page.getByText("The link to this step is in the clipboard.")).toBeVisible();
  const link = new URL(await page.evaluate(() => navigator.clipboard.readText()));
  expect(Object.fromEntries(link.searchParams)).toEqual({
    model: "unit-cube",
    step: "259",
    color: "layer",
    camera: "3,-2,1.5,0.5,0.5,0.5",
  });
  await button(page, "Share this step").click();
  await page.getByTestId("share-embed").click();
  await expect(page.getByText("in a web page is in the clipboard")).toBeVisible();
  const code = await page.evaluate(() => navigator.clipboard.readText());
  expect(code).toMatch(
    /^<iframe src="http[^"]*embed\.html\?model=unit-cube&amp;step=259[^"]*" title="Unit cube" loading="lazy"/,
  );
  expect(await violations(page)).toEqual([]);
});

test("on a phone, a link shows its step and the lens, and the view follows the step", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto("./?test=1&model=unit-cube&step=258&candidate=0");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", "258");
  await expect(page.getByTestId("lens-sentence")).toBeInViewport({ ratio: 1 });
  await page.getByTestId("player-more").click();
  await expect(page.getByTestId("player-follow")).toBeChecked();
  // Labels in the view have the numbers of the sentence, and are above the drawer.
  const labels = page.getByTestId("lens-labels");
  const drawer = await page.getByRole("dialog").boundingBox();
  for (const text of ["face 810", "node 286", "base"]) {
    const label = labels.getByText(text);
    await expect(label).toBeVisible();
    const box = await label.boundingBox();
    expect((box?.y ?? Infinity) + (box?.height ?? 0)).toBeLessThanOrEqual(drawer?.y ?? 0);
  }
  expect(await violations(page)).toEqual([]);
  // In patches, the plane is beside space.
  await button(page, "First state of the phase").click();
  await button(page, "First state of the phase").click();
  await expect(page.getByTestId("plane-view")).toBeInViewport({ ratio: 0.9 });
});

test("what an address asks for and cannot get is reported, in the app and in an embedded front", async ({
  page,
}) => {
  const notice = page.getByTestId("notice-address");
  for (const start of ["./", "./embed.html"]) {
    await page.goto(`${start}?test=1&model=unit-cube&step=9999&color=red`);
    await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", "1743");
    await expect(notice).toContainText("“color=red”");
    await expect(notice).toContainText("The front has no step 9999");
    expect(await violations(page)).toEqual([]);
    await notice.getByRole("button", { name: "OK" }).click();
    await expect(notice).toHaveCount(0);
  }
  await page.goto("./?test=1&model=unit-cube&step=x");
  await expect(notice).toContainText("“step=x”");
  const failure = page.getByTestId("embed-failure");
  await page.goto("./embed.html?test=1&model=unit-cube&step=x");
  await expect(failure).toContainText("“step=x”");
  await page.goto("./embed.html?test=1&model=sphinx&step=1");
  await expect(failure).toContainText("There is no example “sphinx”");
  await expect(failure).toContainText("unit-cube");
});

test("the link to a changed model holds it, and only examples are embedded", async ({ page }) => {
  await page.goto("./?test=1&model=unit-cube&step=10");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", "10");
  await page.getByRole("tab", { name: "Inspector" }).click();
  await page.getByTestId("project-name").fill("Mine");
  await page.getByTestId("project-name").press("Enter");
  await button(page, "Share this step").click();
  await page.getByTestId("share-step-link").click();
  await expect(page.getByRole("dialog", { name: "Share link" })).toContainText("the step of the front");
  await expect(page.getByTestId("share-link-text")).toHaveValue(/#project=/);
  await page.keyboard.press("Escape");
  await button(page, "Share this step").click();
  await page.getByTestId("share-embed").click();
  await expect(page.getByRole("dialog")).toContainText("unchanged examples");
});

/** Clicks a button as soon as the step is passed. From outside, the film of 10 seconds could end before the click. */
function clickAfterStep(
  viewport: HTMLElement | SVGElement,
  { step, button }: { readonly step: number; readonly button: string },
): Promise<void> {
  return new Promise((resolve) => {
    const click = (): void => {
      if (Number(viewport.dataset["step"]) <= step) return;
      watch.disconnect();
      [...document.querySelectorAll("button")].find(({ textContent }) => textContent === button)?.click();
      resolve();
    };
    const watch = new MutationObserver(click);
    watch.observe(viewport, { attributeFilter: ["data-step"] });
    click();
  });
}

test("a step is saved as a picture and a drawing, the front as a film", async ({ page }) => {
  await page.goto("./?test=1&model=unit-cube&step=258");
  const viewport = page.getByTestId("viewport");
  await expect(viewport).toHaveAttribute("data-step", "258");
  const saved = async (item: string) => {
    const download = page.waitForEvent("download");
    await button(page, "Share this step").click();
    await page.getByTestId(item).click();
    const file = await download;
    return { name: file.suggestedFilename(), content: readFileSync(await file.path()) };
  };
  const png = await saved("share-png");
  expect(png.name).toBe("unit-cube-step-258.png");
  expect(countColours(png.content)).toBeGreaterThan(60);

  const svg = await saved("share-svg");
  expect(svg.name).toBe("unit-cube-step-258.svg");
  const faces = Number(await viewport.getAttribute("data-front-faces"));
  const polygons = svg.content.toString().match(/<polygon/g)?.length ?? 0;
  expect(polygons).toBeGreaterThan(faces / 4);
  expect(polygons).toBeLessThanOrEqual(faces + 1);

  // What the lens shows is in the drawing, with the numbers of its sentence.
  const drawing = svg.content.toString();
  const [, base = ""] = /Base face ([\d,]+)/.exec((await page.getByTestId("lens").textContent()) ?? "") ?? [];
  for (const label of [`base ${base}`, "normal", "ideal", "node 231"])
    expect(drawing).toContain(`>${label}</text>`);

  // The film of a short range, which the notice ends early.
  const download = page.waitForEvent("download");
  await button(page, "Share this step").click();
  await page.getByTestId("share-webm").click();
  await expect(page.getByRole("button", { name: "Stop and save" })).toBeVisible();
  await viewport.evaluate(clickAfterStep, { step: 300, button: "Stop and save" });
  const film = await download;
  expect(film.suggestedFilename()).toBe("unit-cube.webm");
  const content = readFileSync(await film.path());
  // The first bytes of every WebM file (EBML).
  expect(content.subarray(0, 4).toString("hex")).toBe("1a45dfa3");
  expect(content.length).toBeGreaterThan(5000);
  await expect(viewport).toHaveAttribute("data-step", "258");

  // In a patch, too; its steps have the numbers that the player shows.
  const scrub = slider(page, "Step of the front");
  await scrub.press("Home");
  await scrub.press("ArrowLeft");
  await scrub.press("PageDown");
  await expect(page.getByTestId("lens-labels")).toContainText("base");
  const patch = await saved("share-svg");
  expect(patch.name).toMatch(/^unit-cube-patches-step-\d+\.svg$/);
  expect(patch.content.toString()).toMatch(/>base \d+<\/text>/);
  expect(patch.content.toString().match(/<polygon/g)?.length ?? 0).toBeGreaterThan(200);
});

test("an embedded front lets the page scroll, and is zoomed with Ctrl and the wheel", async ({ page }) => {
  await page.route("**/course.html", (route) =>
    route.fulfill({
      contentType: "text/html",
      body: `<!doctype html><html><body style="margin:0"><iframe title="front" width="600" height="400"
        src="/embed.html?test=1&model=unit-cube&step=5"></iframe><p style="height: 3000px">Text</p></body></html>`,
    }),
  );
  await page.goto("./course.html");
  const frame = page.frameLocator("iframe");
  await expect(frame.getByTestId("viewport")).toHaveAttribute("data-step", "5");
  await page.mouse.move(300, 150);
  // The hint is shown for a short time.
  const hinted = frame.getByText("Ctrl and the wheel zoom the view.").waitFor();
  await Promise.all([hinted, page.mouse.wheel(0, 200)]);
  await expect.poll(() => page.evaluate(() => window.scrollY)).toBeGreaterThan(100);
  await page.evaluate(() => window.scrollTo(0, 0));
  const frames = async () => Number(await frame.getByTestId("viewport").getAttribute("data-frames"));
  const drawn = await frames();
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, 200);
  await page.keyboard.up("Control");
  await expect.poll(frames).toBeGreaterThan(drawn);
  expect(await page.evaluate(() => window.scrollY)).toBe(0);
});
