/** The front under ellipses, here and in the tensor's space. The reader drags the axes of the ellipses, and a dot. */
import { batch, effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type PlaneFront } from "tetrafront/trace";
import { colours } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer } from "../../kit/film-player";
import { clamp, Motion } from "../../kit/motion";
import { between, Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { filmOf, type FrontFilm } from "../front/front-film";
import { extent, fields, outline, type FieldName } from "./fields";
import { drawField, drawGrid, drawSide, ellipseAround, fadeOut, type Drawn } from "./stretching-drawing";
import { drawHill, drawWind } from "./wind-drawing";
import {
  aspectOf,
  centroidOf,
  contains,
  directionOf,
  ellipseOf,
  fillField,
  intoSpaceOf,
  limits,
  shapeOf,
  TensorField,
  tensorOf,
  type Ellipse,
  type Tensor,
  type Triangle,
} from "./tensor-rules";

const beatNames = ["active side", "ideal point", "candidates", "test", "new triangle"] as const;
/** Pixels between the tip of an axis and its handle: on small stages, fingers need room. */
const gaps = { large: 0, small: 16 } as const;
/** Width of a small stage in pixels. */
const smallStage = 450;
/** Edges of length 1 from the middle to the border of the round window. */
const windowRadius = 3.6;
/** Triangles are stretched at most by this factor. */
const maxStretching = 6;

export class StretchingFigure implements Figure {
  readonly #here = new Stage(() => this.#drawHere());
  readonly #there = new Stage(() => this.#drawThere());
  readonly #player = new FilmPlayer({
    beats: beatNames,
    onChange: () => this.#report(),
    describe: () => this.#status.textContent,
  });
  readonly #motion = new Motion();
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #status = element("p", { class: "status" });
  readonly #aspect = element("span");
  readonly #shape = element("span");
  #field = fields.hill;
  #dot: PlanePoint = [0.9, 0.46];
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  #film: FrontFilm | null = null;
  #triangles: readonly Triangle[] = [];
  /** Index of the triangle at the dot. */
  #chosen = 0;
  #even = { size: 0, triangles: 0 };
  #isHandled = false;
  #isLed = false;
  #isFieldShown = false;
  #lit: string | null = null;

  /** @param isField Whether there is a field of ellipses, and not one ellipse. */
  constructor(readonly isField: boolean) {}

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    const panel = (title: string, stage: Stage, note: HTMLElement): HTMLElement =>
      element(
        "div",
        { class: "twin" },
        element("div", { class: "head" }, element("b", {}, title), note),
        stage.element,
      );
    host.append(
      this.#notice,
      element(
        "div",
        { class: "twins" },
        panel("Here", this.#here, this.#aspect),
        panel("In the tensor’s space", this.#there, this.#shape),
      ),
      this.#player.element,
    );
    if (!this.isField) host.append(this.#player.beats);
    host.append(this.#status);
    this.#engine = await loadPlaneFront();
    // Where handles overlap, a finger takes an axis.
    this.#here.setHandles([
      this.#dotHandle(),
      ...this.#ellipses.flatMap((_ellipse, index) =>
        [true, false].map((isLong) => this.#axisHandle(index, isLong)),
      ),
    ]);
    if (this.isField) {
      this.#dot = [0.52, 0.5];
      this.#fill();
    } else this.#followNumbers(values);
    this.#player.seek(this.#film?.stepCount ?? 0);
  }

  go({ step, beat, field, ...numbers }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    for (const [name, value] of Object.entries(numbers)) this.#values?.ask(name, Number(value));
    this.#isLed = false;
    const film = this.#film;
    const arrive = (): void => {
      if (!film) return;
      const named: Readonly<Record<string, number>> = {
        new: newNodeIn(film),
        middle: Math.round(film.stepCount * 0.55),
        end: film.stepCount,
      };
      const to = step === undefined ? this.#player.step : (named[step] ?? Number(step));
      this.#player.glideTo(to, Number(beat ?? 0));
    };
    if (field === undefined || !(field in fields)) return arrive();
    const [from, to] = [this.#field, fields[field as FieldName]];
    this.#motion.run(
      600,
      (t) => {
        this.#field = from.map((each, i) => betweenEllipses(each, to[i] ?? each, t));
        this.#fill();
      },
      () => step !== undefined && arrive(),
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#here.requestDraw();
    this.#there.requestDraw();
  }

  /** The numbers of the text are the axes of the one ellipse. */
  #followNumbers(values: Values): void {
    let isFirst = true;
    effect(() => {
      for (const name of ["size", "stretching", "angle"]) values.number(name);
      this.#isHandled ||= !isFirst && !this.#isLed;
      isFirst = false;
      untracked(() => this.#fill());
    });
  }

  get #ellipses(): readonly Ellipse[] {
    if (this.isField) return this.#field;
    const number = (name: string): number => this.#values?.number(name) ?? 1;
    return [
      { at: this.#dot, size: number("size"), stretching: number("stretching"), angle: number("angle") },
    ];
  }

  /** The ellipses of a field are at the border of their background grid. */
  get #view(): PlaneView {
    const [wide, high] = !this.isField
      ? [0.02, 0.01]
      : this.#here.width < smallStage
        ? [0.42, 0.2]
        : [0.24, 0.2];
    return new PlaneView(this.#here, [-wide, -high, extent[0] + wide, extent[1] + high]);
  }

  get #gap(): number {
    return this.#here.width < smallStage ? gaps.small : gaps.large;
  }

  get #tensors(): TensorField {
    return new TensorField(this.#ellipses, extent);
  }

  get #tensor(): Tensor {
    return this.#tensors.tensorAt(this.#dot);
  }

  #axisHandle(index: number, isLong: boolean): HandleOptions {
    const ellipse = (): Ellipse => this.#ellipses[index] ?? { at: [0, 0], size: 1, stretching: 1, angle: 0 };
    const name = isLong ? "along" : "across";
    return {
      name: this.isField ? `${name}-${index + 1}` : name,
      label: `${isLong ? "Long" : "Short"} axis of the ellipse${this.isField ? ` ${index + 1}` : ""}`,
      look: isLong ? "active solid" : "active",
      at: () => this.#tipOf(ellipse(), isLong, this.#gap),
      begin: () => this.#take(true),
      end: () => {
        this.#isFieldShown = false;
        this.mark(null);
      },
      move: (pixel) => {
        const { at, ...before } = ellipse();
        const [x, y] = this.#view.pixel(at);
        const [dx, dy] = [pixel[0] - x, y - pixel[1]];
        const length = Math.max(1, Math.hypot(dx, dy) - this.#gap) / this.#view.scale;
        const turn = (Math.atan2(dy, dx) * 180) / Math.PI - (isLong ? 0 : this.#acrossTurn(before.angle));
        this.#setEllipse(index, withAxis(before, length, turn, isLong));
      },
      describe: () => {
        const { size, stretching, angle } = ellipse();
        return `${digits(isLong ? size * stretching : size, 2)}, at ${digits(angle, 0)} degrees`;
      },
    };
  }

  /** Degrees from the long axis to the tip of the short one that has the handle: the one that points up. */
  #acrossTurn(angle: number): 90 | -90 {
    return Math.cos((angle * Math.PI) / 180) >= 0 ? 90 : -90;
  }

  #tipOf({ at, size, stretching, angle }: Ellipse, isLong: boolean, gap: number): Pixel {
    const [x, y] = this.#view.pixel(at);
    const [dx, dy] = directionOf(isLong ? angle : angle + this.#acrossTurn(angle));
    const length = (isLong ? size * stretching : size) * this.#view.scale + gap;
    return [x + length * dx, y - length * dy];
  }

  #setEllipse(index: number, ellipse: Omit<Ellipse, "at">): void {
    this.#isHandled = true;
    if (!this.isField) {
      batch(() => {
        for (const name of ["size", "stretching", "angle"] as const) this.#values?.ask(name, ellipse[name]);
      });
      return;
    }
    this.#field = this.#field.map((each, i) => (i === index ? { ...each, ...ellipse } : each));
    this.#fill();
  }

  #dotHandle(): HandleOptions {
    return {
      name: "dot",
      label: "Dot: chooses a triangle",
      look: "active solid",
      at: () => this.#view.pixel(this.#dot),
      begin: () => this.#take(false),
      move: (pixel) => {
        this.#isHandled = true;
        const [x, y] = this.#view.point(pixel);
        this.#dot = [clamp(x, 0.02, extent[0] - 0.02), clamp(y, 0.02, extent[1] - 0.02)];
        this.#report();
      },
      describe: () => `at ${digits(this.#dot[0], 2)}, ${digits(this.#dot[1], 2)}`,
    };
  }

  #take(isAxis: boolean): void {
    this.#motion.stop();
    this.#player.pause();
    this.#isFieldShown = isAxis && this.isField;
  }

  #fill(): void {
    if (!this.#engine) return;
    const filled = fillField(this.#engine, outline, this.#tensors);
    this.#notice.textContent = filled.success ? "" : filled.message;
    if (!filled.success) return;
    const film = filmOf(filled);
    this.#film = film;
    this.#triangles = film.triangles.map(
      ({ corners }) => corners.map((corner) => film.nodes[corner] ?? [0, 0]) as unknown as Triangle,
    );
    this.#player.setFilm(film);
  }

  /** Number of triangles of the same size in all directions. */
  #countEven(): number {
    const size = this.#values?.number("size") ?? 0;
    if (this.#even.size !== size && this.#engine) {
      const even = new TensorField([{ at: [0, 0], size, stretching: 1, angle: 0 }], extent);
      const filled = fillField(this.#engine, outline, even);
      this.#even = { size, triangles: filled.success ? filled.mesh.triangles.length / 3 : 0 };
    }
    return this.#even.triangles;
  }

  #report(): void {
    const film = this.#film;
    if (!film) return;
    const triangles = this.#triangles;
    const inside = triangles.findIndex((triangle) => contains(triangle, this.#dot));
    this.#chosen = inside >= 0 ? inside : nearestTo(this.#dot, triangles);
    const chosen = triangles[this.#chosen];
    const tensor = this.#tensor;
    const { size, stretching } = ellipseOf(tensor);
    const [aspect, shape] = chosen ? [aspectOf(chosen), shapeOf(within(tensor, chosen))] : [0, 0];
    const fieldOf = this.#tensors;
    const meanOf = (measure: (triangle: Triangle) => number): number =>
      triangles.reduce((sum, triangle) => sum + measure(triangle), 0) / Math.max(1, triangles.length);
    const meanShape = meanOf((each) => shapeOf(within(fieldOf.tensorAt(centroidOf(each)), each)));
    const meanAspect = meanOf(aspectOf);
    const all = this.#ellipses.map((each) => each.stretching);
    this.#values?.put({
      triangles: triangles.length,
      step: this.#player.finished,
      steps: film.stepCount,
      beat: this.#player.beat,
      aspect,
      shape,
      meanaspect: meanAspect,
      meanshape: meanShape,
      local: stretching,
      localsize: size,
      x: this.#dot[0],
      y: this.#dot[1],
      handled: this.#isHandled,
      ...(this.isField
        ? { least: Math.min(...all), most: Math.max(...all) }
        : { even: this.#countEven(), along: size * stretching, xx: tensor[0], xy: tensor[1], yy: tensor[2] }),
    });
    const strong = (text: string): HTMLElement => element("b", { class: "active" }, text);
    this.#aspect.replaceChildren(strong(digits(aspect, 1)), " times as long as wide");
    this.#shape.replaceChildren("shape ", strong(digits(shape, 2)), " of 1");
    const count = element("b", {}, String(triangles.length));
    this.#status.replaceChildren(
      count,
      ` triangles, on average ${digits(meanAspect, 1)} times as long as wide; in the tensor’s space, their shape is ${digits(meanShape, 2)}`,
    );
    this.mark(this.#lit);
  }

  #drawnWith(film: FrontFilm): Drawn {
    const { step, beat, finished } = this.#player;
    const isBorn = (film.triangles[this.#chosen]?.born ?? Infinity) <= Math.max(step, finished);
    const lit = this.#lit;
    return {
      front: {
        film,
        loops: [outline],
        step,
        beat,
        lit: lit === "front" || lit === "ideal" ? lit : null,
      },
      triangle: isBorn ? (this.#triangles[this.#chosen] ?? null) : null,
      dot: this.#dot,
      tensor: this.#tensor,
      lit,
    };
  }

  #drawHere(): void {
    const film = this.#film;
    if (!film) return;
    const c = colours();
    const pen = new Pen(this.#here.context);
    const at = (point: PlanePoint): Pixel => this.#view.pixel(point);
    if (this.isField) drawHill(this.#here, this.#view);
    drawSide(this.#here, at, this.#drawnWith(film));
    if (this.isField) drawWind(pen, at, this.#tensors);
    if (this.isField)
      drawGrid(
        pen,
        this.#ellipses.map((ellipse) => at(ellipse.at)),
      );
    if (this.isField && (this.#isFieldShown || this.#lit === "field"))
      drawField(this.#here, at, this.#tensors);
    for (const ellipse of this.#ellipses) {
      const middle = at(ellipse.at);
      if (this.isField)
        pen.polygon(ellipseAround(ellipse.at, tensorOf(ellipse)).map(at), c.plate, 0.72, {
          colour: c.ink,
          width: 2,
        });
      const colour = this.isField ? c.ink : c.active;
      pen.line(middle, this.#tipOf(ellipse, true, this.#gap), colour, 2.25);
      pen.line(middle, this.#tipOf(ellipse, false, this.#gap), colour, 1.5);
    }
    this.#here.element.classList.toggle("playing", this.#player.isPlaying);
    if (this.isField || this.#player.isPlaying) return;
    const [ellipse] = this.#ellipses;
    if (!ellipse) return;
    // Labels are wider than high.
    const label = (isLong: boolean, text: string): void => {
      const [x, y] = this.#tipOf(ellipse, isLong, this.#gap);
      const [dx, dy] = [x - at(ellipse.at)[0], y - at(ellipse.at)[1]];
      const length = Math.hypot(dx, dy);
      const look = "active plate";
      this.#here.label(text, [x, y], { dx: (34 * dx) / length, dy: (23 * dy) / length, look });
    };
    label(true, digits(ellipse.size * ellipse.stretching, 2));
    label(false, digits(ellipse.size, 2));
  }

  #drawThere(): void {
    const film = this.#film;
    if (!film) return;
    const c = colours();
    const drawn = this.#drawnWith(film);
    const { tensor, dot } = drawn;
    const stage = this.#there;
    const pen = new Pen(stage.context);
    const [width, height] = [stage.width, stage.height];
    const centre = intoSpaceOf(tensor, dot);
    if (this.isField) {
      const radius = Math.min(width, height) / 2 - 2;
      const scale = radius / windowRadius;
      const at = (point: PlanePoint): Pixel => {
        const [u, v] = intoSpaceOf(tensor, point);
        return [width / 2 + (u - centre[0]) * scale, height / 2 - (v - centre[1]) * scale];
      };
      stage.context.save();
      pen.circle([width / 2, height / 2], radius, c.ground);
      stage.context.clip();
      drawSide(stage, at, drawn);
      fadeOut(stage, radius);
      stage.context.restore();
      pen.circle([width / 2, height / 2], radius, null, { stroke: c.rule, width: 1.5 });
      this.#drawUnit(pen, [width / 2, height / 2], scale);
      return;
    }
    const corners = outline.map((point) => intoSpaceOf(tensor, point));
    const [us, vs] = [corners.map(([u]) => u), corners.map(([, v]) => v)];
    const [left, right, low, high] = [Math.min(...us), Math.max(...us), Math.min(...vs), Math.max(...vs)];
    const scale = Math.min((width - 12) / (right - left), (height - 12) / (high - low));
    const at = (point: PlanePoint): Pixel => {
      const [u, v] = intoSpaceOf(tensor, point);
      return [width / 2 + (u - (left + right) / 2) * scale, height / 2 - (v - (low + high) / 2) * scale];
    };
    drawSide(stage, at, drawn);
    this.#drawUnit(pen, at(dot), scale);
  }

  /** The middle of the circle, and its radius, which is 1. */
  #drawUnit(pen: Pen, middle: Pixel, scale: number): void {
    const c = colours();
    const end: Pixel = [middle[0] + scale * 0.8, middle[1] - scale * 0.6];
    pen.line(middle, end, c.active, 2.25);
    pen.circle(middle, 4.5, c.active);
    if (!this.#player.isPlaying && scale > 15)
      this.#there.label("1", between(middle, end, 1), { dx: 9, dy: -8, look: "active plate" });
  }
}

const within = (tensor: Tensor, triangle: Triangle): Triangle =>
  triangle.map((point) => intoSpaceOf(tensor, point)) as unknown as Triangle;

function nearestTo([x, y]: PlanePoint, triangles: readonly Triangle[]): number {
  const distances = triangles.map((triangle) => {
    const [u, v] = centroidOf(triangle);
    return Math.hypot(u - x, v - y);
  });
  return Math.max(0, distances.indexOf(Math.min(...distances)));
}

/** Returns the first step that makes a new node after a third of the film: far from the corners. */
function newNodeIn(film: FrontFilm): number {
  for (let k = Math.floor(film.stepCount / 3); k < film.stepCount; k++)
    if (film.stepAt(k)?.candidates.some(({ isNew, refusal }) => isNew && refusal === null)) return k;
  return 0;
}

/** Returns an ellipse with another long or short axis; the length of the other axis stays, and the long one stays the longer one. */
function withAxis(
  { size, stretching }: Omit<Ellipse, "at">,
  length: number,
  angle: number,
  isLong: boolean,
): Omit<Ellipse, "at"> {
  const { min, max } = limits.size;
  const across = isLong ? size : clamp(length, min, max);
  const along = clamp(
    isLong ? length : size * stretching,
    across,
    Math.min(limits.along, maxStretching * across),
  );
  // A direction and its opposite are the same.
  const folded = ((((angle + 90) % 180) + 180) % 180) - 90;
  return { size: across, stretching: along / across, angle: folded };
}

/** The tensors, and not the directions, change evenly. */
function betweenEllipses(from: Ellipse, to: Ellipse, t: number): Ellipse {
  const [a, b] = [tensorOf(from), tensorOf(to)];
  const tensor = a.map((each, i) => each + ((b[i] ?? each) - each) * t) as unknown as Tensor;
  return { at: to.at, ...(t < 1 ? ellipseOf(tensor) : to) };
}
