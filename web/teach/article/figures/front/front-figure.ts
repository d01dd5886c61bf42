/** A polygon that the engine's own front in the plane fills; every change of the shape or the size fills it again. */
import { effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type PlaneFront, type UnfilledPlane } from "tetrafront/trace";
import { colours } from "../../kit/colours";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer, lastBeat } from "../../kit/film-player";
import { Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type HandleOptions } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { FrontDrawing, type DrawnFront } from "./front-drawing";
import { filmOf, type FrontFilm } from "./front-film";
import { captionOf, Lens } from "./lens";
import { Polygon } from "./polygon";
import { shapes } from "./shapes";

const beatNames = ["active side", "ideal point", "candidates", "test", "new triangle"] as const;
/** Distance of corners from the border of the drawing, in its units. */
const margin = 0.02;
/** Width of the stage in pixels below which lines are thinner. */
const smallStage = 500;

/** Why a shape has no inside, for readers; other reasons are those of the engine. */
const shapeTexts: Readonly<Partial<Record<UnfilledPlane["code"], string>>> = {
  crossing: "The boundary crosses itself, so it has no inside. Let go, and it springs back.",
  "same-corner": "Two corners would be in one place. Let go, and the shape springs back.",
  "too-many-sides": "This size needs too many sides.",
};

export class FrontFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #view = new PlaneView(this.#stage, [-0.03, -0.02, 1.43, 1.02]);
  readonly #pen = new Pen(this.#stage.context);
  readonly #lens = new Lens(this.#stage, this.#view, this.#pen);
  readonly #player = new FilmPlayer({
    beats: beatNames,
    onChange: () => this.#report(),
    describe: () => this.#describe(),
  });
  readonly #spring = new Motion();
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #status = element("p", { class: "status" });
  #polygon = new Polygon(shapes["boot"] ?? []);
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  #film: FrontFilm | null = null;
  #failed: UnfilledPlane | null = null;
  /** The segment whose middle the reader drags, and the new corner. */
  #added: { readonly segment: number; readonly corner: number } | null = null;
  #isTouched = false;
  /** Whether the reader has changed the shape or the size since the text led the figure. */
  #isChanged = false;
  /** Whether a word of the text sets the size at present. */
  #isLed = false;
  #lit: string | null = null;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    this.#polygon = new Polygon(shapes[values.word("shape")] ?? this.#polygon.corners);
    host.append(this.#stage.element, this.#notice, this.#player.element, this.#player.beats, this.#status);
    this.#engine = await loadPlaneFront();
    this.#makeHandles();
    let isFirst = true;
    effect(() => {
      values.number("size");
      if (!isFirst && !this.#isLed) this.#touch();
      isFirst = false;
      untracked(() => this.#fill());
    });
    if (values.word("at") === "middle" && this.#film) this.#player.seek(middleOf(this.#film));
  }

  go({ step, beat, size }: Readonly<Record<string, string>>): void {
    this.#isChanged = false;
    this.#isLed = true;
    if (size !== undefined) this.#values?.ask("size", Number(size));
    this.#isLed = false;
    const film = this.#film;
    if (!film) return;
    const named: Readonly<Record<string, number>> = {
      "first-refused": film.refusals[0] ?? 0,
      "first-new": firstNewIn(film),
      middle: middleOf(film),
      end: film.stepCount,
    };
    const to = step === undefined ? this.#player.step : (named[step] ?? Number(step));
    this.#player.glideTo(to, beat === undefined ? 0 : Number(beat));
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #makeHandles(): void {
    const corners = this.#polygon.corners.map((_corner, index): HandleOptions => this.#cornerHandle(index));
    const middles = this.#polygon.corners.map((_corner, index): HandleOptions => this.#middleHandle(index));
    this.#stage.setHandles([...corners, ...middles]);
  }

  #cornerHandle(index: number): HandleOptions {
    return {
      name: `corner-${index + 1}`,
      label: `Corner ${index + 1}`,
      at: () => this.#view.pixel(this.#polygon.corner(index)),
      begin: () => this.#begin(),
      move: (pixel) => this.#moveCorner(index, this.#view.point(pixel)),
      end: () => this.#settle(),
      remove: () => {
        if (!this.#polygon.remove(index)) return;
        this.#touch();
        this.#fill();
        this.#settle();
        this.#makeHandles();
      },
    };
  }

  /** Between two corners, a drag adds a corner. */
  #middleHandle(index: number): HandleOptions {
    return {
      name: `middle-${index + 1}`,
      label: `New corner after corner ${index + 1}`,
      look: "ghost",
      at: () =>
        this.#view.pixel(
          this.#added?.segment === index
            ? this.#polygon.corner(this.#added.corner)
            : this.#polygon.middle(index),
        ),
      begin: () => {
        this.#begin();
        const corner = this.#polygon.split(index);
        this.#added = corner === null ? null : { segment: index, corner };
      },
      move: (pixel) => {
        if (this.#added) this.#moveCorner(this.#added.corner, this.#view.point(pixel));
      },
      end: () => {
        this.#added = null;
        this.#makeHandles();
        this.#settle();
      },
    };
  }

  /** The shape to which an impossible one springs back is that before the movement. */
  #begin(): void {
    this.#polygon.keep();
    this.#spring.stop();
    this.#player.pause();
  }

  #moveCorner(index: number, to: PlanePoint): void {
    this.#polygon.move(index, this.#view.inside(to, margin));
    this.#touch();
    this.#fill();
  }

  #touch(): void {
    this.#isTouched = true;
    this.#isChanged = true;
  }

  #settle(): void {
    if (!this.#failed) return;
    const [from, to] = [this.#polygon.corners, this.#polygon.sound];
    const isSame = from.length === to.length;
    this.#spring.run(
      350,
      (t) => {
        if (isSame && t < 1)
          this.#polygon.restore(
            from.map(([x, y], i) => [x + ((to[i]?.[0] ?? x) - x) * t, y + ((to[i]?.[1] ?? y) - y) * t]),
          );
        this.#stage.requestDraw();
      },
      () => {
        this.#polygon.restore(to);
        this.#makeHandles();
        this.#fill();
      },
    );
  }

  #fill(): void {
    const values = this.#values;
    if (!values || !this.#engine) return;
    const filled = this.#engine.fill([this.#polygon.corners], values.number("size"), { improve: false });
    this.#failed = filled.success ? null : filled;
    this.#notice.textContent = filled.success ? "" : (shapeTexts[filled.code] ?? filled.message);
    if (filled.success) {
      this.#film = filmOf(filled);
      this.#player.setFilm(this.#film);
    }
    this.#stage.requestDraw();
  }

  #report(): void {
    const film = this.#film;
    if (!film) return;
    const { step, beat, finished } = this.#player;
    const current = beat > 0 ? film.stepAt(step) : undefined;
    const isAtRefusal = beat >= 3.9 && current?.candidates.some(({ refusal }) => refusal !== null) === true;
    this.#values?.put({
      step: finished,
      steps: film.stepCount,
      beat,
      front: film.sizes[finished] ?? 0,
      boundary: film.boundaryNodes,
      triangles: film.triangles.length,
      filled: film.triangles.filter(({ born }) => born <= finished).length,
      fresh: film.nodes.length - film.boundaryNodes,
      refused: film.refusedCount,
      refusedsteps: film.refusals.length,
      refusedsofar: film.refusedBefore[finished] ?? 0,
      angle: film.worst.angle,
      corners: this.#polygon.corners.length,
      touched: this.#isTouched,
      finished: finished === film.stepCount,
      atrefusal: isAtRefusal,
      scrubbed: this.#player.isHandled,
      handled: this.#player.isHandled || this.#isChanged,
    });
    this.#showStatus(film);
    this.#stage.requestDraw();
  }

  #showStatus(film: FrontFilm): void {
    const { step, beat, finished } = this.#player;
    const strong = (text: string, look = ""): HTMLElement => element("b", { class: look }, text);
    const current = beat > 0 ? film.stepAt(step) : undefined;
    if (finished >= film.stepCount && beat === 0) {
      this.#status.replaceChildren(strong(String(film.triangles.length)), " triangles. The front is empty.");
      return;
    }
    const caption = current ? captionOf(current, beat) : { text: "", look: "" };
    this.#status.replaceChildren(
      ...(current ? ["Step ", strong(String(step + 1))] : ["After step ", strong(String(step))]),
      ` of ${film.stepCount} · `,
      strong(String(film.sizes[finished] ?? 0)),
      " sides in the front",
      ...(caption.text === "" ? [] : [" · ", strong(caption.text, caption.look)]),
    );
  }

  #describe(): string {
    return this.#status.textContent;
  }

  #draw(): void {
    if (this.#failed) return this.#drawFailed(this.#failed);
    const film = this.#film;
    if (!film) return;
    const { step, beat, isPlaying } = this.#player;
    const drawn: DrawnFront = { film, loops: [this.#polygon.corners], step, beat, lit: this.#lit };
    const boldness = this.#stage.width < smallStage ? 0.8 : 1;
    new FrontDrawing(this.#pen, (point) => this.#view.pixel(point), boldness).draw(drawn);
    const current = beat > 0 && beat < lastBeat ? film.stepAt(step) : undefined;
    if (current) this.#lens.draw(drawn, current);
    this.#stage.element.classList.toggle("playing", isPlaying);
  }

  #drawFailed({ segments }: UnfilledPlane): void {
    const c = colours();
    const corners = this.#polygon.corners.map((corner) => this.#view.pixel(corner));
    this.#pen.polygon(corners, c.refused, 0.06, { colour: c.ink, width: 2.25 });
    for (const { segment } of segments) {
      const [from, to] = [corners[segment], corners[(segment + 1) % corners.length]];
      if (from && to) this.#pen.line(from, to, c.refused, 4, { dash: [8, 7] });
    }
  }
}

/** Returns a step at which much is filled, and much is empty. */
const middleOf = ({ stepCount }: FrontFilm): number => Math.round(stepCount * 0.45);

/** Returns the first step that makes a new node. */
function firstNewIn(film: FrontFilm): number {
  for (let k = 0; k < film.stepCount; k++)
    if (film.stepAt(k)?.candidates.some(({ isNew, refusal }) => isNew && refusal === null)) return k;
  return 0;
}
