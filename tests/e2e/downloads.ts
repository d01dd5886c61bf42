import { readFile } from "node:fs/promises";
import type { Page } from "@playwright/test";

/** Returns the file that the page downloads after an action. */
export async function downloaded(page: Page, act: () => Promise<void>): Promise<Uint8Array> {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  return new Uint8Array(await readFile(await download.path()));
}

/** Opens the export dialog and chooses the format with this name, without saving yet. */
export async function chooseFormat(page: Page, format: RegExp): Promise<void> {
  await page.getByTestId("download").click();
  await page.getByRole("dialog", { name: "Export mesh" }).getByRole("radio", { name: format }).check();
}

export interface ExportChoice {
  readonly secondOrder?: boolean;
}

/** Saves the mesh in the format with this name. */
export async function downloadMesh(
  page: Page,
  format: RegExp,
  { secondOrder = false }: ExportChoice = {},
): Promise<Uint8Array> {
  await chooseFormat(page, format);
  const dialog = page.getByRole("dialog", { name: "Export mesh" });
  await dialog.getByText(secondOrder ? "Second order" : "Linear", { exact: true }).click();
  return downloaded(page, () => dialog.getByRole("button", { name: "Export", exact: true }).click());
}
