import { expect, test } from "@playwright/test";
import { meshFile, type SurfaceInput } from "tetrafront";
import { boundaryTriangles, measured } from "../support/mesh-measures";
import { parseVtu } from "../support/mesh-files";
import { boxSolid, stepFile } from "../support/step-files";
import { stlBinary, stlText } from "../support/surface-files";
import { boxSurface, joined, sphereSurface } from "../support/surfaces";
import { AppPage } from "./app-page";
import { downloadMesh } from "./downloads";
import { dropBytes, dropFiles } from "./drop-bytes";
import { sharedTest } from "./shared-page";

sharedTest(
  "files that are dropped together become bodies of one mesh; those that cannot be used are named",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropFiles(page, {
      "base.step": stepFile([boxSolid("base", [0, 0, 0], [4, 4, 1])]),
      "damaged.stl": new TextEncoder().encode("solid nothing"),
      "post.step": stepFile([boxSolid("post", [0, 0, 2], [1, 1, 3])]),
      "notes.txt": new TextEncoder().encode("no mesh"),
      "lid.stl": stlBinary(boxSurface(2, [0, 0, 4], [4, 4, 5])),
    });
    const dialog = page.getByRole("dialog", { name: "2 files could not be opened" });
    await expect(dialog).toContainText("damaged.stl:");
    await expect(dialog).toContainText("notes.txt:");
    await page.keyboard.press("Escape");
    await expect(page.getByTestId("entity-name")).toHaveValue("base");
    await expect(page.getByTestId("tree-body-2")).toContainText("post");
    await expect(page.getByTestId("tree-body-3")).toContainText("lid");
    await app.generate();
    const { volume, ...defects } = measured(parseVtu(await downloadMesh(page, /VTU/)));
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    expect(volume).toBeCloseTo(16 + 1 + 16, 6);
    await page.keyboard.press("Control+z");
    await expect(page.getByTestId("tree-body-2")).toHaveCount(0);
    await expect(page.getByTestId("tree-body-1")).toContainText("base");
  },
);

sharedTest(
  "solids of one STL file that touch, share a volume, are apart or nested give the mesh of the package, bit for bit",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const base = new TextDecoder().decode(stlText(boxSurface(1, [0, 0, 0], [2, 2, 2]), "base"));
    const post = boxSurface(1, [0.5, 0.5, 2], [1.5, 1.5, 3.5]);
    const inside = sphereSurface(6, 0.4, [1, 1, 1]);
    const others = {
      corner: [boxSurface(1, [1, 1, 1], [3, 3, 3])],
      // No solids touch: one is beside, one inside the base.
      apart: [boxSurface(6, [4, 0, 0], [5, 1, 1]), inside],
      // Solids that touch, and others that do not: in a box of its own, and within each other.
      mixed: [sphereSurface(6, 1, [5, 1, 1]), post, sphereSurface(8, 0.8, [-2, 1, 1])],
      nested: [post, sphereSurface(6, 1, [5, 1, 1]), sphereSurface(6, 0.4, [5, 1, 1])],
      // Boxes that meet, around solids that do not.
      near: [sphereSurface(6, 1, [2.7, 2.7, 2.7])],
    };
    for (const [name, solids] of Object.entries(others)) {
      const texts = solids.map((solid, s) => new TextDecoder().decode(stlText(solid, `${name} ${s}`)));
      const bytes = new TextEncoder().encode(base + texts.join(""));
      await dropBytes(page, bytes, `${name}.stl`);
      await expect(page.getByTestId("body-card")).toBeVisible();
      await expect(page.getByTestId("entity-name")).toHaveValue(/^(base|apart)$/);
      const { tets, fingerprint } = await app.generate();
      const made = await meshFile(bytes, { fileName: `${name}.stl` });
      expect([tets, fingerprint]).toEqual([made.report.tetrahedra, made.report.fingerprint]);
      await expect(page.getByTestId("log")).toContainText(`The model has ${solids.length + 1} regions`);
    }
  },
);

test("solids that touch are a calm note; those that share a volume are a warning that names them and the volume", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  const fileOf = (other: SurfaceInput): Uint8Array =>
    Uint8Array.of(...stlText(boxSurface(1, [0, 0, 0], [2, 2, 2]), "base"), ...stlText(other, "other"));
  await dropBytes(page, fileOf(boxSurface(1, [0.5, 0.5, 2], [1.5, 1.5, 3.5])), "touching.stl");
  await page.getByRole("tab", { name: /Problems/ }).click();
  const note = page.getByTestId("problems-touching-bodies");
  await expect(note).toContainText("1 note");
  await expect(note).toContainText("base and other touch or intersect");
  await app.generate();
  await expect(page.getByTestId("problem-list")).toContainText("No problems found.");
  await dropBytes(page, fileOf(boxSurface(1, [1, 1, 1], [3, 3, 3])), "overlapping.stl");
  await expect(note).toContainText("1 note");
  await app.generate();
  const warning = page.getByTestId("problems-touching-solids");
  await expect(warning).toContainText("1 warning");
  await expect(warning).toContainText(
    "base and other overlap by a volume of 1, 13 % of the smallest of them",
  );
});

sharedTest(
  "a number of elements is reached by the search of the package; the body's figures are those of the mesh",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const bytes = stlText(boxSurface(1, [0, 0, 0], [3, 2, 1]), "block");
    await dropBytes(page, bytes, "block.stl");
    await expect(page.getByTestId("body-card")).toBeVisible();
    await page.getByTestId("element-count-switch").click();
    await page.getByTestId("elements").fill("600");
    await page.getByTestId("elements").press("Enter");
    const { tets, fingerprint } = await app.generate();
    const { report } = await meshFile(bytes, { fileName: "block.stl", elements: 600 });
    expect([tets, fingerprint]).toEqual([report.tetrahedra, report.fingerprint]);
    await page.getByTestId("tree-body-1").click();
    await expect(page.getByTestId("prepared-triangles")).toHaveText(report.triangles.toLocaleString("en-US"));
  },
);

sharedTest("a solid inside another one of its file is meshed", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const solids = [boxSolid("housing", [0, 0, 0], [4, 4, 4]), boxSolid("core", [1, 1, 1], [2, 2, 2])];
  await dropBytes(page, stepFile(solids), "nested.step");
  await expect(page.getByTestId("tree-body-2")).toContainText("core");
  await app.generate();
  const { volume } = measured(parseVtu(await downloadMesh(page, /VTU/)));
  expect(volume).toBeCloseTo(64, 6);
});

sharedTest(
  "an STL file that intersects itself is repaired by “Generate mesh”, meshed and downloaded",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const crossing = joined(boxSurface(2, [0, 0, 0], [2, 2, 2]), boxSurface(3, [1, 1, 1], [3, 3, 3]));
    await dropBytes(page, stlBinary(crossing), "crossing.stl");
    const problems = page.getByTestId("body-problems");
    await expect(problems.locator("[data-code=self-intersection]").first()).toBeVisible();
    await expect(page.getByTestId("repair-resolved-intersection")).toContainText("cuts");
    await expect(page.getByTestId("repair-outcome")).toContainText("Afterwards, the surface can be meshed.");
    const { tets } = await app.generate();
    // A run clears the selection.
    await page.getByTestId("tree-body-1").click();
    await expect(page.getByTestId("body-triangles")).toBeVisible();
    await expect(problems).toBeHidden();
    await expect(page.getByTestId("body-repair-deviation")).toHaveText("No node was moved.");
    const mesh = parseVtu(await downloadMesh(page, /VTU/));
    expect(mesh.tetrahedra).toHaveLength(tets);
    const { volume, ...defects } = measured(mesh);
    expect(defects).toEqual({ inverted: 0, crowdedFaces: 0, openEdges: 0 });
    // Two cubes of edge length 2 with a common cube of edge length 1.
    expect(Math.abs(volume / 15 - 1)).toBeLessThan(1e-3);
  },
);

sharedTest(
  "triangles of an STL file that are fit are kept, and divided where a size is given",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const sphere = sphereSurface(2);
    await dropBytes(page, stlBinary(sphere), "sphere.stl");
    const treatment = page.getByTestId("body-treatment");
    await expect(treatment.getByRole("radio", { name: "Refine" })).toBeChecked();
    await expect(
      page.getByText(
        /^Its triangles are well shaped, so Generate mesh keeps them, unless they must be repaired/,
      ),
    ).toBeVisible();
    await app.generate();
    const given = sphere.triangles.length / 3;
    expect(boundaryTriangles(parseVtu(await downloadMesh(page, /VTU/)))).toBe(given);
    await page.getByTestId("tree-body-1").click();
    const size = page.getByTestId("remeshing-size");
    await size.fill(String(Number(await size.inputValue()) / 2));
    await size.press("Enter");
    await app.generate();
    expect(boundaryTriangles(parseVtu(await downloadMesh(page, /VTU/)))).toBeGreaterThan(2 * given);
  },
);
