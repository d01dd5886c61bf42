import { expect, test } from "@playwright/test";
import { AppPage } from "./app-page";

test("the help has the documents, a search finds sections of all of them, and links lead on", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("Shift+?");
  const help = page.getByRole("dialog");
  const search = help.getByTestId("help-search");
  await expect(search).toBeFocused();
  await search.fill("second-order ctetra");
  const results = help.getByTestId("help-results");
  await expect(results.getByRole("button", { name: /^Second-order elements/ })).toBeVisible();
  await results.getByRole("button", { name: /^Second-order elements/ }).click();
  const format = help.getByTestId("help-document-format");
  await expect(format.getByRole("heading", { name: "Second-order elements" })).toBeInViewport();
  await expect(format.getByRole("cell", { name: "CTRIA6" })).toBeVisible();
  await search.fill("fit model");
  await expect(results).toContainText("Fit model");
  await search.fill("mesh");
  await expect(help.getByRole("status")).toHaveText(/^The first 40 of \d{2,} sections$/);
  await search.fill("qqqqqq");
  await expect(help).toContainText("Nothing found");
  await search.fill("");
  await help.getByTestId("help-page-readme").click();
  await help
    .getByTestId("help-document-readme")
    .getByRole("button", { name: /FORMAT/ })
    .first()
    .click();
  await expect(format).toBeVisible();
});
