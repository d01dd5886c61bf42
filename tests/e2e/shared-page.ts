/**
 * Tests that share a page with the other tests of their file: loading the app costs more than most of them. Each begins
 * with a document of its own, which `AppPage` opens in the loaded app. After a failure, the next test loads it again.
 */
import { test, type BrowserContext, type Page } from "@playwright/test";

/** Size of the window in which a test begins. */
export const usualSize = { width: 1440, height: 900 } as const;

let shared: { readonly file: string; readonly context: BrowserContext; readonly page: Page } | null = null;

/** Returns whether a page has been loaded for an earlier test of the file. */
export const isLoaded = (page: Page): boolean => shared?.page === page && page.url() !== "about:blank";

/** Returns the page of a file; that of the file before is closed. */
async function pageOf(file: string, open: () => Promise<BrowserContext>): Promise<Page> {
  if (shared?.file === file && !shared.page.isClosed()) {
    await shared.page.setViewportSize(usualSize);
    return shared.page;
  }
  await shared?.context.close();
  const context = await open();
  shared = { file, context, page: await context.newPage() };
  return shared.page;
}

/** A test in the page of its file, for what needs neither another window, theme or storage, nor a file that is missing. */
export const sharedTest = test.extend({
  page: async ({ browser }, use, { file }) => use(await pageOf(file, () => browser.newContext())),
});
