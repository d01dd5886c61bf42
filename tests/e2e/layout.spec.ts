import { expect, test, type Locator, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { DrawPage } from "./draw-page";
import { generateButton, tab } from "./controls";
import { sharedTest } from "./shared-page";

/** Opens the cube in a window of the size of a phone. */
async function openOnPhone(page: Page): Promise<AppPage> {
  await page.setViewportSize({ width: 390, height: 844 });
  const app = new AppPage(page);
  await app.openCube();
  return app;
}

sharedTest("on a phone the panels are drawers, and everything needed can be reached", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  const app = new AppPage(page);
  await app.open();
  await expect(page.getByTestId("app")).toHaveAttribute("data-layout", "phone");
  await expect(page.getByTestId("inspector")).toBeHidden();
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  expect(overflow).toBeLessThanOrEqual(0);

  const whole = await app.viewport.boundingBox();
  await page.getByTestId("drawer-left").click();
  const drawer = page.getByRole("dialog", { name: "Model" });
  await expect(drawer).toBeVisible();
  // The drawer does not cover the view, which keeps its middle on the model.
  await expect
    .poll(async () => {
      const [view, cover] = [await app.viewport.boundingBox(), await drawer.boundingBox()];
      return view && cover && view.height > 200 && view.y + view.height <= cover.y + 1;
    })
    .toBe(true);
  await app.select("patch-1");
  await page.keyboard.press("Escape");
  await expect.poll(() => app.viewport.boundingBox()).toEqual(whole);
  await page.getByTestId("drawer-right").click();
  await expect(page.getByTestId("entity-name")).toHaveValue("inlet");
  await page.getByRole("button", { name: "Close" }).click();
  await page.getByTestId("drawer-bottom").click();
  await expect(page.getByTestId("log")).toContainText("Done");
  await page.getByRole("button", { name: "Close" }).click();

  const before = await app.mesh();
  await page.getByTestId("drawer-left").click();
  await tab(page, "Examples").click();
  await page.getByTestId("example-unit-cube").click();
  await expect(app.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
  await app.meshed();
  await expect(page.getByRole("dialog")).toBeHidden();
});

sharedTest(
  "on a phone the model is as large as before when a panel is closed, unless the view was zoomed",
  async ({ page }) => {
    const app = await openOnPhone(page);
    const height = async (): Promise<number> => {
      const [low, high] = [await app.at([0.5, 0.5, 0]), await app.at([0.5, 0.5, 1])];
      return low.y - high.y;
    };
    const before = await height();
    const withPanel = async (act: () => Promise<void>): Promise<void> => {
      const whole = await app.viewport.boundingBox();
      await page.getByTestId("drawer-right").click();
      await expect.poll(async () => (await height()) < 0.8 * before).toBe(true);
      await act();
      await page.getByRole("button", { name: "Close" }).click();
      await expect.poll(() => app.viewport.boundingBox()).toEqual(whole);
    };
    await withPanel(async () => {
      // Names of patches and positions of elements are large enough for a finger.
      await page.getByRole("tab", { name: "Quality" }).click();
      const buttons = page.getByRole("table").getByRole("button");
      await expect(buttons.first()).toBeVisible();
      const heights = await buttons.evaluateAll((all) =>
        all.map((one) => one.getBoundingClientRect().height),
      );
      expect(Math.min(...heights)).toBeGreaterThanOrEqual(24);
    });
    await expect.poll(height).toBeCloseTo(before, 0);

    const { x, y } = await app.at([0.5, 0.5, 0.5]);
    await page.mouse.move(x, y);
    await page.mouse.wheel(0, 400);
    await expect.poll(height).toBeLessThan(0.9 * before);
    const zoomed = await height();
    await withPanel(() => Promise.resolve());
    await expect.poll(height).toBeCloseTo(zoomed, 0);
  },
);

test("on a screen of usual width, the controls of the player take one row above its bar and one below", async ({
  page,
}) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.goto("./?test=1&model=unit-cube&step=1223");
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-step", "1223");
  const centre = async (part: string): Promise<number> => {
    const box = await page.getByTestId(`player-${part}`).boundingBox();
    return (box?.y ?? NaN) + (box?.height ?? NaN) / 2;
  };
  const above = ["start", "counter", "speed", "follow", "film", "close"];
  const below = ["before", "kind", "stop-at", "coloring", "elements", "region"];
  for (const row of [above, below]) {
    const centres = await Promise.all(row.map(centre));
    expect(Math.max(...centres) - Math.min(...centres), row.join(" ")).toBeLessThan(8);
  }
});

sharedTest("a notice is in the view, and covers nothing of the panels below", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("s");
  const notice = page.getByTestId("notice-note");
  await expect(notice).toContainText("Select");
  await expect(page.getByRole("dialog")).toHaveCount(0);
  const [view, box] = [await app.viewport.boundingBox(), await notice.boundingBox()];
  const lowerEnd = (rect: typeof box): number => (rect?.y ?? NaN) + (rect?.height ?? NaN);
  expect(lowerEnd(box)).toBeLessThan(lowerEnd(view));
});

sharedTest("a notice covers nothing of a drawer at the lower end of the page", async ({ page }) => {
  await page.setViewportSize({ width: 1000, height: 800 });
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("s");
  await page.getByTestId("drawer-bottom").click();
  const log = page.getByTestId("log");
  await expect(log).toBeVisible();
  const [notice, panel] = [await page.getByTestId("notice-note").boundingBox(), await log.boundingBox()];
  expect((notice?.y ?? NaN) + (notice?.height ?? NaN)).toBeLessThan(panel?.y ?? NaN);
});

test("on a phone, notices leave the buttons of an operation free, and the number of problems and of open edges can be read", async ({
  page,
}) => {
  const app = await openOnPhone(page);
  const boxOf = async (locator: Locator) => {
    const box = await locator.boundingBox();
    if (!box) throw new Error("Not shown");
    return box;
  };
  const areApart = async (first: Locator, second: Locator): Promise<boolean> => {
    const [a, b] = [await boxOf(first), await boxOf(second)];
    return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
  };
  // A line that is deleted takes patches along, which a notice says, and leaves open edges.
  await app.click([0.5, 0, 1]);
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Delete");
  const openEdges = page.getByRole("button", { name: /^\d+ open edges$/ });
  await expect(openEdges).toBeVisible();
  expect(await areApart(openEdges, page.getByTestId("legend"))).toBe(true);
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Box…");
  await page.keyboard.press("Enter");
  await expect(page.getByTestId("accept")).toBeVisible();
  await expect(page.getByTestId(/^notice-/)).not.toHaveCount(0);
  for (const notice of await page.getByTestId(/^notice-/).all())
    expect(await areApart(notice, page.getByTestId("accept"))).toBe(true);
  await page.keyboard.press("Escape");
  await page.getByTestId("drawer-bottom").click();
  const badge = page.getByRole("tab", { name: /Problems/ }).getByText(/^\d+$/);
  await expect(badge).toBeVisible();
  expect(await badge.evaluate((label) => label.scrollWidth <= label.clientWidth)).toBe(true);
  await expect(page.getByTestId("legend")).toBeHidden();
});

test("on a phone a new piece is in view as a whole, beside the column of tools", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  const app = new AppPage(page);
  await page.goto("./?test=1&new=1");
  await expect(app.viewport).toHaveAttribute("data-frames", /./);
  await page.getByTestId("create-box").click();
  await page.getByTestId("accept").click();
  await expect(app.viewport).toHaveAttribute("data-points", "8");
  const column = await page.getByTestId("tool-select").boundingBox();
  const edges = async (): Promise<{
    readonly left: number;
    readonly right: number;
    readonly width: number;
  }> => {
    const xs = await page.evaluate(() => {
      const { tetrafrontPosition: at } = window as unknown as {
        tetrafrontPosition: (position: readonly number[]) => { x: number } | null;
      };
      const sides = [-0.5, 0.5];
      return sides.flatMap((x) => sides.flatMap((y) => [0, 1].map((z) => at([x, y, z])?.x ?? NaN)));
    });
    const { width = 0 } = (await app.viewport.boundingBox()) ?? {};
    return { left: Math.min(...xs), right: Math.max(...xs), width };
  };
  const isBeside = async (): Promise<boolean> => {
    const { left, right, width } = await edges();
    return column !== null && left >= column.x + column.width && right <= width;
  };
  await expect.poll(isBeside).toBe(true);
  const { left, right } = await edges();
  expect(right - left).toBeGreaterThan(200);
});

sharedTest(
  "the panel of a piece covers nothing of its preview, neither in an empty project nor beside a model",
  async ({ page }) => {
    const draw = new DrawPage(page);
    await draw.openNew();
    const corners = [-0.5, 0.5].flatMap((x) =>
      [-0.5, 0.5].flatMap((y) => [0, 1].map((z) => [x, y, z] as const)),
    );
    const gap = async (shift: number): Promise<number> => {
      const panel = await page.getByTestId("operation").boundingBox();
      const places = await Promise.all(corners.map(([x, y, z]) => draw.at([x + shift, y, z])));
      return Math.min(...places.map(({ x }) => x)) - ((panel?.x ?? NaN) + (panel?.width ?? NaN));
    };
    await page.getByTestId("create-box").click();
    await expect.poll(() => gap(0)).toBeGreaterThan(0);
    await page.getByTestId("accept").click();
    await draw.counts(8, 12, 6);
    await page.keyboard.press("Escape");
    const before = await draw.at([-0.5, 0, 0]);
    await page.getByTestId("create-box").click();
    await page.getByTestId("operation-position-x").fill("-3");
    await draw.counts(16, 24, 12);
    await expect.poll(() => gap(-3)).toBeGreaterThan(0);
    await page.keyboard.press("Escape");
    await draw.counts(8, 12, 6);
    await page.keyboard.press("f");
    await expect.poll(async () => Math.abs((await draw.at([-0.5, 0, 0])).x - before.x)).toBeLessThan(2);
  },
);

test.describe("by touch", () => {
  test.use({ hasTouch: true });

  test("on a phone lines and a circle are drawn with the fingers, and every choice is large enough and in view", async ({
    page,
  }) => {
    await page.setViewportSize({ width: 390, height: 844 });
    const draw = new DrawPage(page);
    await draw.openNew();
    const tap = async (position: readonly [number, number, number]): Promise<void> => {
      const { x, y } = await draw.at(position);
      await page.touchscreen.tap(x, y);
    };
    await expect(page.getByTestId("grid-unit")).toBeVisible();
    await page.getByTestId("tool-line").click();
    const [bar, hint] = [page.getByTestId("drawing-bar"), page.getByTestId("drawing-hint")];
    await expect(hint).toContainText("Enter ends the chain");
    for (const place of [[0, 0, 0], [1, 0, 0], [1, 1, 0]] as const) await tap(place); // prettier-ignore
    await draw.counts(3, 2, 0);
    const choices = bar.locator("button, select");
    const fitsTwoRows = async (): Promise<void> => {
      const rows = new Set<number>();
      for (const choice of await choices.all()) {
        await expect(choice).toBeInViewport({ ratio: 1 });
        const { y = 0, width = 0, height = 0 } = (await choice.boundingBox()) ?? {};
        expect(Math.min(width, height), (await choice.textContent()) ?? "").toBeGreaterThanOrEqual(40);
        rows.add(y);
      }
      expect(rows.size).toBeLessThanOrEqual(2);
    };
    // Types of lines, work plane and the one of the selection, three to snap to, typed coordinates, the end of the chain.
    expect(await choices.count()).toBe(8);
    await fitsTwoRows();
    const corner = await draw.at([1, 1, 0]);
    await page.getByRole("button", { name: "Finish" }).click();
    await expect(page.getByTestId("finish-drawing")).toBeHidden();
    expect(await draw.at([1, 1, 0])).toEqual(corner);
    // Without the end, this place would be joined to the last one.
    await tap([0, 1, 0]);
    await expect(page.getByTestId("finish-drawing")).toBeVisible();
    await draw.counts(3, 2, 0);
    await page.getByTestId("finish-drawing").click();
    await bar.getByLabel("Type of line").selectOption("circle by 3 points");
    await expect(hint).toContainText("three places");
    await bar.getByLabel("Type of line").selectOption("circle");
    await expect(hint).toContainText("the radius");
    await tap([0.5, 0.5, 0]);
    await fitsTwoRows();
    await page.getByTestId("type-coordinates").click();
    await page.getByTestId("coordinates").fill("0.3");
    await page.getByTestId("coordinates").press("Enter");
    await draw.counts(6, 3, 0);
    for (const tool of ["tool-source", "tool-move", "tool-point", "tool-measure"]) {
      await page.getByTestId(tool).click();
      await fitsTwoRows();
    }
    // What is drawn is not hidden where a drawer leaves little of the view.
    await expect(hint).toBeVisible();
    await page.getByTestId("drawer-right").click();
    await expect(hint).toBeHidden();
  });
});

sharedTest(
  "the view stays while lines are drawn within it, and a model that outgrows it is fitted beside the tools",
  async ({ page }) => {
    const draw = new DrawPage(page);
    await draw.openNew();
    await page.getByTestId("tool-line").click();
    await draw.click([0, 0, 0]);
    await draw.click([2, 0, 0]);
    const before = await draw.at([0, 0, 0]);
    // The fourth corner of the box of these points is outside.
    await draw.click([0, 2, 0]);
    await draw.counts(3, 2, 0);
    expect(await draw.at([0, 0, 0])).toEqual(before);
    await draw.typeCoordinates("0,2,9");
    await draw.counts(4, 3, 0);
    await expect.poll(() => draw.at([0, 0, 0])).not.toEqual(before);
    const column = await page.getByRole("toolbar", { name: "Tools" }).last().boundingBox();
    const view = await draw.viewport.boundingBox();
    for (const point of [
      [0, 0, 0],
      [2, 0, 0],
      [0, 2, 0],
      [0, 2, 9],
    ] as const) {
      // prettier-ignore
      const { x, y } = await draw.at(point);
      expect(x).toBeGreaterThan((column?.x ?? Infinity) + (column?.width ?? 0));
      expect(x).toBeLessThan((view?.x ?? 0) + (view?.width ?? 0));
      expect(y).toBeGreaterThan(view?.y ?? Infinity);
      expect(y).toBeLessThan((view?.y ?? 0) + (view?.height ?? 0));
    }
  },
);

sharedTest("what to draw next is never under the notice that the mesh is out of date", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("tool-line").click();
  for (const place of ["0,0,2", "0,1,2"]) {
    await page.keyboard.type(place);
    await page.keyboard.press("Enter");
    await expect(page.getByTestId("coordinates")).toBeHidden();
  }
  const [hint, badge] = [page.getByTestId("drawing-hint"), page.getByTestId("mesh-badge")];
  for (const width of [1440, 800]) {
    await page.setViewportSize({ width, height: 900 });
    await expect(badge).toBeVisible();
    const [above, below] = [await hint.boundingBox(), await badge.boundingBox()];
    expect((above?.y ?? 0) + (above?.height ?? 0)).toBeLessThanOrEqual(below?.y ?? 0);
  }
});

sharedTest(
  "the notice that the mesh is out of date is short while something is moved, and a click passes it",
  async ({ page }) => {
    const app = new AppPage(page);
    await app.openCube();
    await app.select("point-1");
    await app.type("position-x", "0.25");
    const badge = page.getByTestId("mesh-badge");
    const wide = (await badge.boundingBox())?.width ?? 0;
    await page.getByTestId("tool-move").click();
    await expect.poll(async () => (await badge.boundingBox())?.width ?? 0).toBeLessThan(0.6 * wide);
    // What is hidden stays for screen readers, and the button, which takes the pointer, shows it.
    const title = (await badge.getByRole("button").getAttribute("title")) ?? "";
    expect(title).not.toBe("");
    await expect(badge.getByText(title)).not.toHaveCSS("display", "none");
    expect((await badge.getByText(title).boundingBox())?.width).toBe(1);
    const text = await badge.locator("b").boundingBox();
    if (!text) throw new Error("The notice has no title");
    const [x, y] = [text.x + text.width / 2, text.y + text.height / 2];
    const under = await page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.tagName, [x, y] as const);
    expect(under).toBe("CANVAS");
    await badge.getByRole("button").click({ trial: true });
  },
);

sharedTest("a reason for a refused coordinate takes the width of all three fields", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("point-1");
  const field = page.getByTestId("position-z");
  const [before, first] = [await field.boundingBox(), await page.getByTestId("position-x").boundingBox()];
  await app.type("position-z", "1+");
  const reason = await page.getByText("Enter a number, such as 0.25 or 1/3").boundingBox();
  if (!before || !first || !reason) throw new Error("The fields or the reason are not shown");
  expect(reason.x).toBeCloseTo(first.x, 0);
  expect(reason.width).toBeGreaterThan(2.5 * before.width);
  expect(reason.y).toBeGreaterThanOrEqual(before.y + before.height);
  // The fields stay where they are.
  expect(await field.boundingBox()).toEqual(before);
});

sharedTest(
  "on a phone the palette opens from the menu, and the buttons of a long panel lie above its fields",
  async ({ page }) => {
    await openOnPhone(page);
    await page.getByRole("button", { name: "Menu" }).click();
    await page.getByRole("menuitem", { name: "Search commands" }).click();
    await page.getByRole("textbox", { name: "Search commands" }).fill("NACA");
    await page.keyboard.press("Enter");
    const panel = page.getByTestId("operation");
    await expect(panel).toContainText("NACA");
    for (const button of [panel.getByRole("button", { name: "Cancel" }), page.getByTestId("accept")]) {
      await expect(button).toBeInViewport({ ratio: 1 });
      const isOnTop = await button.evaluate((element) => {
        const { x, y, width, height } = element.getBoundingClientRect();
        const parts = [0.1, 0.3, 0.5, 0.7, 0.9];
        return parts.every((part) =>
          element.contains(document.elementFromPoint(x + part * width, y + height / 2)),
        );
      });
      expect(isOnTop).toBe(true);
    }
    await panel.getByRole("button", { name: "Cancel" }).click();
    await expect(panel).toBeHidden();
  },
);

sharedTest(
  "on a phone several entities are selected by taps, in one go from the menu to the view",
  async ({ page }) => {
    const app = await openOnPhone(page);
    await page.getByRole("button", { name: "Menu" }).click();
    await page.getByRole("menuitem", { name: "Edit", exact: true }).click();
    await page.getByRole("menuitemcheckbox", { name: /Select several/ }).click();
    await expect(page.getByRole("menu")).toBeHidden();
    for (const corner of [[0, 0, 0], [1, 0, 0], [1, 1, 1]] as const) await app.click(corner); // prettier-ignore
    await page.getByTestId("drawer-right").click();
    await expect(page.getByTestId("inspector")).toContainText("3 entities selected");
  },
);

sharedTest(
  "on a phone the number of problems is beside the button of their list, and a marker opens what is wrong",
  async ({ page }) => {
    const app = await openOnPhone(page);
    const button = page.getByTestId("drawer-bottom");
    await expect(button).toHaveAccessibleName("Log and problems");
    await button.click();
    const drawer = page.getByRole("dialog");
    await drawer.getByRole("button", { name: "Close" }).click();
    await app.click([0.9, 0, 0.1]);
    await page.keyboard.press("Delete");
    await expect(button).toHaveAccessibleName("Log and problems: 4");
    await expect(button).toContainText("4");
    await generateButton(page).click();
    await page.getByTestId("marker-0").click();
    await expect(drawer).toContainText("The surface is not closed");
    // The view with the problem is above the drawer.
    const [view, cover] = [await app.viewport.boundingBox(), await drawer.boundingBox()];
    expect((view?.y ?? 0) + (view?.height ?? 0)).toBeLessThanOrEqual((cover?.y ?? 0) + 1);
  },
);

sharedTest("on a phone every menu opens in place, and all its items can be reached", async ({ page }) => {
  await openOnPhone(page);
  await page.getByRole("button", { name: "Menu" }).click();
  const menu = page.getByRole("menu");
  for (const name of ["File", "View"]) {
    await menu.getByRole("menuitem", { name, exact: true }).click();
    const items = menu.getByRole("group", { name }).locator("[role^=menuitem]");
    expect(await items.count()).toBeGreaterThan(3);
    for (const item of await items.all()) {
      await item.scrollIntoViewIfNeeded();
      // Scrolling ends at a fraction of a pixel.
      await expect(item).toBeInViewport({ ratio: 0.99 });
    }
    await menu.getByRole("menuitem", { name, exact: true }).scrollIntoViewIfNeeded();
  }
  await expect(menu.getByRole("group")).toHaveCount(1);
});

sharedTest("the header fits at every width, both idle and during a run", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const overflow = () =>
    page.evaluate(() => {
      const header = document.querySelector("header");
      const label = header?.querySelector("[data-testid=generate] .mantine-Button-label");
      if (!header || !label) throw new Error("The page has no header");
      const excess = (): number =>
        Math.max(
          document.documentElement.scrollWidth - window.innerWidth,
          header.scrollWidth - header.clientWidth,
          header.scrollHeight - header.clientHeight,
        );
      const idleText = label.textContent;
      const idle = excess();
      label.textContent = "Meshing…";
      const meshing = excess();
      label.textContent = idleText;
      return Math.max(idle, meshing);
    });
  for (const width of [360, 390, 429, 430, 520, 699, 700, 720, 799, 800, 899, 900, 1099, 1100, 1440]) {
    await page.setViewportSize({ width, height: 800 });
    const layout = width < 700 ? "phone" : width < 1100 ? "narrow" : "wide";
    await expect(page.getByTestId("app")).toHaveAttribute("data-layout", layout);
    expect(await overflow(), `at ${width} pixels`).toBeLessThanOrEqual(0);
    const generate = await generateButton(page).boundingBox();
    expect((generate?.x ?? width) + (generate?.width ?? 0), `at ${width} pixels`).toBeLessThanOrEqual(width);
  }
});

test("by default the page has the colours of the system, and then those chosen", async ({ page }) => {
  const root = page.locator("html");
  await page.emulateMedia({ colorScheme: "dark" });
  await page.goto("./?test=1");
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "dark");
  await page.emulateMedia({ colorScheme: "light" });
  await expect(root).toHaveAttribute("data-mantine-color-scheme", "light");
  for (const other of ["dark", "light"]) {
    await page.getByTestId("theme").click();
    await expect(root).toHaveAttribute("data-mantine-color-scheme", other);
    await page.reload();
    await expect(root).toHaveAttribute("data-mantine-color-scheme", other);
  }
});

sharedTest("below 1100 pixels the side panels make room for the view", async ({ page }) => {
  await page.setViewportSize({ width: 1000, height: 700 });
  const app = new AppPage(page);
  await app.open();
  await expect(page.getByTestId("app")).toHaveAttribute("data-layout", "narrow");
  const view = await app.viewport.boundingBox();
  expect(view?.width).toBeGreaterThan(900);
  await page.setViewportSize({ width: 1440, height: 900 });
  await expect(page.getByTestId("app")).toHaveAttribute("data-layout", "wide");
  await expect(page.getByTestId("inspector")).toBeVisible();
  expect((await app.mesh()).tets).toBeGreaterThan(1000);
});

sharedTest("panels can be resized with the keyboard and by dragging", async ({ page }) => {
  const app = new AppPage(page);
  await app.open();
  const before = await app.viewport.boundingBox();
  const handle = page.getByRole("separator").first();
  await handle.focus();
  await page.keyboard.press("Shift+ArrowRight");
  await expect.poll(async () => (await app.viewport.boundingBox())?.width).toBeLessThan(before?.width ?? 0);
});

test("a part of the app that cannot be loaded is reported, and the rest keeps working", async ({ page }) => {
  await page.route(/later-panels-.*\.js$/, (route) => route.abort());
  const app = new AppPage(page);
  const before = await app.openCube();
  await tab(page, "Quality").click();
  await expect(page.getByRole("alert")).toContainText("could not be loaded");
  await page.getByRole("tab", { name: "Inspector" }).click();
  await expect(page.getByTestId("project-name")).toHaveValue("Unit cube");
  expect(await app.generate()).toEqual(before);
});

test("parts of the app that load later are available offline", async ({ page, context }) => {
  const fetched = page.waitForResponse(/later-panels-.*\.js$/);
  await new AppPage(page).openCube();
  await (await fetched).finished();
  await context.setOffline(true);
  await tab(page, "Quality").click();
  await expect(page.getByTestId("verdict")).toContainText("Verified");
});

test("on a phone, numbers of tables and labels of charts keep to one line, and a long name widens no panel", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.route("**/models/unit-cube.json", async (route) => {
    const project = (await (await route.fetch()).json()) as { patches: { name: string }[] };
    for (const patch of project.patches) patch.name = "a_name_without_a_blank".repeat(4);
    await route.fulfill({ json: project });
  });
  const app = new AppPage(page);
  await app.openCube();
  /** Texts of cells and labels that take several lines. */
  const broken = (selector: string): Promise<readonly string[]> =>
    page.locator(selector).evaluateAll((elements) =>
      elements.flatMap((element) => {
        const range = document.createRange();
        range.selectNodeContents(element);
        const tops = new Set([...range.getClientRects()].map(({ top }) => Math.round(top)));
        return tops.size > 1 ? [element.textContent] : [];
      }),
    );
  await page.getByTestId("drawer-bottom").click();
  await page.getByRole("tab", { name: "Patches" }).click();
  await expect(page.getByTestId("patch-row-1")).toBeVisible();
  expect(await broken('[data-testid="patch-table"] td')).toEqual([]);
  const drawer = page.getByRole("dialog");
  expect(await drawer.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBe(0);
  await page.keyboard.press("Escape");
  await page.getByTestId("drawer-right").click();
  await tab(page, "Quality").click();
  await expect(page.getByTestId("worst-0")).toBeVisible();
  expect(await broken('[data-testid="worst"] td, [data-testid^="chart-"] span')).toEqual([]);
});
