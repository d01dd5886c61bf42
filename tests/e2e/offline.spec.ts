/** Without a network, after one visit. */
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { expect, test, type BrowserContext, type Page } from "@playwright/test";
import { drilledSolid, stepFile } from "../support/step-files";
import { AppPage } from "./app-page";
import { ArticlePage } from "./article-page";
import { dropBytes } from "./drop-bytes";

const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]);

/** Visits the site until it is kept. */
async function visited(page: Page, address = "./"): Promise<AppPage> {
  const app = new AppPage(page);
  await page.addInitScript(() => localStorage.setItem("tetrafront-start-page", "never"));
  await page.goto(`${address}?model=unit-cube`);
  await app.meshed();
  await page.evaluate(async () => {
    await navigator.serviceWorker.ready;
  });
  await expect.poll(() => page.evaluate(() => navigator.serviceWorker.controller?.state)).toBe("activated");
  return app;
}

/** Opens a page without a network. */
async function opened(context: BrowserContext, address: string): Promise<AppPage> {
  const app = new AppPage(await context.newPage());
  await app.page.goto(address);
  return app;
}

test("after one visit, all pages work without a network, and CAD files once the library is kept", async ({
  page,
  context,
}) => {
  const { page: first } = await visited(page);
  await first.keyboard.press("Control+k");
  await first.keyboard.type("Keep for offline use");
  await first.keyboard.press("Enter");
  await expect(first.getByTestId("notice-offline")).toContainText(/is kept in this browser \(\d+\.\d MB\)/);
  await first.close();
  await context.setOffline(true);

  // The example, and parts of the app that the visit has not used.
  const app = await opened(context, "./?test=1&model=engine-intake");
  expect((await app.meshed()).tets).toBeGreaterThan(10_000);
  await dropBytes(app.page, plate, "plate.step");
  await expect(app.page.getByTestId("entity-name")).toHaveValue("Plate");
  await expect(app.page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");
  await app.page.getByTestId("body-generate").click();
  expect((await app.meshed()).tets).toBeGreaterThan(100);
  await app.openExample("pipe-flange");
  await app.page.close();

  const front = await opened(context, "./?test=1&model=unit-cube&step=99");
  await expect(front.page.locator(".katex").first()).toBeVisible();
  const opening = context.waitForEvent("page");
  await front.page.getByRole("menuitem", { name: "Help" }).click();
  await front.page.getByRole("menuitem", { name: "Lessons" }).click();
  const articles = await opening;
  await front.page.close();
  const embed = await opened(context, "./embed.html?test=1&model=unit-cube&step=100");
  await expect(embed.viewport).toHaveAttribute("data-step", "100");
  await embed.page.close();

  await articles.getByRole("link", { name: /How a front fills a shape/ }).click();
  await expect(articles.getByTestId("figure-A")).toHaveAttribute("data-ready", "true");
});

test("a lesson that was opened first keeps all lessons, after its figure is there", async ({
  page,
  context,
}) => {
  // What is kept must not delay the figure.
  await page.addInitScript(() => {
    if (!("serviceWorker" in navigator)) return;
    const { serviceWorker } = navigator;
    const register = serviceWorker.register.bind(serviceWorker);
    serviceWorker.register = (...args) => {
      const { ready } = document.querySelector<HTMLElement>("[data-figure]")?.dataset ?? {};
      document.documentElement.dataset["registered"] = `figure ${ready === "true" ? "ready" : "missing"}`;
      return register(...args);
    };
  });
  await page.goto("./lessons/4/");
  const root = page.locator("html");
  await expect(root).toHaveAttribute("data-registered", "figure ready");
  await expect.poll(() => page.evaluate(() => navigator.serviceWorker.controller?.state)).toBe("activated");
  await context.setOffline(true);

  const lesson = new ArticlePage(page, false);
  await page.reload();
  await lesson.see("A");
  const number = page.getByTestId("number-size").first();
  await number.focus();
  const height = await lesson.value("A", "height");
  await page.keyboard.press("ArrowRight");
  await expect.poll(() => lesson.value("A", "height")).toBeGreaterThan(height);

  // One that has not been opened: its figure runs the engine.
  await page.getByRole("link", { name: "Lessons", exact: true }).click();
  await page.getByRole("link", { name: /How a front fills a shape/ }).click();
  await lesson.see("A");
  const triangles = await lesson.value("A", "triangles");
  expect(triangles).toBeGreaterThan(20);
  await number.focus();
  await page.keyboard.press("End");
  await expect.poll(() => lesson.value("A", "triangles")).toBeLessThan(triangles);
  // And one whose figure plays a recorded front.
  await lesson.see("B");
  expect(await lesson.value("B", "elements")).toBeGreaterThan(100);
  expect(lesson.errors).toEqual([]);
});

test("a figure alone in a course page keeps nothing", async ({ page }) => {
  await page.goto("./lessons/4/?figure=A");
  await expect(page.getByTestId("figure-A")).toHaveAttribute("data-ready", "true");
  // Longer than a lesson waits for before it keeps the site.
  await page.waitForTimeout(4000);
  expect(await page.evaluate(async () => (await navigator.serviceWorker.getRegistrations()).length)).toBe(0);
  expect(await page.evaluate(() => caches.keys())).toEqual([]);
});

test("without a network and the library for CAD files, a sentence says how to get it", async ({
  page,
  context,
}) => {
  await visited(page);
  await context.setOffline(true);
  await dropBytes(page, plate, "plate.step");
  const dialog = page.getByRole("dialog", { name: "plate.step could not be opened" });
  await expect(dialog).toContainText("not kept in this browser, and there is no network");
  await expect(dialog).not.toContainText(/occt-import-js|setCadLibrary/);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Keep for offline use");
  await page.keyboard.press("Enter");
  await expect(page.getByRole("dialog", { name: "could not be kept" })).toContainText("There is no network.");
  await expect(page.getByTestId("notice-offline")).toBeHidden();
});

test("the library for CAD files is kept when it was used", async ({ page, context }) => {
  const app = await visited(page);
  await dropBytes(page, plate, "plate.step");
  await expect(page.getByTestId("entity-name")).toHaveValue("Plate");
  const kept = () =>
    page.evaluate(async () => {
      const requests = await Promise.all(
        (await caches.keys()).map(async (name) => (await caches.open(name)).keys()),
      );
      return requests.flat().filter(({ url }) => /\/occt-import-js-[^/]*\.(js|wasm)$/.test(url)).length;
    });
  await expect.poll(kept).toBe(2);
  await app.page.close();
  await context.setOffline(true);
  const again = await opened(context, "./?test=1&new=1");
  await expect(again.viewport).toHaveAttribute("data-frames", /./);
  await dropBytes(again.page, plate, "again.step");
  await expect(again.page.getByTestId("entity-name")).toHaveValue("Plate");
});

/**
 * Serves the site in a folder of a plain host. `scriptOf` changes the text of the service worker; `textOf` returns what a file has
 * in place of its content, or null.
 */
async function hosted(
  scriptOf: (script: string) => string,
  textOf: (name: string) => string | null = () => null,
) {
  const folder = fileURLToPath(new URL("../../web/dist", import.meta.url));
  const types: Readonly<Record<string, string>> = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
  };
  const server = createServer((request, response) => {
    const name = new URL(request.url ?? "/", "http://localhost").pathname.replace("/course/mesh/", "");
    // A folder has its page.
    const file = path.join(folder, /(?:^|\/)$/.test(name) ? `${name}index.html` : name);
    if (!existsSync(file)) return void response.writeHead(404).end();
    const type = types[path.extname(file)] ?? "application/octet-stream";
    response.writeHead(200, { "Content-Type": type });
    const text = name === "sw.js" ? scriptOf(readFileSync(file, "utf8")) : textOf(name);
    if (text !== null) response.end(text);
    else createReadStream(file).pipe(response);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address() as AddressInfo;
  return { address: `http://127.0.0.1:${port}/course/mesh/`, close: () => server.close() };
}

/** The page asks whether the host has a new version. */
const searchUpdate = (page: Page): Promise<void> =>
  page.evaluate(async () => {
    await (await navigator.serviceWorker.ready).update();
  });

const newVersion = "f".repeat(16);
const withNewVersion = (script: string): string =>
  script.replace(/version:"[0-9a-f]{16}"/, `version:"${newVersion}"`);

test("in a folder of any host, a new version is offered and waits, also when the page is reloaded; when it is loaded, the old one is removed", async ({
  page,
}) => {
  let isNew = false;
  const host = await hosted((script) => (isNew ? withNewVersion(script) : script));
  try {
    await visited(page, host.address);
    const names = () => page.evaluate(() => window.caches.keys());
    const [first = ""] = await names();
    expect(first).toMatch(/^tetrafront \/course\/mesh\/ [0-9a-f]{16}$/);
    const second = `tetrafront /course/mesh/ ${newVersion}`;
    // Of sites beside and below this one.
    const others = ["tetrafront /course/mesh/a/ 1", "tetrafront /other/ 1"];
    await page.evaluate((all) => Promise.all(all.map((name) => window.caches.open(name))), others);
    const mark = () => page.evaluate(() => Object.assign(window, { isFirstPage: true }));
    await mark();
    isNew = true;
    await searchUpdate(page);
    const offer = page.getByTestId("notice-update");
    await expect(offer).toContainText("A new version of Tetrafront is ready");
    // Nothing is forced.
    expect(await page.evaluate(() => "isFirstPage" in window)).toBe(true);
    await page.reload();
    await new AppPage(page).meshed();
    await expect(offer).toContainText("A new version of Tetrafront is ready");
    expect((await names()).sort()).toEqual([first, second, ...others].sort());
    await mark();
    await offer.getByRole("button", { name: "Reload" }).click();
    await expect.poll(() => page.evaluate(() => "isFirstPage" in window).catch(() => true)).toBe(false);
    await expect.poll(async () => (await names().catch(() => [])).sort()).toEqual([second, ...others].sort());
    await page.context().setOffline(true);
    await page.goto(`${host.address}?test=1&model=unit-cube`);
    expect((await new AppPage(page).meshed()).tets).toBe(1753);
  } finally {
    host.close();
  }
});

test("files of another version are not kept, and one that the browser has dropped is kept again", async ({
  page,
}) => {
  let isNew = false;
  let isMixed = false;
  const host = await hosted(
    (script) => (isNew ? withNewVersion(script) : script),
    (name) => (isMixed && name === "embed.html" ? "<p>of the version after this one</p>" : null),
  );
  try {
    await visited(page, host.address);
    isNew = true;
    isMixed = true;
    const end = await page.evaluate(async () => {
      const registration = await navigator.serviceWorker.ready;
      await registration.update();
      const worker = registration.installing;
      if (!worker) return "nothing";
      await new Promise<void>((resolve) => {
        worker.addEventListener("statechange", () => resolve(), { once: true });
      });
      return worker.state;
    });
    expect(end).toBe("redundant");
    // Neither now, while another version is there, nor of it.
    const drop = () =>
      page.evaluate(async () => {
        for (const name of await caches.keys()) await (await caches.open(name)).delete("./embed.html");
        return (await fetch("./embed.html")).text();
      });
    const isKept = () => page.evaluate(async () => (await caches.match("./embed.html")) !== undefined);
    expect(await drop()).toContain("after this one");
    expect(await isKept()).toBe(false);
    isMixed = false;
    expect(await drop()).toContain("<html");
    await expect.poll(isKept).toBe(true);
  } finally {
    host.close();
  }
});

test("the app can be installed", async ({ page, request }) => {
  await page.goto("./?test=1&new=1");
  const address = await page.locator('link[rel="manifest"]').getAttribute("href");
  const manifest = (await (await request.get(address ?? "")).json()) as {
    readonly display: string;
    readonly start_url: string;
    readonly icons: readonly { readonly src: string; readonly sizes: string; readonly purpose: string }[];
  };
  expect(manifest).toMatchObject({ display: "standalone", start_url: "./" });
  expect(manifest.icons.map(({ sizes, purpose }) => `${sizes} ${purpose}`)).toEqual(
    expect.arrayContaining(["192x192 any", "512x512 any", "512x512 maskable"]),
  );
  for (const { src, sizes } of manifest.icons.filter(({ src }) => src.endsWith(".png"))) {
    const bytes = await (await request.get(src)).body();
    expect(`${bytes.readUInt32BE(16)}x${bytes.readUInt32BE(20)}`).toBe(sizes);
  }
});
