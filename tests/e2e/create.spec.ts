import { expect, test, type Page } from "@playwright/test";
import { readFile } from "node:fs/promises";
import { readProject, type Project } from "tetrafront/project";
import { defectsOf, meshVolume, NO_DEFECTS } from "../support/check-mesh";
import { parseVtu } from "../support/mesh-files";
import { AppPage, nextFrame, sampleProject } from "./app-page";
import { downloadMesh } from "./downloads";
import { generateButton, undoButton } from "./controls";
import { sharedTest } from "./shared-page";

/** Saves the project in the app and returns it. */
async function savedProject(page: Page): Promise<Project> {
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
  const read = readProject(await readFile(await download.path(), "utf8"));
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

async function openEmpty(app: AppPage): Promise<void> {
  const { points, lines, patches, ...rest } = sampleProject("unit-cube");
  expect([points.length, lines.length, patches.length]).toEqual([8, 12, 6]);
  await app.openFile(
    "empty.json",
    JSON.stringify({ ...rest, name: "Empty", points: [], lines: [], patches: [] }),
  );
  await expect(app.page.getByTestId("project-name")).toHaveValue("Empty");
}

/** Adds points through the dialog, with the keyboard. */
async function addPoints(page: Page, positions: readonly (readonly number[])[]): Promise<void> {
  await page.keyboard.press("Shift+P");
  const dialog = page.getByRole("dialog", { name: "New point" });
  await expect(dialog.getByTestId("new-x")).toBeFocused();
  for (const position of positions) {
    for (const [axis, value] of position.entries()) {
      await dialog.getByTestId(`new-${"xyz".charAt(axis)}`).fill(String(value));
    }
    await dialog.getByTestId("add-next").press("Enter");
  }
  await expect(dialog.getByRole("status")).toContainText("Added point");
  await page.keyboard.press("Escape");
  await expect(dialog).toBeHidden();
}

/** Opens a closed group of the tree, so that single rows can be clicked. */
async function choose(page: Page, kind: string, ids: readonly number[]): Promise<void> {
  for (const [index, id] of ids.entries()) {
    const row = page.getByTestId(`tree-${kind}-${id}`);
    await row.click(index === 0 ? {} : { modifiers: ["ControlOrMeta"] });
    await expect(row).toHaveAttribute("aria-selected", "true");
  }
}

const selected = '[role="treeitem"][aria-selected="true"]';

sharedTest("a tetrahedron can be drawn in an empty project, meshed and undone", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await openEmpty(app);
  await addPoints(page, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]); // prettier-ignore
  await expect(page.getByTestId("tree-point-4")).toHaveAttribute("aria-selected", "true");
  // Draw a chain of lines around the base, then the three lines to the apex.
  await choose(page, "point", [1, 2, 3]);
  await page.keyboard.press("l");
  await expect(page.locator(selected)).toHaveCount(2);
  for (const ends of [
    [3, 1],
    [1, 4],
    [2, 4],
    [3, 4],
  ]) {
    await choose(page, "point", ends);
    await page.keyboard.press("l");
  }
  for (const sides of [
    [1, 2, 3],
    [5, 1, 4],
    [6, 2, 5],
    [4, 3, 6],
  ]) {
    await choose(page, "line", sides);
    await page.keyboard.press("a");
  }
  await expect(page.getByTestId("tree-patch-4")).toHaveAttribute("aria-selected", "true");
  await expect(page.getByTestId("patch-type")).toHaveValue("planar");
  expect((await app.generate()).tets).toBeGreaterThan(20);
  const { points, lines, patches } = await savedProject(page);
  expect(points.map(({ position }) => position)).toEqual([
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ]);
  expect(lines.map((line) => line.points)).toEqual([
    [1, 2],
    [2, 3],
    [3, 1],
    [1, 4],
    [2, 4],
    [3, 4],
  ]);
  expect(patches.map(({ loops }) => loops[0]?.length)).toEqual([3, 3, 3, 3]);
  for (let i = 0; i < 4; ++i) await undoButton(page).click();
  await expect(page.getByTestId("tree-patch-1")).toBeHidden();
  await expect(page.getByRole("button", { name: "Undo: Add line 6" })).toBeEnabled();
});

sharedTest("a new project is empty, and new entities appear in the view", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "New project" }).click();
  await expect(page.getByTestId("project-name")).toHaveValue("Untitled");
  await expect(page.getByTestId("model-tree")).toContainText("This project is empty.");
  // The mesh of the previous project is not shown for the new one.
  await expect(app.viewport).toHaveAttribute("data-tets", "0");
  await addPoints(page, [[90, 0, 0], [91, 0, 0], [90, 1, 0]]); // prettier-ignore
  const points = await app.colours();
  await choose(page, "point", [1, 2, 3]);
  await nextFrame(app.viewport, () => page.keyboard.press("l"));
  await choose(page, "point", [3, 1]);
  await nextFrame(app.viewport, () => page.keyboard.press("l"));
  await choose(page, "line", [1, 2, 3]);
  await nextFrame(app.viewport, () => page.keyboard.press("a"));
  await page.keyboard.press("Escape");
  await expect.poll(() => app.colours()).toBeGreaterThan(points);
  for (let i = 0; i < 6; ++i) await undoButton(page).click();
  await expect(page.getByTestId("model-tree")).toContainText("This project is empty.");
  // Undo never leads to another project.
  await expect(undoButton(page)).toBeDisabled();
});

for (const button of ["add", "add-next"]) {
  sharedTest(
    `a new point is not added with the button ${button} while a number is invalid`,
    async ({ page }) => {
      const app = new AppPage(page);
      await app.openCube();
      await page.keyboard.press("Shift+P");
      const dialog = page.getByRole("dialog", { name: "New point" });
      for (const field of ["new-x", "new-y", "new-z"]) {
        const input = dialog.getByTestId(field);
        const before = await input.inputValue();
        await input.fill("12abc");
        await dialog.getByTestId(button).click();
        await expect(dialog).toContainText("Enter a number");
        await expect(input).toBeFocused();
        await input.press("Enter");
        await expect(dialog).toBeVisible();
        await expect(input).toHaveValue("12abc");
        await input.fill(before);
      }
      await dialog.getByTestId("new-x").fill("7.5");
      await dialog.getByTestId("new-x").press("Enter");
      // Enter adds the point, and the next one can be typed.
      await expect(dialog.getByRole("status")).toContainText("Added point 9");
      await expect(dialog.getByTestId("new-x")).toBeFocused();
      await page.keyboard.press("Escape");
      await expect(dialog).toBeHidden();
      await expect(page.getByTestId("position-x")).toHaveValue("7.5");
      await page.getByRole("button", { name: "Undo: Add point 9" }).click();
      await expect(undoButton(page)).toBeDisabled();
    },
  );
}

sharedTest("the dialogs for sizes apply with Enter, but not while a number is invalid", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const runCommand = async (name: string): Promise<void> => {
    await page.keyboard.press("Control+k");
    await page.getByRole("textbox", { name: "Search commands" }).fill(name);
    await page.keyboard.press("Enter");
  };
  for (const { command, field, apply } of [
    { command: "Create covering grid", field: "cover-size", apply: "cover-apply" },
    { command: "Propose sizes", field: "propose-uniform", apply: "propose-apply" },
  ]) {
    await runCommand(command);
    const input = page.getByTestId(field);
    const before = await input.inputValue();
    await expect(page.getByTestId(apply)).toBeEnabled();
    for (const invalid of ["0.2x", "-1"]) {
      await input.fill(invalid);
      await page.getByTestId(apply).click();
      await expect(input).toBeFocused();
      await expect(input).toHaveAttribute("aria-invalid", "true");
    }
    await expect(undoButton(page)).toBeDisabled();
    await input.fill(before);
    await input.press("Enter");
    await expect(input).toBeHidden();
    await expect(undoButton(page)).toBeEnabled();
    await undoButton(page).click();
    await expect(undoButton(page)).toBeDisabled();
  }
});

sharedTest(
  "the inspector and the dialogs state why an entity cannot be created from the selection",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await choose(page, "line", [1, 2]);
    const made = page.getByTestId("create-from-selection");
    await expect(made).toContainText("The lines do not close: only one of them ends at point");
    await expect(made.getByRole("button", { name: "Patch within lines" })).toHaveCount(0);
    await page.keyboard.press("a");
    await expect(page.getByTestId("notice-note")).toContainText(
      /^Patch within lines: .*only one of them ends/,
    );
    await expect(page.getByRole("dialog")).toHaveCount(0);
    await page.getByTestId("add-line").click();
    await expect(page.getByRole("dialog", { name: "New line" })).toContainText("Select its points in order");
  },
);

sharedTest(
  "a patch with a hole can be created from lines in any order, and a hole can be removed and added",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.open("dark", "plate-with-hole");
    const plate = sampleProject("plate-with-hole");
    const bottom = plate.patches.find(({ name }) => name === "bottom");
    const [outer = [], hole = []] = (bottom?.loops ?? []).map((loop) => loop.map(Math.abs));
    if (!bottom) throw new Error("The plate has no bottom");
    await app.select(`patch-${bottom.id}`);
    await page.getByRole("button", { name: "Remove hole 1" }).click();
    await expect(page.getByTestId("patch-loop-1")).toBeHidden();
    await page.getByTestId(`tree-patch-${bottom.id}`).click();
    for (const line of hole) {
      await page.getByTestId(`tree-line-${line}`).click({ modifiers: ["ControlOrMeta"] });
    }
    await page.getByTestId("create-hole").click();
    await expect(page.getByTestId("patch-loop-1")).toBeVisible();
    await page.getByTestId(`tree-patch-${bottom.id}`).press("Delete");
    // Select the hole first and the lines out of order: the outer loop and the order of its lines are still found.
    await choose(page, "line", [hole[2] ?? 0, ...outer.toReversed(), ...hole.filter((_, i) => i !== 2)]);
    await page.getByTestId("create-patch-any").click();
    const again = await app.generate();
    expect(again.tets).toBeGreaterThan(100);
    const { patches } = await savedProject(page);
    const made = patches.at(-1);
    expect(made?.type).toBe("planar");
    expect(made?.loops.map((loop) => loop.map(Math.abs).toSorted((a, b) => a - b))).toEqual(
      [outer, hole].map((loop) => loop.toSorted((a, b) => a - b)),
    );
  },
);

sharedTest(
  "in the tree, Shift selects a range and Ctrl toggles; both add a range, and Ctrl A selects all of a kind",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByTestId("tree-line-2").click();
    for (const [end, count] of [
      [4, 3],
      [6, 5],
      [1, 2],
    ] as const) {
      // prettier-ignore
      await page.getByTestId(`tree-line-${end}`).click({ modifiers: ["Shift"] });
      await expect(page.locator(selected)).toHaveCount(count);
    }
    await page.getByTestId("tree-line-2").click();
    await page.getByTestId("tree-line-8").click({ modifiers: ["ControlOrMeta"] });
    await page.getByTestId("tree-line-2").click({ modifiers: ["ControlOrMeta"] });
    await page.getByTestId("tree-line-5").click({ modifiers: ["ControlOrMeta", "Shift"] });
    await expect(page.locator(selected)).toHaveCount(5);
    await page.getByTestId("tree-line-8").click({ modifiers: ["ControlOrMeta"] });
    await page.getByTestId("tree-line-2").click();
    await page.getByTestId("tree-line-5").click({ modifiers: ["Shift"] });
    await expect(page.locator(selected)).toHaveCount(4);
    await expect(page.getByTestId("inspector")).toContainText("4 entities selected");
    await page.keyboard.press("Shift+ArrowDown");
    await expect(page.locator(selected)).toHaveCount(5);
    await page.getByTestId("tree-line-3").click({ modifiers: ["ControlOrMeta"] });
    await expect(page.locator(selected)).toHaveCount(4);
    await page.keyboard.press("Control+a");
    await expect(page.getByTestId("inspector")).toContainText("12 entities selected");
    await page.keyboard.press("Escape");
    await expect(page.locator(selected)).toHaveCount(0);
  },
);

sharedTest(
  "each type of patch states which lines it needs and why the present lines do not fit",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await app.select("patch-1");
    await expect(page.getByTestId("patch-hint")).toContainText("one plane");
    await page.getByTestId("patch-type").click();
    const expected = [
      [/^planar/, "Any lines that lie in one plane"],
      [/^isoparametric triangle/, "Needs three lines; found 4 lines."],
      [/^serendipity/, "Needs parabolic lines"],
      [/^Barnhill/, "Needs three lines; found 4 lines."],
      [/^Coons/, "Four lines of any type"],
    ] as const;
    for (const [name, text] of expected) {
      await expect(page.getByRole("option", { name })).toContainText(text);
    }
    await page.getByRole("option", { name: /^Barnhill/ }).click();
    await expect(page.getByTestId("inspector")).toContainText("Needs three lines; found 4 lines.");
    await expect(page.getByTestId("inspector").locator("[data-code=wrong-line-count]")).toBeVisible();
    await undoButton(page).click();
    await expect(page.getByTestId("inspector").locator("[data-code]")).toHaveCount(0);
  },
);

sharedTest(
  "the list and the view show the roles of the lines of a Barnhill–Gregory–Nielson patch",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await openEmpty(app);
    await addPoints(page, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]); // prettier-ignore
    await choose(page, "point", [1, 2, 3]);
    await page.keyboard.press("l");
    await choose(page, "point", [3, 1]);
    await page.keyboard.press("l");
    await choose(page, "line", [1, 2, 3]);
    await page.getByTestId("create-patch-barnhill-gregory-nielson").click();
    await expect(page.getByTestId("patch-loop-0")).toHaveValue("1, 2, 3");
    await expect(page.getByTestId("role-2")).toHaveText("F2");
    await expect(page.getByTestId("role-label-F2")).toHaveAttribute("data-line", "2");
    await expect(page.getByTestId("role-label-F2")).toBeVisible();
    await page.getByRole("button", { name: "Make Line 3 F2" }).click();
    await expect(page.getByTestId("patch-loop-0")).toHaveValue("2, 3, 1");
    await expect(page.getByTestId("role-3")).toHaveText("F2");
    await expect(page.getByTestId("role-label-F2")).toHaveAttribute("data-line", "3");
    await page.keyboard.press("Escape");
    await expect(page.getByTestId("role-label-F2")).toBeHidden();
  },
);

/**
 * Saves the mesh in the app; returns it with the defects found by an independent check, except those of the
 * boundary.
 */
async function savedMesh(page: Page) {
  const { points, tetrahedra } = parseVtu(await downloadMesh(page, /VTU/));
  const mesh = {
    points: Float64Array.from(points),
    tetrahedra: Uint32Array.from(tetrahedra.flat()),
  };
  const { extraFaces, ...defects } = defectsOf(mesh, {
    points: new Float64Array(),
    triangles: new Uint32Array(),
  });
  return { mesh, defects, boundaryFaces: extraFaces };
}

sharedTest(
  "a blind bore can be drawn: a hole in a Barnhill–Gregory–Nielson patch, and a tube between its rims along a seam",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await page.getByRole("menuitem", { name: "File" }).click();
    await page.getByRole("menuitem", { name: "New project" }).click();
    const rim = (z: number) => [[0.8, 0.5, z], [0.5, 0.8, z], [0.2, 0.5, z], [0.5, 0.2, z]]; // prettier-ignore
    await addPoints(page, [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], ...rim(0), ...rim(0.25)]); // prettier-ignore
    for (const ends of [
      [1, 2],
      [2, 3],
      [3, 1],
      [1, 4],
      [2, 4],
      [3, 4],
    ]) {
      // prettier-ignore
      await choose(page, "point", ends);
      await page.keyboard.press("l");
    }
    // Close one rim by a click on its first point, the other by the command.
    await page.keyboard.press("7");
    await choose(page, "point", [5, 6, 7, 8]);
    const box = await app.viewport.boundingBox();
    const at = await page.evaluate(() => {
      type Find = (kind: string, id: number) => { x: number; y: number };
      return (window as unknown as { tetrafrontProject: Find }).tetrafrontProject("point", 5);
    });
    await page.keyboard.down("Shift");
    await page.mouse.click((box?.x ?? 0) + at.x, (box?.y ?? 0) + at.y);
    await page.keyboard.up("Shift");
    await expect(page.getByTestId("inspector")).toContainText("4 points, closed");
    await page.keyboard.press("s");
    await choose(page, "point", [9, 10, 11, 12]);
    await page.keyboard.press("Shift+S");
    await expect(page.getByTestId("line-closed")).toBeChecked();
    await expect(page.getByTestId("line-points")).toHaveValue("9, 10, 11, 12, 9");
    await choose(page, "point", [5, 9]);
    await page.keyboard.press("l");
    // Create the face with the hole, the other faces, the wall of the bore and its end.
    await choose(page, "line", [1, 2, 3, 7]);
    await page.getByTestId("create-patch-barnhill-gregory-nielson").click();
    await expect(page.getByTestId("patch-loop-1")).toBeVisible();
    for (const sides of [[1, 4, 5], [2, 5, 6], [3, 4, 6], [7, 8, 9], [8]]) {
      // prettier-ignore
      await choose(page, "line", sides);
      await page.keyboard.press("a");
    }
    await page.keyboard.press("Escape");
    await page.getByText("Uniform", { exact: true }).click();
    await app.type("uniform-size", "0.25");
    expect((await app.generate()).tets).toBeGreaterThan(100);
    const { patches, meshing } = await savedProject(page);
    expect(patches.map(({ type }) => type)).toEqual([
      "barnhill-gregory-nielson",
      ...["planar", "planar", "planar"],
      "coons",
      "planar",
    ]);
    expect(meshing).toEqual({ size: 0.25 });
    const { mesh, defects, boundaryFaces } = await savedMesh(page);
    const { extraFaces: _, ...none } = NO_DEFECTS;
    expect(defects).toEqual(none);
    expect(boundaryFaces).toBeGreaterThan(100);
    // The volume of the bore lies between that of the square inscribed in its rim and that of the circumscribed
    // circle.
    const bore = 8 / 6 - meshVolume(mesh);
    expect(bore).toBeGreaterThan(0.25 * 0.18);
    expect(bore).toBeLessThan(0.25 * Math.PI * 0.09);
  },
);

sharedTest("the inspector closes a spline and opens it again", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("tree-point").click();
  await choose(page, "point", [1, 2, 7, 5]);
  await page.keyboard.press("s");
  const points = page.getByTestId("line-points");
  await expect(points).toHaveValue("1, 2, 7, 5");
  await page.getByTestId("line-closed").click();
  await expect(points).toHaveValue("1, 2, 7, 5, 1");
  await page.getByTestId("line-closed").click();
  await expect(points).toHaveValue("1, 2, 7, 5");
});

sharedTest("two circles are joined by a tube, and a circle becomes an arc", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("tree-point").click();
  await choose(page, "point", [1, 2, 4]);
  await page.getByTestId("create-line-circle").click();
  await expect(page.getByTestId("line-points")).toHaveValue("1, 2, 4, 1");
  await choose(page, "point", [5, 6, 8]);
  await page.keyboard.press("c");
  await expect(page.getByTestId("line-points")).toHaveValue("5, 6, 8, 5");
  const { lines } = await savedProject(page);
  const circles = lines.filter(({ type }) => type === "circle").map(({ id }) => id);
  expect(circles).toHaveLength(2);
  await choose(page, "line", circles);
  await page.keyboard.press("a");
  await expect(page.getByTestId("patch-type")).toHaveValue("tube");
  await expect(page.getByTestId("patch-hint")).toContainText("straight rulings");
  const { patches } = await savedProject(page);
  expect(patches.at(-1)).toMatchObject({ type: "tube", loops: circles.map((id) => [id]) });
  await choose(page, "line", circles.slice(0, 1));
  await page.getByTestId("line-type").click();
  await page.getByRole("option", { name: "arc" }).click();
  await expect(page.getByTestId("line-points")).toHaveValue("1, 2, 4");
});

test("a pasted list becomes points; a drawn and extruded solid needs no size by hand", async ({ page }) => {
  const app = new AppPage(page);
  await page.goto("./?new=1&test=1");
  await expect(app.viewport).toHaveAttribute("data-status", "none");
  await page.keyboard.press("Shift+P");
  const dialog = page.getByRole("dialog", { name: "New point" });
  await expect(dialog.getByTestId("new-x")).toBeFocused();
  await dialog.getByTestId("new-x").evaluate((field) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", "x;y;z\n0;0;0\n1;0;0\n1;1;0\n0;1;0\n");
    field.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  });
  await expect(dialog.getByRole("status")).toHaveText("Added 4 points.");
  await expect(app.viewport).toHaveAttribute("data-points", "4");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-points", "0");
  await page.keyboard.press("Control+Shift+z");

  await choose(page, "point", [1, 2, 3, 4]);
  await page.keyboard.press("l");
  await choose(page, "point", [4, 1]);
  await page.keyboard.press("l");
  await choose(page, "line", [1, 2, 3, 4]);
  await page.getByTestId("create-patch-planar").click();
  // Without a closed surface, the run reports errors, and the status says so until they are mended.
  await generateButton(page).click();
  const status = page.getByTestId("status").getByRole("status").first();
  await expect(status).toHaveText("The model has errors");
  await choose(page, "patch", [1]);
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+k");
  await page.getByRole("dialog").getByRole("textbox", { name: "Search commands" }).fill("extrude");
  await page.keyboard.press("Enter");
  // The distance is typed at once.
  await expect(page.getByTestId("operation-distance")).toBeFocused();
  await page.keyboard.type("0.75");
  await expect(page.getByTestId("operation-distance")).toHaveValue("0.75");
  await page.getByTestId("accept").click();
  await expect(app.viewport).toHaveAttribute("data-patches", "6");
  await expect(status).not.toHaveText("The model has errors");
  await generateButton(page).click();
  await app.meshed();
});

test("the view shows the lines and directions of a Coons patch", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("tree-patch-2").click();
  await expect(page.getByTestId("role-label-F2")).toBeHidden();
  await page.getByTestId("patch-type").click();
  await page.getByRole("option", { name: /Coons/ }).click();
  const angles: number[] = [];
  for (const name of ["F1", "F2", "F3", "F4"]) {
    const label = page.getByTestId(`role-label-${name}`);
    await expect(label).toBeVisible();
    const arrow = label.locator("[data-arrow]");
    angles.push(
      await arrow.evaluate((element) => parseFloat(element.style.transform.replace("rotate(", ""))),
    );
  }
  // F1 and F3 run side by side, and so do F2 and F4.
  const [first = NaN, second = NaN, third = NaN, fourth = NaN] = angles;
  expect(Math.cos(first - third)).toBeGreaterThan(0.5);
  expect(Math.cos(second - fourth)).toBeGreaterThan(0.5);
  // Far away, where there is little room, no label lies on the number of a point.
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Point numbers");
  await page.keyboard.press("Enter");
  await page.getByTestId("tree-patch-2").click();
  await expect(page.getByTestId("role-label-F2")).toBeVisible();
  const { x, y } = await app.at([0.5, 0.5, 0.5]);
  await page.mouse.move(x, y);
  const width = async (): Promise<number> => (await app.at([1, 0, 0])).x - (await app.at([0, 0, 0])).x;
  const before = await width();
  for (let step = 0; step < 6; ++step) await page.mouse.wheel(0, 120);
  await expect.poll(width).toBeLessThan(before / 2);
  const overlaps = (): Promise<string[]> =>
    page.evaluate(() => {
      const rangeOf = (element: Element): DOMRect => {
        const range = document.createRange();
        range.selectNodeContents(element);
        return range.getBoundingClientRect();
      };
      const numbers = [...document.querySelectorAll('[data-testid="point-numbers"] span')];
      return [...document.querySelectorAll('[data-testid^="role-label-"]')].flatMap((label) => {
        const box = label.getBoundingClientRect();
        return numbers.flatMap((number) => {
          const other = rangeOf(number);
          const isApart =
            other.right <= box.left ||
            box.right <= other.left ||
            other.bottom <= box.top ||
            box.bottom <= other.top;
          return isApart ? [] : [`${label.textContent} on ${number.textContent}`];
        });
      });
    });
  await expect.poll(overlaps).toEqual([]);
});

sharedTest(
  "a complete model without sizes is meshed with a size that fits it, as a step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const { background: _, ...cube } = sampleProject("unit-cube");
    await app.openFile("sizeless.json", JSON.stringify({ ...cube, name: "Sizeless" }));
    await expect(page.getByTestId("project-name")).toHaveValue("Sizeless");
    await expect(app.viewport).toHaveAttribute("data-problems", /[1-9]/);
    await generateButton(page).click();
    await app.meshed();
    await expect(undoButton(page)).toHaveAccessibleName(/Set uniform size/);
  },
);
