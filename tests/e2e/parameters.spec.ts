import { expect, test } from "@playwright/test";
import { readProject } from "tetrafront";
import { AppPage } from "./app-page";
import { downloaded } from "./downloads";

test("a parameter moves the points whose coordinates use it; the file keeps it", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.page.getByTestId("new-parameter-name").fill("height");
  await app.page.getByTestId("new-parameter-expression").fill("3/2");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("parameter-value-height")).toHaveText("1.5");
  await expect(page.getByTestId("new-parameter-name")).toBeFocused();

  await app.select("point-5");
  await app.type("position-z", "2*height-2");
  const z = page.getByTestId("position-z");
  await expect(z).toHaveValue("2*height-2");
  await z.blur();
  await expect(z).toHaveValue("1");
  await expect(z).toHaveAttribute("data-expression", "2*height-2");

  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Escape");
  await app.type("parameter-height", "height+1");
  await expect(page.getByText("Uses height itself")).toBeVisible();
  await app.type("parameter-height", "2");
  await app.select("point-5");
  await expect(z).toHaveValue("2");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+z");
  await expect(z).toHaveValue("1");
  await page.keyboard.press("Control+Shift+z");

  const saved = readProject(
    new TextDecoder().decode(await downloaded(page, () => page.keyboard.press("Control+s"))),
  );
  if (!saved.success) throw new Error(saved.errors[0].message);
  expect(saved.value.parameters).toEqual([{ name: "height", expression: "2" }]);
  expect(saved.value.expressions).toEqual([
    { kind: "point", id: 5, field: "position.2", expression: "2*height-2" },
  ]);
  expect(saved.value.points.find(({ id }) => id === 5)?.position[2]).toBe(2);
});

test("a selection is edited at once and becomes a group; the history jumps", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("point-5");
  await page.getByTestId("tree-point-6").click({ modifiers: ["Control"] });
  await expect(page.getByTestId("common-position-y")).toHaveAttribute("placeholder", "mixed");
  await expect(page.getByTestId("common-position-z")).toHaveValue("0");
  await app.type("common-position-z", "1.25");
  await page.getByTestId("group-selection").click();
  await page.getByTestId("tree-point-6").click();
  await expect(page.getByTestId("position-z")).toHaveValue("1.25");
  await expect(page.getByTestId("deletes-also").getByRole("button")).not.toHaveCount(0);

  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Escape");
  const group = page.getByTestId("group-1");
  await group.getByLabel("Name of group Group 1").fill("top edge");
  await page.keyboard.press("Enter");
  await group.getByRole("button", { name: "Hide top edge" }).click();
  await expect(group.getByRole("button", { name: "Show top edge" })).toBeVisible();
  await group.getByRole("button", { name: /^Select the 2/ }).click();
  await expect(page.getByText("2 entities selected")).toBeVisible();

  await page.getByTestId("tab-history").click();
  const history = page.getByTestId("history");
  await expect(history.getByRole("button")).toHaveText([
    "As opened",
    "Set z of 2 entities",
    "Add group 1",
    "Rename group Group 1",
  ]);
  await history.getByRole("button", { name: "As opened" }).click();
  await expect(page.getByTestId("common-position-z")).toHaveValue("0");
  await history.getByRole("button", { name: "Set z of 2 entities" }).click();
  await expect(page.getByTestId("common-position-z")).toHaveValue("1.25");
  await expect(history.locator("[aria-current]")).toHaveText("Set z of 2 entities");
});
