/** One of the fronts of a race: its drawing, with the wing to drag, and its counts. */
import { colours } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import { clamp } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage } from "../../kit/stage";
import { FrontDrawing } from "../front/front-drawing";
import { smallestAngle, type FrontFilm } from "../front/front-film";
import { channel, loopsOf, onWing, type Wing } from "./race-rules";

/** Where the wing is held, and where it is turned, in lengths of its chord. */
const handles = { wing: [0, 0], turn: [1.05, 0] } as const;
/** Width of the stage in pixels below which lines and crosses are smaller. */
const smallStage = 260;
/** Crosses younger than this share of the steps are strong. */
const youngShare = 0.04;
/** Half the width and height of the window around the wing on a small stage. */
const [halfWidth, halfHeight] = [0.5, 0.287] as const;

export interface PanelOwner {
  readonly wing: Wing;
  /** What a small picture shows: its middle. */
  readonly focus: PlanePoint;
  begin(): void;
  end(): void;
  moveWing(to: PlanePoint): void;
  turnWing(towards: PlanePoint): void;
}

export class RacePanel {
  readonly element: HTMLElement;
  readonly #stage = new Stage(() => this.#draw());
  readonly #pen = new Pen(this.#stage.context);
  readonly #count = element("b", { class: "refused" });
  readonly #angle = element("span", { class: "worst" });
  #film: FrontFilm | null = null;
  /** Refused candidates by their steps; found when they are first drawn. */
  #crosses: readonly { readonly at: PlanePoint; readonly step: number }[] | null = null;
  #share = 1;
  #lit: string | null = null;

  constructor(
    readonly owner: PanelOwner,
    readonly index: number,
    title: string,
  ) {
    const head = element(
      "div",
      { class: "head" },
      element("b", { class: "title" }, title),
      this.#angle,
      this.#count,
    );
    this.element = element("div", { class: "race-panel" }, head, this.#stage.element);
    this.#stage.setHandles([
      {
        name: `wing-${index}`,
        label: `Wing, ${title}`,
        at: () => this.#view.pixel(onWing(owner.wing, handles.wing)),
        begin: () => owner.begin(),
        end: () => owner.end(),
        move: (pixel) => owner.moveWing(this.#view.point(pixel)),
      },
      {
        name: `turn-${index}`,
        label: `Angle of the wing, ${title}`,
        look: "active",
        at: () => this.#view.pixel(onWing(owner.wing, handles.turn)),
        begin: () => owner.begin(),
        move: (pixel) => owner.turnWing(this.#view.point(pixel)),
        describe: () => `${digits(owner.wing.angle, 0)} degrees`,
      },
    ]);
  }

  get film(): FrontFilm | null {
    return this.#film;
  }

  setFilm(film: FrontFilm | null): void {
    this.#film = film;
    this.#crosses = null;
  }

  show(share: number, lit: string | null, isBest: boolean, isPlaying: boolean): void {
    this.#share = share;
    this.#lit = lit;
    const film = this.#film;
    this.element.toggleAttribute("data-best", isBest);
    this.#stage.element.classList.toggle("playing", isPlaying);
    if (film) {
      const step = this.#step;
      const isEnd = step >= film.stepCount;
      const angle = isEnd ? film.worst.angle : smallestAngleBefore(film, step);
      const soFar = isEnd ? [] : [element("span", { class: "so-far" }, " so far")];
      this.#count.replaceChildren(`${film.refusedBefore[step] ?? 0} refused`, ...soFar);
      this.#angle.textContent = angle === null ? "" : `smallest angle ${digits(angle, 0)}°`;
    }
    this.#stage.requestDraw();
  }

  /** The channel; on a small stage, what is around the wing. */
  get #view(): PlaneView {
    const whole = [-0.02, -0.02, channel[0] + 0.02, channel[1] + 0.02] as const;
    if (this.#stage.width >= smallStage) return new PlaneView(this.#stage, whole);
    const middle = (axis: 0 | 1, half: number): number =>
      clamp(this.owner.focus[axis], half - 0.02, channel[axis] + 0.02 - half);
    const [x, y] = [middle(0, halfWidth), middle(1, halfHeight)];
    return new PlaneView(this.#stage, [x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight]);
  }

  get #step(): number {
    return Math.round(this.#share * (this.#film?.stepCount ?? 0));
  }

  #draw(): void {
    const film = this.#film;
    if (!film) return;
    const c = colours();
    const pen = this.#pen;
    const { wing } = this.owner;
    const at = (point: PlanePoint) => this.#view.pixel(point);
    const isSmall = this.#stage.width < smallStage;
    const loops = loopsOf(wing);
    new FrontDrawing(pen, at, isSmall ? 0.4 : 0.62).draw({
      film,
      loops,
      step: this.#step,
      beat: 0,
      lit: this.#lit === "front" || this.#lit === "worst" ? this.#lit : null,
    });
    const foil = (loops[1] ?? []).map(at);
    pen.polygon(foil, c.ink, 1, this.#lit === "wing" ? { colour: c.active, width: 3 } : undefined);
    this.#drawCrosses(film, isSmall ? 2 : 3.2);
    if (!this.#stage.element.classList.contains("playing"))
      pen.line(at(onWing(wing, [0.5, 0])), at(onWing(wing, handles.turn)), c.active, 1.5, { dash: [3, 3] });
  }

  #drawCrosses(film: FrontFilm, radius: number): void {
    this.#crosses ??= film.refusals.flatMap((step) =>
      (film.stepAt(step)?.candidates ?? [])
        .filter(({ refusal }) => refusal !== null)
        .map(({ at }) => ({ at, step })),
    );
    // The ideal points of sides at the wall can lie beyond it.
    const [low, high] = [this.#view.pixel([0, 0]), this.#view.pixel(channel)];
    const { context } = this.#pen;
    context.save();
    context.beginPath();
    context.rect(low[0] - 1, high[1] - 1, high[0] - low[0] + 2, low[1] - high[1] + 2);
    context.clip();
    const young = this.#step - film.stepCount * youngShare;
    const isLit = this.#lit === "refused";
    for (const { at, step } of this.#crosses) {
      if (step >= this.#step) break;
      this.#pen.cross(
        this.#view.pixel(at),
        step > young ? radius * 1.5 : radius,
        colours().refused,
        isLit ? 2.4 : 1.5,
        isLit || step > young ? 1 : 0.55,
      );
    }
    context.restore();
  }
}

/** Returns the smallest angle of the triangles that are there at a step, in degrees; null before the first one. */
function smallestAngleBefore({ triangles, nodes }: FrontFilm, step: number): number | null {
  const angles = triangles
    .filter(({ born }) => born <= step)
    .map(({ corners }) => smallestAngle(corners.map((node) => nodes[node] ?? [0, 0])));
  return angles.length > 0 ? Math.min(...angles) : null;
}
