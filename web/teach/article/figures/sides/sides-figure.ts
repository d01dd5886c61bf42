/** A line under its size curve: the reader drags the curve and the beginning of the line, and every side is found again. */
import { effect, untracked } from "@preact/signals-core";
import { button, digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer } from "../../kit/film-player";
import { clamp, Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView } from "../../kit/plane-view";
import { Stage, type HandleOptions } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { divide, worstExcess, type SideRule, type Walk } from "./side-rules";
import { averagingsText, SidesDrawing } from "./sides-drawing";
import { between, curves, SizeCurve } from "./size-curve";

const beatNames = ["size at the start", "middle", "comparison", "mean, again", "side"] as const;
const rules = [
  ["middle", "The middle counts"],
  ["start", "The start counts"],
] as const;
/** The line begins before this position. */
const lastBegin = 7;
/** Width of the stage in pixels below which the curve is stretched upwards. */
const narrowStage = 560;
/** Where the line begins by a word of the figure's block. */
const begins: Readonly<Record<string, number>> = { slope: 2.4 };

export class SidesFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  #view = new PlaneView(this.#stage, [-0.65, -2, 9, 2.75], {
    below: narrowStage,
    window: [-0.65, -1.5, 9, 2.7],
  });
  readonly #player = new FilmPlayer({
    beats: beatNames,
    onChange: () => this.#report(),
    describe: () => this.#status.textContent,
  });
  readonly #pen = new Pen(this.#stage.context);
  readonly #motion = new Motion();
  readonly #status = element("p", { class: "status" });
  readonly #choices = element("div", { class: "choices", role: "group", "aria-label": "Which size counts" });
  #curve = new SizeCurve(curves["valley"] ?? []);
  #begin = 0;
  #rule: SideRule = "middle";
  #walk: Walk = divide(this.#curve, 0, "middle", 1e-3);
  #values: Values | null = null;
  /** Steps of the film: one per side, and one that divides the line. */
  #stepCount = Infinity;
  #isHandled = false;
  #lit: string | null = null;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    const shown = values.word("show");
    if (values.word("rule") === "start") this.#rule = "start";
    // Without bars below the line, its room is used for the curve.
    if (shown === "walk" || shown === "division") {
      const low = shown === "walk" ? -0.35 : -1.85;
      this.#view = new PlaneView(this.#stage, [-0.65, low, 9, 2.75], {
        below: narrowStage,
        window: [-0.65, shown === "walk" ? -0.4 : -1.5, 9, 2.7],
      });
      this.#stage.element.classList.add(shown === "walk" ? "low" : "ruled");
    }
    this.#curve = new SizeCurve(curves[values.word("curve")] ?? this.#curve.knots);
    this.#begin = begins[values.word("begin")] ?? 0;
    host.append(this.#stage.element, this.#player.element);
    // Figures of a whole line have no room for the beats of one side.
    if (shown === "side" || shown === "") host.append(this.#player.beats);
    host.append(this.#status);
    if (values.word("rule") !== "") host.append(this.#choices);
    for (const [rule, label] of rules)
      this.#choices.append(
        button({ "data-rule": rule }, label, () => {
          this.#isHandled = true;
          this.#choose(rule);
        }),
      );
    this.#stage.setHandles([
      ...this.#curve.knots.map((_knot, i) => this.#knotHandle(i)),
      this.#beginHandle(),
    ]);
    let isFirst = true;
    effect(() => {
      values.number("tolerance");
      this.#isHandled ||= !isFirst;
      isFirst = false;
      untracked(() => this.#choose(this.#rule));
    });
    const { length } = this.#walk.sides;
    if (values.word("at") === "end") this.#player.seek(length + 1);
    else if (shown === "side") this.#player.seek(0, 4);
    else if (shown !== "") this.#player.seek(shown === "walk" ? length : length + 1);
  }

  go({ step, beat, curve, rule, x }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    if (rule === "middle" || rule === "start") this.#choose(rule);
    const target = curve === undefined ? undefined : curves[curve];
    const [from, begin] = [this.#curve, this.#begin];
    const [to, toBegin] = [target ? new SizeCurve(target) : from, x === undefined ? begin : Number(x)];
    const arrive = (): void => {
      if (step === undefined && beat === undefined) return;
      const { length } = this.#walk.sides;
      const named: Readonly<Record<string, number>> = { last: length, end: length + 1 };
      this.#player.glideTo(
        step === undefined ? this.#player.step : (named[step] ?? Number(step)),
        Number(beat ?? 0),
      );
    };
    if (to === from && toBegin === begin) return arrive();
    this.#motion.run(
      600,
      (t) => {
        this.#curve = between(from, to, t);
        this.#begin = begin + (toBegin - begin) * t;
        this.#divide();
      },
      arrive,
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #knotHandle(index: number): HandleOptions {
    return {
      name: `size-${index + 1}`,
      label: `Size ${index + 1} of the curve`,
      at: () => this.#view.pixel(this.#curve.knots[index] ?? [0, 0]),
      begin: () => this.#take(),
      move: (pixel) => {
        this.#isHandled = true;
        this.#curve = this.#curve.withKnot(index, this.#view.point(pixel));
        this.#divide();
      },
      describe: () => digits(this.#curve.knots[index]?.[1] ?? 0, 2),
    };
  }

  #beginHandle(): HandleOptions {
    return {
      name: "begin",
      label: "Beginning of the line",
      look: "active",
      at: () => this.#view.pixel([this.#begin, 0]),
      begin: () => this.#take(),
      move: (pixel) => {
        this.#isHandled = true;
        this.#begin = clamp(this.#view.point(pixel)[0], 0, lastBegin);
        this.#divide();
      },
      describe: () => `at ${digits(this.#begin, 2)}`,
    };
  }

  #take(): void {
    this.#motion.stop();
    this.#player.pause();
  }

  #choose(rule: SideRule): void {
    this.#rule = rule;
    for (const node of this.#choices.children)
      node.setAttribute("aria-pressed", String((node as HTMLElement).dataset["rule"] === rule));
    this.#divide();
  }

  #divide(): void {
    const tolerance = (this.#values?.number("tolerance") ?? 0.1) / 100;
    this.#walk = divide(this.#curve, this.#begin, this.#rule, tolerance);
    const { sides } = this.#walk;
    const lengths = sides.map(({ length }) => length);
    const { step, beat } = this.#player;
    const fromEnd = this.#stepCount - step;
    this.#stepCount = sides.length + 1;
    this.#player.setFilm({
      stepCount: sides.length + 1,
      sizes: [lengths[0] ?? 0, ...lengths, lengths.at(-1) ?? 0],
      refusals: [],
    });
    // The present side stays the same one; a finished walk, or division, stays finished.
    this.#player.seek(fromEnd <= 1 ? this.#stepCount - fromEnd : Math.min(step, sides.length - 1), beat);
  }

  #report(): void {
    const { step, beat, finished } = this.#player;
    const { sides, lambda, nodes } = this.#walk;
    // When all sides stand, the text goes on to speak of the first one.
    const side = sides[step] ?? sides[0];
    if (!side) return;
    const [first, second] = side.comparisons;
    const apart = (at: typeof first): number => (at ? (at.target - at.length) / at.length : 0);
    const gap = (at: typeof first): number => (at ? at.target - at.length : 0);
    this.#values?.put({
      step: finished,
      steps: sides.length + 1,
      beat,
      x0: side.from,
      dx0: first?.length ?? 0,
      dx1: first?.target ?? 0,
      apart: 100 * Math.abs(apart(first)),
      mean: ((first?.length ?? 0) + (first?.target ?? 0)) / 2,
      length: side.length,
      rounds: side.comparisons.length - 1,
      slope: this.#curve.slopeAt(side.from),
      shrink: gap(first) === 0 || !second ? 0 : gap(second) / gap(first),
      sides: sides.length,
      lambda,
      count: nodes.length - 1,
      factor: lambda / (nodes.length - 1),
      excess: worstExcess(this.#curve, this.#walk),
      handled: this.#isHandled || this.#player.isHandled,
      finished: finished > sides.length,
      chosen: this.#rule,
    });
    this.#showStatus();
    this.#stage.requestDraw();
  }

  #showStatus(): void {
    const { step, beat } = this.#player;
    const { sides, nodes, lambda } = this.#walk;
    const strong = (text: string): HTMLElement => element("b", {}, text);
    const side = sides[step];
    const count = nodes.length - 1;
    if (!side)
      this.#status.replaceChildren(
        ...(step > sides.length || beat > 0
          ? [strong(`${count} sides`), `, each measures ${digits(lambda / count, 3)} sizes`]
          : ["The last side does not end at the end of the line."]),
      );
    else
      this.#status.replaceChildren(
        "Side ",
        strong(String(step + 1)),
        ` of ${sides.length} · length `,
        strong(digits(side.length, 2)),
        ` · ${this.#rule === "middle" ? averagingsText(side.comparisons.length - 1) : "as the size at its start"}`,
      );
  }

  #draw(): void {
    const { step, beat } = this.#player;
    const tolerance = (this.#values?.number("tolerance") ?? 0.1) / 100;
    new SidesDrawing(this.#stage, this.#view, this.#pen).draw({
      curve: this.#curve,
      walk: this.#walk,
      begin: this.#begin,
      step,
      beat,
      tolerance,
      lit: this.#lit,
    });
    this.#stage.element.classList.toggle("playing", this.#player.isPlaying);
  }
}
