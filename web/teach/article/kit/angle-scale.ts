/** Angles as needles on an axis from 0° to 180°, with the band of good ones. */
import { element } from "./dom";
import { clamp } from "./motion";

const share = (angle: number): string => `${((100 * clamp(angle, 0, 180)) / 180).toFixed(2)}%`;

export class AngleScale {
  readonly element: HTMLElement;
  readonly #needles: readonly HTMLElement[];

  /** @param ideal An angle that is marked, such as that of the regular tetrahedron. */
  constructor(
    readonly band: { readonly min: number; readonly max: number },
    ideal: number,
    count: number,
  ) {
    this.#needles = Array.from({ length: count }, () => element("span", { class: "needle" }));
    const good = element("span", { class: "band" });
    good.style.left = share(band.min);
    good.style.right = `calc(100% - ${share(band.max)})`;
    const mark = element("span", { class: "ideal" });
    mark.style.left = share(ideal);
    const labels = [0, band.min, band.max, 180].map((angle) => {
      const label = element("span", { class: "label-at" }, `${angle}°`);
      label.style.left = share(angle);
      return label;
    });
    this.element = element(
      "div",
      { class: "angle-scale", "aria-hidden": "true" },
      good,
      mark,
      ...this.#needles,
      ...labels,
    );
  }

  show(angles: readonly number[]): void {
    angles.forEach((angle, i) => {
      const needle = this.#needles[i];
      if (!needle) return;
      needle.style.left = share(angle);
      needle.classList.toggle("poor", angle < this.band.min || angle > this.band.max);
    });
  }
}
