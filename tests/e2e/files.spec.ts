import { readFile } from "node:fs/promises";
import { expect, test, type Page } from "@playwright/test";
import { readProject } from "tetrafront/project";
import { parseMsh, parseVtu } from "../support/mesh-files";
import { polyMeshDefects, readPolyMesh } from "../support/poly-mesh";
import { AppPage, sampleProject } from "./app-page";
import { chooseFormat } from "./downloads";
import { undoButton } from "./controls";
import { sharedTest } from "./shared-page";

interface Downloaded {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly text: string;
}

async function downloaded(page: Page, act: () => Promise<void>): Promise<Downloaded> {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  const buffer = await readFile(await download.path());
  // Copy to a Uint8Array: slices of a Buffer share its memory, which the parsers do not expect.
  return { name: download.suggestedFilename(), bytes: new Uint8Array(buffer), text: buffer.toString() };
}

const choose = (page: Page, item: RegExp) => async (): Promise<void> => {
  await chooseFormat(page, item);
  await page.getByTestId("export-apply").click();
};

const chooseReport = (page: Page) => async (): Promise<void> => {
  await page.getByTestId("download").click();
  await page.getByRole("button", { name: "Mesh report (JSON)" }).click();
};

async function dropProject(page: Page, text: string, fileName = "dropped.json"): Promise<void> {
  await page.evaluate(
    ([content, name]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], name));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
    },
    [text, fileName] as const,
  );
}

sharedTest(
  "the downloaded VTU, MSH and polyMesh files have the numbers of elements shown on the page",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.open();
    const { tets } = await app.mesh();
    const points = Number((await page.getByTestId("count-points").textContent())?.replaceAll(/\D/g, ""));

    const vtu = await downloaded(page, choose(page, /VTU/));
    expect(vtu.name).toBe("engine-intake.vtu");
    const vtuMesh = parseVtu(vtu.bytes);
    expect(vtuMesh.tetrahedra).toHaveLength(tets);
    expect(vtuMesh.points.length / 3).toBe(points);

    const msh = await downloaded(page, choose(page, /MSH 4/));
    expect(msh.name).toBe("engine-intake.msh");
    const mshMesh = parseMsh(msh.bytes);
    expect(mshMesh.tetrahedra.flatMap(({ elements }) => elements)).toHaveLength(tets);
    expect(mshMesh.points.length / 3).toBe(points);
    expect(mshMesh.triangles.map(({ name }) => name)).toContain("duct top");

    const foam = await downloaded(page, choose(page, /OpenFOAM/));
    expect(foam.name).toBe("engine-intake.foam.zip");
    const poly = readPolyMesh(foam.bytes);
    expect(polyMeshDefects(poly)).toEqual([]);
    expect(new Set([...poly.owner, ...poly.neighbour]).size).toBe(tets);
    expect(poly.patches.map(({ name }) => name)).toContain("duct_top");
  },
);

sharedTest("the report of the run can be downloaded", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const { tets, fingerprint } = await app.mesh();
  const { name, text } = await downloaded(page, chooseReport(page));
  expect(name).toBe("engine-intake-report.json");
  expect(JSON.parse(text)).toMatchObject({ status: "done", tetrahedra: tets, fingerprint });
});

sharedTest("a saved project reopens unchanged", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-2");
  await app.type("node-size", "0.3");
  const edited = await app.generate();
  const { name, text } = await downloaded(page, () => page.keyboard.press("Control+s"));
  expect(name).toBe("unit-cube.json");
  await expect(page.getByTestId("saved-state")).toHaveText("saved");
  const read = readProject(text);
  expect(read.success && read.value.background.nodes[1]?.size).toBe(0.3);

  await app.openExample("plate-with-hole");
  await app.openFile("unit-cube.json", text);
  await expect(app.viewport).toHaveAttribute("data-fingerprint", edited.fingerprint);
  expect(await app.meshed()).toEqual(edited);
});

sharedTest("an invalid project file is rejected with the reason", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const before = await app.mesh();
  const project = sampleProject("unit-cube");
  const broken = { ...project, lines: project.lines.map((line) => ({ ...line, points: [1, 99] })) };
  await app.openFile("broken.json", JSON.stringify(broken));
  const dialog = page.getByRole("dialog", { name: "broken.json could not be opened" });
  await expect(dialog).toContainText("there is no point with the id 99");
  await dialog.getByRole("button", { name: "Close" }).last().click();
  await expect(dialog).toBeHidden();
  expect(await app.meshed()).toEqual(before);
});

sharedTest("dropping a project file on the page opens it", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const before = await app.mesh();
  const text = JSON.stringify({ ...sampleProject("unit-cube"), name: "Dropped cube" });
  await dropProject(page, text);
  await expect(page.getByRole("button", { name: "Front view" })).toBeVisible();
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
  await app.meshed();
  await expect(page.getByTestId("project-name")).toHaveValue("Dropped cube");
});

sharedTest(
  "dropping a file without a surface shows what is wrong with it and what to do",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.open();
    await dropProject(page, "solid part", "part.STL");
    const surface = page.getByRole("dialog", { name: "part.STL could not be opened" });
    await expect(surface).toContainText("line 2: the file is truncated");
    await expect(surface).toContainText("Export, copy or download the file again");
    await dropProject(page, "1 4 0\n1 1 2 3 4\n", "part.ele");
    const volume = page.getByRole("dialog", { name: "part.ele could not be opened" });
    await expect(volume).toContainText("part.node");
  },
);

sharedTest("the next successful open hides the message of a failed one", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  await dropProject(page, "no project");
  const dialog = page.getByRole("dialog", { name: "dropped.json could not be opened" });
  await expect(dialog).toBeVisible();
  await dropProject(page, JSON.stringify({ ...sampleProject("unit-cube"), name: "Dropped cube" }));
  await expect(dialog).toBeHidden();
  await expect(page.getByTestId("project-name")).toHaveValue("Dropped cube");
});

test("an immediate reload keeps the last edit, and the last undo", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  page.on("dialog", (dialog) => void dialog.accept());
  const size = page.getByTestId("node-size");
  const reloaded = async (): Promise<void> => {
    await page.reload();
    await app.select("background-node-1");
  };
  await app.select("background-node-1");
  await app.type("node-size", "0.3");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  await undoButton(page).click();
  await reloaded();
  await expect(size).toHaveValue("0.16");
  await app.type("node-size", "0.2");
  await reloaded();
  await expect(size).toHaveValue("0.2");
});

test("a reload keeps an edit and shows that it is unsaved", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-1");
  await app.type("node-size", "0.1");
  const edited = await app.generate();
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  await page.reload();
  await expect(app.viewport).toHaveAttribute("data-fingerprint", edited.fingerprint);
  expect(await app.meshed()).toEqual(edited);
  await expect(page.getByTestId("saved-state")).toHaveText("unsaved changes");
});

sharedTest("a file of an unknown kind names the formats that can be opened", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await dropProject(page, "some notes", "notes.txt");
  const dialog = page.getByRole("dialog", { name: "notes.txt could not be opened" });
  await expect(dialog).toContainText("Files that end in .txt cannot be opened.");
  for (const text of ["Projects: .json", ".step", ".stl", ".vtu"]) await expect(dialog).toContainText(text);
});

test("without storage, the app works and says in a sentence that it keeps nothing", async ({ page }) => {
  await page.addInitScript(() => Reflect.defineProperty(window, "indexedDB", { value: undefined }));
  const app = new AppPage(page);
  await app.openCube();
  await app.type("project-name", "Another name");
  const notice = page.getByTestId("notice-autosave-failed");
  await expect(notice).toContainText("This browser keeps no documents for this page");
  await expect(notice).not.toContainText(/indexedDB|undefined/);
  await page.keyboard.press("Control+Shift+O");
  await expect(page.getByRole("dialog", { name: "Open recent" })).toContainText("keeps no documents");
});
