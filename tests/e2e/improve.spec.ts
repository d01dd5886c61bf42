import { expect, test, type Page } from "@playwright/test";
import { createMesher, writeMesh, type Mesh } from "tetrafront";
import { parseMsh } from "../support/mesh-files";
import { sphereSurface } from "../support/surfaces";
import { AppPage } from "./app-page";
import { dropBytes } from "./drop-bytes";
import { downloadMesh } from "./downloads";
import { generateButton, redoButton, undoButton } from "./controls";

/** A sphere as the front left it, with two named patches. */
async function roughMesh(size: number): Promise<Mesh> {
  const mesher = await createMesher();
  const made = await mesher.fillSurface(sphereSurface(8), { size, optimization: "none" });
  mesher.dispose();
  const mesh = made.mesh;
  const trianglePatch = mesh.trianglePatch.map((_, t) => {
    const [a = 0] = mesh.triangles.subarray(3 * t, 3 * t + 1);
    return (mesh.points[3 * a + 2] ?? 0) > 0 ? 1 : 0;
  });
  const patches = ["south", "north"].map((name, k) => ({ name, tag: 7 + k }));
  return { ...mesh, trianglePatch, patches, regions: [{ name: "core", tag: 3 }] };
}

async function openMesh(page: Page, size: number): Promise<{ app: AppPage; mesh: Mesh }> {
  const mesh = await roughMesh(size);
  const [file] = await writeMesh(mesh, "ball.msh");
  const app = new AppPage(page);
  await app.openCube();
  await dropBytes(page, file?.bytes ?? new Uint8Array(), "ball.msh");
  await expect(app.viewport).toHaveAttribute("data-tets", String(mesh.tetrahedra.length / 4));
  await app.drawn();
  return { app, mesh };
}

const smallestAngle = async (page: Page): Promise<number> =>
  Number(/[\d.]+/.exec((await page.getByTestId("min-dihedral").textContent()) ?? "")?.[0]);

test("a mesh file is opened, improved, downloaded with its names, and restored by undo", async ({ page }) => {
  const { app, mesh } = await openMesh(page, 0.3);
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "inspected");
  await expect(page.getByTestId("notice-file-notes")).toContainText("not its elements");
  const before = await smallestAngle(page);
  await page.getByTestId("improve").click();
  await expect(page.getByTestId("improvement-result")).toHaveText("Improved");
  await expect(page.getByTestId("notice-improvement")).toContainText("smallest dihedral angle");
  await expect(page.getByTestId("notice-improvement")).toContainText("least radius ratio");
  await expect(page.getByTestId("notice-improvement")).toContainText(/[\d,]+ (→ [\d,]+ )?tetrahedra/);
  await expect(
    page.getByTestId("improvement").getByRole("row", { name: /Least radius ratio/ }),
  ).toBeVisible();
  const after = await smallestAngle(page);
  expect(after).toBeGreaterThan(before + 5);

  const written = parseMsh(await downloadMesh(page, /MSH 4/));
  const [core] = written.tetrahedra;
  expect(core?.name).toBe("core");
  expect(core?.elements).toHaveLength(Number(await app.viewport.getAttribute("data-tets")));
  expect(written.triangles.map(({ name }) => name).toSorted()).toEqual(["north", "south"]);
  expect(written.triangles.flatMap(({ elements }) => elements)).toHaveLength(mesh.triangles.length / 3);

  await undoButton(page).click();
  expect(await smallestAngle(page)).toBe(before);
  await expect(page.getByTestId("improvement-result")).toBeHidden();
  await redoButton(page).click();
  expect(await smallestAngle(page)).toBe(after);
  // The first improvement has left little to gain.
  const notice = page.getByTestId("notice-improvement");
  const first = (await notice.textContent()) ?? "";
  await page.getByTestId("improve").click();
  await expect(notice).not.toHaveText(first);
  await expect(notice).toContainText(/^(Improved|No better mesh was found)/);
});

/**
 * Runs in the page: stops the next improvement as soon as the page shows that it runs. A click from outside can come too
 * late. Sets the attribute `data-stopped` of the body to whether Generate mesh was there.
 */
function stopAtOnce(): void {
  const find = (id: string): Element | null => document.querySelector(`[data-testid="${id}"]`);
  const observer = new MutationObserver(() => {
    const cancel = find("cancel-run");
    if (find("status")?.textContent.includes("Improving the elements") !== true) return;
    if (!(cancel instanceof HTMLButtonElement)) return;
    observer.disconnect();
    document.body.dataset["stopped"] = find("generate") === null ? "Generate is gone" : "Generate is there";
    cancel.click();
  });
  observer.observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true });
}

test("a stopped improvement keeps a valid mesh, and Generate meshes the boundary again", async ({ page }) => {
  const { app, mesh } = await openMesh(page, 0.07);
  await page.evaluate(stopAtOnce);
  await page.getByTestId("improve").click();
  await expect(page.locator("body")).toHaveAttribute("data-stopped", "Generate is gone");
  await expect(page.getByTestId("improvement-result")).toContainText(/^Stopped/);
  await expect(app.viewport).toHaveAttribute("data-status", "done");
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "inspected");

  await generateButton(page).click();
  const { tets } = await app.meshed();
  expect(tets).not.toBe(mesh.tetrahedra.length / 4);
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "passed");
  await undoButton(page).click();
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "inspected");
});

test("the mesh just generated is improved from the Mesh menu", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByRole("menuitem", { name: "Mesh", exact: true }).click();
  await page.getByRole("menuitem", { name: "Improve mesh" }).click();
  await expect(page.getByTestId("notice-improvement")).toContainText("Improved: smallest dihedral angle");
  await page.getByTestId("notice-improvement").getByRole("button", { name: "Show quality" }).click();
  await expect(page.getByTestId("improvement")).toContainText("Improved");
  // The verdict is that of the improved mesh, not of the run.
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "inspected");
  await undoButton(page).click();
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "passed");
});

test("an example that is opened during an improvement is meshed", async ({ page }) => {
  const { app } = await openMesh(page, 0.07);
  await page.getByTestId("improve").click();
  await expect(page.getByTestId("status")).toContainText("Improving the elements");
  await app.openExample("unit-cube");
  await expect(page.getByTestId("verdict")).toHaveAttribute("data-verdict", "passed");
});
