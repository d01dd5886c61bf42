/** What stands beside the picture of "Be the mesher": the question, the nodes to choose from, tools, and the score. */
import { button, digits, element } from "../../kit/dom";
import type { MeshMeasures } from "./board";

export type Choice = number | "new";

/** A node to choose, with the smallest angle of the element that it makes. */
export interface Offer {
  readonly choice: Choice;
  readonly name: string;
  /** In degrees; null behind the facet. */
  readonly angle: number | null;
  readonly isRefused: boolean;
}

export interface Score extends MeshMeasures {
  readonly refused: number;
  /** Facets that are left empty. */
  readonly front: number;
}

interface PanelActions {
  choose(choice: Choice): void;
  hover(choice: Choice | null): void;
  wait(): void;
  undo(): void;
  hint(): void;
  again(): void;
  next(): void;
  /** Lights a row of the score in the picture. */
  light(part: string | null): void;
}

export class MesherPanel {
  readonly question = element("p", { class: "status", role: "status" });
  readonly #picks = element("div", { class: "picks", role: "group", "aria-label": "The next node" });
  readonly #tools: readonly HTMLButtonElement[];
  readonly #undo: HTMLButtonElement;
  readonly #toolBar: HTMLElement;
  readonly #score = element("div", { class: "score" });
  readonly #end = element("div", { class: "choices end" });
  readonly element: HTMLElement;

  constructor(readonly actions: PanelActions) {
    this.#undo = button({ "data-tool": "undo" }, "Undo", () => actions.undo());
    this.#tools = [
      button({ "data-tool": "hint" }, "Hint", () => actions.hint()),
      button({ "data-choice": "wait" }, "Leave it for later", () => actions.wait()),
    ];
    this.#toolBar = element("div", { class: "choices tools" }, this.#undo, ...this.#tools);
    this.element = element(
      "div",
      { class: "mesher-panel" },
      this.question,
      this.#picks,
      this.#end,
      this.#toolBar,
      this.#score,
    );
  }

  /** Offers nodes; none when the front has closed or stalled. */
  offer(offers: readonly Offer[], canUndo: boolean): void {
    const focused = document.activeElement;
    const held =
      this.#picks.contains(focused) && focused instanceof HTMLElement ? focused.dataset["choice"] : null;
    this.#picks.replaceChildren(...offers.map((offer) => this.#pick(offer)));
    this.#picks.hidden = offers.length === 0;
    this.#toolBar.hidden = offers.length === 0;
    if (offers.length > 0) this.#toolBar.prepend(this.#undo);
    this.#undo.disabled = !canUndo;
    if (held === null) return;
    // Enter is enough to go on; a refused choice keeps the focus.
    const refused = offers.find(({ choice, isRefused }) => isRefused && String(choice) === held);
    this.#picks.querySelector<HTMLElement>(refused ? `[data-choice="${held}"]` : "button")?.focus();
  }

  #pick({ choice, name, angle, isRefused }: Offer): HTMLButtonElement {
    const made = button({ "data-choice": String(choice) }, "", () => this.actions.choose(choice));
    if (isRefused) made.classList.add("refused");
    made.append(
      element("span", { class: choice === "new" ? "spot new" : "spot" }, choice === "new" ? "+" : name),
      element("span", { class: "name" }, choice === "new" ? "New node" : `Node ${name}`),
      element(
        "span",
        { class: "angle" },
        isRefused ? "refused" : angle === null ? "–" : `${digits(angle, 0)}°`,
      ),
    );
    for (const type of ["pointerenter", "focus"])
      made.addEventListener(type, () => this.actions.hover(choice));
    for (const type of ["pointerleave", "blur"]) made.addEventListener(type, () => this.actions.hover(null));
    return made;
  }

  /** Lights a choice, as the picture does. */
  lightPick(choice: Choice | null): void {
    for (const each of this.#picks.querySelectorAll<HTMLElement>("[data-choice]"))
      each.toggleAttribute("data-lit", each.dataset["choice"] === String(choice));
  }

  /** Shows the end, with its verdict and the way on; null while the front is open. */
  showEnd(end: { readonly verdict: string; readonly next: string | null } | null): void {
    const wasFocused =
      this.element.contains(document.activeElement) || document.activeElement === document.body;
    this.#end.hidden = end === null;
    this.question.classList.toggle("ended", end !== null);
    this.#end.replaceChildren(
      ...(end
        ? [
            element("p", { class: "verdict" }, end.verdict),
            ...(end.next === null
              ? []
              : [button({ "data-result": "next", class: "main" }, end.next, () => this.actions.next())]),
            button({ "data-result": "again" }, "Again", () => this.actions.again()),
            this.#undo,
          ]
        : []),
    );
    if (end && wasFocused) this.#end.querySelector("button")?.focus({ preventScroll: true });
  }

  showScore(own: Score, program: Score, dimension: 2 | 3): void {
    const [elements, facets, angle] =
      dimension === 2
        ? ["Triangles", "Sides left", "Smallest angle"]
        : ["Tetrahedra", "Faces left", "Smallest angle between faces"];
    const degrees = ({ angle: value, worst }: MeshMeasures): string =>
      worst === null ? "–" : `${digits(value, 0)}°`;
    const rows = [
      ["worst", angle, degrees(own), degrees(program)],
      ["elements", elements, own.elements, program.elements],
      ["nodes", "New nodes", own.newNodes, program.newNodes],
      ["refused", "Refused", own.refused, program.refused],
      ["front", facets, own.front, program.front],
    ] as const;
    const head = element(
      "tr",
      {},
      element("td"),
      element("th", { scope: "col" }, "You"),
      element("th", { scope: "col" }, "Program"),
    );
    const body = rows.map(([part, label, mine, theirs]) => {
      const row = element(
        "tr",
        { "data-row": part },
        element("th", { scope: "row" }, label),
        element("td", {}, String(mine)),
        element("td", {}, String(theirs)),
      );
      row.addEventListener("pointerenter", () => this.actions.light(part));
      row.addEventListener("pointerleave", () => this.actions.light(null));
      return row;
    });
    this.#score.replaceChildren(
      element("table", { "aria-label": "Your mesh beside the program’s" }, head, ...body),
    );
  }
}
