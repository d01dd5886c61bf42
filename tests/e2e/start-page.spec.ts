/** The first minute: the start page, the first picture on a slow line, and further tabs. */
import AxeBuilder from "@axe-core/playwright";
import { expect, test, type Page } from "@playwright/test";
import { AppPage } from "./app-page";
import { boxSolid, stepFile } from "../support/step-files";
import { flipButton, generateButton } from "./controls";

const start = (page: Page) => page.getByTestId("start-page");

async function violations(page: Page): Promise<string[]> {
  const axe = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ["violations"] });
  const { violations: found } = await axe.analyze();
  return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
}

test("the first visit shows what this is beside the example, and opens a file or an example", async ({
  page,
}) => {
  const app = new AppPage(page);
  await page.addInitScript(() => Reflect.deleteProperty(window, "showOpenFilePicker"));
  await page.goto("./?test=1");
  await expect(start(page)).toContainText("Drop a STEP, STL or mesh here");
  await expect(start(page)).toContainText("MIT");
  await expect(start(page)).toContainText("Nothing is uploaded");
  expect(await violations(page)).toEqual([]);
  expect((await app.meshed()).tets).toBeGreaterThan(10_000);

  const choosing = page.waitForEvent("filechooser");
  await page.getByTestId("start-drop").click();
  const buffer = Buffer.from(stepFile([boxSolid("box", [0, 0, 0], [1, 2, 3])]));
  await (await choosing).setFiles({ name: "box.step", mimeType: "application/step", buffer });
  await expect(page.getByTestId("entity-name")).toHaveValue("box");
  await expect(start(page)).toBeHidden();

  // It comes back with what was opened, with a picture.
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "Start page" }).click();
  await page.getByTestId("start-example-unit-cube").click();
  await expect(start(page)).toBeHidden();
  expect((await app.meshed()).tets).toBe(1753);
});

test("the start page closes on Escape after a click in the view, and on a command for the model", async ({
  page,
}) => {
  const app = new AppPage(page);
  await page.goto("./?test=1");
  await expect(start(page)).toBeVisible();
  await app.meshed();
  const view = await app.viewport.boundingBox();
  await page.mouse.click(
    (view?.x ?? 0) + 0.75 * (view?.width ?? 0),
    (view?.y ?? 0) + 0.5 * (view?.height ?? 0),
  );
  await expect(start(page)).toBeVisible();
  await page.keyboard.press("Escape");
  await expect(start(page)).toBeHidden();
  await page.keyboard.press("Control+k");
  const search = page.getByRole("textbox", { name: "Search commands" });
  await search.fill("welcome");
  await page.keyboard.press("Enter");
  await expect(start(page)).toBeVisible();
  await page.keyboard.press("Control+k");
  await search.fill("Cut across x");
  await page.keyboard.press("Enter");
  await expect(flipButton(page)).toBeVisible();
  await expect(start(page)).toBeHidden();
});

test("the start page lists changed projects with picture and date", async ({ page }) => {
  await page.addInitScript(() => {
    // The page would wait for the picture, for seconds with a large mesh.
    HTMLCanvasElement.prototype.toBlob = () => {
      throw new Error("pictures of documents are made in a worker");
    };
  });
  const app = new AppPage(page);
  await app.openCube();
  await page.getByTestId("project-name").fill("Mine");
  await page.getByTestId("project-name").press("Enter");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
  // Opening a database that does not exist yet would make an empty one.
  const pictures = () =>
    page.evaluate(async () => {
      const name = "tetrafront-pictures";
      if (!(await indexedDB.databases()).some((database) => database.name === name)) return 0;
      return new Promise<number>((resolve) => {
        const opening = indexedDB.open(name);
        opening.onsuccess = () => {
          const { result } = opening;
          const counting = result.transaction("pictures").objectStore("pictures").count();
          counting.onsuccess = () => {
            resolve(counting.result);
            result.close();
          };
        };
      });
    });
  await expect.poll(pictures).toBe(1);
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "New project" }).click();
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "Start page" }).click();
  const row = start(page).getByRole("button", { name: /^Mine/ });
  await expect(row).toContainText(/now|minute/);
  await expect(row.locator("img")).toBeVisible();
  await row.click();
  await expect(page.getByTestId("project-name")).toHaveValue("Mine");
  // A project that is open has its date, too.
  await page.getByRole("menuitem", { name: "File" }).click();
  await page.getByRole("menuitem", { name: "Start page" }).click();
  await expect(row).toContainText(/(now|minute.*), open/);
  await page.keyboard.press("Escape");
  await expect(page.getByTestId("project-name")).toHaveValue("Mine");
});

test("a further tab shows the start page, and does not mesh the example again", async ({ page, context }) => {
  const first = new AppPage(page);
  await first.open();
  const second = await context.newPage();
  await second.goto("./?test=1");
  await expect(start(second)).toBeVisible();
  const viewport = second.getByTestId("viewport");
  await expect(viewport).toHaveAttribute("data-frames", /./);
  await expect(viewport).toHaveAttribute("data-busy", "false");
  await expect(viewport).toHaveAttribute("data-tets", "0");
  const isUnmeshed = async (): Promise<void> => {
    await second.reload();
    await expect(viewport).toHaveAttribute("data-frames", /./);
    await expect(viewport).toHaveAttribute("data-busy", "false");
    await expect(viewport).toHaveAttribute("data-tets", "0");
  };
  await isUnmeshed();
  await expect(start(second)).toBeVisible();
  await second.getByRole("button", { name: "Close start page" }).click();
  await expect(start(second)).toBeHidden();
  await isUnmeshed();
  await expect(start(second)).toBeHidden();
  // What the user has meshed is meshed again.
  await generateButton(second).click();
  await expect(viewport).toHaveAttribute("data-status", "done");
  await second.reload();
  await expect(viewport).toHaveAttribute("data-status", "done");
});

test("on a line of 400 kbit/s, the page says within 2 s what it is and that it is loading", async ({
  page,
}) => {
  const client = await page.context().newCDPSession(page);
  await client.send("Network.emulateNetworkConditions", {
    offline: false,
    latency: 150,
    downloadThroughput: 50_000,
    uploadThroughput: 50_000,
  });
  await page.goto("./?test=1&new=1", { waitUntil: "commit" });
  await expect(page.getByText("Nothing is uploaded.")).toBeVisible();
  const paint = await page.evaluate(
    () =>
      new Promise<number>((resolve) => {
        new PerformanceObserver((list) => {
          const [first] = list.getEntriesByName("first-contentful-paint");
          if (first) resolve(first.startTime);
        }).observe({ type: "paint", buffered: true });
      }),
  );
  expect(paint).toBeLessThan(2000);
  // The app then replaces the shell: at 50 kB a second, its scripts take longer than any other wait.
  await expect(page.getByTestId("viewport")).toHaveAttribute("data-frames", /./, { timeout: 60_000 });
  await expect(page.getByText("Loading…")).toBeHidden();
});
