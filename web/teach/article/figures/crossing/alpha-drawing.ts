/** The values α of a side and a new side as lengths beside them. */
import { colours } from "../../kit/colours";
import { shortValue } from "../../kit/bars";
import { clamp } from "../../kit/motion";
import type { Pen } from "../../kit/pen";
import type { PlaneView } from "../../kit/plane-view";
import type { Pixel, Stage } from "../../kit/stage";
import type { Crossed, Pair, Point } from "./crossing-rules";

/** Distance of a length from its side, in pixels. */
const offset = 17;

export class AlphaDrawing {
  constructor(
    readonly stage: Stage,
    readonly view: PlaneView,
    readonly pen: Pen,
  ) {}

  /** The two lines on which both sides lie. */
  drawLines({ from }: Pair, p: Point, q: Point, r: Point): void {
    for (const [u, v] of [
      [from, p],
      [q, r],
    ] as const) {
      const d = [v[0] - u[0], v[1] - u[1]] as const;
      const at = (t: number): Pixel => this.view.pixel([u[0] + d[0] * t, u[1] + d[1] * t]);
      this.pen.line(at(-6), at(7), colours().ink, 1, { alpha: 0.25, dash: [2, 5] });
    }
  }

  drawLengths(
    { from, alphas: [along, other], at }: Pair,
    { a, b, p, q, r }: Crossed,
    isCrossing: boolean,
  ): void {
    const colour = isCrossing ? "refused" : "active";
    if (!at) return;
    if (!isCrossing)
      this.pen.circle(this.view.pixel(at), 5.5, colours().plate, { stroke: colours().active, width: 2.25 });
    const middle: Point = [(a[0] + b[0] + p[0]) / 3, (a[1] + b[1] + p[1]) / 3];
    this.#length(from, p, along, "*α*^1", from === a ? b : a, colour);
    this.#length(q, r, other, "*α*^3", middle, colour);
  }

  #length(
    from: Point,
    to: Point,
    alpha: number,
    name: string,
    away: Point,
    look: "refused" | "active",
  ): void {
    const [start, end, other] = [this.view.pixel(from), this.view.pixel(to), this.view.pixel(away)];
    const d: Pixel = [end[0] - start[0], end[1] - start[1]];
    const size = Math.hypot(...d) || 1;
    const turned: Pixel = [-d[1] / size, d[0] / size];
    const isTowards = turned[0] * (other[0] - start[0]) + turned[1] * (other[1] - start[1]) > 0;
    const n: Pixel = isTowards ? [-turned[0], -turned[1]] : turned;
    const shown = clamp(alpha, -0.7, 1.7);
    const at = (t: number, by: number): Pixel => [
      start[0] + d[0] * t + n[0] * by,
      start[1] + d[1] * t + n[1] * by,
    ];
    const colour = colours()[look];
    this.pen.line(at(0, offset), at(shown, offset), colour, 1.75);
    for (const t of [0, shown]) this.pen.line(at(t, offset - 5), at(t, offset + 5), colour, 1.75);
    const middle = at(shown / 2, offset + 16);
    this.stage.label(`${name} = ${shortValue(alpha)}`, middle, { look, dx: n[0] * 26 });
  }
}
