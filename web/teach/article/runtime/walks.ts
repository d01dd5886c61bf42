/** Walks: the figure stays, and the paragraph that is being read sets its state. */
import type { PageFigures } from "./page-figure";
import { goTo } from "./words";

/** Share of the window's height where the reader reads: lower on small windows, where the figure is above the text. */
const readingLine = (): number =>
  window.innerHeight * (window.matchMedia("(max-width: 1000px)").matches ? 0.68 : 0.46);

export function startWalks(figures: PageFigures): void {
  for (const walk of document.querySelectorAll<HTMLElement>(".walk")) {
    const stops = [...walk.querySelectorAll<HTMLElement>(".stop")];
    let here: HTMLElement | null = null;
    const choose = (): void => {
      const next = nearest(stops);
      if (!next || next === here) return;
      const isFirst = here === null;
      here?.classList.remove("here");
      here = next;
      here.classList.add("here");
      const { top, bottom } = walk.getBoundingClientRect();
      // What the reader has changed in a figure stays until the reader goes on.
      if (!isFirst && top < window.innerHeight && bottom > 0) goTo(figures, here.dataset["go"] ?? "");
    };
    window.addEventListener("scroll", choose, { passive: true });
    window.addEventListener("resize", choose, { passive: true });
    choose();
  }
}

function nearest(stops: readonly HTMLElement[]): HTMLElement | null {
  const line = readingLine();
  const distances = stops.map((stop) => {
    const { top, height } = stop.getBoundingClientRect();
    return Math.abs(top + Math.min(height, 240) / 2 - line);
  });
  return stops[distances.indexOf(Math.min(...distances))] ?? null;
}
