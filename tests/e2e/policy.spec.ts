/** The Content-Security-Policy of the pages, under which everything works. */
import { expect, test, type Page } from "@playwright/test";
import { boxSolid, stepFile } from "../support/step-files";
import { AppPage } from "./app-page";
import { dropBytes } from "./drop-bytes";
import { recordRefusals } from "./policy";
import { tab } from "./controls";

const policyOf = async (page: Page): Promise<string> =>
  (await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute("content")) ?? "";

test("the policy of both pages lets in nothing from elsewhere, and no text as a script or style", async ({
  page,
}) => {
  for (const address of ["./?test=1&new=1", "./embed.html?model=none"]) {
    await page.goto(address);
    const policy = await policyOf(page);
    expect(policy).toMatch(/^default-src 'none'; script-src 'self' 'wasm-unsafe-eval'/);
    expect(policy).not.toMatch(/unsafe-inline|'unsafe-eval'|https?:|\*/);
    for (const part of ["base-uri 'none'", "form-action 'none'", "object-src 'none'", "connect-src 'self'"])
      expect(policy).toContain(part);
  }
  // It is in force.
  await page.goto("./?test=1&new=1");
  const ran = await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.foreignScript = true";
    document.head.append(script);
    return "foreignScript" in window;
  });
  expect(ran).toBe(false);
});

test("nothing is refused while a CAD file is meshed, bodies are joined and a picture is saved", async ({
  page,
}) => {
  const refused = await recordRefusals(page);
  const app = new AppPage(page);
  await app.openCube();
  const parts = [boxSolid("base", [0, 0, 0], [4, 4, 1]), boxSolid("pin", [1, 1, 0.5], [2, 2, 3])];
  await dropBytes(page, stepFile(parts), "parts.step");
  await expect(page.getByTestId("tree-body-2")).toContainText("pin");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Control+k");
  await expect(page.getByRole("textbox", { name: "Search commands" })).toBeFocused();
  await page.keyboard.type("Union of two bodies");
  await page.keyboard.press("Enter");
  await page.getByTestId("accept").click();
  await expect(page.getByTestId("operation")).toBeHidden();
  await expect(page.getByRole("button", { name: /^Undo: / })).toBeEnabled();
  expect((await app.generate()).tets).toBeGreaterThan(50);
  // Dialogs, menus and tooltips have styles of their own.
  await page.getByTestId("export-image").click();
  const download = page.waitForEvent("download");
  await page.getByTestId("image-save").click();
  await download;
  await page.getByTestId("share-link").click();
  await expect(page.getByTestId("share-link-text")).toHaveValue(/#project=/);
  await page.keyboard.press("Escape");
  await page.getByTestId("theme").click();
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.keyboard.press("Escape");
  await tab(page, "Quality").click();
  await expect(page.getByRole("tab", { name: "Quality", selected: true })).toBeVisible();
  expect(await refused()).toEqual([]);
});

test("nothing is refused in a front with formulas, nor in an embedded front", async ({ page }) => {
  const refused = await recordRefusals(page);
  await page.goto("./?test=1&model=unit-cube&step=99");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-steps", /\d/);
  await expect(page.locator(".katex").first()).toBeVisible();
  await page.goto("./embed.html?test=1&model=unit-cube&step=258&candidate=0");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", "258");
  expect(await refused()).toEqual([]);
});
