/** A figure of the page: its values from the beginning, its drawing from when it is near the window. */
import type { FigurePlan } from "../declaration";
import { figureLoaders } from "../figures/registry";
import type { Figure } from "../kit/figure";
import { Values } from "../kit/values";

/** How far from the window a figure is loaded. */
const nearness = "100% 0px";

export class PageFigure {
  readonly plan: FigurePlan;
  readonly values: Values;
  #loading: Promise<Figure> | null = null;
  #wanted = 0;

  constructor(readonly element: HTMLElement) {
    this.plan = JSON.parse(element.dataset["figure"] ?? "{}") as FigurePlan;
    this.values = new Values(this.plan);
    const watch = new IntersectionObserver(
      (entries) => {
        if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
        watch.disconnect();
        void this.load();
      },
      { rootMargin: nearness },
    );
    watch.observe(element);
  }

  /** Loads and mounts the figure once. */
  load(): Promise<Figure> {
    this.#loading ??= this.#mount();
    return this.#loading;
  }

  /** Resolves when the figure is there, or could not be loaded; at once if it is not near yet. */
  async begun(): Promise<void> {
    await this.#loading?.catch(() => undefined);
  }

  /** Leads to a state; of several calls while the figure loads, only the last counts. */
  async go(entries: Readonly<Record<string, string>>): Promise<void> {
    const call = ++this.#wanted;
    const figure = await this.load();
    if (call === this.#wanted) figure.go(entries);
  }

  async mark(part: string | null): Promise<void> {
    (await this.load()).mark(part);
  }

  async #mount(): Promise<Figure> {
    const stage = this.element.querySelector<HTMLElement>(".stage");
    const loader = figureLoaders[this.plan.kind];
    if (!stage || !loader) throw new Error(`There is no figure "${this.plan.kind}".`);
    try {
      const figure = await loader();
      await figure.mount(stage, this.values);
      this.element.dataset["ready"] = "true";
      return figure;
    } catch (error) {
      stage.textContent =
        "This figure could not be loaded. Check the connection to the network, then reload the page.";
      throw error;
    }
  }
}

export type PageFigures = ReadonlyMap<string, PageFigure>;

/** Returns the figure and the name of a tie such as `A.size`. */
export function tiedTo(
  figures: PageFigures,
  target: string,
): { readonly figure: PageFigure; readonly name: string } {
  const [id = "", name = ""] = target.split(".");
  const figure = figures.get(id);
  if (!figure) throw new Error(`There is no figure ${id}.`);
  return { figure, name };
}
