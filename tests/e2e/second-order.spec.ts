import { expect, test } from "@playwright/test";
import { middlesOnCylinder, parseVtu } from "../support/mesh-files";
import { drilledSolid, stepFile } from "../support/step-files";
import { AppPage } from "./app-page";
import { downloadMesh } from "./downloads";
import { dropBytes } from "./drop-bytes";

const radius = 3;
const axis = [8, 5] as const;
const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], axis, radius)]);

/** Checks that the file has ten-node elements with the middles of the hole on its cylinder. */
function expectCurved(file: Uint8Array, tets: number): void {
  const mesh = parseVtu(file);
  expect(mesh.tetrahedra).toHaveLength(tets);
  expect(new Set(mesh.tetrahedra.map(({ length }) => length))).toEqual(new Set([10]));
  const gaps = middlesOnCylinder(mesh, axis, radius);
  expect(gaps.length).toBeGreaterThan(50);
  expect(Math.max(...gaps)).toBeLessThan(1e-9);
}

test("a dropped STEP file is meshed, shown and saved with curved second-order elements", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, plate, "plate.step");
  await expect(page.getByTestId("entity-name")).toHaveValue("Plate");
  await expect(page.getByTestId("body-preview")).toHaveAttribute("data-current", "true");
  await page.getByTestId("body-generate").click();
  const { tets } = await app.meshed();
  // The file is curved also while the view shows straight edges.
  expectCurved(await downloadMesh(page, /VTU/, { secondOrder: true }), tets);

  const section = page.getByRole("region", { name: "Second order" });
  const faces = async (): Promise<number> => Number(await app.viewport.getAttribute("data-faces"));
  const straight = await faces();
  const before = await app.stillView();
  await section.getByRole("switch", { name: "Second order" }).check({ force: true });
  const bars = section.getByRole("list", { name: "Histogram of the scaled jacobian" });
  await expect(bars.getByRole("listitem")).toHaveCount(20);
  await expect(section).toContainText(/min\s*0\.\d{3}/);
  await expect(section.getByTestId("straightened")).toHaveText("0");
  // A curved face is drawn with 16 triangles.
  await expect.poll(faces).toBeGreaterThan(straight + 15 * 50);
  await app.drawn();
  expect((await app.stillView()).equals(before)).toBe(false);
  expectCurved(await downloadMesh(page, /VTU/, { secondOrder: true }), tets);

  await section
    .getByRole("button", { name: /^Element/ })
    .first()
    .click();
  await expect(section.getByRole("button", { pressed: true })).toHaveCount(1);
  // The choice stays with the browser.
  await page.reload();
  await app.meshed();
  await expect(section.getByRole("switch", { name: "Second order" })).toBeChecked();
  await section.getByRole("switch", { name: "Second order" }).uncheck({ force: true });
  await expect(bars).toBeHidden();
});
