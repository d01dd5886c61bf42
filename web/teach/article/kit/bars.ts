/** Values as needles on an axis from −1 to 2, with the band of the values that count as a crossing. */
import { digits, element, rich } from "./dom";
import { clamp } from "./motion";

const [low, high] = [-1, 2] as const;
const share = (value: number): string =>
  `${((100 * (clamp(value, low, high) - low)) / (high - low)).toFixed(2)}%`;

/** Returns a value with two digits, or "far" for a value that the axis does not show. */
export const shortValue = (value: number): string => (Math.abs(value) > 99 ? "far" : digits(value, 2));

export class ValueBar {
  readonly parts: readonly HTMLElement[];
  readonly #band = element("span", { class: "band" });
  readonly #needles: readonly HTMLElement[];
  readonly #value = element("span", { class: "value" });

  /** @param name Name of the value, as for `rich`. */
  constructor(name: string, needles = 1) {
    this.#needles = Array.from({ length: needles }, () => element("span", { class: "needle" }));
    const axis = element("span", { class: "axis" }, this.#band, ...this.#needles);
    this.parts = [element("span", {}, rich(name)), axis, this.#value];
  }

  /** `tolerance` widens the band from 0 to 1 at both ends. */
  show(values: readonly number[], tolerance: number): void {
    this.#band.style.left = share(-tolerance);
    this.#band.style.right = `calc(100% - ${share(1 + tolerance)})`;
    values.forEach((value, i) => {
      const needle = this.#needles[i];
      if (!needle) return;
      needle.style.left = share(value);
      needle.classList.toggle("inside", value >= -tolerance && value <= 1 + tolerance);
    });
    this.#value.textContent = values.map(shortValue).join("  ");
  }
}
