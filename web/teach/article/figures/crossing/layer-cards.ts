/** The three layers of the test below the drawing: what each has found, and what it costs. */
import { element } from "../../kit/dom";
import { ValueBar } from "../../kit/bars";
import type { CrossingVerdict } from "./crossing-rules";

type CardState = "idle" | "passed" | "apart" | "crossing";

/** What one layer has found. */
export class LayerCard {
  readonly element: HTMLElement;
  readonly #verdict = element("span", { class: "verdict" });

  constructor(title: string, cost: string, bars: readonly ValueBar[]) {
    const parts = bars.flatMap(({ parts }) => parts);
    this.element = element(
      "div",
      { class: "layer-card" },
      element("b", {}, title),
      ` ${cost}`,
      this.#verdict,
    );
    if (parts.length > 0) this.element.append(element("div", { class: "bars" }, ...parts));
  }

  show(state: CardState, text: string): void {
    this.element.dataset["state"] = state;
    this.#verdict.textContent = text;
  }
}

export class LayerCards {
  readonly #shapes = ["*N*^1", "*N*^2", "*N*^3"].map((name) => new ValueBar(name, 2));
  readonly #alphas = ["*α*^1", "*α*^3", "*α*^4"].map((name) => new ValueBar(name));
  readonly #cards = [
    new LayerCard("a Boxes", "· cost 1", []),
    new LayerCard("b Lines of the triangle", "· cost about 10", this.#shapes),
    new LayerCard("c Side against side", "· cost about 100", this.#alphas),
  ] as const;
  readonly element = element("div", { class: "layers" }, ...this.#cards.map(({ element }) => element));

  show(
    { layer, isCrossing, entersAt, isInside, shapes, decisive, pairs }: CrossingVerdict,
    tolerance: number,
  ): void {
    const [boxes, lines, sides] = this.#cards;
    this.#shapes.forEach((bar, i) => bar.show([shapes[0][i] ?? 0, shapes[1][i] ?? 0], tolerance));
    this.#alphas.forEach((bar, i) => bar.show([decisive.alphas[i] ?? 0], tolerance));
    if (layer === 1) boxes.show("apart", "Apart. Nothing more is asked.");
    else boxes.show("passed", "The boxes overlap: ask on.");
    if (layer === 1) lines.show("idle", "Not asked.");
    else if (layer === 2) lines.show("apart", "Both ends lie beyond one line: apart.");
    else lines.show("passed", "No line has both ends beyond it: ask on.");
    if (layer < 3) sides.show("idle", "Not asked.");
    else if (entersAt)
      sides.show("crossing", "They share a node, but the side starts into the triangle: refused.");
    else if (isCrossing) sides.show("crossing", "All three lie in the band: refused.");
    else if (pairs.some(({ isShared }) => isShared))
      sides.show("apart", "They share a node, and nothing else: no crossing.");
    else if (isInside) sides.show("apart", "One value lies outside: no crossing, though the side is inside.");
    else sides.show("apart", "One value lies outside: no crossing.");
  }
}
