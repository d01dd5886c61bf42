import { expect } from "@playwright/test";
import type { Project } from "tetrafront/project";
import { AppPage, countOrange, nextFrame, sampleProject } from "./app-page";
import { generateButton } from "./controls";
import { sharedTest } from "./shared-page";

sharedTest(
  "a problem of a model is shown in the inspector, in the view and in the list",
  async ({ page }) => {
    const app = new AppPage(page);
    const before = await app.openCube();
    await app.select("point-7");
    await app.type("position-x", "1.5");
    const tree = page.getByTestId("tree-patch-2");
    await expect(tree.getByRole("img", { name: "1 problem" })).toBeVisible();
    await tree.click();
    await expect(page.getByTestId("inspector")).toContainText("right");
    await expect(page.getByTestId("inspector").locator("[data-code=not-planar]")).toContainText(/plan/);
    await expect(page.getByTestId("marker-0")).toBeVisible();

    await generateButton(page).click();
    await expect(page.getByTestId("status")).toContainText("The model has errors");
    await expect(page.getByTestId("problem-0")).toBeVisible();
    // The last mesh is still shown, as out of date.
    await expect(app.viewport).toHaveAttribute("data-stale", "true");
    expect(await app.mesh()).toEqual(before);

    await page.getByTestId("tree-point-1").or(page.getByTestId("tree-line-1")).first().click();
    await page.getByTestId("problem-0").getByRole("button", { name: "Show" }).click();
    await expect(page.locator('[role="treeitem"][aria-selected="true"]')).toHaveCount(1);
    await expect(page.getByTestId("inspector").locator("[data-code]")).not.toHaveCount(0);

    await page.getByRole("button", { name: /^Undo/ }).click();
    await expect(page.getByTestId("marker-0")).toBeHidden();
    await expect(page.getByText("No problems found.")).toBeVisible();
    expect(await app.meshed()).toEqual(before);
  },
);

sharedTest("an open surface is reported immediately", async ({ page }) => {
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

sharedTest("an invalid value stays in its field, with the reason", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-1");
  await app.type("node-size", "-1");
  await expect(page.getByText("Must be above 0")).toBeVisible();
  await expect(page.getByTestId("node-size")).toHaveValue("-1");
  await expect(app.viewport).toHaveAttribute("data-stale", "false");
  await page.getByTestId("node-size").press("Escape");
  await expect(page.getByTestId("node-size")).toHaveValue("0.16");
  await app.type("node-size", "a tenth");
  await expect(page.getByText("Enter a number, such as 0.25 or 1/3")).toBeVisible();
});

sharedTest("deleting a point deletes its dependents, and undo restores them all", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.openCube();
  await app.select("point-1");
  await page.getByTestId("tree-point-1").press("Delete");
  await expect(page.getByTestId("tree-point-1")).toBeHidden();
  await expect(page.getByTestId("tree-line-1")).toBeHidden();
  await page.getByRole("button", { name: "Undo: Delete point 1 and 6 dependent entities" }).click();
  await expect(page.getByTestId("tree-line-1")).toBeVisible();
  expect(await app.meshed()).toEqual(before);
});

sharedTest(
  "each triangle of a self-intersecting boundary is listed with its position and can be shown in the view",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    // Two patches between the same parabolas, closer together than such coarse triangles can resolve.
    const positions = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [0.5, -0.152, -0.25],
      [0.5, 0.5, -0.36],
      [0.012, 0.5, -0.04],
    ];
    const crescent = {
      ...sampleProject("barrel"),
      points: positions.map((at, i) => ({ id: i + 1, position: at })),
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
    await expect(first).toContainText("The surface intersects itself: patch");
    await first.getByTestId("triangles").locator("summary").click();
    const rows = first.getByRole("listitem");
    expect(await rows.count()).toBeGreaterThan(1);
    await expect(rows.first()).toContainText(/Triangle \d+ at -?\d/);
    const before = await app.viewport.screenshot();
    await nextFrame(app.viewport, () => rows.first().getByRole("button").click());
    await expect(rows.first().getByRole("button")).toHaveAttribute("aria-pressed", "true");
    await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
    // The view is centred near the stated position of the triangle.
    const text = (await rows.first().textContent()) ?? "";
    const position = text.split(" at ")[1]?.split(", ").map(Number);
    const box = await app.viewport.boundingBox();
    const { x, y } = await page.evaluate((at) => {
      const { tetrafrontPosition } = window as unknown as {
        tetrafrontPosition: (at: unknown) => { x: number; y: number };
      };
      return tetrafrontPosition(at);
    }, position);
    expect(Math.abs(x - (box?.width ?? 0) / 2)).toBeLessThan(0.15 * (box?.width ?? 0));
    expect(Math.abs(y - (box?.height ?? 0) / 2)).toBeLessThan(0.15 * (box?.height ?? 0));
  },
);

/**
 * Returns a ring of three straight bars with a patch, "gate", across one of them; the same region lies on both
 * sides of it.
 */
function ringWithGate(): Project {
  const points = [0, 1, 2].flatMap((corner) => {
    const [x = 0, y = 0] = [
      [0, 0],
      [4, 0],
      [2, 3],
    ][corner] as number[];
    const within = (share: number) => [2 + share * (x - 2), 1 + share * (y - 1)] as const;
    // Outer and inner, each below and above.
    return [within(1), within(0.4)].flatMap(([u, v]) => [
      [u, v, 0],
      [u, v, 0.8],
    ]);
  });
  const lines: { id: number; type: "straight"; points: number[] }[] = [];
  const line = (a: number, b: number): number => {
    const known = lines.find(({ points: ends }) => ends.includes(a) && ends.includes(b));
    if (known) return known.points[0] === a ? known.id : -known.id;
    lines.push({ id: lines.length + 1, type: "straight", points: [a, b] });
    return lines.length;
  };
  const loop = (...nodes: number[]) => nodes.map((node, i) => line(node, nodes[(i + 1) % nodes.length] ?? 0));
  // Points of a corner in order around the section of the bar.
  const section = (corner: number) => [1, 2, 4, 3].map((k) => 4 * (corner % 3) + k);
  const loops = [0, 1, 2].flatMap((corner) => {
    const [here, there] = [section(corner), section(corner + 1)];
    return [0, 1, 2, 3].map((k) => {
      const next = (k + 1) % 4;
      return loop(here[k] ?? 0, there[k] ?? 0, there[next] ?? 0, here[next] ?? 0);
    });
  });
  return {
    ...sampleProject("unit-cube"),
    points: points.map(([x = 0, y = 0, z = 0], i) => ({ id: i + 1, position: [x, y, z] })),
    patches: [...loops, loop(...section(0))].map((sides, i) => ({
      id: i + 1,
      type: "planar",
      loops: [sides],
      ...(i === loops.length && { name: "gate" }),
    })),
    lines,
    meshing: { size: 0.4 },
  };
}

sharedTest("a dangling sheet inside a region is highlighted in the view", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const project = ringWithGate();
  await app.openFile("ring.json", JSON.stringify(project));
  await expect(page.locator("[data-code=dangling-sheet]").first()).toContainText("gate");
  // The gate is highlighted: nothing else in the picture has the colour of problems.
  await page.keyboard.press("f");
  const orange = async (): Promise<number> => countOrange(await app.viewport.screenshot());
  await expect.poll(orange).toBeGreaterThan(100);
  const { width = 0, height = 0 } = (await app.viewport.boundingBox()) ?? {};
  expect(await orange()).toBeLessThan(0.1 * width * height);
});
