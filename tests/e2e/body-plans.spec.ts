import { expect } from "@playwright/test";
import { stlBinary } from "../support/surface-files";
import { boxSurface, joined } from "../support/surfaces";
import { AppPage, sampleProject } from "./app-page";
import { downloaded } from "./downloads";
import { dropBytes, dropFiles } from "./drop-bytes";
import { sharedTest } from "./shared-page";

/** Part of a mesh report that the package writes too. */
interface Report {
  readonly tetrahedra: number;
  readonly regions: readonly {
    readonly name: string;
    readonly tetrahedra: number;
    readonly volume: number;
  }[];
  readonly diagnostics: readonly { readonly code: string; readonly message: string }[];
}

sharedTest(
  "a card says what a run will do with a surface that must be repaired, and the run what it has done",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const boxes = joined(boxSurface(3), boxSurface(3, [0.5, 0.4, 0.3], [1.5, 1.4, 1.3]));
    await dropBytes(page, stlBinary(boxes), "crossing.stl");
    const plan = page.getByTestId("body-plan");
    await expect(plan).toHaveText(
      "“Generate mesh” repairs the surface first. Its triangles are replaced by new ones, because cuts leave needles.",
    );
    await app.generate();
    const notices = page.getByRole("region", { name: "Notices" });
    await expect(notices).toContainText(/crossing, repaired: .*\d+ intersecting triangles cut/);
    await notices.getByRole("button", { name: "Show log" }).click();
    await expect(page.getByText(/crossing: remeshed to [\d,]+ triangles/)).toBeVisible();
    await page.getByTestId("tree-body-1").click();
    await expect(plan).toHaveText("Its triangles are replaced by new ones.");
  },
);

sharedTest(
  "the report of bodies that overlap has their regions, and the warning about the volume that they share",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await dropFiles(page, {
      "left.stl": stlBinary(boxSurface(3)),
      "right.stl": stlBinary(boxSurface(3, [0.5, 0, 0], [1.5, 1, 1])),
    });
    await expect(page.getByTestId("body-plan")).toContainText("joins it to the bodies that it touches");
    await app.generate();
    const reported = async (): Promise<Report> => {
      await page.getByTestId("download").click();
      const bytes = await downloaded(page, () =>
        page.getByRole("button", { name: "Mesh report (JSON)" }).click(),
      );
      await page.keyboard.press("Escape");
      return JSON.parse(Buffer.from(bytes).toString()) as Report;
    };
    const { tetrahedra, regions, diagnostics } = await reported();
    expect(regions.map(({ name }) => name)).toEqual(["left", "right"]);
    expect(regions.reduce((sum, region) => sum + region.tetrahedra, 0)).toBe(tetrahedra);
    expect(regions.reduce((sum, { volume }) => sum + volume, 0)).toBeCloseTo(1.5, 9);
    const overlaps = diagnostics.filter(({ code }) => code === "touching-solids");
    expect(overlaps.map(({ message }) => message)).toEqual([
      "left and right overlap by a volume of 0.5, 50 % of the smallest of them, which counts once",
    ]);
    // A mesh that is shown again has the same report.
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+Shift+z");
    await app.meshed();
    expect((await reported()).diagnostics).toEqual(diagnostics);
  },
);

sharedTest("a file that is dropped while a model is meshed shows nothing of its mesh", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const { viewport } = app;
  const fine = { ...sampleProject("unit-cube"), meshing: { size: 0.02 } };
  await app.openFile("fine.json", JSON.stringify(fine));
  await expect(viewport).toHaveAttribute("data-busy", "true");
  await expect(page.getByRole("progressbar").first()).toBeVisible();
  await dropBytes(page, stlBinary(boxSurface(2)), "box.stl");
  await expect(page.getByTestId("body-card")).toBeVisible();
  await expect(viewport).toHaveAttribute("data-busy", "false");
  await expect(page.getByTestId("download")).toBeDisabled();
  // The cancelled run of the model ends before that of the box.
  const { tets } = await app.generate();
  expect(tets).toBeLessThan(1000);
});

sharedTest("the view cube stays when a picture of the document is taken for the lists", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, stlBinary(boxSurface(2)), "box.stl");
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");
  const { x = 0, y = 0, width = 0 } = (await app.viewport.boundingBox()) ?? {};
  const cube = async (): Promise<Buffer> =>
    page.screenshot({ clip: { x: x + width - 102, y: y + 10, width: 92, height: 92 } });
  await app.stillView();
  const before = await cube();
  // The database is made with its first picture. Opening it earlier would make another one.
  const databases = () => page.evaluate(async () => (await indexedDB.databases()).map(({ name }) => name));
  await expect.poll(databases).toContain("tetrafront-pictures");
  expect((await cube()).equals(before)).toBe(true);
});
