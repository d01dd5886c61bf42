import { readFileSync } from "node:fs";
import { expect, test, type Page } from "@playwright/test";
import { AppPage, sampleProject } from "./app-page";
import { redoButton, undoButton } from "./controls";

const projectName = (page: Page) => page.getByTestId("project-name");

async function renameProject(page: Page, name: string): Promise<void> {
  await projectName(page).fill(name);
  await projectName(page).press("Enter");
}

async function openRecentDialog(page: Page) {
  await page.keyboard.press("Control+Shift+O");
  const dialog = page.getByRole("dialog", { name: "Open recent" });
  await expect(dialog).toBeVisible();
  return dialog;
}

async function kept(app: AppPage): Promise<void> {
  await expect(app.viewport).toHaveAttribute("data-autosaved", "true");
}

test("opening an example keeps a project with unsaved changes; a notice reopens it with its undo steps", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.select("background-node-1");
  await app.type("node-size", "0.3");
  const edited = await app.generate();
  await app.openExample("plate-with-hole");
  const notice = page.getByTestId("notice-document-left");
  await expect(notice).toContainText("“Unit cube” is available");
  await notice.getByRole("button", { name: "Reopen" }).click();
  await expect(projectName(page)).toHaveValue("Unit cube");
  expect(await app.meshed()).toEqual(edited);
  await page.getByRole("button", { name: "Undo: Set size of background node 1" }).click();
  await app.select("background-node-1");
  await expect(page.getByTestId("node-size")).toHaveValue("0.16");
});

test("leaving a project without changes shows no notice", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await app.openExample("plate-with-hole");
  await expect(page.getByTestId("notice-document-left")).toBeHidden();
  const dialog = await openRecentDialog(page);
  await expect(dialog).toContainText("No project has been changed yet.");
});

test("Recent lists changed projects, the latest first, and opens and removes them", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  for (const name of ["first", "second"]) {
    await renameProject(page, name);
    await page.getByRole("menuitem", { name: "File" }).click();
    await page.getByRole("menuitem", { name: "New project" }).click();
    await expect(projectName(page)).toHaveValue("Untitled");
  }
  const dialog = await openRecentDialog(page);
  const rows = dialog.getByRole("listitem");
  await expect(rows).toHaveText([/^second/, /^first/]);
  await rows.nth(1).getByRole("button", { name: "first" }).first().click();
  await expect(dialog).toBeHidden();
  await expect(projectName(page)).toHaveValue("first");
  await expect(page.getByRole("button", { name: "Undo: Rename project" })).toBeEnabled();
  await openRecentDialog(page);
  await expect(rows.nth(0)).toContainText("Open now");
  await dialog.getByRole("button", { name: "Remove “second”" }).click();
  await expect(rows).toHaveText([/^first/]);
});

test("a reload keeps the project with its undo and redo steps", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  for (const name of ["one", "two", "three"]) await renameProject(page, name);
  await undoButton(page).click();
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("two");
  await redoButton(page).click();
  await expect(projectName(page)).toHaveValue("three");
  for (const name of ["two", "one", "Unit cube"]) {
    await undoButton(page).click();
    await expect(projectName(page)).toHaveValue(name);
  }
  await expect(undoButton(page)).toBeDisabled();
});

test("an edit survives if the page crashes 0.1 s later", async ({ page, context }) => {
  const app = new AppPage(page);
  await app.openCube();
  await kept(app);
  const client = await context.newCDPSession(page);
  const crashed = page.waitForEvent("crash");
  await renameProject(page, "edited at the last moment");
  // Measure 0.1 s in the page, so that a busy machine does not shorten it.
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 100)));
  client.send("Page.crash").catch(() => undefined);
  await crashed;
  const after = await context.newPage();
  // On a busy machine, the locks of the crashed page are released some time later. This page of the site has no app.
  await after.goto("./index.json");
  const locks = () => after.evaluate(async () => (await navigator.locks.query()).held?.length);
  await expect.poll(locks).toBe(0);
  await after.goto("./?test=1");
  // If no other tab is open, a new tab continues with the project used last.
  await expect(projectName(after)).toHaveValue("edited at the last moment");
  await after.getByRole("button", { name: "Undo: Rename project" }).click();
  await expect(projectName(after)).toHaveValue("Unit cube");
});

test("three tabs keep their own projects after a reload, including an idle tab", async ({
  page,
  context,
}) => {
  const tabs: AppPage[] = [];
  for (const name of ["one", "two", "three"]) {
    const app = new AppPage(tabs.length === 0 ? page : await context.newPage());
    await app.openCube();
    await renameProject(app.page, name);
    await kept(app);
    tabs.push(app);
  }
  // The first tab is idle during the edits in the others.
  for (const app of tabs.slice(1)) {
    await app.select("background-node-1");
    for (const size of ["0.3", "0.25"]) await app.type("node-size", size);
    await kept(app);
  }
  for (const { page: tab } of tabs) await tab.reload();
  for (const [i, name] of ["one", "two", "three"].entries()) {
    const tab = tabs[i]?.page;
    if (tab) await expect(projectName(tab)).toHaveValue(name);
  }
});

test("a new tab does not open a project that is open in another tab", async ({ page, context }) => {
  const app = new AppPage(page);
  await app.openCube();
  await renameProject(page, "mine");
  await kept(app);
  const other = new AppPage(await context.newPage());
  await other.page.goto("./?test=1");
  await expect(projectName(other.page)).toHaveValue("Engine intake");
  const dialog = await openRecentDialog(other.page);
  await expect(dialog.getByRole("listitem")).toHaveText([/^mine.*Open in another tab/]);
});

test("the address selects the project, and a reload keeps the changes to it", async ({ page }) => {
  const app = new AppPage(page);
  await app.openCube();
  await renameProject(page, "my cube");
  await kept(app);
  await page.goto("./?test=1&model=plate-with-hole");
  await expect(projectName(page)).toHaveValue("Plate with a hole");
  await expect(page.getByTestId("notice-document-left")).toContainText("“my cube” is available");
  await renameProject(page, "my plate");
  await kept(app);
  await page.goto("./?test=1&model=plate");
  await expect(page.getByRole("dialog", { name: "There is no example “plate”" })).toContainText(
    "plate-with-hole",
  );
  await page.keyboard.press("Escape");
  await expect(projectName(page)).toHaveValue("my plate");
  await page.reload();
  await expect(projectName(page)).toHaveValue("my plate");
  const dialog = await openRecentDialog(page);
  await expect(dialog.getByRole("listitem")).toHaveText([/^my plate/, /^my cube/]);
});

test("the address ?new=1 opens an empty project, and a reload keeps what was drawn in it", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  await renameProject(page, "my cube");
  await kept(app);
  await page.goto("./?test=1&new=1");
  await expect(projectName(page)).toHaveValue("Untitled");
  await expect(page.getByTestId("notice-document-left")).toContainText("“my cube” is available");
  for (const kind of ["points", "lines", "patches"]) {
    await expect(app.viewport).toHaveAttribute(`data-${kind}`, "0");
  }
  await expect(app.viewport).toHaveAttribute("data-status", "none");
  await renameProject(page, "my drawing");
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("my drawing");
});

test("a failed autosave is reported and repeated, and the notice disappears when it succeeds", async ({
  page,
}) => {
  const app = new AppPage(page);
  await app.openCube();
  await kept(app);
  await page.evaluate(() => {
    const store = IDBObjectStore.prototype;
    const put = Object.getOwnPropertyDescriptor(store, "put") ?? {};
    store.put = () => {
      throw new DOMException("The disk is full", "QuotaExceededError");
    };
    Object.assign(window, { repair: () => Object.defineProperty(store, "put", put) });
  });
  await renameProject(page, "kept in the end");
  const notice = page.getByTestId("notice-autosave-failed");
  await expect(notice).toContainText("The disk is full");
  await expect(app.viewport).toHaveAttribute("data-autosaved", "false");
  await page.evaluate(() => (window as unknown as { repair: () => void }).repair());
  await expect(notice).toBeHidden();
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("kept in the end");
});

test("saving never writes a project into another project's file, even after a reload", async ({ page }) => {
  const app = new AppPage(page, { filePickers: true });
  await app.openCube();
  const files = () =>
    page.evaluate(async () => {
      const folder = await navigator.storage.getDirectory();
      const names: Record<string, string> = {};
      for await (const [name, handle] of folder as unknown as AsyncIterable<[string, FileSystemFileHandle]>) {
        // Skip temporary files, which exist while a file is written.
        const text = name.endsWith(".json") && (await handle.getFile().then((file) => file.text(), () => null)); // prettier-ignore
        if (text) names[name] = (JSON.parse(text) as { readonly name: string }).name;
      }
      return names;
    });
  // Files can disappear while they are listed; that is tried again.
  const expectFiles = (expected: Readonly<Record<string, string>>) =>
    expect(async () => expect(await files()).toEqual(expected)).toPass({ timeout: 60_000 });
  const chooseNext = (name: string) =>
    page.evaluate((chosen) => Object.assign(window, { chosenFile: chosen }), name);

  await renameProject(page, "A");
  await chooseNext("a.json");
  await page.keyboard.press("Control+Shift+S");
  await expect(page.getByTestId("saved-state")).toHaveText("saved");
  await app.openFile("b.json", JSON.stringify({ ...sampleProject("unit-cube"), name: "B" }));
  await expect(projectName(page)).toHaveValue("B");
  await renameProject(page, "B changed");
  await chooseNext("b-copy.json");
  await page.keyboard.press("Control+Shift+S");
  await expectFiles({ "a.json": "A", "b.json": "B", "b-copy.json": "B changed" });
  // The file exists before the document refers to it.
  await expect(page.getByTestId("saved-state")).toHaveText("saved");

  await renameProject(page, "B again");
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("B again");
  await page.getByTestId("viewport-canvas").focus();
  await page.keyboard.press("Control+s");
  await expectFiles({ "a.json": "A", "b.json": "B", "b-copy.json": "B again" });
});

test("a document that an earlier version of the app has stored opens with its steps, and keeps them", async ({
  page,
}) => {
  const fixture = new URL("../fixtures/kept-document-with-patches.json", import.meta.url);
  const { kept: document } = JSON.parse(readFileSync(fixture, "utf8")) as { readonly kept: object };
  // A page of the site without the app.
  await page.goto("./index.json");
  await page.evaluate(storeAsVersion2, document);
  await page.goto("./?test=1");
  await expect(projectName(page)).toHaveValue("Random");
  const app = new AppPage(page);
  const points = (): Promise<string | null> => app.viewport.getAttribute("data-points");
  await expect.poll(points).toBe("6");
  const undo = undoButton(page);
  const last = await undo.getAttribute("aria-label");
  await undo.click();
  await renameProject(page, "Renamed");
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("Renamed");
  await expect(undo).toHaveAttribute("aria-label", /Rename project/);
  await undo.click();
  await expect(projectName(page)).toHaveValue("Random");
  await expect(undo).not.toHaveAttribute("aria-label", last ?? "");
  for (let step = 0; step < 14; ++step) await undo.click();
  await expect(undo).toBeDisabled();
  await expect.poll(points).toBe("0");
});

test("without locks, two tabs have projects of their own, and the last edit of a closed one is kept", async ({
  context,
  page,
}) => {
  await context.addInitScript(() => Reflect.deleteProperty(Navigator.prototype, "locks"));
  const app = new AppPage(page);
  await app.openCube();
  await renameProject(page, "First");
  await kept(app);
  const other = await context.newPage();
  await other.goto("./?test=1");
  await expect(projectName(other)).not.toHaveValue(/^(First|)$/);
  await renameProject(other, "Other");
  await kept(new AppPage(other));
  await other.close();
  await renameProject(page, "Last");
  await kept(app);
  await page.reload();
  await expect(projectName(page)).toHaveValue("Last");
  const dialog = await openRecentDialog(page);
  await expect(dialog.getByRole("listitem")).toHaveText([/^Last/, /^Other/]);
});

/** Makes the database of version 2 with one document, in the page. */
function storeAsVersion2(document: object): Promise<void> {
  return new Promise((resolve, reject) => {
    const opening = indexedDB.open("tetrafront", 2);
    opening.onerror = () => reject(new Error("The database cannot be opened"));
    opening.onupgradeneeded = () => {
      const store = opening.result.createObjectStore("documents", { keyPath: "id" });
      store.createIndex("recent", ["listed", "at", "name"]);
    };
    opening.onsuccess = () => {
      const { result } = opening;
      const transaction = result.transaction("documents", "readwrite");
      transaction.objectStore("documents").put(document);
      transaction.oncomplete = () => {
        result.close();
        resolve();
      };
    };
  });
}
