import { readFile } from "node:fs/promises";
import type { Page } from "@playwright/test";

/** Returns the file that the page downloads after an action. */
export async function downloaded(page: Page, act: () => Promise<void>): Promise<Uint8Array> {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  return new Uint8Array(await readFile(await download.path()));
}

/** Downloads the mesh in the format whose menu entry has this name. */
export async function downloadMesh(page: Page, format: RegExp): Promise<Uint8Array> {
  return downloaded(page, async () => {
    await page.getByTestId("download").click();
    await page.getByRole("menuitem", { name: format }).click();
  });
}
