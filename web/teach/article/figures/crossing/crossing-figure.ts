/** A new triangle and a side of the front: all five points move, and the three layers of the test answer at once. */
import { effect } from "@preact/signals-core";
import { colours } from "../../kit/colours";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import { Pen, widths } from "../../kit/pen";
import { PlaneView } from "../../kit/plane-view";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import { element } from "../../kit/dom";
import type { Values } from "../../kit/values";
import { AlphaDrawing } from "./alpha-drawing";
import { orient, testCrossing, type Crossed, type CrossingVerdict, type Point } from "./crossing-rules";
import { LayerCards } from "./layer-cards";

type Name = keyof Crossed;

const triangle = { a: [0.32, 0.2], b: [0.86, 0.2], p: [0.6, 0.66] } as const;
const poses: Readonly<Record<string, Crossed>> = {
  apart: { ...triangle, q: [0.98, 0.72], r: [1.26, 0.3] },
  beyond: { ...triangle, q: [0.72, 0.74], r: [0.98, 0.3] },
  through: { ...triangle, q: [0.3, 0.58], r: [1.08, 0.34] },
  near: { ...triangle, q: [0.42, 0.69], r: [0.86, 0.664] },
  shared: { ...triangle, q: [0.6, 0.66], r: [1.1, 0.75] },
  entering: { ...triangle, q: [0.6, 0.66], r: [0.56, 0.3] },
  beside: { ...triangle, q: [0.8055, 0.3209], r: [0.6755, 0.5509] },
};
const labels: Readonly<Record<Name, string>> = {
  a: "First end of the active side",
  b: "Second end of the active side",
  p: "Third corner of the new triangle",
  q: "First end of the side of the front",
  r: "Second end of the side of the front",
};
const names = ["a", "b", "p", "q", "r"] as const;
const looks: Readonly<Record<Name, string>> = { a: "active", b: "active", p: "new", q: "plain", r: "plain" };
/** Distances in units of the drawing: of a snap to a corner, and the smallest area and length. */
const snap = 0.03;
const minDoubleArea = 0.05;
const minLength = 0.08;

export class CrossingFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #view = new PlaneView(this.#stage, [0, 0.02, 1.5, 0.92]);
  readonly #pen = new Pen(this.#stage.context);
  readonly #cards = new LayerCards();
  readonly #alphas = new AlphaDrawing(this.#stage, this.#view, this.#pen);
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #motion = new Motion();
  #points: Crossed = poses["apart"] as Crossed;
  #values: Values | null = null;
  #verdict: CrossingVerdict = testCrossing(this.#points, 0);
  #lit: string | null = null;
  /** Whether the reader has made the present state, and not a word of the text. */
  #isHandled = false;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    host.append(
      this.#notice,
      element("div", { class: "with-layers" }, this.#stage.element, this.#cards.element),
    );
    this.#stage.setHandles(names.map((name) => this.#handle(name)));
    effect(() => {
      values.number("t");
      this.#compute();
    });
  }

  go({ pose = "" }: Readonly<Record<string, string>>): void {
    const target = poses[pose];
    if (!target) return;
    this.#isHandled = false;
    const from = this.#points;
    const at = (name: Name, t: number): Point => [
      from[name][0] + (target[name][0] - from[name][0]) * t,
      from[name][1] + (target[name][1] - from[name][1]) * t,
    ];
    this.#motion.run(600, (t) => {
      this.#points = { a: at("a", t), b: at("b", t), p: at("p", t), q: at("q", t), r: at("r", t) };
      this.#compute();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #handle(name: Name): HandleOptions {
    return {
      name,
      label: labels[name],
      look: looks[name],
      at: () => this.#view.pixel(this.#points[name]),
      begin: () => this.#motion.stop(),
      move: (pixel) => this.#move(name, this.#view.inside(this.#view.point(pixel), 0.03)),
      end: () => (this.#notice.textContent = ""),
      describe: () => (this.#verdict.isCrossing ? "refused" : "allowed"),
    };
  }

  #move(name: Name, to: Point): void {
    const isEnd = name === "q" || name === "r";
    const corners = isEnd
      ? [this.#points.a, this.#points.b, this.#points.p]
      : [this.#points.q, this.#points.r];
    // Near each other, two points become one node.
    const near = corners.find(([x, y]) => Math.hypot(x - to[0], y - to[1]) < snap);
    const points = { ...this.#points, [name]: near ?? to };
    const isFlat = orient(points.a, points.b, points.p) < minDoubleArea;
    const isShort = Math.hypot(points.r[0] - points.q[0], points.r[1] - points.q[1]) < minLength;
    this.#notice.textContent = isFlat
      ? "The new triangle would be flat, or on the wrong side of the active side."
      : isShort
        ? "The side would have no length."
        : "";
    if (isFlat || isShort) return;
    this.#points = points;
    this.#isHandled = true;
    this.#compute();
  }

  #compute(): void {
    const values = this.#values;
    if (!values) return;
    const tolerance = values.number("t");
    const verdict = testCrossing(this.#points, tolerance);
    this.#verdict = verdict;
    const [a1, a3, a4] = verdict.decisive.alphas;
    const isShared = verdict.pairs.some((pair) => pair.isShared);
    values.put({
      layer: verdict.layer,
      crossing: verdict.isCrossing,
      meets: verdict.meets,
      inside: verdict.isInside,
      shared: isShared,
      enters: verdict.entersAt !== null,
      a1,
      a3,
      a4,
      excess: verdict.decisive.excess,
      handled: this.#isHandled,
      verdict: verdict.isCrossing ? "refused" : "allowed",
    });
    this.#cards.show(verdict, tolerance);
    this.#stage.requestDraw();
  }

  #draw(): void {
    const c = colours();
    const pen = this.#pen;
    const { a, b, p, q, r } = this.#points;
    const { layer, isCrossing, entersAt, pairs, decisive } = this.#verdict;
    const at = (point: Point): Pixel => this.#view.pixel(point);
    this.#drawBoxes();
    if (layer === 1) this.#drawGap();
    if (layer === 2) this.#drawSeparatingLine();
    pen.polygon([a, b, p].map(at), c["new-soft"], this.#lit === "triangle" ? 0.9 : 0.45);
    for (const from of [a, b])
      pen.line(at(from), at(p), c.new, this.#lit === "triangle" ? widths.active : widths.strong);
    pen.glow(at(a), at(b), c.active, this.#lit === "base" ? 1.4 : 1);
    if (layer === 3 && !decisive.isShared) this.#alphas.drawLines(decisive, p, q, r);
    if (isCrossing)
      for (const pair of pairs)
        if (this.#isHit(pair)) pen.line(at(pair.from), at(p), c.refused, widths.active, { dash: [9, 7] });
    pen.line(at(q), at(r), isCrossing ? c.refused : c.ink, this.#lit === "side" ? 7 : widths.active);
    if (isCrossing)
      for (const pair of pairs) if (this.#isHit(pair) && pair.at) pen.cross(at(pair.at), 9, c.refused, 3.5);
    if (entersAt) pen.cross(at(entersAt), 9, c.refused, 3.5);
    if (layer === 3 && !decisive.isShared) this.#alphas.drawLengths(decisive, this.#points, isCrossing);
    this.#drawLabels();
  }

  #isHit({ isShared, excess }: CrossingVerdict["pairs"][number]): boolean {
    return !isShared && excess <= (this.#values?.number("t") ?? 0);
  }

  #drawBoxes(): void {
    const c = colours();
    const { a, b, p, q, r } = this.#points;
    const isLit = this.#verdict.layer === 1 || this.#lit === "boxes";
    for (const points of [
      [a, b, p],
      [q, r],
    ]) {
      const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
      const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
      const corners = (
        [
          [left, low],
          [right, low],
          [right, high],
          [left, high],
        ] as const
      ).map((point) => this.#view.pixel(point));
      if (isLit) this.#pen.polygon(corners, c.active, 0.06, { colour: c.active, width: 2 });
      else
        corners.forEach((corner, i) =>
          this.#pen.line(corner, corners[(i + 1) % 4] as Pixel, c.faint, 1, { dash: [2, 5], alpha: 0.8 }),
        );
    }
  }

  /** The strip between both boxes. */
  #drawGap(): void {
    const { a, b, p, q, r } = this.#points;
    const [gapX, gapY] = this.#verdict.gaps;
    const i = gapX > gapY ? 0 : 1;
    const [triangleEnds, sideEnds] = [
      [a[i], b[i], p[i]],
      [q[i], r[i]],
    ];
    const isBeyond = Math.min(...sideEnds) > Math.max(...triangleEnds);
    const [from, to] = isBeyond
      ? [Math.max(...triangleEnds), Math.min(...sideEnds)]
      : [Math.max(...sideEnds), Math.min(...triangleEnds)];
    const [x0, y0, x1, y1] = this.#view.window;
    const strip: readonly Point[] =
      i === 0
        ? [
            [from, y0],
            [to, y0],
            [to, y1],
            [from, y1],
          ]
        : [
            [x0, from],
            [x1, from],
            [x1, to],
            [x0, to],
          ];
    this.#pen.polygon(
      strip.map((point) => this.#view.pixel(point)),
      colours().active,
      0.13,
    );
    const middle: Point = i === 0 ? [(from + to) / 2, y0 + 0.06] : [x0 + 0.08, (from + to) / 2];
    this.#stage.label("gap", this.#view.pixel(middle), { look: "active" });
  }

  /** The line beyond which both ends lie, and the half-plane behind it. */
  #drawSeparatingLine(): void {
    const { a, b, p, q, r } = this.#points;
    const index = this.#verdict.beyond ?? 0;
    const tolerance = this.#values?.number("t") ?? 0;
    const [from, to, opposite] = (
      [
        [b, p, a],
        [p, a, b],
        [a, b, p],
      ] as const
    )[index] ?? [a, b, p];
    const isLow = (this.#verdict.shapes[0][index] ?? 0) < 0;
    const shift = isLow ? -tolerance : 1 + tolerance;
    const shifted = (point: Point, by: number): Point => [
      point[0] + (opposite[0] - from[0]) * by,
      point[1] + (opposite[1] - from[1]) * by,
    ];
    const stretch = (t: number, by: number): Pixel =>
      this.#view.pixel(shifted([from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t], by));
    const beyond = shift + (isLow ? -6 : 6);
    const line = [stretch(-5, shift), stretch(6, shift)] as const;
    this.#pen.polygon([line[0], line[1], stretch(6, beyond), stretch(-5, beyond)], colours().active, 0.1);
    this.#pen.line(line[0], line[1], colours().active, 2);
    const middle = this.#view.pixel([(q[0] + r[0]) / 2, (q[1] + r[1]) / 2]);
    this.#stage.label(`*N*^${index + 1} ${isLow ? "< −t" : "> 1 + t"}`, middle, {
      dx: 52,
      dy: -6,
      look: "active",
    });
  }

  #drawLabels(): void {
    const { a, b, p, q, r } = this.#points;
    const at = (point: Point): Pixel => this.#view.pixel(point);
    this.#stage.label("active side", at([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]), { dy: 22, look: "active" });
    const isLow = this.#view.scale * (p[1] - (a[1] + b[1]) / 2) < 130;
    this.#stage.label(
      isLow ? "new" : "new triangle",
      at([(a[0] + b[0] + p[0]) / 3, (a[1] + b[1] + p[1]) / 3]),
      {
        dy: isLow ? 4 : 14,
        look: "new",
      },
    );
    const far = Math.hypot(q[0] - p[0], q[1] - p[1]) > Math.hypot(r[0] - p[0], r[1] - p[1]) ? q : r;
    this.#stage.label("side of the front", at(far), {
      dy: far[1] > 0.5 ? -22 : 24,
      look: this.#verdict.isCrossing ? "refused" : "",
    });
  }
}
