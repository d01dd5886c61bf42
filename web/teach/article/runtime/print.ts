/**
 * Printing: every figure is loaded, light, and as it stands in the window, only smaller. While a page is printed, neither frames nor
 * observers of sizes run, so a drawing cannot follow another width; it keeps its size, and is scaled.
 */
import { themeChanged } from "../kit/colours";
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

/** Fixes the sizes of all figures, and makes the page light; returns what undoes it. */
function prepare(figures: PageFigures): () => void {
  const { documentElement: root } = document;
  const theme = root.dataset["theme"];
  const changed: HTMLElement[] = [];
  const sizes = [...figures.values()].flatMap(({ element }) =>
    [...element.querySelectorAll<HTMLElement>(".scene, canvas")].map((node) => {
      const { width, height } = node.getBoundingClientRect();
      return { node, width, height };
    }),
  );
  const widths = [...figures.values()].map(({ element }) => ({ element, width: element.offsetWidth }));
  root.dataset["theme"] = "light";
  themeChanged();
  for (const { node, width, height } of sizes) {
    node.style.width = `${width}px`;
    node.style.height = `${height}px`;
    changed.push(node);
  }
  for (const { element, width } of widths) {
    element.style.width = `${width}px`;
    element.style.zoom = String(Math.min(1, paperWidth / Math.max(1, width)));
    changed.push(element);
  }
  return () => {
    if (theme === undefined) delete root.dataset["theme"];
    else root.dataset["theme"] = theme;
    for (const { style } of changed)
      for (const name of ["width", "height", "zoom"]) style.removeProperty(name);
    themeChanged();
  };
}
