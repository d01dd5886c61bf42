import { expect, test } from "@playwright/test";
import { createBody, readProject, writeProject } from "tetrafront/project";
import { AppPage } from "./app-page";
import { cubeProject } from "../support/projects";
import { boxSurface } from "../support/surfaces";
import { downloaded } from "./downloads";
import { dropBytes } from "./drop-bytes";
import { tab } from "./controls";
import { sharedTest } from "./shared-page";

sharedTest("a parameter moves the points whose coordinates use it; the file keeps it", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  // An equation typed into the first field goes on in the second.
  await page.getByTestId("new-parameter-name").focus();
  await page.keyboard.type("height = 3/2");
  await expect(page.getByTestId("new-parameter-name")).toHaveValue("height");
  await expect(page.getByTestId("new-parameter-expression")).toBeFocused();
  // Without a right side, the expression of the other field stays; a name typed into the second field moves to the first.
  await page.getByTestId("new-parameter-name").fill("height=");
  await expect(page.getByTestId("new-parameter-name")).toHaveValue("height");
  await expect(page.getByTestId("new-parameter-expression")).toHaveValue(/^ ?3\/2$/);
  await page.getByTestId("new-parameter-name").fill("");
  await page.getByTestId("new-parameter-expression").fill("");
  await page.keyboard.type("height = 3/2");
  await expect(page.getByTestId("new-parameter-name")).toHaveValue("height");
  await expect(page.getByTestId("new-parameter-expression")).toHaveValue(/^ ?3\/2$/);
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

sharedTest("a selection is edited at once and becomes a group; the history jumps", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("point-5");
  await page.getByTestId("tree-point-6").click({ modifiers: ["Control"] });
  await expect(page.getByTestId("common-position-y")).toHaveAttribute("placeholder", "mixed");
  await expect(page.getByTestId("common-position-z")).toHaveValue("0");
  // Each from its own value: also where the values differ, by typing and by an arrow key.
  const mixed = page.getByTestId("common-position-y");
  await app.type("common-position-y", "size+1");
  await expect(mixed).toHaveAttribute("aria-invalid", "true");
  await app.type("common-position-y", "y+0.25");
  await expect(mixed).not.toHaveAttribute("aria-invalid", "true");
  await mixed.press("ArrowUp");
  await expect(mixed).not.toHaveAttribute("aria-invalid", "true");
  for (const [key, y] of [
    ["point-5", "0.26"],
    ["point-6", "1.26"],
  ] as const) {
    await app.select(key);
    await expect(page.getByTestId("position-y")).toHaveValue(y);
  }
  // What was typed and the arrow key are one step of the history if they follow each other quickly, else two.
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await app.select("point-5");
  await page.getByTestId("tree-point-6").click({ modifiers: ["Control"] });
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

  // The same in the tree: a click selects the members, buttons hide the others and show everything again.
  const row = page.getByTestId("tree-group-1");
  await expect(row).toContainText("top edge");
  await row.getByRole("button", { name: "Show only top edge" }).click();
  const other = page.getByTestId("tree-point-7");
  await expect(other.getByRole("button", { name: /^Show/ })).toBeVisible();
  await expect(page.getByTestId("tree-point-6").getByRole("button", { name: /^Hide/ })).toBeVisible();
  await page.getByTestId("groups-show-all").click();
  await expect(other.getByRole("button", { name: /^Hide/ })).toBeVisible();
  await expect(page.getByTestId("show-hidden")).toBeHidden();
  const hide = row.getByRole("button", { name: "Hide top edge" });
  await hide.click();
  await page.getByRole("button", { name: "Show 2 hidden" }).click();
  await expect(hide).toBeVisible();
  await page.getByTestId("tree-point-7").click();
  await row.click();
  await expect(page.getByText("2 entities selected")).toBeVisible();

  await tab(page, "History").click();
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

sharedTest(
  "bodies are edited together; their sizes use parameters, and the estimate names what it leaves out",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const bodies = [1, 2].map((id) => {
      const name = `a part with a name as long as those of files ${id}`;
      const surface = boxSurface(2, [2 * id, 0, 0], [2 * id + 1, 1, 1]);
      return createBody(surface, { id, firstPatchId: 100 + id, name });
    });
    const project = { ...cubeProject(), bodies, meshing: { size: 0.5 } };
    await dropBytes(page, new TextEncoder().encode(writeProject(project)), "parts.json");
    await expect(page.getByTestId("tree-body-2")).toContainText("remesh");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Escape");
    await app.page.getByTestId("new-parameter-name").fill("h");
    await app.page.getByTestId("new-parameter-expression").fill("0.25");
    await page.keyboard.press("Enter");

    const both = async (): Promise<void> => {
      await page.getByTestId("tree-body-1").click();
      await page.getByTestId("tree-body-2").click({ modifiers: ["Control"] });
    };
    const setSize = async (id: number, size: string): Promise<void> => {
      await page.getByTestId(`tree-body-${id}`).click();
      await app.type("remeshing-size", size);
    };
    // The hint names what all of them have, and a step suits the smallest of the values.
    const hint = page.getByTestId("common-fields");
    await setSize(1, "0.02");
    await both();
    await expect(hint).toContainText("scale means each entity's own value");
    await setSize(2, "0.25");
    await both();
    await expect(hint).toContainText("scale and size mean each entity's own value");
    await page.getByTestId("common-remeshing-size").press("ArrowUp");
    for (const [id, size] of [
      [1, "0.021"],
      [2, "0.251"],
    ] as const) {
      await page.getByTestId(`tree-body-${id}`).click();
      await expect(page.getByTestId("remeshing-size")).toHaveValue(size);
    }
    await page.getByTestId("viewport-canvas").focus();
    for (let step = 0; step < 3; ++step) await page.keyboard.press("Control+z");

    await both();
    await expect(page.getByTestId("common-remeshing-size")).toHaveAttribute("placeholder", "automatic");
    await app.type("common-remeshing-size", "2*h");
    await page.getByTestId("common-treatment").getByText("Keep").click();
    await expect(page.getByTestId("common-remeshing-size")).toHaveCount(0);
    await page.getByTestId("common-treatment").getByText("Remesh").click();
    await expect(page.getByTestId("common-remeshing-size")).toHaveValue("0.5");
    await expect(page.getByTestId("count-expected")).toContainText(
      /tetrahedra without (2 bodies|a part with)/,
    );

    await page.getByTestId("tree-body-2").click();
    await expect(page.getByTestId("remeshing-size")).toHaveAttribute("data-expression", "2*h");
    await page.getByTestId("body-placement").locator("summary").click();
    await app.type("placement-position-x", "4*h");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Escape");
    await app.type("parameter-h", "0.5");
    await page.getByTestId("tree-body-2").click();
    await expect(page.getByTestId("remeshing-size")).toHaveValue("1");
    await expect(page.getByTestId("placement-position-x")).toHaveValue("2");
  },
);

test("pieces and circles made from expressions follow their parameters", async ({ page }) => {
  const app = new AppPage(page);
  await page.addInitScript(() => {
    Reflect.deleteProperty(window, "showOpenFilePicker");
    Reflect.deleteProperty(window, "showSaveFilePicker");
  });
  await page.goto("./?new=1&test=1");
  await expect(app.viewport).toHaveAttribute("data-status", "none");
  await page.getByTestId("new-parameter-name").fill("r");
  await page.getByTestId("new-parameter-expression").fill("1");
  await page.keyboard.press("Enter");
  await page.getByTestId("create-cylinder").click();
  const radius = page.getByTestId("operation-radius");
  await radius.fill("2*r");
  await page.getByTestId("operation-position-x").fill("-r");
  await expect(radius).toHaveAttribute("data-expression", "2*r");
  await radius.focus();
  await expect(radius).toHaveValue("2*r");
  await page.getByTestId("accept").click();
  await expect(app.viewport).toHaveAttribute("data-points", "6");

  await page.getByTestId("tool-line").click();
  await page.getByTestId("drawing-bar").getByText("circle", { exact: true }).click();
  const canvas = page.getByTestId("viewport-canvas");
  await canvas.focus();
  for (const typed of ["(r),9,0", "(r)/2"]) {
    await page.keyboard.type(typed);
    await page.keyboard.press("Enter");
  }
  await expect(app.viewport).toHaveAttribute("data-points", "9");

  await canvas.focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await app.type("parameter-r", "2");
  await canvas.focus();
  const saved = readProject(
    new TextDecoder().decode(await downloaded(page, () => page.keyboard.press("Control+s"))),
  );
  if (!saved.success) throw new Error(saved.errors[0].message);
  const positions = saved.value.points.map(({ position }) => position);
  for (const [x, y, z] of positions.slice(0, 6)) {
    expect(Math.hypot(x + 2, y)).toBeCloseTo(4, 12);
    expect(z).toBeCloseTo(z > 0 ? 1 : 0, 12);
  }
  for (const [x, y, z] of positions.slice(6)) {
    expect(Math.hypot(x - 2, y - 9)).toBeCloseTo(1, 12);
    expect(z).toBe(0);
  }
});

sharedTest(
  "lengths are typed in any unit, and another unit of the project converts or keeps the numbers",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const unit = page.getByTestId("project-unit");
    const choose = async (name: string): Promise<void> => {
      await unit.click();
      await page.getByRole("option", { name, exact: true }).click();
    };
    await choose("not stated");
    await app.select("point-5");
    const z = page.getByTestId("position-z");
    await app.type("position-z", "1 in");
    await expect(page.getByText("Choose the length unit of the project first")).toBeVisible();
    await z.press("Escape");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Escape");
    await choose("mm");
    await app.select("point-5");
    await app.type("position-z", "1/2 in");
    await z.blur();
    await expect(z).toHaveValue("12.7");
    await expect(z).toHaveAttribute("data-expression", "1/2 in");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Escape");

    await choose("inch");
    await expect(page.getByTestId("unit-question")).toContainText("1 mm becomes");
    await page.getByTestId("unit-convert").click();
    await expect(unit).toHaveValue("inch");
    await app.select("point-5");
    await expect(z).toHaveValue("0.5");
    await expect(z).toHaveAttribute("data-expression", "1/2 in");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Escape");
    await choose("mm");
    await page.getByTestId("unit-relabel").click();
    await expect(unit).toHaveValue("mm");
    await app.select("point-5");
    await expect(z).toHaveValue("0.5");
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await expect(z).toHaveValue("12.7");
  },
);
