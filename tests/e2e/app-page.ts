import { readFileSync } from "node:fs";
import { expect, type Locator, type Page } from "@playwright/test";
import { inflateSync } from "node:zlib";
import { readProject, type Project } from "tetrafront/project";
import { generateButton, tab } from "./controls";
import { isLoaded, usualSize } from "./shared-page";

/** Number of tetrahedra and fingerprint of the app's mesh, as stored in attributes of the page. */
export interface MeshState {
  readonly tets: number;
  readonly fingerprint: string;
}

export type Position = readonly [x: number, y: number, z: number];

const modelsFolder = new URL("../../public/models/", import.meta.url);

export function sampleProject(id: string): Project {
  const read = readProject(readFileSync(new URL(`${id}.json`, modelsFolder), "utf8"));
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** The application in a browser tab. Its methods wait for states of the page, never for a fixed time. */
export class AppPage {
  readonly page: Page;
  readonly viewport: Locator;

  readonly #filePickers: boolean;

  /**
   * Tests cannot use native file dialogs, so the app uses downloads and file inputs. With `filePickers`, its
   * dialogs choose files in the page's private folder instead: `window.chosenFile` names the next one.
   */
  constructor(page: Page, { filePickers = false }: { readonly filePickers?: boolean } = {}) {
    this.page = page;
    this.#filePickers = filePickers;
    this.viewport = page.getByTestId("viewport");
  }

  /** Opens the app with a model, by default the opening one, and waits for its mesh. */
  async open(scheme: "auto" | "dark" | "light" = "dark", model?: string): Promise<MeshState> {
    if (isLoaded(this.page)) return this.#openAgain(model ?? "engine-intake");
    await this.page.addInitScript((scheme) => {
      localStorage.setItem("mantine-color-scheme-value", scheme);
      // The start page covers a part of the view.
      localStorage.setItem("tetrafront-start-page", "never");
      Reflect.deleteProperty(window, "showOpenFilePicker");
      Reflect.deleteProperty(window, "showSaveFilePicker");
    }, scheme);
    if (this.#filePickers) await this.page.addInitScript(choosePrivateFiles);
    await this.page.goto(model === undefined ? "./?test=1" : `./?test=1&model=${model}`);
    return this.meshed();
  }

  /** Opens the app with the smallest model. */
  async openCube(): Promise<MeshState> {
    return this.open("dark", "unit-cube");
  }

  /** Opens an example in the app of an earlier test. */
  async #openAgain(model: string): Promise<MeshState> {
    const size = this.page.viewportSize();
    // Without points between two documents, the second one cannot be taken for the first.
    await this.#empty();
    await tab(this.page, "Examples").click();
    await this.page.getByTestId(`example-${model}`).click();
    await expect(this.viewport).not.toHaveAttribute("data-points", "0");
    const state = await this.meshed();
    await this.tidy();
    await this.#resize(size);
    return state;
  }

  /**
   * Opens an empty project in the app of an earlier test. Returns whether there is such an app. `reset` takes back choices that
   * belong to no document, in a window of the usual size.
   */
  async openEmptyAgain(reset: () => Promise<void> = () => Promise.resolve()): Promise<boolean> {
    if (!isLoaded(this.page)) return false;
    const size = this.page.viewportSize();
    await this.#empty();
    await reset();
    await this.#resize(size);
    return true;
  }

  async #resize(size: { readonly width: number; readonly height: number } | null): Promise<void> {
    if (!size || (size.width === usualSize.width && size.height === usualSize.height)) return;
    await this.page.setViewportSize(size);
    await this.rest();
  }

  async #empty(): Promise<void> {
    await this.tidy();
    await this.page.getByRole("menuitem", { name: "File", exact: true }).click();
    await this.page.getByRole("menuitem", { name: "New project" }).click();
    await expect(this.viewport).toHaveAttribute("data-points", "0");
    await expect(this.viewport).toHaveAttribute("data-busy", "false");
    await this.page.keyboard.press("0");
  }

  /** Closes what is open over the page, and shows the tabs that a new page shows, in a window of the usual size. */
  async tidy(): Promise<void> {
    await this.page.setViewportSize(usualSize);
    for (let i = 0; i < 5 && (await this.page.locator("[role=dialog], [role=menu]").count()) > 0; i++) {
      await this.page.keyboard.press("Escape");
      await this.page.waitForTimeout(50);
    }
    await this.page.mouse.move(0, 0);
    await this.page.getByTestId("viewport-canvas").focus();
    for (let i = 0; i < 3; i++) await this.page.keyboard.press("Escape");
    await this.page.evaluate(() => {
      for (const button of document.querySelectorAll<HTMLElement>(
        "[data-testid^=notice-] [aria-label=Dismiss]",
      ))
        button.click();
      for (const tab of document.querySelectorAll<HTMLElement>("[role=tab][aria-selected=false]"))
        if (/^(Model|Inspector|Log)$/.test(tab.textContent)) tab.click();
    });
  }

  /** Where a position appears on the page. */
  async at(position: Position): Promise<{ readonly x: number; readonly y: number }> {
    const box = await this.viewport.boundingBox();
    const found = await this.page.evaluate((position) => {
      const { tetrafrontPosition } = window as unknown as {
        tetrafrontPosition: (position: Position) => { x: number; y: number } | null;
      };
      return tetrafrontPosition(position);
    }, position);
    if (!box || !found) throw new Error(`${position.join()} is not in view`);
    return { x: box.x + found.x, y: box.y + found.y };
  }

  async click(position: Position): Promise<void> {
    const { x, y } = await this.at(position);
    await this.page.mouse.click(x, y);
  }

  /** Waits until the mesh shown is that of the present model. */
  async meshed(): Promise<MeshState> {
    await expect(this.viewport).toHaveAttribute("data-busy", "false");
    await expect(this.viewport).toHaveAttribute("data-stale", "false");
    await expect(this.viewport).toHaveAttribute("data-status", "done");
    await this.drawn();
    return this.mesh();
  }

  /** Waits until the requested faces are drawn; returns at once if there is no view. */
  async drawn(): Promise<void> {
    await expect(this.viewport).not.toHaveAttribute("data-drawn", "false");
  }

  async mesh(): Promise<MeshState> {
    return {
      tets: Number(await this.viewport.getAttribute("data-tets")),
      fingerprint: (await this.viewport.getAttribute("data-fingerprint")) ?? "",
    };
  }

  async openExample(id: string): Promise<MeshState> {
    const before = await this.mesh();
    await tab(this.page, "Examples").click();
    await this.page.getByTestId(`example-${id}`).click();
    await expect(this.viewport).not.toHaveAttribute("data-fingerprint", before.fingerprint);
    return this.meshed();
  }

  /** Opens a project through the replacement of the file dialog. */
  async openFile(name: string, content: string): Promise<void> {
    if (this.#filePickers) {
      await this.page.evaluate(writeChosenFile, [name, content] as const);
      await this.page.keyboard.press("Control+o");
      return;
    }
    const choosing = this.page.waitForEvent("filechooser");
    await this.page.keyboard.press("Control+o");
    const chooser = await choosing;
    await chooser.setFiles({ name, mimeType: "application/json", buffer: Buffer.from(content) });
  }

  /** Selects an entity in the tree by kind and id, e.g. "point-2". */
  async select(key: string): Promise<void> {
    const filter = this.page.getByLabel("Filter (name, type, id)");
    await filter.fill(key.replace("background-", "").replace("-", " "));
    await this.page.getByTestId(`tree-${key}`).click();
    await filter.fill("");
  }

  /** Types a value into a field and commits it. */
  async type(testId: string, value: string): Promise<void> {
    await this.page.getByTestId(testId).fill(value);
    await this.page.getByTestId(testId).press("Enter");
  }

  /** Returns a picture of the view at rest: edges become smooth in a frame of its own, some time after the last motion. */
  async stillView(): Promise<Buffer> {
    await this.rest();
    return this.viewport.screenshot();
  }

  /** Waits until the view has drawn nothing for longer than it waits before it draws sharply. */
  async rest(): Promise<void> {
    await this.viewport.evaluate(async (view) => {
      let frames = view.dataset["frames"];
      for (let looks = 0; looks < 6; ++looks) {
        await new Promise((next) => setTimeout(next, 100));
        await new Promise((next) => requestAnimationFrame(next));
        if (view.dataset["frames"] === frames) continue;
        frames = view.dataset["frames"];
        looks = 0;
      }
    });
  }

  async generate(): Promise<MeshState> {
    await generateButton(this.page).click();
    return this.meshed();
  }

  /** Number of colours in the picture, with 5 bits per channel. */
  async colours(): Promise<number> {
    return countColours(await this.viewport.screenshot());
  }
}

/** Runs in the page: replaces the file dialogs; they choose `window.chosenFile` without asking. */
function choosePrivateFiles(): void {
  const choose = async (): Promise<FileSystemFileHandle> => {
    const { chosenFile } = window as unknown as { readonly chosenFile: string };
    return (await navigator.storage.getDirectory()).getFileHandle(chosenFile, { create: true });
  };
  Object.assign(window, { showOpenFilePicker: async () => [await choose()], showSaveFilePicker: choose });
}

/** Runs in the page: writes a file, which the next dialog chooses. */
async function writeChosenFile([name, content]: readonly [string, string]): Promise<void> {
  const handle = await (await navigator.storage.getDirectory()).getFileHandle(name, { create: true });
  const stream = await handle.createWritable();
  await stream.write(content);
  await stream.close();
  Object.assign(window, { chosenFile: name });
}

/** Calls `act` and waits until a later frame has been drawn. */
export async function nextFrame(viewport: Locator, act: () => Promise<void>): Promise<void> {
  const before = Number(await viewport.getAttribute("data-frames"));
  await act();
  await expect.poll(async () => Number(await viewport.getAttribute("data-frames"))).toBeGreaterThan(before);
}

/** Number of colours in a PNG, with 5 bits per channel. */
export function countColours(png: Buffer): number {
  const colours = new Set<number>();
  forEachPixel(png, (r, g, b) => colours.add(((r >> 3) << 10) | ((g >> 3) << 5) | (b >> 3)));
  return colours.size;
}

/**
 * Number of orange pixels: red exceeds green and green exceeds blue by more than 30, and red exceeds blue by more
 * than 85, of 255.
 */
export function countOrange(png: Buffer): number {
  let count = 0;
  forEachPixel(png, (r, g, b) => (count += Number(r > g + 30 && g > b + 30 && r > b + 85)));
  return count;
}

/** Visits the pixels of a PNG written by Chromium: 8 bits per channel, not interlaced. */
export function forEachPixel(png: Buffer, visit: (r: number, g: number, b: number) => void): void {
  const width = png.readUInt32BE(16);
  const height = png.readUInt32BE(20);
  const channels = png[25] === 6 ? 4 : 3;
  const data: Buffer[] = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") {
      data.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    }
  }
  const rows = unfilter(inflateSync(Buffer.concat(data)), width * channels, height, channels);
  for (let i = 0; i < rows.length; i += channels) visit(rows[i] ?? 0, rows[i + 1] ?? 0, rows[i + 2] ?? 0);
}

/** Undoes PNG's row filters (PNG specification, section 9). */
function unfilter(raw: Buffer, stride: number, height: number, pixel: number): Uint8Array {
  const rows = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)] ?? 0;
    for (let x = 0; x < stride; ++x) {
      const at = y * stride + x;
      const left = x >= pixel ? (rows[at - pixel] ?? 0) : 0;
      const above = y > 0 ? (rows[at - stride] ?? 0) : 0;
      const corner = x >= pixel && y > 0 ? (rows[at - stride - pixel] ?? 0) : 0;
      const guess = [0, left, above, (left + above) >> 1, paeth(left, above, corner)][filter] ?? 0;
      rows[at] = ((raw[y * (stride + 1) + 1 + x] ?? 0) + guess) & 255;
    }
  }
  return rows;
}

function paeth(left: number, above: number, corner: number): number {
  const guess = left + above - corner;
  const distances = [left, above, corner].map((value) => Math.abs(guess - value));
  const nearest = Math.min(...distances);
  return [left, above, corner][distances.indexOf(nearest)] ?? 0;
}
