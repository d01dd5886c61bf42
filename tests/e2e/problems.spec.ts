import { expect, test } from "@playwright/test";
import { AppPage, nextFrame, sampleProject } from "./app-page";

test("a broken model is explained beside the entity, in the view and in the list", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("point-7");
  await app.type("at-x", "1.5");
  const tree = page.getByTestId("tree-patch-2");
  await expect(tree.getByRole("img", { name: "1 problem" })).toBeVisible();
  await tree.click();
  await expect(page.getByTestId("inspector")).toContainText("right");
  await expect(page.getByTestId("inspector").locator("[data-code=not-planar]")).toContainText(/plan/);
  await expect(page.getByTestId("marker-0")).toBeVisible();

  await page.getByTestId("generate").click();
  await expect(page.getByTestId("status")).toContainText("The model has errors");
  await expect(page.getByTestId("issue-0")).toBeVisible();
  // The last mesh stays, marked as out of date.
  await expect(app.viewport).toHaveAttribute("data-stale", "true");
  expect(await app.mesh()).toEqual(before);

  await page.getByTestId("tree-point-1").or(page.getByTestId("tree-line-1")).first().click();
  await page.getByTestId("issue-0").getByRole("button", { name: "Show" }).click();
  await expect(page.locator('[role="treeitem"][aria-selected="true"]')).toHaveCount(1);
  await expect(page.getByTestId("inspector").locator("[data-code]")).not.toHaveCount(0);

  await page.getByRole("button", { name: /^Undo/ }).click();
  await expect(page.getByTestId("marker-0")).toBeHidden();
  await expect(page.getByText("No problems found.")).toBeVisible();
  expect(await app.meshed()).toEqual(before);
});

test("a surface left open is told at once", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("patch-2");
  await page.getByTestId("tree-patch-2").press("Delete");
  await expect(page.getByTestId("tree-line-5").getByRole("img", { name: "1 problem" })).toBeVisible();
  await expect(page.getByTestId("tree-line-1").getByRole("img")).toHaveCount(0);
  await page.getByRole("button", { name: /^Undo/ }).click();
  await expect(page.getByTestId("tree-line-5").getByRole("img")).toHaveCount(0);
  expect(await app.meshed()).toEqual(before);
});

test("a value that cannot be taken stays in its field with the reason", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-1");
  await app.type("bg-size", "-1");
  await expect(page.getByText("Must be above 0")).toBeVisible();
  await expect(page.getByTestId("bg-size")).toHaveValue("-1");
  await expect(app.viewport).toHaveAttribute("data-stale", "false");
  await page.getByTestId("bg-size").press("Escape");
  await expect(page.getByTestId("bg-size")).toHaveValue("0.16");
  await app.type("bg-size", "a tenth");
  await expect(page.getByText("Type a number, such as 0.25 or 1/3")).toBeVisible();
});

test("deleting a point takes what is built on it, and undo brings it all back", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("point-1");
  await page.getByTestId("tree-point-1").press("Delete");
  await expect(page.getByTestId("tree-point-1")).toBeHidden();
  await expect(page.getByTestId("tree-line-1")).toBeHidden();
  await page.getByRole("button", { name: "Undo: Delete point 1 and 6 built on it" }).click();
  await expect(page.getByTestId("tree-line-1")).toBeVisible();
  expect(await app.meshed()).toEqual(before);
});

test("each triangle of a boundary that cuts itself is listed with its place, and shown", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  // Two patches between the same parabolas, nearer to one another than triangles so coarse can keep apart.
  const places = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0.5, -0.152, -0.25],
    [0.5, 0.5, -0.36],
    [0.012, 0.5, -0.04],
  ];
  const crescent = {
    ...sampleProject("barrel"),
    points: places.map((at, i) => ({ id: i + 1, at })),
    lines: [
      { id: 1, type: "parabolic", points: [1, 4, 2] },
      { id: 2, type: "parabolic", points: [2, 5, 3] },
      { id: 3, type: "parabolic", points: [3, 6, 1] },
    ],
    patches: [
      { id: 1, name: "lower", type: "isoparametric-triangle", loops: [[1, 2, 3]] },
      { id: 2, name: "upper", type: "barnhill-gregory-nielson", loops: [[1, 2, 3]] },
    ],
    meshing: { size: 0.5 },
  };
  await app.openFile("crescent.json", JSON.stringify(crescent));
  const group = page.getByTestId("problems-self-intersection");
  const first = group.locator("[data-code=self-intersection]").first();
  await expect(first).toContainText("The surface cuts itself: patch");
  await first.getByTestId("triangles").locator("summary").click();
  const rows = first.getByRole("listitem");
  expect(await rows.count()).toBeGreaterThan(1);
  await expect(rows.first()).toContainText(/Triangle \d+ at -?\d/);
  const before = await app.viewport.screenshot();
  await nextFrame(app.viewport, () => rows.first().getByRole("button").click());
  await expect(rows.first().getByRole("button")).toHaveAttribute("aria-pressed", "true");
  await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
  // The triangle is where it is said to be: in the middle of the view, near the problem's place.
  const text = (await rows.first().textContent()) ?? "";
  const place = text.split(" at ")[1]?.split(", ").map(Number);
  const box = await app.viewport.boundingBox();
  const { x, y } = await page.evaluate((at) => {
    const { tetrafrontPlace } = window as unknown as {
      tetrafrontPlace: (at: unknown) => { x: number; y: number };
    };
    return tetrafrontPlace(at);
  }, place);
  expect(Math.abs(x - (box?.width ?? 0) / 2)).toBeLessThan(0.15 * (box?.width ?? 0));
  expect(Math.abs(y - (box?.height ?? 0) / 2)).toBeLessThan(0.15 * (box?.height ?? 0));
});
