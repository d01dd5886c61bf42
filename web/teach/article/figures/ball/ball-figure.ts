/** A ball that the front fills, as the engine recorded it: played, cut, and pulled apart by whole elements. */
import { effect, untracked } from "@preact/signals-core";
import { loadTrace } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { between, length } from "../../../../document/vectors";
import { button, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer, lastBeat } from "../../kit/film-player";
import { clamp, Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { BallDrawing, viewOf } from "./ball-drawing";
import { BallFilm } from "./ball-film";

const beatNames = ["active face", "ideal point", "candidates", "test", "new tetrahedron"] as const;
/** Where the ball is seen from. */
const home = { target: [0.1, 0.1, -0.2] as Position, distance: 4.75, yaw: 0.66, pitch: 0.36 };
/** What the buttons set: position of the cut, and how far the elements are apart. */
const looks = [
  { label: "Whole", cut: -1.1, open: 0 },
  { label: "Cut", cut: 0, open: 0 },
  { label: "Pulled apart", cut: 0, open: 0.6 },
] as const;

type View = Pick<Camera, "target" | "distance" | "yaw" | "pitch">;

export class BallFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, { ...home, pitches: [-0.5, 1.4] });
  readonly #drawing = new BallDrawing(this.#stage, this.#camera, new Pen(this.#stage.context));
  readonly #player = new FilmPlayer({
    beats: beatNames,
    onChange: () => this.#report(),
    describe: () => this.#status.textContent,
  });
  readonly #status = element("p", { class: "status" });
  readonly #flight = new Motion();
  readonly #opening = new Motion();
  readonly #buttons = looks.map((look) => button({}, look.label, () => this.#look(look, true)));
  #values: Values | null = null;
  #film: BallFilm | null = null;
  /** The step that the camera is near to; null if it sees the whole ball. */
  #near: number | null = null;
  #far: View = home;
  #lit: string | null = null;
  #isOpened = false;
  #farness = 1;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const choices = element(
      "div",
      { class: "choices", role: "group", "aria-label": "The ball" },
      ...this.#buttons,
    );
    host.append(this.#stage.element, choices, this.#player.element, this.#player.beats, this.#status);
    const answer = await fetch(new URL("../../traces/ball.tft", document.baseURI));
    const trace = await loadTrace(new Uint8Array(await answer.arrayBuffer()));
    if (!trace.success) throw new Error(trace.errors[0].message);
    this.#film = new BallFilm(trace.value);
    this.#player.setFilm(this.#film);
    effect(() => {
      values.number("cut");
      const open = values.number("open");
      untracked(() => {
        this.#stepBack(open);
        this.#report();
      });
    });
  }

  go({ step, beat, cut, open }: Readonly<Record<string, string>>): void {
    const film = this.#film;
    if (!film) return;
    this.#isOpened = false;
    const values = this.#values;
    this.#look(
      { cut: Number(cut ?? values?.number("cut")), open: Number(open ?? values?.number("open")) },
      false,
    );
    if (step === undefined && beat === undefined) return;
    const named: Readonly<Record<string, number>> = {
      middle: Math.round(film.stepCount * 0.42),
      "first-refused": film.refusals.find((k) => film.stepAt(k) !== undefined) ?? 0,
      end: film.stepCount,
    };
    const to = step === undefined ? this.#player.step : (named[step] ?? Number(step));
    this.#player.glideTo(to, beat === undefined ? 0 : Number(beat));
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  /** Moves the cut and the elements; the reader may do so, too. */
  #look({ cut, open }: { readonly cut: number; readonly open: number }, isReader: boolean): void {
    const values = this.#values;
    if (!values) return;
    if (isReader) {
      this.#isOpened = open > 0;
      this.#player.pause();
      if (this.#player.beat > 0) this.#player.seek(this.#player.step, 0);
    }
    const from = [values.number("cut"), values.number("open")] as const;
    this.#opening.run(800, (t) => {
      values.ask("cut", from[0] + (cut - from[0]) * t);
      values.ask("open", from[1] + (open - from[1]) * t);
    });
  }

  /** The eye goes back as the elements come apart. */
  #stepBack(open: number): void {
    const factor = (1 + 0.62 * open) / this.#farness;
    this.#farness *= factor;
    this.#far = { ...this.#far, distance: this.#far.distance * factor };
    if (this.#near === null) this.#camera.distance *= factor;
  }

  #report(): void {
    const film = this.#film;
    const values = this.#values;
    if (!film || !values) return;
    const { step, beat, finished, isHandled, isPlaying } = this.#player;
    const refused = film.refusedIn(step);
    const filled = film.filledAt(finished);
    values.put({
      step: finished,
      steps: film.stepCount,
      beat,
      front: film.sizes[finished] ?? 0,
      boundary: film.sizes[0] ?? 0,
      filled,
      elements: film.filledAt(film.stepCount),
      fresh: film.nodeCount - film.boundaryNodes,
      refused: film.refusals.length,
      atrefusal: beat >= 3.9 && refused > 0,
      finished: finished === film.stepCount,
      handled: isHandled || this.#isOpened,
    });
    const strong = (text: string, look = ""): HTMLElement => element("b", { class: look }, text);
    if (finished === film.stepCount)
      this.#status.replaceChildren(strong(filled.toLocaleString("en")), " tetrahedra. The front is empty.");
    else
      this.#status.replaceChildren(
        ...(beat > 0 ? ["Step ", strong(String(step + 1))] : ["After step ", strong(String(step))]),
        ` of ${film.stepCount.toLocaleString("en")} · `,
        strong(String(film.sizes[finished] ?? 0)),
        " faces in the front · ",
        strong(String(filled)),
        " tetrahedra",
        ...(beat >= 3.9 && refused > 0 ? [" · ", strong(`${refused} refused`, "refused")] : []),
      );
    const [cut, open] = [values.number("cut"), values.number("open")];
    this.#buttons.forEach((each, i) => {
      const look = looks[i];
      const isPressed = look !== undefined && Math.abs(look.cut - cut) < 0.03 && look.open > 0 === open > 0;
      each.setAttribute("aria-pressed", String(isPressed));
    });
    this.#stage.element.classList.toggle("playing", isPlaying);
    this.#fly(beat > 0 && !isPlaying && film.stepAt(step) ? step : null);
    this.#stage.requestDraw();
  }

  /** Moves the camera to a step, or back to where it was. */
  #fly(near: number | null): void {
    const film = this.#film;
    if (near === this.#near || !film) return;
    const camera = this.#camera;
    if (this.#near === null)
      this.#far = { target: camera.target, distance: camera.distance, yaw: camera.yaw, pitch: camera.pitch };
    this.#near = near;
    const step = near === null ? undefined : film.stepAt(near);
    const to = step ? this.#viewOf(film, step) : this.#far;
    const from = { target: camera.target, distance: camera.distance, yaw: camera.yaw, pitch: camera.pitch };
    // The shorter way around.
    const turn = Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
    this.#flight.run(750, (t) => {
      camera.target = between(from.target, to.target, t);
      camera.distance = from.distance + (to.distance - from.distance) * t;
      camera.yaw = from.yaw + turn * t;
      camera.pitch = from.pitch + (to.pitch - from.pitch) * t;
      this.#stage.requestDraw();
    });
  }

  #viewOf(film: BallFilm, step: NonNullable<ReturnType<BallFilm["stepAt"]>>): View {
    const [x, y, z] = viewOf(film, step);
    const size = length([x, y, z]) || 1;
    const middle = film.faces[step.face]?.middle ?? home.target;
    return {
      target: between(middle, step.idealPoint, 0.5),
      distance: Math.max(1.2, 5 * step.targetEdge),
      yaw: Math.atan2(x, -y),
      pitch: clamp(Math.asin(clamp(z / size, -1, 1)), -1.3, 1.3),
    };
  }

  #draw(): void {
    const film = this.#film;
    const values = this.#values;
    if (!film || !values) return;
    const { step, beat, isPlaying } = this.#player;
    const near = beat > 0 && !isPlaying ? film.stepAt(step) : undefined;
    if (near) return this.#drawing.drawStep(film, step, near, Math.min(beat, lastBeat));
    this.#drawing.drawWhole({
      film,
      state: step,
      cut: values.number("cut"),
      open: values.number("open"),
      isPlaying,
      lit: this.#lit,
    });
  }
}
