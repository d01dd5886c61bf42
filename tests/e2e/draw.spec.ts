import { expect, test } from "@playwright/test";
import { meshVolume, NO_DEFECTS } from "../support/check-mesh";
import { DrawPage } from "./draw-page";
import type { Position } from "./app-page";
import { generateButton } from "./controls";

const { extraFaces: _, ...noDefects } = NO_DEFECTS;

/** The corners of a unit square, the first one repeated. */
const square = (z: number): Position[] => [[0, 0, z], [1, 0, z], [1, 1, z], [0, 1, z], [0, 0, z]]; // prettier-ignore

async function drawCubeLines(draw: DrawPage): Promise<void> {
  await draw.page.keyboard.press("l");
  await expect(draw.viewport).toHaveAttribute("data-tool", "line");
  for (const corner of square(0)) await draw.click(corner);
  await draw.counts(4, 4, 0);
  await draw.typeCoordinates("0,0,1", "@1,0,0", "1,1,sin(90)", "@-1,0", "0,0,1");
  await draw.counts(8, 8, 0);
  for (const [x, y] of square(0).slice(0, 4)) {
    await draw.click([x, y, 0]);
    await draw.click([x, y, 1]);
    await draw.page.keyboard.press("Enter");
  }
  await draw.counts(8, 12, 0);
}

test("a unit cube drawn in the view, with pointer and keyboard alone, gives a valid mesh", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await drawCubeLines(draw);
  await page.getByTestId("tool-patch").click();
  // The sides that face the eye first: a filled loop lets the pointer through to the loops behind it.
  const sides: Position[] = [[0.5, 0.5, 1], [0.5, 0, 0.5], [1, 0.5, 0.5], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 1, 0.5]]; // prettier-ignore
  for (const [count, side] of sides.entries()) {
    await draw.hover(side);
    await draw.click(side);
    await draw.counts(8, 12, count + 1);
  }
  const { mesh, defects } = await draw.downloadedMesh("0.3", "Unit cube, line by line");
  expect(defects).toEqual(noDefects);
  expect(meshVolume(mesh)).toBeCloseTo(1, 9);
});

test("a sphere of eight octants: three arcs, a patch and three mirror images give a valid mesh", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  await page.getByTestId("drawing-bar").getByText("arc", { exact: true }).click();
  await page.getByTestId("viewport-canvas").focus();
  const half = "1/sqrt(2)";
  await draw.typeCoordinates("1,0,0", `${half},${half},0`, "0,1,0");
  await draw.typeCoordinates("0,1,0", `0,${half},${half}`, "0,0,1");
  await draw.typeCoordinates("0,0,1", `${half},0,${half}`, "1,0,0");
  await draw.counts(6, 3, 0);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.getByTestId("tree-line-1").click();
  for (const id of [2, 3]) await page.getByTestId(`tree-line-${id}`).click({ modifiers: ["Control"] });
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Shift+A");
  await draw.counts(6, 3, 1);
  for (const [normal, points, lines, patches] of [
    ["X", 9, 5, 2],
    ["Y", 13, 8, 4],
    ["Z", 18, 12, 8],
  ] as const) {
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+a");
    await page.keyboard.press("Control+k");
    await page.keyboard.type("Mirror…");
    await page.keyboard.press("Enter");
    await page.getByTestId("operation-normal").getByText(normal, { exact: true }).click();
    await page.getByTestId("accept").click();
    await draw.counts(points, lines, patches);
  }
  const { mesh, defects } = await draw.downloadedMesh("0.3", "Sphere of eight octants, by arcs");
  expect(defects).toEqual(noDefects);
  // Larger than the octahedron of its corners, smaller than the ball.
  expect(meshVolume(mesh)).toBeGreaterThan(1.5 * (4 / 3));
  expect(meshVolume(mesh)).toBeLessThan((4 / 3) * Math.PI);
});

test("the handles of a piece change its sizes and its place before it is created", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.getByTestId("create-box").click();
  const drag = async (from: Position, to: Position): Promise<void> => {
    await draw.hover(from);
    await page.mouse.down();
    await draw.hover(to);
    await page.mouse.up();
  };
  await drag([0, 0, 1], [0, 0, 1.5]);
  await expect(page.getByTestId("operation-height")).toHaveValue("1.5");
  await drag([0.5, 0, 0.75], [0.75, 0, 0.75]);
  await expect(page.getByTestId("operation-width")).toHaveValue("1.5");
  await drag([0, 0, 0], [0.5, -0.5, 0]);
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("operation")).toBeHidden();
  await draw.counts(8, 12, 6);
  const positions = await draw.savedPositions();
  expect(positions).toContainEqual([-0.25, -1, 0]);
  expect(positions).toContainEqual([1.25, 0, 1.5]);
  await page.keyboard.press("Control+z");
  await draw.counts(0, 0, 0);
});

test("a drag selects in a box, Shift pans instead, and the right button has a menu", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openCube();
  const box = await draw.viewport.boundingBox();
  if (!box) throw new Error("There is no view");
  const selected = page.locator('[role="treeitem"][aria-selected="true"]');
  const corner = await draw.at([0, 0, 0]);
  const drag = async (): Promise<void> => {
    await page.mouse.move(corner.x - 8, corner.y - 8);
    await page.mouse.down();
    await page.mouse.move(corner.x + 8, corner.y + 8, { steps: 4 });
    await page.mouse.up();
  };
  await drag();
  await expect(selected).toHaveCount(1);
  expect(await draw.at([0, 0, 0])).toEqual(corner);
  await page.keyboard.down("Shift");
  await drag();
  await page.keyboard.up("Shift");
  await expect.poll(() => draw.at([0, 0, 0])).not.toEqual(corner);
  await expect(selected).toHaveCount(1);
  await draw.click([0, 0, 0]);
  const moved = await draw.at([0, 0, 0]);
  await page.mouse.click(moved.x, moved.y, { button: "right" });
  const menu = page.getByTestId("context-menu");
  await menu.getByRole("menuitem", { name: /Select what is connected/ }).click();
  await expect(menu).toBeHidden();
  await expect(page.getByTestId("inspector")).toContainText("26 entities selected");
  await page.keyboard.press("Control+i");
  await expect(page.getByTestId("inspector")).not.toContainText("entities selected");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await expect(page.getByTestId("inspector")).toContainText("26 entities selected");
});

test("open edges are one quiet count until a mesh is asked for", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  for (const corner of square(0)) await draw.click(corner);
  await page.getByTestId("tool-patch").click();
  await draw.hover([0.5, 0.5, 0]);
  await draw.click([0.5, 0.5, 0]);
  await draw.counts(4, 4, 1);
  await expect(page.getByTestId("open-edges")).toHaveText("4 open edges");
  await expect(page.getByTestId("marker-0")).toBeHidden();
  await page.getByRole("tab", { name: /^Problems/ }).click();
  const list = page.getByTestId("problem-list");
  const icon = page.getByTestId("tree-line-1").getByRole("img", { name: "1 problem" });
  await expect(list.getByRole("img", { name: "To do" })).not.toHaveCount(0);
  await expect(list.getByRole("img", { name: "Error" })).toHaveCount(0);
  await expect(icon).toHaveAttribute("data-severity", "expected");
  await generateButton(page).click();
  await expect(list.getByRole("img", { name: "Error" })).not.toHaveCount(0);
  await expect(list.getByRole("img", { name: "To do" })).toHaveCount(0);
  await expect(icon).not.toHaveAttribute("data-severity", "expected");
  await expect(page.getByTestId("marker-0")).toBeVisible();
  await expect(page.getByTestId("open-edges")).toBeHidden();
});

test("a notice names what a delete has taken along, and undoes it; F2 renames", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openCube();
  await draw.select("point-1");
  await page.getByTestId("tree-point-1").press("F2");
  await expect(page.getByTestId("entity-name")).toBeFocused();
  await page.keyboard.type("origin");
  await page.keyboard.press("Enter");
  await page.getByTestId("tree-point-1").press("Delete");
  await draw.counts(7, 9, 3);
  const notice = page.getByTestId("notice-deleted");
  await expect(notice).toContainText("Deleted point 1 and 6 dependent entities: line");
  await expect(notice).toContainText("bottom");
  await notice.getByRole("button", { name: "Undo" }).click();
  await draw.counts(8, 12, 6);
  await expect(page.getByTestId("tree-point-1")).toContainText("origin");
});

test("a circle on a face of a patch becomes its hole, and a second click fills it", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  for (const corner of square(0)) await draw.click(corner);
  await page.getByTestId("drawing-bar").getByText("circle", { exact: true }).click();
  await draw.typeCoordinates("0.5,0.5,0", "@0.2,0,0");
  await draw.counts(7, 5, 0);
  await page.getByTestId("tool-patch").click();
  await draw.hover([0.1, 0.1, 0]);
  await draw.click([0.1, 0.1, 0]);
  await draw.counts(7, 5, 1);
  await expect(page.getByTestId("patch-loop-1")).toBeVisible();
  await draw.hover([0.5, 0.5, 0]);
  await draw.click([0.5, 0.5, 0]);
  await draw.counts(7, 5, 2);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await draw.counts(7, 5, 0);
});

test("a circle through three places is refused on a straight line, and goes through them", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  const bar = page.getByTestId("drawing-bar");
  await bar.getByText("circle", { exact: true }).click();
  await page.getByTestId("circle-by").getByText("3 points").click();
  await expect(page.getByTestId("drawing-hint")).toContainText("three places on the circle");
  await draw.click([0, 0, 0]);
  await draw.click([1, 0, 0]);
  await draw.click([2, 0, 0]);
  await expect(page.getByTestId("drawing-hint")).toContainText("straight line");
  await draw.counts(0, 0, 0);
  await draw.click([1, 1, 0]);
  await draw.counts(3, 1, 0);
  await bar.getByText("Centre", { exact: true }).click();
  await draw.typeCoordinates("0,0,0", "1,0,0");
  await draw.counts(5, 2, 0);
  await page.getByTestId("tree-line-1").click();
  await expect(page.getByTestId("line-type")).toHaveValue("circle");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await draw.counts(0, 0, 0);
});

test("Backspace removes the last place, Esc leaves the chain and then the tool, and distances are measured", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.getByTestId("tool-line").click();
  for (const corner of square(0).slice(0, 3)) await draw.click(corner);
  await draw.counts(3, 2, 0);
  await page.keyboard.press("Backspace");
  await draw.counts(2, 1, 0);
  await draw.typeCoordinates("@0,0,2");
  await draw.counts(3, 2, 0);
  await page.keyboard.press("Escape");
  await expect(draw.viewport).toHaveAttribute("data-tool", "line");
  await page.keyboard.press("Escape");
  await expect(draw.viewport).toHaveAttribute("data-tool", "select");
  await page.keyboard.press("m");
  await draw.click([0, 0, 0]);
  await draw.click([1, 0, 2]);
  const measurement = page.getByTestId("measurement");
  await expect(measurement).toHaveText(/distance2\.236dx1dy0dz2/);
  await draw.click([1, 0, 0]);
  await expect(measurement).toContainText("angle26.57°");
});

test("handles move, turn and scale the selection: each drag is one step of undo, and Escape cancels it", async ({
  page,
}) => {
  const app = new DrawPage(page);
  await app.openNew();
  await page.getByTestId("tool-line").click();
  for (const corner of square(0)) await app.click(corner);
  await page.keyboard.press("Escape");
  await page.getByTestId("tool-move").click();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+a");
  await expect(page.getByTestId("inspector")).toContainText("8 entities selected");
  const middle: Position = [0.5, 0.5, 0];
  const before = await app.savedPositions();
  expect(before).toHaveLength(4);

  /** Presses the button on the handle in a direction from the middle, and moves by as much again. */
  const pull = async (direction: Position, share: number): Promise<void> => {
    const reach = share * (await app.handleLength(middle));
    const [from, to] = [reach, 2 * reach].map(
      (by) => middle.map((x, k) => x + by * (direction[k] ?? 0)) as unknown as Position,
    );
    if (!from || !to) return;
    await app.hover(from);
    await page.mouse.down();
    const { x, y } = await app.at(to);
    await page.mouse.move(x, y, { steps: 6 });
  };
  const undoOnce = async (): Promise<void> => {
    await page.keyboard.press("Control+z");
    expect(await app.savedPositions()).toEqual(before);
    await app.counts(4, 4, 0);
  };
  const shifted = (positions: readonly Position[], k: number): number =>
    (positions[k]?.[0] ?? 0) - (before[k]?.[0] ?? 0);

  await pull([1, 0, 0], 0.35);
  await expect(page.getByTestId("amount")).toBeVisible();
  await page.mouse.up();
  const moved = await app.savedPositions();
  expect(shifted(moved, 0)).toBeGreaterThan(0);
  for (const [k, [x, y, z]] of moved.entries()) {
    expect(x - (before[k]?.[0] ?? 0)).toBeCloseTo(shifted(moved, 0), 9);
    expect([y, z]).toEqual(before[k]?.slice(1));
  }
  await undoOnce();

  await pull([1, 0, 0], 0.35);
  await page.keyboard.press("Escape");
  await page.mouse.up();
  expect(await app.savedPositions()).toEqual(before);

  await page.getByTestId("handle-mode").getByText("Rotate").click();
  await pull([Math.SQRT1_2, Math.SQRT1_2, 0], 0.5);
  await page.mouse.up();
  const rotated = await app.savedPositions();
  expect(rotated).not.toEqual(before);
  for (const [k, [x, y, z]] of rotated.entries()) {
    expect(Math.hypot(x - 0.5, y - 0.5, z)).toBeCloseTo(Math.SQRT1_2, 9);
    const next = rotated[(k + 1) % 4] ?? [0, 0, 0];
    expect(Math.hypot(next[0] - x, next[1] - y, next[2] - z)).toBeCloseTo(1, 9);
  }
  await undoOnce();

  await page.getByTestId("handle-mode").getByText("Scale").click();
  await pull([1, 0, 0], 0.35);
  await page.mouse.up();
  const scaled = await app.savedPositions();
  const factor = 1 - 2 * shifted(scaled, 0);
  expect(factor).toBeGreaterThan(1);
  for (const [k, [x, y, z]] of scaled.entries()) {
    expect(x - 0.5).toBeCloseTo(factor * ((before[k]?.[0] ?? 0) - 0.5), 9);
    expect([y, z]).toEqual(before[k]?.slice(1));
  }
  await undoOnce();
});

test("the move tool drags a point as one step of undo, joins what coincides, and arrow keys move the selection", async ({
  page,
}) => {
  const app = new DrawPage(page);
  // Without file dialogs, saving downloads the project.
  await app.openNew();
  const positions = () => app.savedPositions();
  const drag = async (from: Position, to: Position): Promise<void> => {
    await app.hover(from);
    await page.mouse.down();
    const { x, y } = await app.at(to);
    await page.mouse.move(x, y, { steps: 4 });
    await page.mouse.up();
  };
  await page.getByTestId("tool-line").click();
  await app.typeCoordinates("0,0,0", "1,0,0", "0,1,0");
  await page.keyboard.press("Enter");
  await page.getByTestId("tool-move").click();
  await expect(app.viewport).toHaveAttribute("data-tool", "move");
  await drag([1, 0, 0], [1, 1, 0]);
  expect(await positions()).toEqual([
    [0, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
  ]);

  await page.keyboard.press("ArrowUp");
  const [, moved = [0, 0, 0]] = await positions();
  expect(moved[1]).toBeGreaterThan(1);
  expect([moved[0], moved[2]]).toEqual([1, 0]);
  for (let steps = 0; steps < 2; steps++) await page.keyboard.press("Control+z");
  expect(await positions()).toEqual([
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
  ]);

  await drag([1, 0, 0], [0, 1, 0]);
  await expect(app.viewport).toHaveAttribute("data-points", "2");
  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-points", "3");
  await page.keyboard.press("Escape");
  await expect(app.viewport).toHaveAttribute("data-tool", "select");
});

test("a line between the middles of two sides splits them, and each half is a loop", async ({ page }) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  for (const corner of square(0)) await draw.click(corner);
  await draw.counts(4, 4, 0);
  for (const middle of [[0.5, 0, 0], [0.5, 1, 0]] as const) await draw.click(middle); // prettier-ignore
  await draw.counts(6, 7, 0);
  await page.getByTestId("tool-patch").click();
  for (const inside of [
    [0.25, 0.5, 0],
    [0.75, 0.5, 0],
  ] as const) {
    await draw.hover(inside);
    await draw.click(inside);
  }
  await draw.counts(6, 7, 2);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await draw.counts(4, 4, 0);
});

test("typed lines that cross bound four loops; a line is split where its menu is opened", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.keyboard.press("l");
  for (const corner of square(0)) await draw.click(corner);
  await draw.typeCoordinates("0,0.4,0", "1,0.4,0");
  await page.keyboard.press("Escape");
  await draw.typeCoordinates("0.6,0,0", "0.6,1,0");
  await draw.counts(8, 6, 0);
  await page.getByTestId("tool-patch").click();
  await draw.hover([0.3, 0.2, 0]);
  await draw.click([0.3, 0.2, 0]);
  // The point where the lines cross, and a further part of each of the four lines.
  await draw.counts(9, 10, 1);
  await draw.hover([0.8, 0.7, 0]);
  await draw.click([0.8, 0.7, 0]);
  await draw.counts(9, 12, 2);
  await page.keyboard.press("v");
  await expect(draw.viewport).toHaveAttribute("data-tool", "select");
  const { x, y } = await draw.at([0.8, 0.4, 0]);
  await page.mouse.click(x, y, { button: "right" });
  await page.getByTestId("context-menu").getByRole("menuitem", { name: "Split line here" }).click();
  await draw.counts(10, 13, 2);
  const positions = await draw.savedPositions();
  expect(positions.at(-2)?.map((value) => Math.round(value * 1e9) / 1e9)).toEqual([0.6, 0.4, 0]);
  expect(positions.at(-1)?.[0]).toBeCloseTo(0.8, 1);
  expect(positions.at(-1)?.[1]).toBeCloseTo(0.4, 12);
});

test("a circle drawn on a face of a box lies in its plane, by clicks and by a typed radius", async ({
  page,
}) => {
  const draw = new DrawPage(page);
  await draw.openNew();
  await page.getByTestId("create-box").click();
  await page.getByTestId("accept").click();
  await draw.counts(8, 12, 6);
  await page.getByTestId("tool-line").click();
  await page.getByTestId("drawing-bar").getByText("circle", { exact: true }).click();
  await draw.click([0.5, 0, 0.5]);
  await draw.hover([0.5, 0.2, 0.5]);
  await draw.click([0.5, 0.2, 0.5]);
  await draw.counts(11, 13, 6);
  await draw.click([0, -0.5, 0.5]);
  await draw.typeCoordinates("0.25");
  await draw.counts(14, 14, 6);
  const positions = await draw.savedPositions();
  for (const [x, y, z] of positions.slice(8, 11)) {
    expect(x).toBeCloseTo(0.5, 12);
    expect(Math.hypot(y, z - 0.5)).toBeGreaterThan(0.1);
  }
  for (const [x, y, z] of positions.slice(11)) {
    expect(y).toBeCloseTo(-0.5, 12);
    expect(Math.hypot(x, z - 0.5)).toBeCloseTo(0.25, 2);
  }
});
