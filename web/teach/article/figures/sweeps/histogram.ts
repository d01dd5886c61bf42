/**
 * Draws how many elements have which smallest angle: now as bars, and before the first sweep as a line. Heights are square roots of
 * the numbers, so that a single element is visible.
 */
import { colours, mix, onTheme } from "../../kit/colours";
import { element } from "../../kit/dom";
import { Pen } from "../../kit/pen";
import type { Pixel } from "../../kit/stage";
import { poorAngles } from "../sliver/sliver-rules";
import { barCount, barWidth } from "./sweep-film";

export class Histogram {
  readonly element = element("div", { class: "histogram", role: "img" });
  readonly #canvas = element("canvas", { "aria-hidden": "true" });
  #bars: readonly number[] = [];
  #first: readonly number[] = [];
  #isLit = false;

  constructor() {
    this.element.append(this.#canvas);
    new ResizeObserver(() => this.#draw()).observe(this.element);
    onTheme(() => this.#draw());
  }

  show(bars: readonly number[], first: readonly number[], isLit: boolean): void {
    this.#bars = bars;
    this.#first = first;
    this.#isLit = isLit;
    this.#draw();
  }

  #draw(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    const context = this.#canvas.getContext("2d");
    if (!context || width === 0) return;
    const ratio = Math.max(2, devicePixelRatio);
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    context.scale(ratio, ratio);
    context.lineJoin = "round";
    const c = colours();
    const pen = new Pen(context);
    const ground = height - 20;
    const most = Math.max(1, ...this.#bars, ...this.#first);
    const x = (bar: number): number => 2 + (bar / barCount) * (width - 4);
    const y = (count: number): number => ground - Math.sqrt(count / most) * (ground - 6);
    this.#bars.forEach((count, bar) => {
      const isPoor = (bar + 1) * barWidth <= poorAngles.min;
      const [left, right, top] = [x(bar) + 1, x(bar + 1) - 1, y(count)];
      const corners: Pixel[] = [
        [left, ground],
        [left, top],
        [right, top],
        [right, ground],
      ];
      if (count > 0)
        pen.polygon(corners, isPoor ? c.refused : mix(c.active, c.void, this.#isLit ? 0 : 0.35), 1);
    });
    this.#first.forEach((count, bar) => {
      pen.line([x(bar), y(count)], [x(bar + 1), y(count)], c.ink, 1.5);
      const next = this.#first[bar + 1] ?? 0;
      pen.line([x(bar + 1), y(count)], [x(bar + 1), y(next)], c.ink, 1.5);
    });
    pen.line([0, ground], [width, ground], c.faint, 1);
    context.font = '500 13px "Lesson Sans", system-ui, sans-serif';
    context.fillStyle = `rgb(${c.soft.join(" ")})`;
    for (const angle of [0, 15, 30, 45, 60]) {
      context.textAlign = angle === 0 ? "left" : "center";
      context.fillText(`${angle}°`, x(angle / barWidth), height - 4);
    }
  }
}
