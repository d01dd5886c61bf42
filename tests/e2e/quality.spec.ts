import { expect, test } from "@playwright/test";
import { readFile } from "node:fs/promises";
import type { MeshReport } from "tetrafront";
import { readProject } from "tetrafront/project";
import { cubeProject } from "../support/projects";
import { AppPage, nextFrame } from "./app-page";
import { tab, toggle, undoButton } from "./controls";
import { sharedTest } from "./shared-page";

/** Downloads the report from the app and returns it. */
async function reportOf({ page }: AppPage): Promise<MeshReport> {
  await page.getByTestId("download").click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Mesh report (JSON)" }).click(),
  ]);
  await page.keyboard.press("Escape");
  return JSON.parse(await readFile(await download.path(), "utf8")) as MeshReport;
}

const sum = (counts: readonly number[]): number => counts.reduce((total, count) => total + count, 0);

test("the quality report shows the statistics of all regions together and of each", async ({ page }) => {
  const app = new AppPage(page);
  await app.open("light", "core-in-a-shell");
  const { quality, tetrahedra, recovery } = await reportOf(app);
  await page.getByTestId("all-statistics").click();
  const panel = page.getByTestId("quality-report");
  await expect(page.getByTestId("verdict")).toContainText("Verified");
  await expect(panel.getByRole("heading", { name: "Worst 10" })).toBeVisible();
  await expect(page.getByTestId("out-of-range")).toHaveText(String(quality.outOfRange));
  await expect(page.getByTestId("limited")).toHaveText(String(quality.limitedByBoundary.count));
  await expect(panel).toContainText(`${(100 * quality.edges.nearTarget).toFixed(1)} %`);
  const rungs = Object.values(recovery).filter((count) => count > 0).length;
  await expect(page.getByTestId("recovery").getByRole("listitem")).toHaveCount(rungs);

  /** Returns the sum of the counts of a chart's bars. */
  const counted = async (chart: string): Promise<number> => {
    const bars = await page.getByTestId(`chart-${chart}`).getByRole("listitem").all();
    const labels = await Promise.all(bars.map((bar) => bar.getAttribute("aria-label")));
    return sum(labels.map((label) => Number(label?.replaceAll(",", "").match(/^\d+/)?.[0])));
  };
  expect(await counted("radiusRatio")).toBe(tetrahedra);
  expect(await counted("dihedral")).toBe(6 * tetrahedra);
  const [, second] = quality.regions;
  await page.getByTestId("quality-region").click();
  await page.getByRole("option", { name: /^Region 2/ }).click();
  expect(await counted("radiusRatio")).toBe(second?.tetrahedra);
  expect(await counted("edge")).toBe(sum(second?.edge ?? []));
});

sharedTest(
  "a lattice interior: the statistics have its share, and the cut says what its pattern is",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await expect(page.getByText("Lattice interior")).toBeHidden();
    const project = { ...cubeProject(0.08), name: "Lattice", meshing: { interior: "lattice" } };
    await app.openFile("lattice.json", JSON.stringify(project));
    await expect(page.getByTestId("project-name")).toHaveValue("Lattice");
    await app.generate();
    const { interior, tetrahedra } = await reportOf(app);
    const share = `${Number(((100 * interior.lattice) / tetrahedra).toPrecision(2))} % of the elements`;
    expect(interior.lattice).toBeGreaterThan(0.1 * tetrahedra);
    await expect(page.getByRole("term").filter({ hasText: "Lattice interior" })).toBeVisible();
    await expect(page.getByRole("definition").filter({ hasText: share })).toBeVisible();
    await tab(page, "Display").click();
    const note = page.getByText(`The even pattern inside is the lattice, ${share}`);
    await expect(note).toBeHidden();
    await toggle(page, "Cut mesh").check({ force: true });
    await expect(note).toBeVisible();
  },
);

sharedTest("radius ratios say what they are at the pointer", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await tab(page, "Quality").click();
  await page.getByRole("heading", { name: "Radius ratio" }).getByText("Radius ratio").hover();
  await expect(page.getByRole("tooltip")).toContainText("3r/R");
  await expect(page.getByRole("tooltip")).toHaveCSS("text-transform", "none");
  await expect(page.getByRole("tooltip")).toContainText("1: regular. 0: without volume");
  await tab(page, "Patches").click();
  await page.getByTestId("patch-table").getByText("Mean 2r/R").hover();
  await expect(page.getByRole("tooltip")).toContainText("1: equilateral. 0: without area");
});

sharedTest(
  "a click on one of the worst elements moves the camera to it and highlights it",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const { quality } = await reportOf(app);
    await tab(page, "Quality").click();
    await app.stillView();
    const centre = [0.5, 0.5, 0.5] as const;
    const inView = (target: readonly [number, number, number]) =>
      page.evaluate((position) => {
        return (
          window as unknown as { tetrafrontPosition: (position: unknown) => unknown }
        ).tetrafrontPosition(position) as { x: number; y: number };
      }, target);
    const whole = await inView(centre);
    for (const index of [0, 9]) {
      const row = page.getByTestId(`worst-${index}`);
      const element = quality.worst[index];
      const number = element?.tetrahedron.toLocaleString("en-US");
      await expect(row).toHaveAccessibleName(new RegExp(`^Go to tetrahedron ${number} at `));
      const before = await app.viewport.screenshot();
      await nextFrame(app.viewport, () => row.click());
      await expect(row).toHaveAttribute("aria-pressed", "true");
      await expect.poll(async () => (await app.viewport.screenshot()).equals(before)).toBe(false);
      const position = element?.centroid ?? [NaN, NaN, NaN];
      const box = await app.viewport.boundingBox();
      // The camera has moved: the element is in the middle of the view.
      const { x, y } = await inView(position);
      expect(Math.abs(x - (box?.width ?? 0) / 2)).toBeLessThan(0.1 * (box?.width ?? 0));
      expect(Math.abs(y - (box?.height ?? 0) / 2)).toBeLessThan(0.1 * (box?.height ?? 0));
    }
    // The mesh was cut open at the element.
    const cut = toggle(page, "Cut");
    await expect(cut).toBeChecked();
    const open = await app.stillView();
    await page.keyboard.press("x");
    await expect(cut).not.toBeChecked();
    expect((await app.stillView()).equals(open)).toBe(false);
    await page.keyboard.press("Escape");
    await page.keyboard.press("f");
    await expect(page.getByTestId("worst-9")).toHaveAttribute("aria-pressed", "false");
    await expect.poll(async () => Math.round((await inView(centre)).x)).toBe(Math.round(whole.x));
  },
);

sharedTest(
  "the mesh settings affect the mesh, can be undone, and are saved in the file",
  async ({ page }) => {
    const app = new AppPage(page);
    const before = await app.openCube();
    await page.getByTestId("mesh-settings").locator("summary").click();
    await page.getByRole("radiogroup", { name: "Front order" }).getByText("Smallest first").click();
    await page.getByRole("radiogroup", { name: "Optimization" }).getByText("0").click();
    await app.type("gradation", "0.5");
    await expect(page.getByText("Must be 0, or above 1")).toBeVisible();
    await app.type("gradation", "0");
    await expect(app.viewport).toHaveAttribute("data-stale", "true");
    const set = await app.generate();
    expect(set.fingerprint).not.toBe(before.fingerprint);
    expect((await reportOf(app)).seconds.optimize).toBeLessThan(0.01);
    const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
    const read = readProject(await readFile(await download.path(), "utf8"));
    expect(read.success && read.value.meshing).toEqual({
      gradation: 0,
      order: "smallest-first",
      optimization: "none",
    });
    for (let i = 0; i < 3; ++i) await undoButton(page).click();
    expect(await app.meshed()).toEqual(before);
  },
);

test("a closed shell inside a region is a cavity, or a region if the settings say so", async ({ page }) => {
  const app = new AppPage(page);
  const before = await app.open("light", "sphere-in-a-box");
  const hollow = await reportOf(app);
  expect(hollow.quality.regions).toHaveLength(1);
  await page.getByTestId("mesh-settings").locator("summary").click();
  await page.getByRole("radiogroup", { name: "Inner shells" }).getByText("Regions").click();
  await app.generate();
  const filled = await reportOf(app);
  const [inner, around] = [...filled.quality.regions].sort((a, b) => a.volume - b.volume);
  expect(filled.quality.regions).toHaveLength(2);
  expect(around?.volume).toBeCloseTo(hollow.volume, 9);
  expect(filled.volume).toBeCloseTo(hollow.volume + Number(inner?.volume), 9);
  await undoButton(page).click();
  expect(await app.meshed()).toEqual(before);
});

sharedTest(
  "one switch measures the whole report of a stretched mesh in the metric or in space",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.open("dark", "wing-in-a-tunnel");
    await tab(page, "Quality").click();
    const choice = page.getByTestId("quality-space");
    const facts = page.getByTestId("chart-dihedral-facts");
    const worst = page.getByTestId("worst-0");
    await expect(choice.getByRole("radio", { name: "Metric" })).toBeChecked();
    /** Expects that the report, its histogram, the status bar, the legend and the view's label show the same space. */
    const expectSmallest = async (space: string): Promise<void> => {
      const smallest = page.getByTestId("min-dihedral");
      await expect(smallest).toContainText(space);
      const angle = /[\d.]+°/.exec(String(await smallest.textContent()))?.[0] ?? "";
      await expect(facts).toContainText(`min ${angle}`);
      await expect(page.getByTestId("legend")).toContainText(space);
      await expect(page.getByTestId("viewport-canvas")).toHaveAttribute(
        "aria-label",
        new RegExp(`smallest dihedral angle ${angle} ${space}`),
      );
      const bars = await page.getByTestId("chart-dihedral").getByRole("listitem").all();
      const labels = await Promise.all(bars.map((bar) => bar.getAttribute("aria-label")));
      const first = labels.findIndex((label) => !label?.startsWith("0 "));
      expect(first).toBe(Math.floor(parseFloat(angle) / 5));
    };
    await expect(page.getByRole("heading", { name: "Edge length / target" })).toBeVisible();
    const inMetric = await worst.textContent();
    await expectSmallest("in the metric");

    await choice.getByText("Space").click();
    await expect(page.getByRole("heading", { name: "Edge length / mean" })).toBeVisible();
    await expect(worst).not.toHaveText(String(inMetric));
    await expectSmallest("in space");

    await app.openExample("unit-cube");
    await expect(page.getByTestId("quality-report")).toBeVisible();
    await expect(choice).toHaveCount(0);
  },
);
