/**
 * The lesson as slides, for a lecture: a figure on the left, one stop, paragraph or task on the right, in large type. The keys of
 * a clicker turn the slides: Page Down and Page Up, B for a black screen, Escape to end.
 */
import { button, element } from "../kit/dom";
import type { PageFigures } from "./page-figure";
import { goTo } from "./words";

interface Slide {
  readonly figure: HTMLElement | null;
  readonly parts: readonly Element[];
  /** State of the figure; null if the slide leaves it as it is. */
  readonly destination: string | null;
}

const onKeys: ReadonlySet<string> = new Set(["PageDown", "ArrowRight", "ArrowDown", " ", "Enter"]);
const backKeys: ReadonlySet<string> = new Set(["PageUp", "ArrowLeft", "ArrowUp", "Backspace"]);

/** Part of its column that a formula made smaller has at most: its numbers may get more digits. */
const roomForDigits = 0.92;
/** Columns of KaTeX have a margin of as many pixels that is no ink. */
const emptyMargin = 2;

export class Slides {
  readonly #slides: readonly Slide[];
  readonly #root = document.documentElement;
  readonly #count = element("p", { class: "slide-count", role: "status" });
  readonly #button = button({ class: "slides-button" }, "Slides", () => this.#toggle());
  #present = -1;

  constructor(readonly figures: PageFigures) {
    this.#slides = slidesOf(document.querySelector("main"));
    document.querySelector(".top nav")?.append(this.#button);
    document.body.append(this.#count);
    // Before the figures, whose numbers have these keys, too.
    window.addEventListener("keydown", (event) => this.#key(event), { capture: true });
    window.addEventListener("resize", () => this.#fitFormulas());
    document.fonts.addEventListener("loadingdone", () => this.#fitFormulas());
    const numbers = new MutationObserver(() => this.#isOn && this.#fitFormulas());
    for (const formula of document.querySelectorAll(".formula.displayed"))
      numbers.observe(formula, { childList: true, characterData: true, subtree: true });
    if (new URLSearchParams(location.search).has("slides")) this.#show(0);
  }

  get #isOn(): boolean {
    return this.#present >= 0;
  }

  #toggle(): void {
    if (this.#isOn) return this.#end();
    // The slide of what is read now.
    const line = window.innerHeight / 3;
    const index = this.#slides.findLastIndex(
      ({ parts }) => (parts[0]?.getBoundingClientRect().top ?? Infinity) < line,
    );
    this.#show(Math.max(0, index));
  }

  #key(event: KeyboardEvent): void {
    if (!this.#isOn || event.ctrlKey || event.altKey || event.metaKey) return;
    const act = this.#actionOf(event);
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  #actionOf({ key, target }: KeyboardEvent): (() => void) | null {
    const isClicker = key === "PageDown" || key === "PageUp";
    // Other keys belong to the number, handle or button that has the focus.
    const isFree = target === document.body || target === this.#root;
    if ((isClicker || isFree) && onKeys.has(key)) return () => this.#show(this.#present + 1);
    if ((isClicker || isFree) && backKeys.has(key)) return () => this.#show(this.#present - 1);
    if (key === "Home" && isFree) return () => this.#show(0);
    if (key === "End" && isFree) return () => this.#show(this.#slides.length - 1);
    if (key === "b" || key === "B" || key === ".") return () => this.#root.toggleAttribute("data-black");
    if (key === "Escape") return () => (this.#root.hasAttribute("data-black") ? this.#light() : this.#end());
    return null;
  }

  #light(): void {
    this.#root.removeAttribute("data-black");
  }

  #show(index: number): void {
    const to = Math.min(this.#slides.length - 1, Math.max(0, index));
    const slide = this.#slides[to];
    if (!slide) return;
    this.#light();
    const isSame = to === this.#present;
    this.#present = to;
    this.#root.dataset["slides"] = slide.figure ? "figure" : "text";
    for (const each of document.querySelectorAll("[data-on]")) each.removeAttribute("data-on");
    for (const part of [...slide.parts, ...(slide.figure ? [slide.figure] : [])]) {
      part.setAttribute("data-on", "");
      part.closest(".walk")?.setAttribute("data-on", "");
      part.closest(".stop")?.setAttribute("data-on", "");
    }
    this.#count.textContent = `${to + 1} / ${this.#slides.length}`;
    this.#button.textContent = "Article";
    window.scrollTo(0, 0);
    this.#fitFormulas();
    if (slide.figure) void this.figures.get(slide.figure.id.replace("figure-", ""))?.load();
    if (slide.destination !== null && !isSame) goTo(this.figures, slide.destination);
  }

  /** Makes formulas smaller that are wider than the column of a slide: nobody scrolls them in a lecture. */
  #fitFormulas(): void {
    for (const formula of document.querySelectorAll<HTMLElement>(".formula.displayed")) {
      formula.style.fontSize = "";
      if (!this.#isOn || formula.scrollWidth <= formula.clientWidth + emptyMargin) continue;
      const share = (roomForDigits * formula.clientWidth) / formula.scrollWidth;
      formula.style.fontSize = `${share * Number.parseFloat(getComputedStyle(formula).fontSize)}px`;
    }
  }

  #end(): void {
    const part = this.#slides[this.#present]?.parts[0];
    this.#present = -1;
    this.#light();
    delete this.#root.dataset["slides"];
    for (const each of document.querySelectorAll("[data-on]")) each.removeAttribute("data-on");
    this.#button.textContent = "Slides";
    this.#count.textContent = "";
    this.#fitFormulas();
    part?.scrollIntoView({ block: "center" });
    // A page that is loaded again stays the article.
    const address = new URL(location.href);
    address.searchParams.delete("slides");
    history.replaceState(history.state, "", address);
  }
}

/** Text stands beside the last figure before it; a heading goes with what follows, a formula with what is before it. */
function slidesOf(main: HTMLElement | null): readonly Slide[] {
  const slides: Slide[] = [];
  let figure: HTMLElement | null = null;
  let heads: Element[] = [];
  for (const node of main?.children ?? []) {
    if (node.matches("nav")) continue;
    if (node.matches(".walk")) {
      figure = node.querySelector<HTMLElement>(".figure");
      for (const stop of node.querySelectorAll<HTMLElement>(".stop"))
        slides.push({ figure, parts: [stop], destination: stop.dataset["go"] ?? null });
    } else if (node.matches(".figure")) figure = node as HTMLElement;
    else if (node.matches(".number, h1, h2")) heads.push(node);
    else if (node.matches(".formula, .displayed, blockquote") && slides.length > 0 && heads.length === 0) {
      const last = slides.pop();
      if (last) slides.push({ ...last, parts: [...last.parts, node] });
    } else {
      slides.push({
        figure: node.matches(".lead") ? null : figure,
        parts: [...heads, node],
        destination: null,
      });
      heads = [];
    }
  }
  return slides;
}
