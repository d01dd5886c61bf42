/**
 * Printing: every figure is loaded, light, and as it stands in the window, only smaller. While a page is printed, neither frames nor
 * observers of sizes run, so a drawing cannot follow another width; it keeps its size, and is scaled.
 */
import { themeChanged } from "../kit/colours";
import { canvasRatio } from "../kit/stage";
import type { PageFigures } from "./page-figure";

/** Width of a figure on paper, in pixels of the style sheet: it fits A4 and Letter within the margins of all browsers. */
const paperWidth = 660;

export function startPrint(figures: PageFigures): void {
  window.addEventListener("keydown", (event) => {
    if (
      event.key.toLowerCase() !== "p" ||
      !(event.ctrlKey || event.metaKey) ||
      event.shiftKey ||
      event.altKey
    )
      return;
    event.preventDefault();
    void loadAll(figures).then(() => window.print());
  });
  let undo: (() => void) | null = null;
  window.addEventListener("beforeprint", () => {
    // By the menu of the browser, what is not loaded yet comes too late; the style sheet says so in its place.
    void loadAll(figures);
    undo ??= prepare(figures);
  });
  window.addEventListener("afterprint", () => {
    undo?.();
    undo = null;
  });
}

const loadAll = (figures: PageFigures): Promise<unknown> =>
  Promise.all([...figures.values()].map((figure) => figure.load().catch(() => null)));

/** Fixes the sizes and columns of all figures, and makes the page light; returns what undoes it. */
function prepare(figures: PageFigures): () => void {
  const { documentElement: root } = document;
  const theme = root.dataset["theme"];
  const fixed = [...figures.values()].flatMap(({ element }) => stylesOf(element));
  root.dataset["theme"] = "light";
  root.dataset["printed"] = "true";
  themeChanged();
  for (const { node, styles } of fixed)
    for (const [name, value] of Object.entries(styles)) node.style.setProperty(name, value);
  return () => {
    for (const { node, styles } of fixed)
      for (const name of Object.keys(styles)) node.style.removeProperty(name);
    delete root.dataset["printed"];
    if (theme === undefined) delete root.dataset["theme"];
    else root.dataset["theme"] = theme;
    themeChanged();
  };
}

interface FixedStyles {
  readonly node: HTMLElement;
  readonly styles: Readonly<Record<string, string>>;
}

/**
 * Returns the zoom up to a largest one by which drawings are scaled as the labels upon them. Chromium prints a canvas in whole 64ths
 * of its own pixels, rounded down; a little more than such a share stays one, although canvases have whole pixels.
 */
function exactZoom(largest: number): number {
  const step = canvasRatio() / 64;
  return (Math.floor(largest / step) + 0.08) * step;
}

/** Returns the styles by which a figure stays as it is, whatever the width of the paper. */
function stylesOf(figure: HTMLElement): readonly FixedStyles[] {
  const { width } = figure.getBoundingClientRect();
  const zoom = String(exactZoom(Math.min(1, paperWidth / Math.max(1, width))));
  const found: FixedStyles[] = [
    { node: figure, styles: { width: `${width}px`, zoom, "--print-zoom": zoom } },
  ];
  for (const node of figure.querySelectorAll<HTMLElement>(
    ":is(.scene, .cost-chart, .history), :is(.scene, .cost-chart, .history) canvas",
  )) {
    const box = node.getBoundingClientRect();
    found.push({ node, styles: { width: `${box.width}px`, height: `${box.height}px` } });
  }
  for (const node of figure.querySelectorAll<HTMLElement>("div")) {
    const { display, gridTemplateColumns } = getComputedStyle(node);
    if (display !== "grid") continue;
    found.push({ node, styles: { "grid-template-columns": gridTemplateColumns } });
    for (const child of node.children)
      if (child instanceof HTMLElement)
        found.push({ node: child, styles: { "grid-column": getComputedStyle(child).gridColumn } });
  }
  return found;
}
