import { readFile } from "node:fs/promises";
import { expect, type Page } from "@playwright/test";
import { PROJECT_FORMAT, PROJECT_VERSION } from "tetrafront/project";
import { DrawPage } from "./draw-page";
import { acceptOperation, startOperation } from "./operations";
import { sharedTest } from "./shared-page";

type Corner = readonly [number, number, number];

const square = (half: number, z: number | string): readonly (readonly (number | string)[])[] => [
  [-half, -half, z],
  [half, -half, z],
  [half, half, z],
  [-half, half, z],
];

/**
 * Lines 1 to 4 and 5 to 8 are squares of the half sides 1 and 2, the second one at the height h; lines 9 and 10 are a path from the
 * first one up to the height h and sideways by 4.
 */
function drawnProject(): string {
  const positions = [...square(1, 0), ...square(2, "h"), [0, 0, 0], [0, 0, "h"], [4, 0, "h"]];
  const h = 2;
  const lines = [0, 4].flatMap((first) =>
    [0, 1, 2, 3].map((k) => [first + 1 + k, first + 1 + ((k + 1) % 4)] as const),
  );
  return JSON.stringify({
    format: PROJECT_FORMAT,
    version: PROJECT_VERSION,
    name: "drawn loops",
    points: positions.map((position, p) => ({
      id: p + 1,
      position: position.map((x) => (typeof x === "number" ? x : h)) as unknown as Corner,
    })),
    lines: [...lines, [9, 10], [10, 11]].map((points, l) => ({ id: l + 1, type: "straight", points })),
    patches: [],
    parameters: [{ name: "h", expression: String(h) }],
    expressions: positions.flatMap((position, p) =>
      position[2] === "h" ? [{ kind: "point", id: p + 1, field: "position.2", expression: "h" }] : [],
    ),
  });
}

async function openDrawn(page: Page): Promise<DrawPage> {
  const app = new DrawPage(page);
  await app.openNew();
  await app.openFile("drawn.json", drawnProject());
  await expect(page.getByTestId("tree-line-10")).toBeVisible();
  return app;
}

async function selectLines(page: Page, ids: readonly number[]): Promise<void> {
  for (const [k, id] of ids.entries())
    await page.getByTestId(`tree-line-${id}`).click(k === 0 ? {} : { modifiers: ["Control"] });
}

async function computed(page: Page): Promise<void> {
  await expect(page.getByTestId("operation")).not.toHaveAttribute("data-pending", "true", {
    timeout: 60_000,
  });
}

const volume = async (page: Page): Promise<number> =>
  parseFloat((await page.getByTestId("body-volume").textContent()) ?? "");

const frustum = (height: number): number => (height / 3) * 4 * (1 + 2 + 4);

sharedTest("drawn loops become a loft that follows the parameters of their points", async ({ page }) => {
  const app = await openDrawn(page);
  await selectLines(page, [1]);
  await startOperation(page, "Loft…");
  const panel = page.getByTestId("operation");
  await expect(panel.getByRole("status")).toContainText("two or more closed loops");
  // The panel follows the selection, and the view shows the solid before it is accepted.
  await selectLines(page, [1, 2, 3, 4, 5, 6, 7, 8]);
  await page.getByTestId("operation-isRuled").click({ force: true });
  await computed(page);
  await expect(page.getByTestId("operation-note")).toContainText("Through Line 1, Line 5");
  await expect(page.getByTestId("piece-operation").getByText("New")).toBeVisible();
  await expect(app.viewport).toHaveAttribute("data-solids", "1");
  await acceptOperation(page);
  await expect.poll(() => volume(page)).toBeCloseTo(frustum(2), 1);
  await expect(page.getByTestId("feature-list").getByRole("listitem")).toHaveCount(1);
  await expect(page.getByTestId("feature-1")).toContainText("Loft 1");

  const setHeight = async (expression: string): Promise<void> => {
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    await page.getByTestId("parameter-h").fill(expression);
    await page.getByTestId("parameter-h").press("Enter");
    await page.getByTestId("tree-body-1").click();
  };
  await setHeight("5");
  await expect.poll(() => volume(page)).toBeCloseTo(frustum(5), 1);

  // Both loops coincide: that is said at the feature, and the solid stays as it was.
  await setHeight("0");
  await expect(page.getByTestId("feature-1").getByRole("alert")).toContainText("loops are apart");
  await page.keyboard.press("Control+z");
  await expect(page.getByTestId("feature-1").getByRole("alert")).toBeHidden();
  await expect.poll(() => volume(page)).toBeCloseTo(frustum(5), 1);

  await page.reload();
  await page.getByTestId("tree-body-1").click();
  await expect.poll(() => volume(page)).toBeCloseTo(frustum(5), 1);
  await page.getByTestId("feature-1").dblclick();
  await expect(page.getByTestId("operation-isRuled")).toBeChecked();
});

sharedTest("a drawn loop is swept along drawn lines, and cut from the solid there", async ({ page }) => {
  const app = await openDrawn(page);
  await startOperation(page, "Box…");
  await page.getByTestId("piece-operation").getByText("New").click();
  for (const key of ["width", "depth", "height"]) {
    await page.getByTestId(`operation-${key}`).fill("3");
    await page.getByTestId(`operation-${key}`).press("Tab");
  }
  await computed(page);
  await acceptOperation(page);
  await expect.poll(() => volume(page)).toBeCloseTo(27, 6);
  await selectLines(page, [1, 2, 3, 4, 9, 10]);
  await startOperation(page, "Sweep along lines…");
  await computed(page);
  await expect(page.getByTestId("operation-note")).toContainText("Along 2 lines");
  await page.getByTestId("piece-operation").getByText("Cut").click();
  await computed(page);
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("operation")).toBeHidden();
  // Within the box, the sweep has the height 3 above the square, and 2 beside it up to the side.
  await expect.poll(() => volume(page)).toBeCloseTo(27 - 4 * 3 - 2 * 0.5 * 2, 6);
  await expect(page.getByTestId("feature-2")).toContainText("cut");
  await expect(app.viewport).toHaveAttribute("data-lines", "4");
  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-lines", "10");
  await page.keyboard.press("Control+Shift+z");
  await expect(app.viewport).toHaveAttribute("data-lines", "4");
});

sharedTest("a solid explodes into patches that can be edited", async ({ page }) => {
  const app = new DrawPage(page);
  await app.openNew();
  await startOperation(page, "Cylinder…");
  await page.getByTestId("piece-operation").getByText("New").click();
  await computed(page);
  await acceptOperation(page);
  await expect(app.viewport).toHaveAttribute("data-solids", "1");
  await page.getByText("Explode into patches…").click();
  await computed(page);
  await expect(page.getByTestId("operation-note")).toContainText("3 faces keep their exact shape");
  await expect(app.viewport).toHaveAttribute("data-patches", "3");
  await acceptOperation(page);
  await expect(app.viewport).toHaveAttribute("data-solids", "0");
  await expect(page.locator("[data-testid^=tree-patch-]").getByText("Cylinder 1 side")).toBeVisible();
  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-solids", "1");
  await expect(app.viewport).toHaveAttribute("data-patches", "0");
});

sharedTest("curved patches are sewn to a solid, which is cut and meshed", async ({ page }) => {
  const app = new DrawPage(page);
  await app.openNew();
  const barrel = await readFile("public/models/barrel.json", "utf8");
  await app.openFile("barrel.json", barrel);
  await expect(page.getByTestId("tree-patch-1")).toBeVisible();
  await startOperation(page, "Sew patches to a solid…");
  await computed(page);
  await expect(page.getByTestId("operation-note")).toContainText("kept as they are drawn");
  await acceptOperation(page);
  await expect.poll(() => volume(page)).toBeCloseTo(3.28, 1);
  await expect(page.getByTestId("tree-patch-1")).toHaveCount(0);
  await startOperation(page, "Hole…");
  await computed(page);
  await acceptOperation(page);
  await expect(page.getByTestId("feature-2")).toContainText("Hole 1");
  const { tets } = await app.generate();
  expect(tets).toBeGreaterThan(100);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await expect(page.getByTestId("tree-patch-1")).toBeVisible();
});
