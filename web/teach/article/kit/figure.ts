import type { Values } from "./values";

/** An instrument of a lesson. `mount` is called once, when the figure is near the window. */
export interface Figure {
  /** Builds the figure in an element, computes its values, and follows its inputs from then on. */
  mount(element: HTMLElement, values: Values): void | Promise<void>;
  /** Leads to a state that the text names, such as `{ step: "end", beat: "0" }`. */
  go(entries: Readonly<Record<string, string>>): void;
  /** Lights a part of the figure; null for none. */
  mark(part: string | null): void;
}
