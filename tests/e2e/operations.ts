import { expect, type Page } from "@playwright/test";

/** Opens the panel of an operation by the palette. */
export async function startOperation(page: Page, command: string): Promise<void> {
  await page.keyboard.press("Control+k");
  const search = page.getByRole("dialog").getByRole("textbox", { name: "Search commands" });
  await expect(search).toBeFocused();
  await page.keyboard.type(command);
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("operation")).toBeVisible();
}

/** Accepts what the open panel gives. */
export async function acceptOperation(page: Page): Promise<void> {
  await page.getByTestId("accept").click();
  await expect(page.getByTestId("operation")).toBeHidden();
}
