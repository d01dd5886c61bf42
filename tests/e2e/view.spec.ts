import { expect, test, type Page } from "@playwright/test";
import { AppPage, countOrange, forEachPixel, nextFrame, sampleProject } from "./app-page";
import { flipButton, toggle } from "./controls";
import { sharedTest } from "./shared-page";

/**
 * Returns the position of an entity in the view, by the query that `?test=1` provides; null if it is out of view.
 */
async function projected(page: Page, kind: string, id: number): Promise<{ x: number; y: number } | null> {
  return page.evaluate(
    ([kind, id]) => {
      const query = Reflect.get(window, "tetrafrontProject") as (
        kind: string,
        id: number,
      ) => { x: number; y: number } | null;
      return query(kind, id);
    },
    [kind, id] as const,
  );
}

/**
 * Returns the position of an entity in the page, once the view no longer moves: a model that was just opened has
 * yet to be fitted.
 */
async function screenPosition(page: Page, kind: string, id: number): Promise<{ x: number; y: number }> {
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

test("the view draws the mesh in many colours, and not at all when it is hidden", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const withMesh = await app.colours();
  expect(withMesh).toBeGreaterThan(150);
  await page.getByRole("tab", { name: "Display" }).click();
  await nextFrame(app.viewport, () => page.getByRole("switch", { name: "Mesh", exact: true }).press("Space"));
  expect(await app.colours()).toBeLessThan(withMesh / 2);
});

sharedTest("the view draws only when something has changed", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  await nextFrame(app.viewport, () => page.keyboard.press("7"));
  const frames = () => app.viewport.getAttribute("data-frames");
  // A running loop would draw in one of two animation frames; an idle view does not.
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

sharedTest("moving the pointer over empty space and over the view cube draws no frame", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await screenPosition(page, "point", 1);
  const box = await app.viewport.boundingBox();
  if (!box) throw new Error("The view has no box");
  await page.mouse.move(box.x + 20, box.y + box.height / 2);
  await screenPosition(page, "point", 1);
  const before = await app.viewport.getAttribute("data-frames");
  await page.mouse.move(box.x + 30, box.y + box.height / 2 + 60, { steps: 12 });
  await page.getByRole("button", { name: "Front view" }).hover();
  await page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );
  expect(await app.viewport.getAttribute("data-frames")).toBe(before);
});

sharedTest(
  "a drag of the view cube turns the camera and may end beside it; the view then answers as before",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const box = await app.viewport.boundingBox();
    if (!box) throw new Error("The view has no box");
    const cube = { x: box.x + box.width - 56, y: box.y + 56 };
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const top: Position = [0.5, 0.5, 1];
    const before = await app.at(top);
    await page.mouse.move(cube.x, cube.y, { steps: 3 });
    await page.mouse.down();
    await nextFrame(app.viewport, () => page.mouse.move(cube.x - 30, cube.y + 20, { steps: 4 }));
    await page.mouse.move(middle.x, middle.y, { steps: 6 });
    await page.mouse.up();
    await screenPosition(page, "patch", 6);
    const after = await app.at(top);
    expect(Math.hypot(after.x - before.x, after.y - before.y)).toBeGreaterThan(5);
    // Without a pressed button, the pointer turns nothing.
    await page.mouse.move(middle.x + 90, middle.y + 40, { steps: 4 });
    await page.mouse.move(middle.x, middle.y, { steps: 4 });
    expect(await app.at(top)).toEqual(after);
    // A click selects, and a drag in the view turns the camera.
    const hit = await screenPosition(page, "patch", 6);
    await page.mouse.click(hit.x, hit.y);
    await expect(page.getByTestId("tree-patch-6")).toHaveAttribute("aria-selected", "true");
    const corner = await app.at([0, 0, 1]);
    await page.mouse.move(middle.x, middle.y);
    await page.mouse.down({ button: "right" });
    await nextFrame(app.viewport, () => page.mouse.move(middle.x + 80, middle.y, { steps: 4 }));
    await page.mouse.up({ button: "right" });
    expect(await app.at([0, 0, 1])).not.toEqual(corner);
  },
);

sharedTest(
  "the view cube turns the camera by pointer and by keyboard, and turns with it",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const cube = page.getByRole("group", { name: "View cube" });
    const face = (name: string) => cube.getByRole("button", { name, exact: true });
    /** Where the upper corner at the front right is, relative to the lower one at the front left. */
    const across = async (): Promise<string> => {
      await screenPosition(page, "patch", 3);
      const [from, to] = [await app.at([0, 0, 0]), await app.at([1, 0, 1])];
      return [to.x - from.x, from.y - to.y]
        .map((pixels) => (Math.abs(pixels) < 1 ? 0 : Math.sign(pixels)))
        .join();
    };
    await face("Front view").click();
    await expect.poll(across).toBe("1,1");
    const seen = await face("Front view").boundingBox();
    expect((seen?.width ?? 0) / (seen?.height ?? 1)).toBeCloseTo(1, 1);
    await face("Back view").press("Enter");
    await expect.poll(across).toBe("-1,1");
    await face("Top view").press("Space");
    // What is nearer is farther from the middle.
    await expect.poll(across).toBe("1,-1");
    // The corner at the lower right is that of the front and the right.
    const box = await cube.boundingBox();
    if (!box) throw new Error("The view has no cube");
    await page.mouse.click(box.x + box.width / 2 + 27.5, box.y + box.height / 2 + 27.5);
    await expect.poll(across).toBe("1,1");
  },
);

sharedTest("a selected point is emphasized from near and from far", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("point-1");
  /** Number of pixels in the colour of the selection around the point. */
  const blue = async (): Promise<number> => {
    const { x, y } = await app.at([0, 0, 0]);
    const clip = { x: Math.round(x) - 4, y: Math.round(y) - 4, width: 8, height: 8 };
    let count = 0;
    forEachPixel(await page.screenshot({ clip }), (r, _, b) => (count += Number(b > r + 80)));
    return count;
  };
  await expect.poll(blue).toBeGreaterThan(40);
  const width = async (): Promise<number> => (await app.at([1, 0, 0])).x - (await app.at([0, 0, 0])).x;
  const before = await width();
  const { x, y } = await app.at([0, 0, 0]);
  await page.mouse.move(x, y);
  for (let step = 0; step < 15; ++step) await page.mouse.wheel(0, 300);
  await expect.poll(width).toBeLessThan(0.2 * before);
  await expect.poll(blue).toBeGreaterThan(40);
});

test("the cut shows whole tetrahedra, on either side of its plane", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const faces = async (): Promise<number> => Number(await app.viewport.getAttribute("data-faces"));
  const whole = await faces();
  const picture = await app.viewport.screenshot();
  await nextFrame(app.viewport, () => page.keyboard.press("x"));
  await expect.poll(faces).not.toBe(whole);
  const first = await faces();
  expect((await app.viewport.screenshot()).equals(picture)).toBe(false);
  await flipButton(page).click();
  await expect.poll(faces).not.toBe(first);
  // Both sides together show the boundary once and the faces of the cut twice.
  const second = await faces();
  expect(first + second).toBeGreaterThan(whole);
  expect((first + second - whole) % 2).toBe(0);
  await page.getByRole("slider", { name: "Position" }).first().press("End");
  await expect.poll(faces).toBeLessThan(second);
  await toggle(page, "Cut").press("Space");
  await expect.poll(faces).toBe(whole);
});

sharedTest(
  "a click in the view selects the entity in the tree, and the view highlights the tree's selection",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const corner = await screenPosition(page, "point", 6);
    await page.mouse.click(corner.x, corner.y);
    await expect(page.getByTestId("tree-point-6")).toHaveAttribute("aria-selected", "true");
    await expect(page.getByTestId("position-x")).toHaveValue("1");
    const front = await screenPosition(page, "patch", 3);
    await page.mouse.click(front.x, front.y);
    await expect(page.getByTestId("tree-patch-3")).toHaveAttribute("aria-selected", "true");
    await expect(page.getByTestId("tree-point-6")).toHaveAttribute("aria-selected", "false");
    await nextFrame(app.viewport, () => page.getByTestId("tree-patch-6").click());
    await page.keyboard.press("Escape");
    await expect(page.getByTestId("tree-patch-6")).toHaveAttribute("aria-selected", "false");
  },
);

sharedTest("a click on the cut shows the tetrahedron's quality", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.keyboard.press("x");
  await nextFrame(app.viewport, () => page.keyboard.press("3"));
  await app.drawn();
  const middle = await app.viewport.boundingBox();
  if (!middle) throw new Error("The view has no box");
  await page.getByTestId("viewport-canvas").click({
    position: { x: middle.width / 2, y: middle.height / 2 },
  });
  await expect(page.getByTestId("inspector")).toContainText(/Tetrahedron \d+/);
});

type Position = readonly [number, number, number];

/** Returns the direction on the screen from one position to another, in pixels to the right and upwards. */
async function onScreen(page: Page, from: Position, to: Position): Promise<{ right: number; up: number }> {
  return page.evaluate(
    ([start, end]) => {
      const query = Reflect.get(window, "tetrafrontPosition") as (
        position: Position,
      ) => { x: number; y: number } | null;
      const [a, b] = [query(start), query(end)];
      if (!a || !b) throw new Error("Out of view");
      return { right: b.x - a.x, up: a.y - b.y };
    },
    [from, to] as const,
  );
}

const cubeCentre: Position = [0.5, 0.5, 0.5];

/** Keys of the standard views: the axes of the model that point to the right and upwards. */
const standardViews: Readonly<Record<string, readonly [right: Position, up: Position]>> = {
  "1": [[1, 0, 0], [0, 0, 1]], // prettier-ignore
  "3": [[0, 1, 0], [0, 0, 1]], // prettier-ignore
  "7": [[1, 0, 0], [0, 1, 0]], // prettier-ignore
  "Alt+1": [[-1, 0, 0], [0, 0, 1]], // prettier-ignore
  "Alt+3": [[0, -1, 0], [0, 0, 1]], // prettier-ignore
  "Alt+7": [[1, 0, 0], [0, -1, 0]], // prettier-ignore
};

sharedTest("the standard views look along the axes", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  const towards = async (axis: Position) =>
    onScreen(page, cubeCentre, [0.5 + 0.2 * axis[0], 0.5 + 0.2 * axis[1], 0.5 + 0.2 * axis[2]]);
  for (const [key, [right, up]] of Object.entries(standardViews)) {
    await nextFrame(app.viewport, () => page.keyboard.press(key));
    await expect.poll(async () => Math.abs((await towards(right)).up), { message: key }).toBeLessThan(0.5);
    const [across, upward] = [await towards(right), await towards(up)];
    expect(across.right, key).toBeGreaterThan(20);
    expect(Math.abs(upward.right), key).toBeLessThan(1);
    expect(upward.up, key).toBeGreaterThan(20);
  }
  // In the isometric view, x points to the right and down, y to the right and up, and z up.
  await nextFrame(app.viewport, () => page.keyboard.press("0"));
  const [x, y, z] = [await towards([1, 0, 0]), await towards([0, 1, 0]), await towards([0, 0, 1])];
  expect(Math.min(x.right, -x.up, y.right, y.up, z.up)).toBeGreaterThan(10);
  expect(Math.abs(z.right)).toBeLessThan(1);
});

sharedTest("a click on the top of the view cube shows x to the right", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", ({ message }) => errors.push(message));
  const app = new AppPage(page);
  await app.openCube();
  const box = await app.viewport.boundingBox();
  if (!box) throw new Error("there is no view");
  // In the isometric view, the upper face is above the middle of the cube.
  await page.mouse.click(box.x + box.width - 56, box.y + 56 - 24);
  const along = (end: Position) => onScreen(page, cubeCentre, end);
  await expect.poll(async () => Math.abs((await along([0.7, 0.5, 0.5])).up)).toBeLessThan(0.5);
  expect((await along([0.7, 0.5, 0.5])).right).toBeGreaterThan(20);
  expect((await along([0.5, 0.7, 0.5])).up).toBeGreaterThan(20);
  expect(errors).toEqual([]);
});

sharedTest("keys rotate, zoom and pan the view", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await nextFrame(app.viewport, () => page.keyboard.press("1"));
  await page.getByTestId("viewport-canvas").focus();
  const press = async (key: string): Promise<void> => nextFrame(app.viewport, () => page.keyboard.press(key));
  /** Directions on the screen from the centre to a position behind it and to one beside it. */
  const behind = () => onScreen(page, cubeCentre, [0.5, 0.9, 0.5]);
  const beside = () => onScreen(page, cubeCentre, [0.9, 0.5, 0.5]);

  await press("ArrowLeft");
  expect((await behind()).right).toBeLessThan(-5);
  await press("ArrowRight");
  expect(Math.abs((await behind()).right)).toBeLessThan(1);
  await press("ArrowDown");
  expect((await behind()).up).toBeLessThan(-5);
  await press("ArrowUp");
  expect(Math.abs((await behind()).up)).toBeLessThan(1);

  const width = (await beside()).right;
  await press("+");
  expect((await beside()).right / width).toBeCloseTo(1.15, 1);
  await press("-");
  expect((await beside()).right / width).toBeCloseTo(1, 2);

  const centre = await projected(page, "patch", 3);
  await press("Shift+ArrowRight");
  const panned = await projected(page, "patch", 3);
  expect((panned?.x ?? 0) - (centre?.x ?? 0)).toBeGreaterThan(5);
  expect(panned?.y).toBeCloseTo(centre?.y ?? 0, 0);
});

sharedTest(
  "a double click on an entity edits it, from any tab; beside the model it fits the view",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await nextFrame(app.viewport, () => page.keyboard.press("1"));
    await app.stillView();
    const edge = () => onScreen(page, [0, 0, 0], [1, 0, 0]);
    const whole = (await edge()).right;
    const corner = await screenPosition(page, "point", 2);
    await page.getByRole("tab", { name: "Quality" }).click();
    await page.mouse.dblclick(corner.x, corner.y);
    await expect(page.getByTestId("entity-name")).toHaveAttribute("placeholder", "Point 2");
    await expect(page.getByTestId("position-x")).toBeFocused();
    await page.keyboard.type("0.25");
    await page.keyboard.press("Enter");
    await expect(page.getByTestId("tree-point-2")).toContainText("0.25");
    await page.keyboard.press("Control+z");
    await page.getByRole("tab", { name: "Quality" }).click();
    await page.getByTestId("tree-point-2").press("F2");
    await expect(page.getByTestId("entity-name")).toBeFocused();
    await page.getByTestId("viewport-canvas").focus();
    await nextFrame(app.viewport, () => page.keyboard.press("Shift+F"));
    await expect.poll(async () => (await edge()).right).toBeGreaterThan(2 * whole);
    const box = await app.viewport.boundingBox();
    if (!box) throw new Error("The view has no box");
    // Beside the column of tools.
    await page.mouse.dblclick(box.x + 80, box.y + box.height / 2);
    await expect.poll(async () => Math.round((await edge()).right)).toBe(Math.round(whole));
  },
);

sharedTest(
  "Tab selects what is hidden under the pointer, and Ctrl+click takes one entity off a selection",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const selection = page.locator('[role="treeitem"][aria-selected="true"]');
    const selected = async (...keys: readonly string[]): Promise<void> => {
      await expect(selection).toHaveCount(keys.length);
      for (const key of keys)
        await expect(page.getByTestId(`tree-${key}`)).toHaveAttribute("aria-selected", "true");
    };
    const corner = await screenPosition(page, "point", 7);
    await page.mouse.click(corner.x, corner.y);
    await selected("point-7");
    await page.keyboard.press("Tab");
    await expect(page.getByTestId("tree-point-7")).toHaveAttribute("aria-selected", "false");
    await expect(selection).toHaveCount(1);
    await page.keyboard.press("Shift+Tab");
    await selected("point-7");
    // The key moves the focus again when the pointer has left the point.
    await page.mouse.move(corner.x + 40, corner.y + 40);
    await page.keyboard.press("Tab");
    await selected("point-7");
    await expect(page.getByTestId("viewport-canvas")).not.toBeFocused();

    for (const [id, ...keys] of [
      [6, "point-6", "point-7"],
      [5, "point-5", "point-6", "point-7"],
      [6, "point-5", "point-7"],
    ] as const) {
      const { x, y } = await screenPosition(page, "point", id);
      await page.keyboard.down("Control");
      await page.mouse.click(x, y);
      await page.keyboard.up("Control");
      await selected(...keys);
    }
    // Twice, as fast as a double click: off and on again. The view stays.
    const last = await screenPosition(page, "point", 7);
    await page.keyboard.down("Control");
    await page.mouse.dblclick(last.x, last.y);
    await page.keyboard.up("Control");
    await selected("point-5", "point-7");
    expect(await screenPosition(page, "point", 7)).toEqual(last);
  },
);

sharedTest(
  "the entity under the pointer is highlighted, and a drag rotates the view without selecting",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    const corner = await screenPosition(page, "point", 6);
    const before = await app.viewport.screenshot();
    await nextFrame(app.viewport, () => page.mouse.move(corner.x, corner.y));
    await expect(page.getByTestId("hover-label")).toContainText("6");
    expect((await app.viewport.screenshot()).equals(before)).toBe(false);
    const turned = await projected(page, "point", 6);
    await page.mouse.down({ button: "right" });
    await page.mouse.move(corner.x + 80, corner.y + 30, { steps: 5 });
    await page.mouse.up({ button: "right" });
    await expect.poll(() => projected(page, "point", 6)).not.toEqual(turned);
    await expect(page.getByTestId("context-menu")).toBeHidden();
    await expect(page.locator('[data-testid^="tree-"][aria-selected="true"]')).toHaveCount(0);
  },
);

/** What the view says of a run at some moment: the number of faces of the front, 0 without one, and the text of the legend. */
interface ShownFront {
  readonly faces: number;
  readonly legend: string;
  readonly isBusy: boolean;
}

/** Runs in the page: notes what the view says at each change. From outside, a busy machine would miss some of it. */
function watchFront(view: HTMLElement | SVGElement): void {
  const shownFronts: ShownFront[] = [];
  Object.assign(window, { shownFronts });
  const note = (): void => {
    const faces = Number(view.dataset["frontDrawn"] ?? 0);
    const legend = document.querySelector('[data-testid="legend"]')?.textContent ?? "";
    const last = shownFronts.at(-1);
    if (last?.faces !== faces || last.legend !== legend)
      shownFronts.push({ faces, legend, isBusy: view.dataset["busy"] === "true" });
  };
  new MutationObserver(note).observe(document.body, { subtree: true, childList: true, attributes: true });
}

sharedTest("the front is drawn while it advances", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByRole("tab", { name: "Display" }).click();
  const before = countOrange(await app.viewport.screenshot());
  const cube = sampleProject("unit-cube");
  const fine = cube.background.nodes.map((node) => ({ ...node, size: 0.02 }));
  const background = { ...cube.background, nodes: fine };
  // The front alone: beside a lattice, it ends too soon to be seen twice.
  const project = { ...cube, name: "Fine cube", background, meshing: { ...cube.meshing, interior: "front" } };
  await app.viewport.evaluate(watchFront);
  await app.openFile("fine.json", JSON.stringify(project));
  const shown = () =>
    page.evaluate(() => (window as unknown as { shownFronts: readonly ShownFront[] }).shownFronts);
  const orange = async (): Promise<number> => countOrange(await app.viewport.screenshot());
  await expect.poll(orange).toBeGreaterThan(before + 5000);
  const ofFront = async () => (await shown()).filter(({ faces }) => faces > 1000);
  await expect.poll(async () => (await ofFront()).length).toBeGreaterThan(1);
  // Until the result, the view shows the mesh that is being optimized.
  const ofMesh = async () => (await shown()).filter(({ legend }) => legend.includes("not optimized yet"));
  await expect.poll(async () => (await ofMesh()).length).toBeGreaterThan(0);
  for (const { legend } of await ofFront()) expect(legend).toBe("");
  expect((await ofMesh()).at(-1)).toMatchObject({ faces: 0, isBusy: true });
  await page.getByTestId("cancel").click();
  await expect(app.viewport).toHaveAttribute("data-busy", "false");
});

test("without a graphics processor, a view at rest is drawn in a higher resolution than one that moves", async ({
  page,
}) => {
  await page.goto("/?model=unit-cube");
  const canvas = page.getByTestId("viewport-canvas");
  const ratio = (): Promise<number> =>
    canvas.evaluate((element) =>
      element instanceof HTMLCanvasElement ? element.width / element.clientWidth : 0,
    );
  await expect.poll(ratio).toBe(2);
  await canvas.evaluate((element) => {
    let least = Infinity;
    const note = (): void => {
      if (!(element instanceof HTMLCanvasElement)) return;
      least = Math.min(least, element.width / element.clientWidth);
      element.dataset["least"] = String(least);
    };
    new MutationObserver(note).observe(element, { attributeFilter: ["width"] });
  });
  await canvas.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowLeft");
  await expect.poll(async () => Number(await canvas.getAttribute("data-least"))).toBeGreaterThan(0);
  expect(Number(await canvas.getAttribute("data-least"))).toBeLessThanOrEqual(1);
  await expect.poll(ratio).toBe(2);
});

test("without WebGL the page reports it and still meshes", async ({ page }) => {
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  const app = new AppPage(page);
  await app.open();
  await expect(page.getByRole("alert")).toContainText("This browser cannot show the view");
  expect((await app.mesh()).tets).toBeGreaterThan(1000);
  await expect(page.getByTestId("download")).toBeEnabled();
});

test("a lost graphics context is reported and restored", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const before = await app.colours();
  await page.getByTestId("viewport-canvas").evaluate((canvas) => {
    const context = (canvas as HTMLCanvasElement).getContext("webgl2");
    const loss = context?.getExtension("WEBGL_lose_context");
    loss?.loseContext();
    Reflect.set(window, "restoreContext", () => loss?.restoreContext());
  });
  await expect(page.getByRole("alert")).toContainText("reset the view");
  await page.evaluate(() => (Reflect.get(window, "restoreContext") as () => void)());
  await expect(page.getByRole("alert")).toBeHidden();
  await nextFrame(app.viewport, () => page.keyboard.press("0"));
  expect(await app.colours()).toBeGreaterThan(before / 2);
});

test("regions have different colours, show their numbers of tetrahedra, and can be hidden and shown", async ({
  page,
}) => {
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

  /** Returns the number of faces drawn with only this region visible. */
  const alone = async (shown: number): Promise<number> => {
    for (const [index, entry] of entries.entries()) {
      const hide = index !== shown;
      if ((await entry.getAttribute("aria-pressed")) === String(hide)) await entry.click();
      await expect(entry).toHaveAttribute("aria-pressed", String(!hide));
    }
    await app.drawn();
    return faces();
  };
  const drawn: number[] = [];
  for (const index of entries.keys()) drawn.push(await alone(index));
  // All regions together show the boundary once and each interface from both sides.
  const sum = drawn.reduce((total, count) => total + count);
  expect(Math.min(...drawn)).toBeGreaterThan(0);
  expect(sum).toBeGreaterThan(whole);
  expect((sum - whole) % 2).toBe(0);
  // The list of regions in the display tab does the same.
  await page.getByTestId("display-region-1").click();
  await expect(page.getByTestId("legend-region-1")).toHaveAttribute("aria-pressed", "true");
  await page.keyboard.press("Shift+H");
  await expect.poll(faces).toBe(whole);

  // With a single region there is no legend, and no region stays hidden.
  await page.getByTestId("legend-region-1").click();
  await app.openExample("unit-cube");
  await expect(legend).toBeHidden();
  await expect.poll(faces).toBeGreaterThan(0);
});
