import { expect, test, type Page } from "@playwright/test";
import { AppPage, nextFrame } from "./app-page";

/** Where an entity is on the screen, by the query that `?test=1` offers; null if out of view. */
async function projected(page: Page, kind: string, id: number): Promise<{ x: number; y: number } | null> {
  return page.evaluate(
    ([wantedKind, wantedId]) => {
      const query = Reflect.get(window, "tetrafrontProject") as (
        kind: string,
        id: number,
      ) => { x: number; y: number } | null;
      return query(wantedKind, wantedId);
    },
    [kind, id] as const,
  );
}

/** The same in the page, once the view has come to rest: a model just opened is still to be fitted. */
async function screenPlace(page: Page, kind: string, id: number): Promise<{ x: number; y: number }> {
  const viewport = page.getByTestId("viewport");
  const look = async (): Promise<string> =>
    JSON.stringify([await viewport.getAttribute("data-frames"), await projected(page, kind, id)]);
  await expect
    .poll(async () => {
      const before = await look();
      await page.evaluate(
        () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
      );
      return before === (await look());
    })
    .toBe(true);
  const at = await projected(page, kind, id);
  const box = await viewport.boundingBox();
  if (!at || !box) throw new Error(`${kind} ${id} is not in view`);
  return { x: box.x + at.x, y: box.y + at.y };
}

test("draws the mesh, in many colours, and nothing of it when hidden", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const withMesh = await app.colours();
  expect(withMesh).toBeGreaterThan(150);
  await page.getByRole("tab", { name: "Display" }).click();
  await nextFrame(app.viewport, () => page.getByRole("switch", { name: "Mesh", exact: true }).press("Space"));
  expect(await app.colours()).toBeLessThan(withMesh / 2);
});

test("draws only when something has changed", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  await nextFrame(app.viewport, () => page.keyboard.press("7"));
  const frames = () => app.viewport.getAttribute("data-frames");
  // A running loop would draw in one of two animation frames; a settled view does not.
  const settles = async (): Promise<boolean> => {
    const before = await frames();
    await page.evaluate(
      () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
    );
    return (await frames()) === before;
  };
  await expect.poll(settles).toBe(true);
  expect(await settles()).toBe(true);
});

test("the pointer over the picture draws nothing, over the view cube it does", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await screenPlace(page, "point", 1);
  const box = await app.viewport.boundingBox();
  if (!box) throw new Error("The view has no box");
  await page.mouse.move(box.x + 20, box.y + box.height / 2);
  await screenPlace(page, "point", 1);
  const before = await app.viewport.getAttribute("data-frames");
  await page.mouse.move(box.x + 30, box.y + box.height / 2 + 60, { steps: 12 });
  await page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );
  expect(await app.viewport.getAttribute("data-frames")).toBe(before);
  await nextFrame(app.viewport, () => page.mouse.move(box.x + box.width - 56, box.y + 56, { steps: 3 }));
});

test("the cut shows whole tetrahedra inside, on either side and along any axis", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const faces = async (): Promise<number> => Number(await app.viewport.getAttribute("data-faces"));
  const whole = await faces();
  const picture = await app.viewport.screenshot();
  await nextFrame(app.viewport, () => page.keyboard.press("x"));
  await expect.poll(faces).not.toBe(whole);
  const first = await faces();
  expect((await app.viewport.screenshot()).equals(picture)).toBe(false);
  await page.getByTestId("cut-flip").click();
  await expect.poll(faces).not.toBe(first);
  // Both parts together show the boundary once and the faces of the cut twice.
  const second = await faces();
  expect(first + second).toBeGreaterThan(whole);
  expect((first + second - whole) % 2).toBe(0);
  await page.getByRole("slider", { name: "Position" }).first().press("End");
  await expect.poll(faces).toBeLessThan(second);
  await page.getByTestId("cut-toggle").press("Space");
  await expect.poll(faces).toBe(whole);
});

test("a click in the view selects in the tree, and the tree marks in the view", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const corner = await screenPlace(page, "point", 6);
  await page.mouse.click(corner.x, corner.y);
  await expect(page.getByTestId("tree-point-6")).toHaveAttribute("aria-selected", "true");
  await expect(page.getByTestId("at-x")).toHaveValue("1");
  const front = await screenPlace(page, "patch", 3);
  await page.mouse.click(front.x, front.y);
  await expect(page.getByTestId("tree-patch-3")).toHaveAttribute("aria-selected", "true");
  await expect(page.getByTestId("tree-point-6")).toHaveAttribute("aria-selected", "false");
  await nextFrame(app.viewport, () => page.getByTestId("tree-patch-6").click());
  await page.keyboard.press("Escape");
  await expect(page.getByTestId("tree-patch-6")).toHaveAttribute("aria-selected", "false");
});

test("a click on the cut tells the tetrahedron's quality", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("x");
  await page.keyboard.press("3");
  const middle = await app.viewport.boundingBox();
  if (!middle) throw new Error("The view has no box");
  await page.getByTestId("viewport-canvas").click({
    position: { x: middle.width / 2, y: middle.height / 2 },
  });
  await expect(page.getByTestId("inspector")).toContainText(/Tetrahedron \d+/);
});

test("standard views and keys on the picture move the camera", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const seen = new Set<string>();
  for (const key of ["0", "1", "3", "7"]) {
    await nextFrame(app.viewport, () => page.keyboard.press(key));
    seen.add((await app.viewport.screenshot()).toString("base64"));
  }
  await page.getByTestId("viewport-canvas").focus();
  for (const key of ["ArrowLeft", "ArrowDown", "+", "Shift+ArrowRight"]) {
    await nextFrame(app.viewport, () => page.keyboard.press(key));
    seen.add((await app.viewport.screenshot()).toString("base64"));
  }
  expect(seen.size).toBe(8);
});

test("without WebGL the page says so and still meshes", async ({ page }) => {
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  const app = new AppPage(page);
  await app.open();
  await expect(page.getByRole("alert")).toContainText("This browser cannot show the view");
  expect((await app.mesh()).tets).toBeGreaterThan(1000);
  await expect(page.getByTestId("download")).toBeEnabled();
});

test("a lost graphics context is told and comes back", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const before = await app.colours();
  await page.getByTestId("viewport-canvas").evaluate((canvas) => {
    const context = (canvas as HTMLCanvasElement).getContext("webgl2");
    const loss = context?.getExtension("WEBGL_lose_context");
    loss?.loseContext();
    Reflect.set(window, "restoreContext", () => loss?.restoreContext());
  });
  await expect(page.getByRole("alert")).toContainText("has reset the view");
  await page.evaluate(() => (Reflect.get(window, "restoreContext") as () => void)());
  await expect(page.getByRole("alert")).toBeHidden();
  await nextFrame(app.viewport, () => page.keyboard.press("0"));
  expect(await app.colours()).toBeGreaterThan(before / 2);
});

test("regions are told apart by colour, counted, hidden and shown", async ({ page }) => {
  const app = new AppPage(page);
  const { tets } = await app.open("light", "pipe-and-flow");
  const faces = async (): Promise<number> => Number(await app.viewport.getAttribute("data-faces"));
  const whole = await faces();
  await page.getByRole("tab", { name: "Display" }).click();
  const shadings = page.getByRole("radiogroup", { name: "Shading" });
  const legend = page.getByRole("figure", { name: "Regions" });
  await expect(legend).toBeHidden();
  const before = await app.viewport.screenshot();
  await nextFrame(app.viewport, () => shadings.getByText("Region").click());
  await app.drawn();
  expect((await app.viewport.screenshot()).equals(before)).toBe(false);

  const entries = await legend.getByRole("button").all();
  const names = await Promise.all(entries.map((entry) => entry.getAttribute("aria-label")));
  const counts = names.map((name) => Number(name?.replaceAll(",", "").match(/: (\d+) /)?.[1]));
  expect(counts.length).toBeGreaterThan(1);
  expect(counts.reduce((sum, count) => sum + count)).toBe(tets);

  /** What is drawn with the other regions hidden. */
  const alone = async (wanted: number): Promise<number> => {
    for (const [index, entry] of entries.entries()) {
      const hide = index !== wanted;
      if ((await entry.getAttribute("aria-pressed")) === String(hide)) await entry.click();
      await expect(entry).toHaveAttribute("aria-pressed", String(!hide));
    }
    await app.drawn();
    return faces();
  };
  const drawn: number[] = [];
  for (const index of entries.keys()) drawn.push(await alone(index));
  // All of them together show the boundary once and each wall from both sides.
  const sum = drawn.reduce((total, count) => total + count);
  expect(Math.min(...drawn)).toBeGreaterThan(0);
  expect(sum).toBeGreaterThan(whole);
  expect((sum - whole) % 2).toBe(0);
  // The list among the layers is the same.
  await page.getByTestId("display-region-1").click();
  await expect(page.getByTestId("legend-region-1")).toHaveAttribute("aria-pressed", "true");
  await page.keyboard.press("Shift+H");
  await expect.poll(faces).toBe(whole);

  // Where there is one region, there is nothing to tell apart, and nothing stays hidden.
  await page.getByTestId("legend-region-1").click();
  await app.openExample("unit-cube");
  await expect(legend).toBeHidden();
  await expect.poll(faces).toBeGreaterThan(0);
});
