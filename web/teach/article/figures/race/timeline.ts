/** One scrubber for several fronts: lines of the refusals so far over the share of the steps. */
import { colours, css, onTheme } from "../../kit/colours";
import { button, element } from "../../kit/dom";
import { clamp, isCalm, Motion } from "../../kit/motion";

export interface TimelineRun {
  readonly name: string;
  readonly dash: readonly number[];
  /** Refusals before each state. */
  readonly refusedBefore: readonly number[];
}

/** Seconds of a race, and the share of the steps by which a key moves it. */
const playTime = 9;
const [keyStep, pageStep] = [0.01, 0.1] as const;
/** Room for the names, and the smallest distance between two of them, in pixels. */
const [namesWidth, nameHeight, top, bottom] = [118, 18, 18, 8] as const;

export class Timeline {
  readonly element: HTMLElement;
  share = 1;
  #runs: readonly TimelineRun[] = [];
  readonly #motion = new Motion();
  readonly #canvas = element("canvas", { "aria-hidden": "true" });
  readonly #slider: HTMLElement;
  readonly #play: HTMLButtonElement;

  /** @param onChange Called after every change of the share. */
  constructor(readonly onChange: () => void) {
    this.#play = button({ class: "round play", "aria-label": "Play" }, "", () => this.#toggle());
    this.#slider = element(
      "div",
      {
        class: "history",
        role: "slider",
        tabindex: "0",
        "aria-label": "Share of the steps",
        "aria-valuemin": "0",
        "aria-valuemax": "100",
      },
      this.#canvas,
    );
    this.element = element("div", { class: "player race-line" }, this.#play, this.#slider);
    this.#icon();
    this.#listen();
    new ResizeObserver(() => this.#draw()).observe(this.#slider);
    onTheme(() => this.#draw());
  }

  setRuns(runs: readonly TimelineRun[]): void {
    this.#runs = runs;
    this.#draw();
  }

  seek(share: number): void {
    this.share = clamp(share, 0, 1);
    this.#slider.setAttribute("aria-valuenow", String(Math.round(100 * this.share)));
    this.#slider.setAttribute("aria-valuetext", this.#describe());
    this.#draw();
    this.onChange();
  }

  glideTo(share: number): void {
    this.#stop();
    const from = this.share;
    this.#motion.run(700, (t) => this.seek(from + (share - from) * t));
  }

  pause(): void {
    this.#stop();
  }

  get isPlaying(): boolean {
    return this.#play.getAttribute("aria-label") === "Pause";
  }

  #refusedBy({ refusedBefore }: TimelineRun): number {
    return refusedBefore[Math.round(this.share * (refusedBefore.length - 1))] ?? 0;
  }

  #describe(): string {
    return this.#runs.map((run) => `${run.name}: ${this.#refusedBy(run)} refused`).join(", ");
  }

  #toggle(): void {
    if (this.isPlaying) return this.#stop();
    if (this.share >= 1) this.seek(0);
    if (isCalm()) return this.seek(1);
    this.#play.setAttribute("aria-label", "Pause");
    this.#icon();
    this.#motion.frames(
      (seconds) => {
        this.seek(this.share + seconds / playTime);
        return this.share < 1;
      },
      () => this.#stop(),
    );
  }

  #stop(): void {
    this.#motion.stop();
    this.#play.setAttribute("aria-label", "Play");
    this.#icon();
    this.onChange();
  }

  #icon(): void {
    const path = this.isPlaying ? "M7 5h3v14h-3zM14 5h3v14h-3z" : "M8 5l11 7-11 7z";
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("viewBox", "0 0 24 24");
    svg.setAttribute("aria-hidden", "true");
    const shape = document.createElementNS("http://www.w3.org/2000/svg", "path");
    shape.setAttribute("d", path);
    svg.append(shape);
    this.#play.replaceChildren(svg);
  }

  #listen(): void {
    const slider = this.#slider;
    const scrub = ({ clientX }: PointerEvent): void => {
      const { left, width } = slider.getBoundingClientRect();
      this.seek((clientX - left - 7) / (width - namesWidth - 7));
    };
    slider.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#stop();
      slider.setPointerCapture(event.pointerId);
      scrub(event);
      slider.addEventListener("pointermove", scrub);
      for (const type of ["pointerup", "pointercancel"])
        slider.addEventListener(type, () => slider.removeEventListener("pointermove", scrub), { once: true });
    });
    slider.addEventListener("keydown", (event) => {
      const { key } = event;
      const by = {
        ArrowLeft: -keyStep,
        ArrowDown: -keyStep,
        ArrowRight: keyStep,
        ArrowUp: keyStep,
        PageDown: -pageStep,
        PageUp: pageStep,
      }[key];
      const to = by === undefined ? { Home: 0, End: 1 }[key] : this.share + by;
      if (to === undefined) return;
      event.preventDefault();
      this.#stop();
      this.seek(to);
    });
  }

  #draw(): void {
    const { clientWidth: width, clientHeight: height } = this.#slider;
    const context = this.#canvas.getContext("2d");
    if (!context || width === 0) return;
    const ratio = Math.max(2, devicePixelRatio);
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    context.scale(ratio, ratio);
    const c = colours();
    const ground = height - bottom;
    const most = Math.max(1, ...this.#runs.map(({ refusedBefore }) => refusedBefore.at(-1) ?? 0));
    const x = (share: number): number => 7 + share * (width - namesWidth - 7);
    const y = (count: number): number => ground - (count / most) * (ground - top);
    const rule = (from: number, to: number, colour: string, lineWidth: number): void => {
      context.strokeStyle = colour;
      context.lineWidth = lineWidth;
      context.beginPath();
      context.moveTo(x(from), ground);
      context.lineTo(x(to), ground);
      context.stroke();
    };
    rule(0, 1, css(c.rule), 2);
    rule(0, this.share, css(c.ink), 2);
    context.lineJoin = "round";
    for (const { refusedBefore, dash } of this.#runs) {
      const last = refusedBefore.length - 1;
      const line = (from: number, to: number, alpha: number): void => {
        context.beginPath();
        for (let k = from; k <= to; k++) context.lineTo(x(k / last), y(refusedBefore[k] ?? 0));
        context.strokeStyle = css(c.refused, alpha);
        context.lineWidth = 2.5;
        context.setLineDash([...dash]);
        context.stroke();
        context.setLineDash([]);
      };
      const here = Math.round(this.share * last);
      line(0, here, 1);
      line(here, last, 0.4);
    }
    this.#drawNames(context, x(1) + 8, y, ground);
    context.strokeStyle = context.fillStyle = css(c.ink);
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x(this.share), 6);
    context.lineTo(x(this.share), ground);
    context.stroke();
    context.beginPath();
    context.arc(x(this.share), 6, 5.5, 0, 2 * Math.PI);
    context.fill();
    this.#drawTitle(context, x(0) + 4);
  }

  /** What the lines count, in front of them and of the hand. */
  #drawTitle(context: CanvasRenderingContext2D, x: number): void {
    const c = colours();
    context.font = `500 13px ${getComputedStyle(this.#slider).fontFamily}`;
    context.textBaseline = "alphabetic";
    context.strokeStyle = css(c.ground);
    context.lineWidth = 5;
    context.strokeText("refused candidates", x, top + 9);
    context.fillStyle = css(c.soft);
    context.fillText("refused candidates", x, top + 9);
  }

  /** Names at the ends of the lines, from below, moved up where they would overlap. */
  #drawNames(
    context: CanvasRenderingContext2D,
    x: number,
    y: (count: number) => number,
    ground: number,
  ): void {
    const ends = this.#runs
      .map(({ name, refusedBefore }) => ({ name, total: refusedBefore.at(-1) ?? 0 }))
      .sort((a, b) => a.total - b.total);
    const places = ends.map(({ total }) => y(total));
    const room = Math.min(nameHeight, (ground - 6) / Math.max(1, ends.length - 1));
    places.forEach((place, i) => {
      const below = places[i - 1] ?? ground + room;
      places[i] = Math.min(place, below - room);
    });
    // The names must not leave the picture either.
    for (let i = places.length - 1; i >= 0; i--)
      places[i] = Math.max(places[i] ?? 0, i === places.length - 1 ? 6 : (places[i + 1] ?? 0) + room);
    context.font = `560 13px ${getComputedStyle(this.#slider).fontFamily}`;
    context.textBaseline = "middle";
    context.fillStyle = css(colours().soft);
    ends.forEach(({ name, total }, i) => context.fillText(`${name} ${total}`, x, places[i] ?? 0));
  }
}
