/** Draws the size curve, the sides that stand under it as triangles, and the present side with its bars. */
import { colours, mix } from "../../kit/colours";
import { clamp, ease } from "../../kit/motion";
import { digits } from "../../kit/dom";
import { between, type Pen, widths } from "../../kit/pen";
import type { PlanePoint, PlaneView } from "../../kit/plane-view";
import type { Pixel, Stage } from "../../kit/stage";
import type { Comparison, Side, Walk } from "./side-rules";
import { lineEnd, type SizeCurve } from "./size-curve";

export interface DrawnSides {
  readonly curve: SizeCurve;
  readonly walk: Walk;
  readonly begin: number;
  readonly step: number;
  readonly beat: number;
  readonly tolerance: number;
  readonly lit: string | null;
}

/** Sides longer or shorter than the size at their middle by this share are shown as wrong. */
const wrongShare = 0.05;
/** A last side that sticks out beyond the line is pale. */
const overAlpha = 0.45;
/** Thickness of bars, and distance between rows of bars, in pixels. */
const barWidth = 6;
const maxRows = 7;
/** About half the width of a character of a label, in pixels. */
const charWidth = 3.6;
/** Up to where lines of whole sizes are drawn behind the curve. */
const highestTick = 2;
/** Smallest width in pixels of a side whose length stands in its triangle. */
const labelledWidth = 54;
/** Where the line lies that is drawn in sizes: below the line, in its units. */
const rulerDepth = { wide: 1.15, narrow: 0.62 } as const;

export class SidesDrawing {
  constructor(
    readonly stage: Stage,
    readonly view: PlaneView,
    readonly pen: Pen,
  ) {}

  draw(drawn: DrawnSides): void {
    const { walk, step, beat } = drawn;
    const divided = step >= walk.sides.length ? ease(step > walk.sides.length ? 1 : beat / 5) : 0;
    this.#drawGround(drawn);
    this.#drawSides(drawn, divided);
    this.#drawCurve(drawn);
    const side = walk.sides[step];
    if (side && beat > 0) this.#drawStep(drawn, side);
    else if (divided > 0) this.#drawCount(drawn, divided);
  }

  get #isSmall(): boolean {
    return this.stage.width < 560;
  }

  #at(point: PlanePoint): Pixel {
    return this.view.pixel(point);
  }

  /** Under the curve is what is empty. */
  #drawGround({ curve, begin }: DrawnSides): void {
    const c = colours();
    const first = curve.sizeAt(begin);
    const top = curve.knots.filter(([x]) => x > begin).map((knot) => this.#at(knot));
    this.pen.polygon(
      [this.#at([begin, 0]), this.#at([begin, first]), ...top, this.#at([lineEnd, 0])],
      c.void,
    );
    this.#drawAxes();
    this.pen.line(this.#at([0, 0]), this.#at([lineEnd, 0]), c.faint, 1.5, { dash: [2, 5] });
    this.pen.line(this.#at([begin, 0]), this.#at([lineEnd, 0]), c.ink, widths.front);
  }

  /** Squares of one unit: heights and lengths have the same scale. */
  #drawAxes(): void {
    const c = colours();
    for (let x = 0; x <= lineEnd; x++)
      this.pen.line(this.#at([x, 0]), this.#at([x, highestTick + 0.6]), c.ink, 1, { alpha: 0.07 });
    for (let size = 1; size <= highestTick; size++) {
      this.pen.line(this.#at([0, size]), this.#at([lineEnd, size]), c.ink, 1, { alpha: 0.07 });
      this.stage.label(String(size), this.#at([0, size]), {
        dx: this.#isSmall ? -13 : -20,
        look: "soft small",
      });
    }
    const top = this.#at([0, highestTick + 0.6]);
    this.stage.label("size", top, { dx: this.#isSmall ? -4 : -20, look: "soft small" });
  }

  #drawCurve({ curve, lit }: DrawnSides): void {
    const c = colours();
    const points = curve.knots.map((knot) => this.#at(knot));
    points.slice(1).forEach((to, i) => {
      this.pen.line(points[i] ?? to, to, c.ink, lit === "curve" ? widths.active : widths.front);
    });
  }

  /** Sides are triangles as high as they are wide; `divided` leads from the walk to the finished division. */
  #drawSides(drawn: DrawnSides, divided: number): void {
    const { curve, walk, step, beat, lit } = drawn;
    const c = colours();
    const { sides, nodes } = walk;
    const ends = [
      drawn.begin,
      ...sides.slice(0, step).map(({ from, length, to }) => (to === lineEnd ? from + length : to)),
    ];
    if (divided > 0) {
      const shown = nodes.map((node, i) => {
        const walked = ends[Math.min(i, ends.length - 1)] ?? node;
        return walked + (node - walked) * divided;
      });
      // A node more or less than the walk has: it comes from, or goes to, the end of the line.
      ends.splice(0, ends.length, ...shown);
    }
    const isFull = divided > 0;
    const isNew = beat >= 5 && sides[step] !== undefined;
    ends.slice(1).forEach((to, i) => {
      const from = ends[i] ?? to;
      const age = isFull ? 1 : clamp((ends.length - 1 - i - (isNew ? 0 : 1)) / 3 + 0.25, 0, 1);
      const isOver = to > lineEnd + 1e-9;
      const width = lit === "triangle" || lit === "sides" ? 2.5 : 1;
      this.#drawTriangle(from, to, mix(c["new-soft"], c.stone, age), width, isOver ? overAlpha : 1);
      if (isOver) return;
      this.#drawWrong(curve, from, to, divided);
      const middle = (from + to) / 2;
      if ((to - from) * this.view.scale > labelledWidth && (!isNew || i < ends.length - 2))
        this.stage.label(digits(to - from, 2), this.#at([middle, 0.24 * (to - from)]), { look: "soft" });
    });
    for (const [i, to] of ends.entries()) {
      const from = ends[i - 1];
      if (from === undefined) continue;
      const width = lit === "sides" ? widths.active + 1 : widths.strong;
      this.pen.line(this.#at([from, 0]), this.#at([Math.min(to, lineEnd), 0]), c.ink, width);
      if (to > lineEnd)
        this.pen.line(this.#at([lineEnd, 0]), this.#at([to, 0]), c.refused, widths.front, { dash: [5, 4] });
    }
    for (const end of [...ends.filter((at) => at < lineEnd), lineEnd])
      this.pen.circle(this.#at([end, 0]), 3.6, c.ink);
  }

  #drawTriangle(
    from: number,
    to: number,
    fill: Parameters<Pen["polygon"]>[1],
    width: number,
    alpha = 1,
  ): void {
    const c = colours();
    const middle = (from + to) / 2;
    const corners = [this.#at([from, 0]), this.#at([to, 0]), this.#at([middle, to - from])];
    this.pen.polygon(corners, fill, alpha, { colour: width > 1 ? c.new : c.edge, width: width + 0.5, alpha });
    if (alpha === 1) this.pen.circle(corners[2] ?? [0, 0], 3, c.new);
  }

  /** A side that is not as long as the size at its middle: its triangle misses the curve. */
  #drawWrong(curve: SizeCurve, from: number, to: number, divided: number): void {
    const middle = (from + to) / 2;
    const [length, size] = [to - from, curve.sizeAt(middle)];
    if (Math.abs(length - size) < wrongShare * size || divided > 0) return;
    const c = colours();
    const [tip, on] = [this.#at([middle, length]), this.#at([middle, size])];
    this.pen.line(tip, on, c.refused, 2.5, { dash: [5, 4] });
    this.pen.cross(tip, 5.5, c.refused, 2.5);
  }

  /** Beats: 1 the size at the start, 2 the middle, 3 the comparison, 4 the averagings, 5 the side. */
  #drawStep(drawn: DrawnSides, side: Side): void {
    const c = colours();
    const { beat, curve, lit } = drawn;
    const t = [0, 1, 2, 3, 4].map((i) => ease(beat - i)) as [number, number, number, number, number];
    const fades = 1 - t[4];
    const { from, comparisons } = side;
    const averagings = comparisons.length - 1;
    const round = beat <= 3 ? 0 : clamp((beat - 3) * averagings, 0, averagings);
    const present = presentOf(comparisons, round);
    const start = this.#at([from, 0]);
    const size = curve.sizeAt(from);
    // The size at the start stands upright, and is laid down on the line.
    const [grown, laid] = [clamp(beat * 2.2, 0, 1), ease((beat - 0.45) / 0.55)];
    const angle = (Math.PI / 2) * (1 - laid);
    const isStart = lit === "start" || lit === "guess";
    if (beat < 2.2)
      this.pen.line(start, this.#at([from, size * grown]), c.active, 2, { alpha: 0.55, dash: [3, 4] });
    if (laid > 0 && beat < 2.2) this.#drawArc(from, size, angle);
    const reach = beat <= 1 ? size * grown : present.length;
    const end = this.#at([from + reach * Math.cos(angle), reach * Math.sin(angle)]);
    this.#drawTip(from, present, t[1] * fades);
    if (t[4] > 0)
      this.#drawTriangle(from, from + side.length, mix(c["new-soft"], c.new, fades * 0.5), 2.5, t[4]);
    this.pen.glow(start, end, c.active, (isStart ? 1.4 : 1) * (1 - 0.6 * t[4]));
    this.pen.circle(start, 3.6, c.ink);
    if (t[1] > 0 && fades > 0) this.#drawMiddle(from, present, t[1], fades, lit === "middle");
    if (fades > 0.05) this.#drawBars(drawn, side, round, t[2], fades);
    this.#labelStep(drawn, side, present, t);
  }

  /** The quarter of a circle on which the size is laid down. */
  #drawArc(from: number, size: number, angle: number): void {
    const { context } = this.pen;
    const [x, y] = this.#at([from, 0]);
    context.beginPath();
    const { scale, scaleY } = this.view;
    context.ellipse(x, y, size * scale, size * scaleY, 0, -Math.PI / 2, -angle);
    context.strokeStyle = `rgb(${colours().active.join(" ")} / 0.5)`;
    context.lineWidth = 1.25;
    context.stroke();
  }

  /** The tentative triangle: as high as the side is long. */
  #drawTip(from: number, { length }: Comparison, alpha: number): void {
    if (alpha <= 0) return;
    const c = colours();
    const tip = this.#at([from + length / 2, length]);
    for (const end of [from, from + length])
      this.pen.line(this.#at([end, 0]), tip, c.active, 1.5, { alpha: 0.6 * alpha, dash: [4, 4] });
    this.pen.circle(tip, 4, c.plate, { alpha, stroke: c.active, width: 2, strokeAlpha: alpha });
  }

  #drawMiddle(
    from: number,
    { length, target }: Comparison,
    grown: number,
    alpha: number,
    isLit: boolean,
  ): void {
    const c = colours();
    const foot = this.#at([from + length / 2, 0]);
    const top = this.#at([from + length / 2, target]);
    const to = between(foot, top, grown);
    this.pen.line(foot, to, c.new, isLit ? 6 : 4, { alpha });
    this.pen.circle(foot, 4, c.new, { alpha });
    if (grown > 0.9)
      this.pen.circle(top, 5, c.new, { alpha, stroke: c.ground, width: 1.5, strokeAlpha: alpha });
  }

  /** Rows of bars below the line: each comparison, the tentative length above and the size at its middle below. */
  #drawBars(drawn: DrawnSides, { from, comparisons }: Side, round: number, out: number, fades: number): void {
    if (out <= 0) return;
    const c = colours();
    const [x, ground] = this.#at([from, 0]);
    const { scale } = this.view;
    const row = this.#isSmall ? 19 : 24;
    const rows = Math.max(3, Math.min(maxRows, 1 + Math.floor((this.stage.height - ground - 36) / row)));
    const last = comparisons.length - 1;
    // If there are too many rows, those before the last one are left out, and a line says so.
    const leftOut = comparisons.length > rows ? comparisons.length - (rows - 1) : 0;
    const shown = comparisons.map((_comparison, i) => i).filter((i) => i < last - leftOut || i === last);
    if (leftOut > 0 && round > last - 0.5)
      this.#labelAfter([x - 6, ground + 28 + (shown.length - 1) * row], `⋮ ${leftOut} rows left out`, "soft");
    shown.forEach((i, order) => {
      const at = order + (leftOut > 0 && i === last ? 1 : 0);
      const alpha = (i === 0 ? out : clamp(round - i + 1, 0, 1)) * fades;
      const { length, target } = comparisons[i] ?? { length: 0, target: 0 };
      if (alpha <= 0.02) return;
      const y = ground + 25 + at * row;
      const grown = i === 0 ? out : 1;
      this.pen.line([x, y], [x + length * scale, y], c.active, barWidth, { alpha });
      this.pen.line([x, y + barWidth + 1], [x + target * scale * grown, y + barWidth + 1], c.new, barWidth, {
        alpha,
      });
      const share = Math.abs(target - length) / length;
      const isEqual = share <= drawn.tolerance;
      const isLit = drawn.lit === "apart";
      const [low, high] = [Math.min(length, target), Math.max(length, target)];
      if (!isEqual && (high - low) * scale > 7) {
        const between = y + (target > length ? 0 : barWidth + 1);
        this.pen.line(
          [x + low * scale + 5, between],
          [x + high * scale, between],
          c.refused,
          isLit ? 4 : 2.25,
          { alpha, dash: [3, 4] },
        );
      }
      if (alpha < 0.6) return;
      const percent = 100 * share;
      const text = isEqual
        ? `equal after ${averagingsText(i)}`
        : `${digits(Math.abs(target - length), 3)} apart, ${digits(percent, percent < 9.95 ? 1 : 0)} %`;
      this.#labelAfter([x + high * scale, y + 3], text, isEqual ? "new" : "refused");
    });
  }

  /** Puts a label to the right of a pixel. */
  #labelAfter([x, y]: Pixel, text: string, look: string): void {
    this.stage.label(text, [x, y], { dx: 12 + text.length * charWidth, look });
  }

  #labelStep(drawn: DrawnSides, { from, length }: Side, present: Comparison, t: readonly number[]): void {
    const { beat, curve } = drawn;
    const start = this.#at([from, 0]);
    if (beat < 5) this.stage.label("**x**_0", start, { dx: -15, dy: 16, look: "active" });
    if (beat <= 1.05)
      this.stage.label(`size ${digits(curve.sizeAt(from), 2)}`, this.#at([from, curve.sizeAt(from)]), {
        dx: this.#isSmall ? 40 : 46,
        dy: -14,
        look: "active",
      });
    if (beat > 0.9 && beat < 2.9) {
      const [x, y] = this.#at([from + present.length * 0.78, 0]);
      // To the right of the name of its start, however short the guess is.
      this.stage.label(`d**x**_0 = ${digits(present.length, 2)}`, [Math.max(x, start[0] + 42), y], {
        dy: 18,
        look: "active",
      });
    }
    if ((t[1] ?? 0) > 0.8 && beat < 3.4)
      this.stage.label(
        `d**x**_1 = ${digits(present.target, 2)}`,
        this.#at([from + present.length / 2, present.target / 2]),
        { dx: 52, look: "new" },
      );
    if (beat >= 5)
      this.stage.label(digits(length, 2), this.#at([from + length / 2, 0]), { dy: 18, look: "strong" });
  }

  /**
   * The finished division: below the line, the same line drawn in sizes. There, all sides are equally long; ticks are whole sizes.
   */
  #drawCount({ walk, begin }: DrawnSides, divided: number): void {
    if (divided < 0.5) return;
    const c = colours();
    const { nodes, lambda } = walk;
    const count = nodes.length - 1;
    const depth = this.#isSmall ? rulerDepth.narrow : rulerDepth.wide;
    const alpha = 2 * divided - 1;
    const onRuler = (share: number): Pixel => this.#at([begin + share * (lineEnd - begin), -depth]);
    const gap = 9;
    for (let i = 0; i < count; i++) {
      const [from, to] = [this.#at([nodes[i] ?? 0, 0]), this.#at([nodes[i + 1] ?? 0, 0])];
      const [low, high] = [onRuler(i / count), onRuler((i + 1) / count)];
      const band: readonly Pixel[] = [[from[0], from[1] + gap], [to[0], to[1] + gap], high, low];
      this.pen.polygon(band, i % 2 === 0 ? c["new-soft"] : c.stone, 0.55 * alpha);
      this.pen.line(low, high, c.new, 4, { alpha });
    }
    for (let i = 0; i <= count; i++) this.pen.circle(onRuler(i / count), 3.6, c.ink, { alpha });
    const [x, y] = onRuler(0.5);
    // In a low picture, as in the small window beside the text, there is no room for the numbers and the sentence.
    const isLow = this.stage.height - y < lowRoom;
    for (let size = 0; size <= lambda; size++) {
      const [x, y] = onRuler(size / lambda);
      this.pen.line([x, y + 6], [x, y + 13], c.soft, 1.5, { alpha });
      if (!isLow && (size === 0 || lambda < 14 || size % 5 === 0))
        this.stage.label(String(size), [x, y], { dy: 23, look: "soft small" });
    }
    this.stage.label(
      `${digits(lambda, 2)} sizes long: ${count} sides, each ${digits(lambda / count, 3)} sizes`,
      [x, y],
      { dy: isLow ? 25 : this.#isSmall ? 42 : 46, look: "strong" },
    );
  }
}

export const averagingsText = (count: number): string =>
  count === 0 ? "no averaging" : count === 1 ? "1 averaging" : `${count} averagings`;

/** Pixels that numbers and a sentence take below the line drawn in sizes. */
const lowRoom = 56;

/** Returns the comparison between two rounds: lengths glide from one to the next. */
function presentOf(comparisons: readonly Comparison[], round: number): Comparison {
  const low = Math.floor(round);
  const [from, to] = [comparisons[low], comparisons[Math.min(low + 1, comparisons.length - 1)]];
  if (!from || !to) return { length: 0, target: 0 };
  const t = ease(round - low);
  return {
    length: from.length + (to.length - from.length) * t,
    target: from.target + (to.target - from.target) * t,
  };
}
