import { expect, type Page } from "@playwright/test";
import { readProject } from "tetrafront/project";
import { parseMsh, parseVtu } from "../support/mesh-files";
import { measured } from "../support/mesh-measures";
import { plateSurface } from "../support/plate";
import { stlBinary } from "../support/surface-files";
import { boxSurface, sphereSurface } from "../support/surfaces";
import { AppPage } from "./app-page";
import { downloaded, downloadMesh } from "./downloads";
import { dropBytes, dropFiles } from "./drop-bytes";
import { undoButton } from "./controls";
import { sharedTest } from "./shared-page";

const previewed = (page: Page): Promise<void> =>
  expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");

sharedTest(
  "the outer ring of the handles rotates a body about the view's direction, as one step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const plate = plateSurface({ half: 5, thickness: 1, radius: 2, corners: 24 });
    await dropBytes(page, stlBinary(plate), "plate.stl");
    await previewed(page);
    await page.getByTestId("body-placement").locator("summary").click();
    const handles = page.getByTestId("body-placement").getByRole("radiogroup", { name: "Handles" });
    const before = await app.viewport.screenshot();
    await handles.getByText("Rotate", { exact: true }).click();
    await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);

    const middle = await page.evaluate(() => {
      const { tetrafrontPosition } = window as unknown as {
        tetrafrontPosition: (at: readonly number[]) => { x: number; y: number };
      };
      return tetrafrontPosition([0, 0, 0.5]);
    });
    const { x = 0, y = 0, height = 0 } = (await app.viewport.boundingBox()) ?? {};
    // The unit of the handles is 0.2375 of the view's height, and the radius of the outer ring 0.75.
    const radius = 0.75 * 0.2375 * height;
    const at = (degrees: number): [number, number] => {
      const angle = (degrees * Math.PI) / 180;
      return [x + middle.x + radius * Math.cos(angle), y + middle.y - radius * Math.sin(angle)];
    };
    await page.mouse.move(...at(0));
    await page.mouse.move(...at(1));
    await page.mouse.down();
    for (let degrees = 10; degrees <= 90; degrees += 10) await page.mouse.move(...at(degrees));
    await page.mouse.up();

    const angles = async (): Promise<number[]> => {
      const fields = ["x", "y", "z"].map((axis) => page.getByTestId(`placement-rotation-${axis}`));
      return Promise.all(fields.map(async (field) => Number(await field.inputValue())));
    };
    await expect.poll(async () => Math.max(...(await angles()).map(Math.abs))).toBeGreaterThan(20);
    const saved = readProject(
      Buffer.from(await downloaded(page, () => page.keyboard.press("Control+s"))).toString(),
    );
    if (!saved.success) throw new Error(saved.errors[0].message);
    const [, , , w = 1] = saved.value.bodies?.[0]?.placement?.rotation ?? [];
    // About a quarter turn.
    expect((2 * Math.acos(Math.abs(w)) * 180) / Math.PI).toBeGreaterThan(60);
    expect((2 * Math.acos(Math.abs(w)) * 180) / Math.PI).toBeLessThan(120);
    await undoButton(page).click();
    expect(await angles()).toEqual([0, 0, 0]);
    await expect(page.getByTestId("body-placement")).toBeVisible();
  },
);

sharedTest(
  "typed numbers move and rotate a body at its middle: Tab goes to the next number, each is one step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropBytes(page, stlBinary(boxSurface(1, [4, 4, 0], [6, 8, 2])), "block.stl");
    await previewed(page);
    await page.getByTestId("body-placement").locator("summary").click();
    const handles = page.getByTestId("body-placement").getByRole("radiogroup", { name: "Handles" });
    const numbers = (field: string): Promise<number[]> =>
      Promise.all(
        ["x", "y", "z"].map(async (axis) =>
          Number(await page.getByTestId(`placement-${field}-${axis}`).inputValue()),
        ),
      );
    const field = page.getByTestId("coordinates");
    await handles.getByText("Move", { exact: true }).click();
    await app.viewport.focus();
    await page.keyboard.type("0.5");
    await page.keyboard.press("Tab");
    await page.keyboard.type("2");
    await expect(field).toHaveValue("@0.5,2");
    await page.keyboard.press("Enter");
    await expect(field).toBeHidden();
    await expect.poll(() => numbers("position")).toEqual([0.5, 2, 0]);
    await handles.getByText("Rotate", { exact: true }).click();
    await app.viewport.focus();
    await page.keyboard.type("z90");
    await page.keyboard.press("Enter");
    await expect(field).toBeHidden();
    await expect.poll(() => numbers("rotation")).toEqual([0, 0, 90]);
    // The middle, which was at (5.5, 8, 1), stays there.
    await expect.poll(() => numbers("position")).toEqual([11.5, 3, 0]);
    await page.keyboard.press("Escape");
    await expect(handles.getByRole("radio", { name: "None" })).toBeChecked();
    await undoButton(page).click();
    await undoButton(page).click();
    await expect.poll(() => numbers("position")).toEqual([0, 0, 0]);
  },
);

sharedTest("a project with a large body is saved and opened again without a change", async ({ page }) => {
  const sphere = sphereSurface(90);
  const triangles = sphere.triangles.length / 3;
  expect(triangles).toBeGreaterThan(90_000);
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, stlBinary(sphere), "sphere.stl");
  const count = page.getByTestId("body-triangles");
  await expect(count).toHaveText(triangles.toLocaleString("en-US"));
  const volume = (await page.getByTestId("body-volume").textContent()) ?? "";
  await app.type("entity-name", "ball");
  const save = async (): Promise<string> =>
    Buffer.from(await downloaded(page, () => page.keyboard.press("Control+s"))).toString();
  const text = await save();
  const saved = readProject(text);
  if (!saved.success) throw new Error(saved.errors[0].message);
  expect(saved.value.bodies).toHaveLength(1);

  await app.openExample("unit-cube");
  await expect(page.getByTestId("tree-body-1")).toBeHidden();
  await app.openFile("ball.json", text);
  await page.getByTestId("tree-body-1").click();
  await expect(page.getByTestId("entity-name")).toHaveValue("ball");
  await expect(count).toHaveText(triangles.toLocaleString("en-US"));
  await expect(page.getByTestId("body-volume")).toHaveText(volume);
  expect(await save()).toBe(text);
});

sharedTest("a body inside drawn patches and a source are meshed together", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const choosing = page.waitForEvent("filechooser");
  await page.getByTestId("add-body").click();
  const box = boxSurface(2, [0.3, 0.3, 0.3], [0.7, 0.7, 0.7]);
  const file = { name: "box.stl", mimeType: "model/stl", buffer: Buffer.from(stlBinary(box)) };
  await (await choosing).setFiles(file);
  await previewed(page);
  await app.generate();
  // The triangles of the body face outward, so it is a region of its own.
  const whole = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(whole).toMatchObject({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(whole.volume).toBeCloseTo(1, 6);

  await page.getByTestId("mesh-settings").locator("summary").click();
  await page.getByTestId("mesh-settings").getByText("Cavities", { exact: true }).click();
  const coarse = await app.generate();
  const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(volume).toBeCloseTo(1 - 0.4 ** 3, 6);
  const names = parseMsh(await downloadMesh(page, /MSH 4/)).triangles.map(({ name }) => name);
  expect(names.toSorted()).toEqual(["back", "bottom", "box", "front", "left", "right", "top"]);

  await page.getByRole("button", { name: "Add source" }).click();
  await app.type("source-size", "0.02");
  const fine = await app.generate();
  expect(fine.tets).toBeGreaterThan(1.2 * coarse.tets);
  const after = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(after).toMatchObject({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(after.volume).toBeCloseTo(1 - 0.4 ** 3, 6);
});

sharedTest("the elements and nodes of TetGen are dropped together, in any order", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const node = Buffer.from("5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n");
  const ele = Buffer.from("2 4 0\n1 1 2 3 4\n2 2 3 4 5\n");
  await dropFiles(page, { "pair.node": node, "pair.ele": ele });
  await expect(app.viewport).toHaveAttribute("data-tets", "2");
  // Alone, the elements cannot be read.
  await dropBytes(page, ele, "pair.ele");
  await expect(page.getByRole("dialog", { name: "pair.ele could not be opened" })).toContainText(".node");
});
