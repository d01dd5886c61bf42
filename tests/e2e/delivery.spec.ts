/** What a first visit loads. */
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { expect, test, type Browser, type Request } from "@playwright/test";
import { AppPage } from "./app-page";

// What a service worker keeps for later would be counted.
test.use({ serviceWorkers: "block" });

/** Compressed by Brotli, as the build does it. Of these, 300 kB are the engine, and 236 kB React, Mantine and three.js. */
const MOST = { beforePaint: 400_000, beforeMesh: 875_000 } as const;

/** On a busy machine, the paint comes after the first requests of what follows it. */
const MOST_REQUESTS = Number(process.env["TETRAFRONT_SLOWNESS"] ?? 1) < 1.5 ? 10 : 14;

interface Loaded {
  readonly name: string;
  readonly bytes: number;
  /** Milliseconds since 1970. */
  readonly begin: number;
}

async function loadedBy(request: Request): Promise<Loaded | null> {
  const response = await request.response();
  if (response === null) return null;
  const bytes = Number(await response.headerValue("content-length")) || (await response.body()).length;
  return { name: new URL(request.url()).pathname, bytes, begin: request.timing().startTime };
}

/** Notes in a page when its first mesh is there. */
function noteFirstMesh(): void {
  const isMeshed = () => document.querySelector("[data-status='done']") !== null;
  new MutationObserver((_, observer) => {
    if (!isMeshed()) return;
    observer.disconnect();
    performance.mark("first-mesh");
  }).observe(document, { subtree: true, childList: true, attributeFilter: ["data-status"] });
}

/** Returns the number of requests and the bytes that a page without a cache loads before its first paint. */
async function paintedIn(browser: Browser): Promise<{ readonly requests: number; readonly bytes: number }> {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto("./");
  const paints = () => page.evaluate(() => performance.getEntriesByName("first-contentful-paint").length);
  await expect.poll(paints).toBe(1);
  const painted = await page.evaluate(() => {
    const [paint] = performance.getEntriesByName("first-contentful-paint");
    const resources = performance.getEntriesByType("resource") as PerformanceResourceTiming[];
    const before = resources.filter(({ responseEnd }) => responseEnd <= (paint?.startTime ?? 0));
    const bytes = before.reduce((sum, { encodedBodySize }) => sum + encodedBodySize, 0);
    return { requests: 1 + before.length, bytes };
  });
  await context.close();
  return painted;
}

test("a first visit loads little before the first paint", async ({ browser }) => {
  // On a busy machine, what the paint does not wait for may arrive before it.
  await expect(async () => {
    const { requests, bytes } = await paintedIn(browser);
    expect(requests).toBeLessThanOrEqual(MOST_REQUESTS);
    expect(bytes).toBeLessThan(MOST.beforePaint);
  }).toPass({ timeout: 60_000 });
});

test("a first visit loads nothing before the first mesh that it does not need", async ({ page }) => {
  const loading: Promise<Loaded | null>[] = [];
  page.on("request", (request) => void loading.push(loadedBy(request).catch(() => null)));
  await page.addInitScript(noteFirstMesh);
  await new AppPage(page).open();
  const loaded = (await Promise.all(loading)).filter((one) => one !== null);
  const meshed = await page.evaluate(() => {
    const [mesh] = performance.getEntriesByName("first-mesh");
    return performance.timeOrigin + (mesh?.startTime ?? 0);
  });
  // A script of a worker is announced by the page and by the worker.
  const bytesOf = new Map(
    loaded.filter(({ begin }) => begin < meshed).map(({ name, bytes }) => [name, bytes]),
  );
  const list = [...bytesOf].map(([name, bytes]) => `${bytes} ${name}`);
  expect(list).toContainEqual(expect.stringMatching(/engine-.*\.wasm$/));
  expect(list).not.toContainEqual(expect.stringMatching(/later-panels|front-panels/));
  const bytes = [...bytesOf.values()].reduce((sum, one) => sum + one, 0);
  expect(bytes, list.join("\n")).toBeLessThan(MOST.beforeMesh);
});

test("the site has the styles of all components that it uses, and few others", () => {
  const folder = fileURLToPath(new URL("../../web/dist/assets", import.meta.url));
  const textOf = (type: string): string =>
    readdirSync(folder)
      .filter((name) => name.endsWith(type))
      .map((name) => readFileSync(path.join(folder, name), "utf8"))
      .join("\n");
  const classesIn = (text: string): ReadonlySet<string> => new Set(text.match(/\bm_[\da-f]{6,8}\b/g));
  const require = createRequire(new URL("../../web/package.json", import.meta.url));
  const known = classesIn(readFileSync(require.resolve("@mantine/core/styles.css"), "utf8"));
  const [used, styled] = [classesIn(textOf(".js")), classesIn(textOf(".css"))];
  const needed = [...used].filter((name) => known.has(name));
  expect(needed.length).toBeGreaterThan(100);
  expect(needed.filter((name) => !styled.has(name))).toEqual([]);
  const unused = [...styled].filter((name) => known.has(name) && !used.has(name));
  expect(unused.length).toBeLessThan(10);
});
