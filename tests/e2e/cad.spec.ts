import { expect, test } from "@playwright/test";
import { measured } from "../support/mesh-measures";
import { parseMsh, parseVtu } from "../support/mesh-files";
import { boxSolid, drilledSolid, stepFile } from "../support/step-files";
import { AppPage, countOrange, forEachPixel } from "./app-page";
import { downloadMesh } from "./downloads";
import { dropBytes, dropFiles } from "./drop-bytes";
import { sharedTest } from "./shared-page";

const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]);
const plateVolume = 1600 - 72 * Math.PI;

test("a STEP file becomes a mesh: card, faces as patches, mesh, download", async ({ page }) => {
  const requested: string[] = [];
  page.on("request", (request) => requested.push(request.url()));
  const app = new AppPage(page);
  await app.openCube();
  expect(requested.filter((url) => url.includes("occt"))).toEqual([]);
  await dropBytes(page, plate, "plate.step");
  await expect(page.getByTestId("entity-name")).toHaveValue("Plate");
  await expect(page.getByTestId("body-size")).toContainText("20 × 10 × 8");
  const volume = parseFloat((await page.getByTestId("body-volume").textContent()) ?? "");
  expect(Math.abs(volume / plateVolume - 1)).toBeLessThan(1e-3);
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");

  await page.getByTestId("body-generate").click();
  const { tets } = await app.meshed();
  const mesh = parseVtu(await downloadMesh(page, /VTU/));
  expect(mesh.tetrahedra).toHaveLength(tets);
  const { volume: filled, ...defects } = measured(mesh);
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(Math.abs(filled / plateVolume - 1)).toBeLessThan(5e-3);
  const names = parseMsh(await downloadMesh(page, /MSH 4/)).triangles.map(({ name }) => name);
  expect(new Set(names)).toEqual(new Set([1, 2, 3, 4, 5, 6, 7].map((n) => `face ${n}`)));
});

sharedTest("the solids of an assembly are bodies with names, colours and previews", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const orange = [1, 0.45, 0.1] as const;
  const assembly = stepFile([
    boxSolid("base", [0, 0, 0], [4, 4, 1], { color: orange }),
    boxSolid("cover", [0, 0, 2], [4, 4, 3], { color: orange }),
  ]);
  await dropBytes(page, assembly, "assembly.step");
  await expect(page.getByTestId("entity-name")).toHaveValue("base");
  await expect(page.getByTestId("body-size")).toContainText("4 × 4 × 1 mm");
  await expect(page.getByTestId("tree-body-2")).toContainText("cover");
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");
  await page.getByText("Given", { exact: true }).click();
  await expect.poll(async () => countOrange(await app.viewport.screenshot())).toBeGreaterThan(5000);
  const { tets } = await app.generate();
  expect(tets).toBeGreaterThan(100);
  const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
  expect(volume).toBeCloseTo(32, 6);
});

const [base, pin] = [boxSolid("base", [0, 0, 0], [4, 4, 1]), boxSolid("pin", [1, 1, 1], [2, 2, 3])] as const;

sharedTest(
  "solids of one file that touch in a part of a face share its triangles from the start",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropBytes(page, stepFile([base, pin]), "assembly.step");
    await expect(page.getByTestId("entity-name")).toHaveValue("base + pin");
    await expect(page.getByTestId("body-card")).toContainText("Regions2");
    await expect(page.getByTestId("model-tree")).toContainText("base / pin");
    await app.generate();
    const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    expect(volume).toBeCloseTo(18, 6);
    const { tetrahedra } = parseMsh(await downloadMesh(page, /MSH 4/));
    expect(tetrahedra.map(({ name }) => name).toSorted()).toEqual(["base", "pin"]);
  },
);

sharedTest(
  "solids of two files that touch in a part of a face are joined by Generate mesh, as a step of undo",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropFiles(page, { "base.step": stepFile([base]), "pin.step": stepFile([pin]) });
    await expect(page.getByTestId("tree-body-2")).toContainText("pin");
    await expect(page.getByTestId("problem-list")).toBeHidden();
    await expect(page.getByTestId("body-card")).toContainText("base and pin touch or intersect");
    const { tets } = await app.generate();
    expect(tets).toBeGreaterThan(100);
    // A run clears the selection.
    await page.getByRole("treeitem", { name: "base + pin" }).click();
    await expect(page.getByTestId("entity-name")).toHaveValue("base + pin");
    await expect(page.getByTestId("log")).toContainText("they became one body with 2 regions");
    const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    expect(volume).toBeCloseTo(18, 6);
    await page.getByRole("button", { name: "Undo: Join base and pin" }).click();
    await expect(page.getByTestId("tree-body-2")).toContainText("pin");
  },
);

sharedTest("a face has its colour in every pixel", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  // One less than this red, as a number of 24 bits, would be a light cyan.
  const red = [192 / 255, 0, 0] as const;
  const part = stepFile([{ ...drilledSolid("Part", [0, 0, 0], [20, 10, 8], [8, 5], 3), color: red }]);
  await dropBytes(page, part, "part.step");
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");
  await page.getByText("Given", { exact: true }).click();
  const pixels = async () => {
    const count = { red: 0, cyan: 0 };
    forEachPixel(await page.getByTestId("viewport-canvas").screenshot(), (r, g, b) => {
      if (r > g + 60 && r > b + 60) ++count.red;
      if (Math.min(g, b) > Math.max(r + 40, 120)) ++count.cyan;
    });
    return count;
  };
  await expect.poll(async () => (await pixels()).red).toBeGreaterThan(5000);
  // An icon over the view has a few such pixels.
  expect((await pixels()).cyan).toBeLessThan(200);
});

sharedTest("a damaged STEP file gives an error, and the next file is opened", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, plate.subarray(0, 1000), "damaged.step");
  await expect(page.getByRole("dialog")).toContainText("line 20: the file is truncated");
  await page.keyboard.press("Escape");
  await dropBytes(page, stepFile([boxSolid("box", [0, 0, 0], [1, 2, 3])]), "box.stp");
  await expect(page.getByTestId("entity-name")).toHaveValue("box");
});
