/**
 * Keeps the figure that the text speaks of in view: while the figure that the reader has touched last is out of view, its stage is
 * docked beside the text, or above it in a small window, until the reader has read on. A task that is not done calls for its
 * figure, too, as long as it is read.
 */
import { parseCondition, valuesIn } from "../condition";
import { button, element } from "../kit/dom";
import type { PageFigure, PageFigures } from "./page-figure";

/** Share of a figure, or of the window, that must be visible for the figure to be in view. */
const inView = 0.45;
/** Tasks between these shares of the window's height call: below the dock, if it is above the text. */
const callingShares = (): readonly [number, number] =>
  matchMedia("(max-width: 1279px)").matches ? [0.45, 0.9] : [0.2, 0.9];

/** Largest time from the end of a press to its click, in milliseconds. */
const clickMs = 50;

/** Window heights after which the reader has read on since a figure was touched. */
const interest = 1.2;

export class Dock {
  #last: PageFigure | null = null;
  /** Where the page was when the last figure was touched. */
  #lastAt = 0;
  #docked: PageFigure | null = null;
  #isPressed = false;
  /** Figures that the reader does not want to see docked until they are touched again. */
  readonly #closed = new Set<PageFigure>();
  readonly #tasks: readonly { readonly element: HTMLElement; readonly figure: PageFigure }[];
  readonly #bar = element(
    "div",
    { class: "dock-bar" },
    button({ class: "dock-back" }, "↑ To the figure", () => this.#goBack()),
    button({ class: "dock-close", "aria-label": "Close the small figure" }, "×", () => this.#close()),
  );

  constructor(readonly figures: PageFigures) {
    this.#tasks = [...document.querySelectorAll<HTMLElement>(".task")].flatMap((task) => {
      const [value] = valuesIn(parseCondition(task.dataset["until"] ?? ""));
      const figure = figures.get(value?.figure ?? "");
      return figure ? [{ element: task, figure }] : [];
    });
    for (const figure of figures.values())
      for (const type of ["pointerdown", "keydown"] as const)
        figure.element.addEventListener(type, (event) => {
          if (this.#bar.contains(event.target as Node)) return;
          if (event instanceof KeyboardEvent && event.key === "Escape") this.#close();
          else this.#remember(figure);
        });
    for (const type of ["scroll", "resize"])
      window.addEventListener(type, () => this.#follow(), { passive: true });
    // A figure that came between a press and its end would take the click.
    window.addEventListener("pointerdown", () => (this.#isPressed = true), { capture: true });
    for (const type of ["pointerup", "pointercancel", "blur"])
      window.addEventListener(type, () => this.#endPress(), { capture: true });
    // The end of a press may be outside the page.
    window.addEventListener("pointermove", ({ buttons }) => buttons === 0 && this.#endPress(), {
      capture: true,
      passive: true,
    });
  }

  /** The reader has touched a figure by the text; `word` stays visible beside it. Null: the page does not move. */
  touch(figure: PageFigure, word: HTMLElement | null): void {
    this.#remember(figure);
    this.#closed.delete(figure);
    if (word === null) return this.#follow();
    this.#update();
    if (this.#docked !== figure) return;
    const stage = stageOf(figure).getBoundingClientRect();
    const { top, left } = word.getBoundingClientRect();
    const isHidden = left < stage.right && left >= stage.left && top < stage.bottom + 8;
    if (isHidden) window.scrollBy(0, top - stage.bottom - 40);
  }

  #remember(figure: PageFigure): void {
    this.#last = figure;
    this.#lastAt = window.scrollY;
  }

  /** Waits for the click, which follows the end of a press. */
  #endPress(): void {
    if (!this.#isPressed) return;
    setTimeout(() => {
      this.#isPressed = false;
      this.#follow();
    }, clickMs);
  }

  /** Follows the reader, except during a press: what is held keeps its place and size. */
  #follow(): void {
    if (!this.#isPressed && document.querySelector(".held") === null) this.#update();
  }

  #update(): void {
    const all = [...this.figures.values()];
    const seen = all.filter((figure) => isInView(figure.element));
    if (seen.length > 0) {
      // A figure that is read now ends the interest in another one.
      if (this.#last && !seen.includes(this.#last)) this.#last = null;
      return this.#dock(null);
    }
    const calling = this.#tasks.find(({ element: task }) => isCalling(task))?.figure;
    if (Math.abs(window.scrollY - this.#lastAt) > interest * window.innerHeight) this.#last = null;
    const wanted = [calling, this.#last].find((figure) => figure && !this.#closed.has(figure));
    this.#dock(wanted ?? null);
  }

  #dock(figure: PageFigure | null): void {
    if (this.#docked === figure) return;
    if (this.#docked) {
      delete this.#docked.element.dataset["docked"];
      this.#docked.element.style.minHeight = "";
      this.#bar.remove();
    }
    this.#docked = figure;
    if (!figure) return;
    void figure.load();
    // The place of the figure stays as high as it was, and nothing moves.
    figure.element.style.minHeight = `${figure.element.getBoundingClientRect().height}px`;
    figure.element.dataset["docked"] = "true";
    stageOf(figure).prepend(this.#bar);
  }

  #close(): void {
    if (this.#docked) this.#closed.add(this.#docked);
    this.#dock(null);
  }

  #goBack(): void {
    const figure = this.#docked?.element;
    this.#dock(null);
    figure?.scrollIntoView({ block: "center" });
  }
}

const stageOf = ({ element: figure }: PageFigure): HTMLElement =>
  figure.querySelector<HTMLElement>(".stage") ?? figure;

function isInView(node: HTMLElement): boolean {
  const { top, bottom, height } = node.getBoundingClientRect();
  const visible = Math.min(bottom, window.innerHeight) - Math.max(top, 0);
  return visible > inView * Math.min(height, window.innerHeight);
}

function isCalling(task: HTMLElement): boolean {
  if (task.dataset["done"] === "true") return false;
  const { top, bottom } = task.getBoundingClientRect();
  const middle = (top + bottom) / 2 / window.innerHeight;
  const [from, to] = callingShares();
  return middle > from && middle < to;
}
