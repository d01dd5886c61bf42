/**
 * Two scales of time below a figure: the history of all steps as an area, which is scrubbed, and the five beats within a step.
 * State (k, 0) is that after k steps; with a beat, step k + 1 is shown as far as this beat; at beat 5 it is done.
 */
import { colours, css, onTheme } from "./colours";
import { button, element } from "./dom";
import { clamp, isCalm, Motion } from "./motion";

export const lastBeat = 5;

/** What the history shows. */
export interface Film {
  readonly stepCount: number;
  /** Size of the front in the states from 0 to `stepCount`. */
  readonly sizes: readonly number[];
  /** Steps, from 0, in which a candidate is refused. */
  readonly refusals: readonly number[];
}

export interface FilmPlayerOptions {
  readonly beats: readonly [string, string, string, string, string];
  /** Called after every change of the state. */
  onChange(): void;
  /** What a screen reader says about the present state. */
  describe(): string;
}

/** Milliseconds of a beat. */
const beatTime = 420;
/** Beats per second at which playing begins; the speed doubles within about a second. */
const startSpeed = 2.2;
const acceleration = 0.75;
/** Seconds that the rest of a long film takes at most. */
const playTime = 7;

export class FilmPlayer {
  readonly element: HTMLElement;
  readonly beats: HTMLElement;
  step = 0;
  beat = 0;
  #film: Film = { stepCount: 0, sizes: [0], refusals: [] };
  readonly #motion = new Motion();
  readonly #canvas = element("canvas", { "aria-hidden": "true" });
  readonly #history: HTMLElement;
  readonly #play: HTMLButtonElement;
  readonly #beatButtons: readonly HTMLButtonElement[];
  #isPlaying = false;
  #isHandled = false;

  constructor(readonly options: FilmPlayerOptions) {
    this.#play = button({ class: "round play", "aria-label": "Play" }, "", () => this.#togglePlay());
    this.#history = element(
      "div",
      { class: "history", role: "slider", tabindex: "0", "aria-label": "Step" },
      this.#canvas,
    );
    const back = button({ class: "round", "aria-label": "One step back" }, "", () => this.#stepBack());
    const on = button({ class: "round", "aria-label": "One step on" }, "", () => this.#stepOn());
    drawIcon(this.#play, "M8 5l11 7-11 7z");
    drawIcon(back, "M14 6l-6 6 6 6");
    drawIcon(on, "M10 6l6 6-6 6");
    this.element = element("div", { class: "player" }, this.#play, back, on, this.#history);
    this.#beatButtons = options.beats.map((label, index) => {
      const made = button({ class: "beat" }, "", () => this.#showBeat(index + 1));
      made.append(element("i"), element("span", {}, label));
      return made;
    });
    this.beats = element(
      "div",
      { class: "beats", role: "group", "aria-label": "Beats of the step" },
      ...this.#beatButtons,
    );
    this.#listen();
    new ResizeObserver(() => this.#drawHistory()).observe(this.#history);
    onTheme(() => this.#drawHistory());
  }

  /** Number of finished steps. */
  get finished(): number {
    return this.step + (this.beat >= lastBeat ? 1 : 0);
  }

  /** Whether the reader has led the film to its present state, and not the text. */
  get isHandled(): boolean {
    return this.#isHandled;
  }

  get isPlaying(): boolean {
    return this.#isPlaying;
  }

  /** Takes another film and keeps the share of the steps that the reader has reached. */
  setFilm(film: Film): void {
    const share = this.#film.stepCount === 0 ? 0 : this.step / this.#film.stepCount;
    this.#film = film;
    this.step = clamp(Math.round(share * film.stepCount), 0, film.stepCount);
    if (this.step === film.stepCount) this.beat = 0;
    this.#changed();
  }

  seek(step: number, beat = 0): void {
    this.step = clamp(Math.round(step), 0, this.#film.stepCount);
    this.beat = this.step === this.#film.stepCount ? 0 : clamp(beat, 0, lastBeat);
    this.#changed();
  }

  /** Glides to a state: over the steps, then beat by beat. */
  glideTo(step: number, beat: number): void {
    this.#stop();
    this.#isHandled = false;
    const from = this.step;
    const to = clamp(Math.round(step), 0, this.#film.stepCount);
    if (to === from) {
      this.#showBeat(beat);
      return;
    }
    const time = clamp(Math.abs(to - from) * 14, 200, 1400);
    this.#motion.run(
      time,
      (t) => this.seek(from + (to - from) * t, 0),
      () => (beat > 0 ? this.#showBeat(beat) : this.seek(to, 0)),
    );
  }

  pause(): void {
    this.#stop();
    this.#changed();
  }

  #stop(): void {
    this.#motion.stop();
    this.#isPlaying = false;
    this.#play.setAttribute("aria-label", "Play");
    drawIcon(this.#play, "M8 5l11 7-11 7z");
  }

  /** Plays the beats of the present step up to one of them. */
  #showBeat(to: number): void {
    this.#stop();
    if (this.step >= this.#film.stepCount) return this.#changed();
    if (to === 0 || isCalm()) return this.seek(this.step, to);
    if (this.beat >= to) this.beat = to - 1;
    const { step } = this;
    this.#motion.frames((seconds) => {
      this.seek(step, Math.min(to, this.beat + (seconds * 1000) / beatTime));
      return this.beat < to;
    });
  }

  #stepOn(): void {
    if (this.beat >= lastBeat) this.seek(this.step + 1, 0);
    this.#showBeat(lastBeat);
  }

  #stepBack(): void {
    this.#stop();
    this.seek(this.beat > 0 ? this.step : this.step - 1, 0);
  }

  #togglePlay(): void {
    if (this.#isPlaying) return this.pause();
    if (this.finished >= this.#film.stepCount) this.seek(0);
    this.#isPlaying = true;
    this.#play.setAttribute("aria-label", "Pause");
    drawIcon(this.#play, "M7 5h3v14h-3zM14 5h3v14h-3z");
    let [speed, position] = [startSpeed, this.step + Math.min(this.beat, 4.9) / lastBeat];
    const fast = (this.#film.stepCount / playTime) * lastBeat;
    this.#motion.frames(
      (seconds) => {
        speed = Math.min(Math.max(fast, startSpeed), speed * Math.exp(seconds * acceleration));
        position += (speed * seconds) / lastBeat;
        const step = Math.min(this.#film.stepCount, Math.floor(position));
        this.seek(step, isCalm() || speed > 60 ? 0 : (position - step) * lastBeat);
        return step < this.#film.stepCount;
      },
      () => this.pause(),
    );
  }

  #listen(): void {
    const history = this.#history;
    for (const node of [this.element, this.beats])
      for (const type of ["pointerdown", "keydown"])
        node.addEventListener(type, () => (this.#isHandled = true), { capture: true });
    const scrub = ({ clientX }: PointerEvent): void => {
      const { left, width } = history.getBoundingClientRect();
      this.seek(((clientX - left - 7) / (width - 14)) * this.#film.stepCount, 0);
    };
    history.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#stop();
      history.setPointerCapture(event.pointerId);
      scrub(event);
      history.addEventListener("pointermove", scrub);
      for (const type of ["pointerup", "pointercancel"])
        history.addEventListener(type, () => history.removeEventListener("pointermove", scrub), {
          once: true,
        });
    });
    history.addEventListener("keydown", (event) => {
      const to = this.#keyed(event.key);
      if (to === null) return;
      event.preventDefault();
      this.#stop();
      this.seek(to, 0);
    });
  }

  #keyed(key: string): number | null {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[key];
    if (by !== undefined) return this.step + by;
    return key === "Home" ? 0 : key === "End" ? this.#film.stepCount : null;
  }

  #changed(): void {
    const { stepCount } = this.#film;
    this.#beatButtons.forEach((node, index) => {
      node.toggleAttribute("data-on", this.beat >= index + 0.9);
      if (Math.ceil(this.beat) === index + 1) node.setAttribute("aria-current", "step");
      else node.removeAttribute("aria-current");
    });
    this.beats.toggleAttribute("data-off", this.step >= stepCount);
    this.options.onChange();
    this.#history.setAttribute("aria-valuemin", "0");
    this.#history.setAttribute("aria-valuemax", String(stepCount));
    this.#history.setAttribute("aria-valuenow", String(this.finished));
    this.#history.setAttribute("aria-valuetext", this.options.describe());
    this.#drawHistory();
  }

  /** The area is the size of the front; refusals are red ticks below it. */
  #drawHistory(): void {
    const { clientWidth: width, clientHeight: height } = this.#history;
    const context = this.#canvas.getContext("2d");
    if (!context || width === 0) return;
    const ratio = Math.max(2, devicePixelRatio);
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    context.scale(ratio, ratio);
    const { stepCount, sizes, refusals } = this.#film;
    const c = colours();
    const ground = height - 9;
    const most = Math.max(1, ...sizes);
    const at = (step: number): number => 7 + (step / Math.max(1, stepCount)) * (width - 14);
    const area = (to: number, colour: string): void => {
      context.beginPath();
      context.moveTo(at(0), ground);
      for (let step = 0; step <= to; step++)
        context.lineTo(at(step), ground - ((sizes[step] ?? 0) / most) * (ground - 12));
      context.lineTo(at(to), ground);
      context.closePath();
      context.fillStyle = colour;
      context.fill();
    };
    area(stepCount, css(c.void));
    area(Math.floor(this.finished), css(c["new-soft"]));
    // From the first step to the last one, also where the front is small.
    context.fillStyle = css(c.faint, 0.7);
    context.fillRect(at(0), ground, at(stepCount) - at(0), 1.5);
    context.fillStyle = css(c.refused);
    for (const step of refusals) context.fillRect(at(step) - 0.9, ground + 2, 1.8, 7);
    const x = at(this.step + this.beat / lastBeat);
    context.strokeStyle = context.fillStyle = css(c.ink);
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, 6);
    context.lineTo(x, ground);
    context.stroke();
    context.beginPath();
    context.arc(x, 6, 5.5, 0, 2 * Math.PI);
    context.fill();
  }
}

function drawIcon(node: HTMLElement, path: string): void {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const shape = document.createElementNS("http://www.w3.org/2000/svg", "path");
  shape.setAttribute("d", path);
  svg.append(shape);
  node.replaceChildren(svg);
}
