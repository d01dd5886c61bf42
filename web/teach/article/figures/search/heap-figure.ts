/** A front that takes its shortest side again and again, and the heap that has this side on top. The reader steps through both. */
import { loadPlaneFront } from "tetrafront/trace";
import { colours, mix } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer, lastBeat } from "../../kit/film-player";
import { clamp, ease } from "../../kit/motion";
import { between, Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { FrontDrawing } from "../front/front-drawing";
import { heapFilm, type HeapFilm, type HeapStep } from "./heap-rules";
import { heapShape, heapSize } from "./heap-shape";

const beatNames = [
  "the top leaves",
  "the last one goes up",
  "it sinks",
  "closed sides leave",
  "new sides rise",
] as const;
/** Rows of the heap that are drawn. */
const rowCount = 5;
/** Pixels between a side and its length. */
const labelGap = 15;

export class HeapFigure implements Figure {
  readonly #front = new Stage(() => this.#drawFront());
  readonly #heap = new Stage(() => this.#drawHeap());
  readonly #view = new PlaneView(this.#front, [0.02, 0.02, 0.99, 0.98]);
  readonly #player = new FilmPlayer({
    beats: beatNames,
    onChange: () => this.#report(),
    describe: () => this.#status.textContent,
  });
  readonly #status = element("p", { class: "status" });
  #made: HeapFilm | null = null;
  #values: Values | null = null;
  #lit: string | null = null;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const panel = (title: string, stage: Stage): HTMLElement =>
      element(
        "div",
        { class: "twin" },
        element("div", { class: "head" }, element("b", {}, title)),
        stage.element,
      );
    host.append(
      element(
        "div",
        { class: "twins heap" },
        panel("Front", this.#front),
        panel("Heap of its sides", this.#heap),
      ),
      this.#player.element,
      this.#player.beats,
      this.#status,
    );
    this.#made = heapFilm(await loadPlaneFront(), heapShape, heapSize);
    if (this.#made) this.#player.setFilm(this.#made.film);
    this.#player.seek(5);
  }

  go({ step, beat }: Readonly<Record<string, string>>): void {
    const count = this.#made?.film.stepCount ?? 0;
    const named: Readonly<Record<string, number>> = { middle: Math.round(count / 2), end: count };
    this.#player.glideTo(
      step === undefined ? this.#player.step : (named[step] ?? Number(step)),
      Number(beat ?? 0),
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#front.requestDraw();
    this.#heap.requestDraw();
  }

  /** The present step; at the end, the last one. */
  get #step(): HeapStep | undefined {
    return this.#made?.steps[this.#player.step];
  }

  #report(): void {
    const made = this.#made;
    if (!made) return;
    const { finished, step, beat } = this.#player;
    const present = made.steps[step] ?? made.steps.at(-1);
    const sides = made.film.sizes[finished] ?? 0;
    const all = (of: (each: HeapStep) => number): number =>
      made.steps.slice(0, finished).reduce((sum, each) => sum + of(each), 0);
    const [compared, list] = [present?.comparisons ?? 0, present?.listComparisons ?? 0];
    this.#values?.put({
      step: finished,
      steps: made.film.stepCount,
      beat,
      sides,
      rows: sides === 0 ? 0 : Math.floor(Math.log2(sides)) + 1,
      compared,
      list,
      allcompared: all((each) => each.comparisons),
      alllist: all((each) => each.listComparisons),
      cheaper: step < made.film.stepCount && list < compared,
      finished: finished === made.film.stepCount,
      handled: this.#player.isHandled,
    });
    const strong = (text: string): HTMLElement => element("b", {}, text);
    this.#status.replaceChildren(
      ...(step >= made.film.stepCount
        ? ["The front is empty."]
        : [
            "Step ",
            strong(String(step + 1)),
            ` of ${made.film.stepCount} · `,
            strong(String(compared)),
            ` comparisons in the heap, `,
            strong(String(list)),
            " in a list",
          ]),
    );
    this.mark(this.#lit);
  }

  #drawFront(): void {
    const made = this.#made;
    if (!made) return;
    const c = colours();
    const pen = new Pen(this.#front.context);
    const { film, lengths } = made;
    const { step, beat } = this.#player;
    const at = (point: PlanePoint): Pixel => this.#view.pixel(point);
    const drawn = { film, loops: [heapShape], step, beat: 0, lit: this.#lit === "front" ? "front" : null };
    new FrontDrawing(pen, at, 0.95).draw(drawn);
    const present = this.#step;
    if (!present) return;
    const pixels = (side: number): readonly [Pixel, Pixel] => {
      const [a, b] = film.sides[side]?.ends ?? [0, 0];
      return [at(film.nodes[a] ?? [0, 0]), at(film.nodes[b] ?? [0, 0])];
    };
    // The new triangle, once the closed sides leave.
    const triangle = film.triangles.find(({ born }) => born === step + 1);
    const grown = ease(beat - 3);
    if (triangle && grown > 0)
      pen.polygon(
        triangle.corners.map((node) => at(film.nodes[node] ?? [0, 0])),
        mix(c["new-soft"], c.new, 0.4),
        grown,
        {
          colour: c.new,
          width: 2.5,
          alpha: grown,
        },
      );
    const [a, b] = pixels(present.base);
    pen.glow(a, b, c.active, 1);
    // The lengths of the other sides have no room on a small stage.
    const isSmall = this.#front.width < 400;
    const middle = at([0.5, 0.5]);
    const placed: Pixel[] = [];
    for (const side of present.states[0] ?? []) {
      const isTop = side === present.base;
      if (isSmall && !isTop) continue;
      const half = between(...pixels(side), 0.5);
      const text = digits(lengths[side] ?? 0, 2);
      // The label of the active side is beside it, away from the middle of the front; the others are on the empty side.
      if (isTop) {
        const away = [half[0] - middle[0], half[1] - middle[1]] as const;
        const by = 24 / Math.max(1, Math.hypot(...away));
        this.#front.label(text, half, { dx: by * away[0], dy: by * away[1], look: "active plate" });
        continue;
      }
      const [from, to] = pixels(side);
      const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
      const by = labelGap / Math.max(1, Math.hypot(dx, dy));
      const place: Pixel = [half[0] + by * dy * 1.3, half[1] - by * dx];
      // Where there is no room, the tree tells the length.
      if (placed.some(([x, y]) => Math.abs(x - place[0]) < 30 && Math.abs(y - place[1]) < 15)) continue;
      placed.push(place);
      this.#front.label(text, place, { look: "small" });
    }
  }

  #slot(slot: number): Pixel {
    const row = Math.floor(Math.log2(slot + 1));
    const inRow = slot + 1 - 2 ** row;
    const { width, height } = this.#heap;
    return [((inRow + 0.5) / 2 ** row) * width, (height * (row + 0.55)) / rowCount];
  }

  #drawHeap(): void {
    const made = this.#made;
    const present = this.#step;
    if (!made || !present) return;
    const c = colours();
    const pen = new Pen(this.#heap.context);
    const beat = clamp(this.#player.beat, 0, lastBeat);
    // Beat 1 lets the top leave; the states of the heap change in the beats after it.
    const from = clamp(Math.floor(beat) - 1, 0, 4);
    const to = clamp(from + 1, 0, 4);
    const t = beat < 1 ? 0 : ease(beat - Math.floor(beat));
    const [before, after] = [present.states[from] ?? [], present.states[t > 0 ? to : from] ?? []];
    const slots = new Map<number, Pixel>();
    const alphas = new Map<number, number>();
    for (const [slot, side] of after.entries()) {
      const earlier = before.indexOf(side);
      const end = this.#slot(slot);
      // A new side comes from below.
      const start = earlier < 0 ? ([end[0], this.#heap.height + 20] as const) : this.#slot(earlier);
      slots.set(side, between(start, end, t));
      alphas.set(side, earlier < 0 ? t : 1);
    }
    for (const [slot, side] of before.entries())
      if (!slots.has(side)) {
        const start = this.#slot(slot);
        slots.set(side, [start[0] - 60 * t, start[1] - 24 * t]);
        alphas.set(side, 1 - t);
      }
    const count = Math.max(before.length, after.length);
    for (let slot = 1; slot < count; slot++)
      pen.line(this.#slot(slot), this.#slot((slot - 1) >> 1), c.faint, 1.5, { alpha: 0.8 });
    const isSmall = this.#heap.width < 420;
    const radius = isSmall ? 9.5 : 16;
    const born = new Set(present.states[4]?.filter((side) => !(present.states[0] ?? []).includes(side)));
    for (const [side, at] of slots) {
      const isTop = side === present.base;
      const isNew = born.has(side);
      const alpha =
        (alphas.get(side) ?? 1) * (isTop ? 1 - 0.75 * clamp(beat - 0.2, 0, 1) * (beat > 1 ? 1 : 0) : 1);
      const fill = isTop ? c.active : isNew ? c.new : c.plate;
      if ((isTop && this.#lit === "top") || (isNew && this.#lit === "new"))
        pen.circle(at, radius + 6, fill, { alpha: 0.3 });
      pen.circle(at, radius, fill, {
        alpha,
        stroke: isTop ? c.active : isNew ? c.new : c.ink,
        width: 1.75,
        strokeAlpha: alpha,
      });
      const { context } = this.#heap;
      context.font = `560 ${isSmall ? 10 : 13}px ${getComputedStyle(this.#heap.element).getPropertyValue("--sans")}`;
      context.textAlign = "center";
      context.textBaseline = "middle";
      const ink = isTop ? c.ground : isNew ? ([32, 36, 43] as const) : c.ink;
      context.fillStyle = `rgb(${ink.join(" ")} / ${alpha})`;
      context.fillText(digits(made.lengths[side] ?? 0, 2).slice(1), at[0], at[1] + 0.5);
    }
  }
}
