import { expect, test } from "@playwright/test";
import { DrawPage } from "./draw-page";

test("an expression may begin with a hotkey; undo takes back the last line of a chain, which goes on", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  await expect(draw.viewport).toHaveAttribute("data-tool", "line");
  await draw.typeCoordinates("sin(0),0,0", "pi/pi,0,0", "1,cos(0),0", "5,5,0");
  await draw.counts(4, 3, 0);
  await page.keyboard.press("Control+z");
  await draw.counts(3, 2, 0);
  await draw.typeCoordinates("abs(0),1,0", "0,0,0");
  await draw.counts(4, 4, 0);
  expect(await draw.savedPositions()).toEqual([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]); // prettier-ignore
  // Without more letters, A is the hotkey of patches.
  await page.keyboard.press("a");
  await expect(page.getByTestId("waiting-letter")).toHaveText(/^a… {2}Enter: /);
  await page.keyboard.press("Enter");
  await expect(draw.viewport).toHaveAttribute("data-tool", "patch");
  await page.keyboard.press("p");
  await expect(draw.viewport).toHaveAttribute("data-tool", "point");
  // A place that is no step of undo yet is taken back first.
  await page.keyboard.press("l");
  await draw.typeCoordinates("3,3,3");
  await expect(page.getByRole("button", { name: "Undo: last place" })).toBeEnabled();
  await page.keyboard.press("Control+z");
  await draw.counts(4, 4, 0);
  await page.keyboard.press("Control+z");
  await draw.counts(4, 3, 0);
});

test("typed numbers move the selection, before and during a drag: each is one step of undo", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("p");
  await expect(draw.viewport).toHaveAttribute("data-tool", "point");
  await draw.typeCoordinates("0,0,0", "1,0,0");
  await page.keyboard.press("Control+a");
  await page.keyboard.press("g");
  await expect(draw.viewport).toHaveAttribute("data-tool", "move");
  const field = page.getByTestId("coordinates");
  await page.keyboard.type("z0.5");
  await expect(page.getByRole("textbox", { name: "Distance, axis Z" })).toHaveValue("0.5");
  await page.keyboard.press("Enter");
  await expect(field).toBeHidden();
  expect(await draw.savedPositions()).toEqual([[0, 0, 0.5], [1, 0, 0.5]]); // prettier-ignore
  await page.keyboard.type("0.5");
  await page.keyboard.press("Tab");
  await page.keyboard.type("sqrt(4)");
  await expect(field).toHaveValue("@0.5,sqrt(4)");
  await page.keyboard.press("Enter");
  await expect(field).toBeHidden();
  expect(await draw.savedPositions()).toEqual([[0.5, 2, 0.5], [1.5, 2, 0.5]]); // prettier-ignore
  await page.keyboard.type("7");
  await page.keyboard.press("Escape");
  await expect(field).toBeHidden();
  await page.keyboard.press("f");
  const { x, y } = await draw.at([1.5, 2, 0.5]);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 30, y + 20);
  await expect(page.getByTestId("amount")).toBeVisible();
  await page.keyboard.type("@0,0,-0.5");
  await expect(field).toHaveValue("@0,0,-0.5");
  await page.mouse.up();
  await page.keyboard.press("Enter");
  await expect(field).toBeHidden();
  expect(await draw.savedPositions()).toEqual([[0.5, 2, 0], [1.5, 2, 0]]); // prettier-ignore
  for (let step = 0; step < 3; ++step) await page.keyboard.press("Control+z");
  expect(await draw.savedPositions()).toEqual([[0, 0, 0], [1, 0, 0]]); // prettier-ignore
});

test("on a phone, a button opens the field for coordinates, beside the place picked last", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await page.setViewportSize({ width: 390, height: 844 });
  await draw.openNew();
  await page.getByTestId("tool-line").click();
  const field = page.getByTestId("coordinates");
  for (const place of ["0,0,0", "1,0,0"]) {
    await page.getByTestId("type-coordinates").click();
    await expect(field).toBeFocused();
    await page.keyboard.type(place);
    await page.keyboard.press("Enter");
    await expect(field).toBeHidden();
  }
  await draw.counts(2, 1, 0);
  await page.getByTestId("type-coordinates").click();
  await expect(field).toBeInViewport({ ratio: 1 });
  const [box, bar] = [await field.boundingBox(), await page.getByTestId("drawing-bar").boundingBox()];
  expect(box?.y ?? 0).toBeGreaterThan((bar?.y ?? Infinity) + (bar?.height ?? 0));
});
