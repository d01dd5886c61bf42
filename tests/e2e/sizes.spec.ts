import { expect, test } from "@playwright/test";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { NO_DEFECTS, defectsOf, meshVolume } from "../support/check-mesh";
import { parseVtu } from "../support/mesh-files";
import { stlBinary } from "../support/surface-files";
import { sphereSurface } from "../support/surfaces";
import { countActions, expectActions } from "./actions";
import { AppPage, forEachPixel, nextFrame, sampleProject, type Position } from "./app-page";
import { downloaded, downloadMesh } from "./downloads";
import { dropBytes } from "./drop-bytes";
import { sharedTest } from "./shared-page";

type Colour = readonly [red: number, green: number, blue: number];

/** The app with the background grid of its model drawn in the view. */
class SizesPage extends AppPage {
  /** Zooms out until positions are in view. */
  async show(...positions: readonly Position[]): Promise<void> {
    const box = await this.viewport.boundingBox();
    if (!box) throw new Error("there is no view");
    const isInView = async (position: Position): Promise<boolean> => {
      const { x, y } = await this.at(position);
      return x > box.x + 60 && y > box.y + 60 && x < box.x + box.width - 60 && y < box.y + box.height - 30;
    };
    await this.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    const areInView = async (): Promise<boolean> => {
      const seen = await Promise.all(positions.map(isInView));
      if (seen.every(Boolean)) return true;
      await nextFrame(this.viewport, () => this.page.mouse.wheel(0, 200));
      return false;
    };
    await expect.poll(areInView).toBe(true);
  }

  /** The colour of the view at a position. */
  async colourAt(position: Position): Promise<Colour> {
    const { x, y } = await this.at(position);
    let colour: Colour = [0, 0, 0];
    const clip = { x: Math.round(x), y: Math.round(y), width: 1, height: 1 };
    forEachPixel(await this.page.screenshot({ clip }), (...found) => (colour = found));
    return colour;
  }

  async drag(from: Position, to: Position): Promise<void> {
    const [a, b] = [await this.at(from), await this.at(to)];
    await this.page.mouse.move(a.x, a.y);
    await this.page.mouse.down();
    await this.page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2);
    await this.page.mouse.move(b.x, b.y);
    await this.page.mouse.up();
  }

  async typeCoordinates(text: string): Promise<void> {
    await this.page.keyboard.type(text);
    await expect(this.page.getByTestId("coordinates")).toHaveValue(text);
    await this.page.keyboard.press("Enter");
    await expect(this.page.getByTestId("coordinates")).toBeHidden();
  }

  /** Opens an empty project, without native file dialogs. */
  async openNew(): Promise<void> {
    if (await this.openEmptyAgain()) return;
    await this.page.addInitScript(() => {
      Reflect.deleteProperty(window, "showOpenFilePicker");
      Reflect.deleteProperty(window, "showSaveFilePicker");
    });
    await this.page.goto("./?test=1&new=1");
    await expect(this.viewport).toHaveAttribute("data-points", "0");
  }

  /** Opens a project file and waits for its view. */
  async openProject(project: Project): Promise<void> {
    await this.openNew();
    await this.openFile("project.json", writeProject(project));
    await expect(this.viewport).toHaveAttribute("data-points", String(project.points.length));
  }

  /** The project as it would be saved. */
  async project(): Promise<Project> {
    const bytes = await downloaded(this.page, () => this.page.keyboard.press("Control+s"));
    const read = readProject(new TextDecoder().decode(bytes));
    if (!read.success) throw new Error(read.errors[0].message);
    return read.value;
  }

  async downloadedMesh() {
    const { points, tetrahedra } = parseVtu(await downloadMesh(this.page, /^VTU/));
    const mesh = {
      points: Float64Array.from(points),
      tetrahedra: Uint32Array.from(tetrahedra.flat()),
    };
    const empty = { points: new Float64Array(), triangles: new Uint32Array() };
    const { extraFaces: _, ...defects } = defectsOf(mesh, empty);
    return { mesh, defects };
  }
}

const { extraFaces: _, ...noDefects } = NO_DEFECTS;

test("the engine intake's background grid is built by pointer and keyboard, and meshes", async ({ page }) => {
  const app = new SizesPage(page);
  const intake = sampleProject("engine-intake");
  const { nodes, tetrahedra } = intake.background;
  await countActions(page);
  await app.openProject({ ...intake, background: { nodes: [], tetrahedra: [] } });
  await app.show(...nodes.map(({ position }) => position));
  await page.getByTestId("tool-node").click();
  const known = new Set<number>();
  for (const corners of tetrahedra) {
    for (const id of corners) {
      const node = nodes.find((one) => one.id === id);
      if (!node) throw new Error(`there is no node ${id}`);
      // New nodes by their coordinates, existing ones by a click.
      if (known.has(id)) await app.click(node.position);
      else await app.typeCoordinates(node.position.join(","));
      known.add(id);
    }
  }
  await page.keyboard.press("v");
  const positionOf = (id: number): string => nodes.find((one) => one.id === id)?.position.join() ?? "";
  const ids = [...known];
  // Nodes of the same size are selected together.
  const sizeOf = (id: number): number => nodes.find((one) => one.id === id)?.size ?? 0;
  await page.getByLabel("Filter (name, type, id)").fill("node");
  for (const size of new Set(ids.map(sizeOf))) {
    const rows = ids.flatMap((id, index) =>
      sizeOf(id) === size ? [`tree-background-node-${index + 1}`] : [],
    );
    for (const [index, row] of rows.entries())
      await page.getByTestId(row).click({ modifiers: index > 0 ? ["ControlOrMeta"] : [] });
    await app.type(rows.length > 1 ? "common-size" : "node-size", String(size));
  }
  await page.keyboard.press("Control+Enter");
  await app.meshed();
  await expectActions(page, "Background grid of the engine intake");
  const { background } = await app.project();
  // The nodes are numbered in the order in which they were placed.
  expect(background.nodes.map(({ position, size }) => `${position.join()} ${size}`)).toEqual(
    ids.map((id) => `${positionOf(id)} ${sizeOf(id)}`),
  );
  expect(background.tetrahedra.map((corners) => corners.map((corner) => ids[corner - 1]))).toEqual(
    tetrahedra,
  );
  const { defects } = await app.downloadedMesh();
  expect(defects).toEqual(noDefects);
});

sharedTest("an imported STL gets a source drawn by two clicks, which refines the mesh", async ({ page }) => {
  const app = new SizesPage(page);
  await app.openNew();
  await dropBytes(page, stlBinary(sphereSurface(8)), "ball.stl");
  await expect(page.getByTestId("body-card")).toBeVisible();
  // The unit of the file: in a project without one, it becomes that of the project.
  await page.getByTestId("body-unit").click();
  await page.getByRole("option", { name: "mm", exact: true }).click();
  await app.generate();
  const before = await app.mesh();
  await page.getByTestId("tool-source").click();
  await app.click([0.5, 0, 0]);
  await app.click([1, 0, 0]);
  await expect(page.getByTestId("source-size")).toBeVisible();
  await app.type("source-size", "0.05");
  await page.keyboard.press("Escape");
  const { background, units } = await app.project();
  expect(units).toBe("mm");
  expect(background.sources).toHaveLength(1);
  expect(background.sources?.[0]).toMatchObject({ type: "segment", size: 0.05 });
  const after = await app.generate();
  expect(after.tets).toBeGreaterThan(before.tets);
  const { mesh, defects } = await app.downloadedMesh();
  expect(defects).toEqual(noDefects);
  expect(Math.abs(meshVolume(mesh) / ((4 / 3) * Math.PI) - 1)).toBeLessThan(0.1);
});

sharedTest(
  "handles change size and stretching of a node, and undo takes each drag back",
  async ({ page }) => {
    const app = new SizesPage(page);
    await app.openCube();
    await page.getByTestId("tool-node").click();
    await page.keyboard.press("v");
    await app.select("background-node-1");
    // A ball of radius 1 around (-0.5, -0.5, -0.5), with the handle of its direction.
    await app.type("node-size", "2");
    const nodeOf = async () => (await app.project()).background.nodes.find(({ id }) => id === 1);
    const node = await nodeOf();
    expect(node).toMatchObject({ position: [-0.5, -0.5, -0.5], size: 2 });
    expect(node?.stretching ?? 1).toBe(1);
    await app.show([0.5, -0.5, -0.5], [1, -0.5, -0.5]);
    await nextFrame(app.viewport, () => app.drag([0.5, -0.5, -0.5], [1, -0.5, -0.5]));
    await expect.poll(async () => (await nodeOf())?.stretching ?? 1).toBeGreaterThan(1.1);
    await page.getByTestId("viewport-canvas").focus();
    await page.keyboard.press("Control+z");
    await expect.poll(nodeOf).toEqual(node);
  },
);

const isYellow = ([red, green, blue]: Colour): boolean => Math.min(red, green) > blue + 50;

sharedTest(
  "target sizes are shown before meshing on the model and a plane, with a legend",
  async ({ page }) => {
    const app = new SizesPage(page);
    const wing = sampleProject("unit-cube");
    await app.openProject({
      ...wing,
      background: {
        ...wing.background,
        sources: [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 0.02, distance: 0.05, growth: 0.3 }],
      },
    });
    await page.getByTestId("show-sizes").click();
    await expect(page.getByTestId("size-legend")).toContainText("0.02");
    await expect(page.getByTestId("size-bar")).toBeVisible();
    // Small sizes are blue, large ones yellow.
    await expect.poll(async () => isYellow(await app.colourAt([0.9, 0, 0.1]))).toBe(true);
    const [, green, blue] = await app.colourAt([0.1, 0, 0.1]);
    expect(blue).toBeGreaterThan(0.7 * green);
    const slider = page.getByRole("slider", { name: "Position of the plane" });
    await slider.focus();
    await nextFrame(app.viewport, () => page.keyboard.press("ArrowRight"));
    await page.getByTestId("size-bar").getByText("x", { exact: true }).click();
    await page.keyboard.press("Shift+D");
    await expect(page.getByTestId("size-legend")).toBeHidden();
  },
);

sharedTest(
  "a number of elements is reached; without it, the sizes are the given ones again",
  async ({ page }) => {
    const app = new SizesPage(page);
    await app.openCube();
    const { tets: before } = await app.mesh();
    await page.getByRole("switch", { name: "Reach a number of elements" }).click();
    await app.type("elements", "2500");
    expectNear((await app.generate()).tets, 2500);
    const slider = page.getByRole("slider", { name: "Elements" });
    await slider.press("ArrowRight");
    await expect(page.getByTestId("elements")).not.toHaveValue("2500");
    await app.type("elements", "0");
    await expect(page.getByText("Must be a whole number from 1 to 20 million")).toBeVisible();
    await page.getByRole("switch", { name: "Reach a number of elements" }).click();
    await expect(page.getByTestId("elements")).toBeHidden();
    expect((await app.generate()).tets).toBe(before);
  },
);

const expectNear = (count: number, wanted: number): void =>
  expect(Math.abs(count / wanted - 1)).toBeLessThanOrEqual(0.05);

sharedTest("a problem is fixed by its button, and undo brings it back", async ({ page }) => {
  const app = new SizesPage(page);
  const cube = sampleProject("unit-cube");
  await app.openProject({ ...cube, patches: cube.patches.slice(2) });
  await page.getByRole("tab", { name: "Problems" }).click();
  const fix = page.getByTestId("fix-open-edge").first();
  await expect(fix).toHaveAttribute("aria-description", /Adds a planar patch/);
  await page.getByTestId("fix-all-open-edge").click();
  await expect(app.viewport).toHaveAttribute("data-patches", "6");
  await expect(app.viewport).toHaveAttribute("data-problems", "0");
  await page.keyboard.press("Control+z");
  await expect(app.viewport).toHaveAttribute("data-patches", "4");
});
