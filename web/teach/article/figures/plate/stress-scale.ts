/** The colours of stress, and the gauge below a plate: the highest stress that a mesh has found, beside the truth. */
import { colours, css, mix, type Colour } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import { clamp } from "../../kit/motion";

type Stops = readonly (readonly [number, Colour])[];

/** Where there is more stress, it is darker on a light page, and brighter on a dark one. */
const lightStops: Stops = [
  [0, [213, 226, 240]],
  [0.2, [234, 236, 232]],
  [0.36, [248, 234, 204]],
  [0.55, [244, 188, 92]],
  [0.75, [222, 104, 48]],
  [0.9, [176, 38, 44]],
  [1, [112, 14, 40]],
];
const darkStops: Stops = [
  [0, [24, 40, 62]],
  [0.2, [42, 48, 76]],
  [0.36, [76, 56, 88]],
  [0.55, [148, 68, 82]],
  [0.75, [222, 108, 58]],
  [0.9, [250, 178, 74]],
  [1, [255, 240, 184]],
];

/** How far the gauge reaches, as a multiple of the truth. */
const reach = 1.12;

const isDark = (): boolean => {
  const [r, g, b] = colours().ground;
  return r + g + b < 384;
};

/** Where on the scale of colours the stress of 1 is, that far away from the hole. */
const farAway = 0.345;

/** Returns a function for the colours of stresses from 0 to the highest: that far away always has the same colour. */
export function stressColours(highest: number): (stress: number) => Colour {
  const stops = isDark() ? darkStops : lightStops;
  const table = Array.from({ length: 129 }, (_none, i): Colour => {
    const t = i / 128;
    const next = Math.max(
      1,
      stops.findIndex(([at]) => at >= t),
    );
    const [[low, from], [high, to]] = [stops[next - 1], stops[next]] as [Stops[number], Stops[number]];
    return mix(from, to, (t - low) / (high - low));
  });
  const power = Math.log(farAway) / Math.log(1 / highest);
  return (stress) => table[Math.round(128 * clamp(stress / highest, 0, 1) ** power)] ?? [0, 0, 0];
}

export class Gauge {
  readonly element: HTMLElement;
  readonly #bar = element("canvas", { width: "256", height: "1" });
  readonly #gap = element("span", { class: "gap" });
  readonly #needle = element("span", { class: "answer" });
  readonly #answer = element("span", { class: "answer-label" });
  readonly #one = element("span", { class: "tick-label" }, "far away 1");
  readonly #truth = element("span", { class: "truth" });
  readonly #truthLabel = element("span", { class: "tick-label truth-label" });
  /** Theme and truth for which the bar is drawn. */
  #drawn = "";

  constructor() {
    this.element = element(
      "div",
      { class: "gauge", "aria-hidden": "true" },
      this.#bar,
      this.#gap,
      this.#truth,
      this.#needle,
      this.#answer,
      this.#one,
      this.#truthLabel,
    );
  }

  show(answer: number, truth: number): void {
    this.#drawBar(truth);
    const at = (stress: number): number => (100 * clamp(stress / truth, 0, reach)) / reach;
    const [from, to] = [Math.min(answer, truth), Math.max(answer, truth)];
    this.#gap.style.left = `${at(from)}%`;
    this.#gap.style.width = `${at(to) - at(from)}%`;
    this.#needle.style.left = `${at(answer)}%`;
    this.#answer.style.left = `${at(answer)}%`;
    this.#answer.textContent = digits(answer, 2);
    this.#truth.style.left = this.#truthLabel.style.left = `${at(truth)}%`;
    this.#truthLabel.textContent = `truth ${digits(truth, 2)}`;
    this.#one.style.left = `${at(1)}%`;
    // Labels that would stand on each other.
    this.#one.hidden = truth > 9 || truth < 1.9;
  }

  #drawBar(truth: number): void {
    const key = `${isDark()} ${truth}`;
    if (key === this.#drawn) return;
    this.#drawn = key;
    const context = this.#bar.getContext("2d");
    const colour = stressColours(truth);
    for (let i = 0; context && i < 256; i++) {
      context.fillStyle = css(colour((i / 255) * reach * truth));
      context.fillRect(i, 0, 1, 1);
    }
  }
}
