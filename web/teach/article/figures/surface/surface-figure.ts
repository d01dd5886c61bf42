/** A unit square, the stretched square and the surface: the reader drags one dot in all three, and the corners of the patch. */
import { effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type PlaneFront } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { addScaled, between as betweenPositions } from "../../../../document/vectors";
import { colours, mix } from "../../kit/colours";
import { button, digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer } from "../../kit/film-player";
import { clamp, Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { FrontDrawing } from "../front/front-drawing";
import { drawNet, drawSurface, type SurfaceTriangle } from "./surface-drawing";
import { fillPatch, rulers, type FilledPatch, type Ruler } from "./surface-fill";
import { anglesOf, lossOf, startCorners, SurfaceMaps, type Corners } from "./surface-maps";

const names = ["A", "B", "C", "D"] as const;
const unitCorners: readonly PlanePoint[] = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
];
type Views = Readonly<Record<"square" | "plane", PlaneView>>;
const rulerTexts: Readonly<Record<Ruler, string>> = {
  square: "Measure in the unit square",
  plane: "Measure in the stretched square",
  space: "Measure in space",
};
const patches: Readonly<Record<string, Corners>> = {
  sail: startCorners,
  kite: [
    [-1.2, -0.35, -0.2],
    [1, -0.75, -0.22],
    [1.25, 0.75, 0.1],
    [-0.9, 0.35, 0.1],
  ],
  flat: [
    [-1.05, -0.5, 0],
    [0.75, -0.5, 0],
    [1.05, 0.5, 0],
    [-0.75, 0.5, 0],
  ],
};
const dots: Readonly<Record<string, PlanePoint>> = { a: [0.1, 0.12], edge: [0.5, 0.1], middle: [0.5, 0.5] };
/** From its middle to its corners, in space. */
const triangleRadius = 0.27;
/** Distance of the dot from the sides of the square. */
const dotMargin = 0.06;
/** Where corners may be. */
const reach: Position = [1.5, 1, 0.8];
/** Milliseconds after the last change in which the rulers that are not shown measure as well. */
const restTime = 400;
/** Distance in pixels of labels from handles. */
const labelDistance = 34;
/** Where the name of a corner may stand, around it, and places spread over a patch, which it must not cover. */
const directions = Array.from({ length: 24 }, (_none, i): Pixel => {
  const angle = (i * Math.PI) / 12;
  return [Math.cos(angle), Math.sin(angle)];
});
const sampledUnits = Array.from({ length: 289 }, (_none, i): PlanePoint => [
  (i % 17) / 16,
  Math.floor(i / 17) / 16,
]);
/** Distance of the eye from a patch that is wider than the sail. */
const wideDistance = 4.5;
/** An angle of all equilateral triangles, in degrees. */
const bestAngle = 60;
const panels = ["square", "plane", "space"] as const;
type Panel = (typeof panels)[number];

export class SurfaceFigure implements Figure {
  readonly #stages: Readonly<Record<Panel, Stage>> = {
    square: new Stage(() => this.#drawFlat("square")),
    plane: new Stage(() => this.#drawFlat("plane")),
    space: new Stage(() => this.#drawSpace()),
  };
  readonly #camera = new Camera(this.#stages.space, {
    target: [0, 0, -0.12],
    distance: 3.85,
    yaw: 0.3,
    pitch: 0.95,
  });
  readonly #player = new FilmPlayer({
    beats: ["", "", "", "", ""],
    onChange: () => this.#report(),
    describe: () => this.#status.textContent,
  });
  readonly #motion = new Motion();
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #status = element("p", { class: "status" });
  readonly #choices = element("div", {
    class: "choices rulers",
    role: "group",
    "aria-label": "Which lengths the front measures",
  });
  readonly #notes: Readonly<Record<Panel, HTMLElement>> = {
    square: element("span"),
    plane: element("span"),
    space: element("span"),
  };
  #corners: Corners = startCorners;
  #maps = new SurfaceMaps(startCorners, 1);
  #views: Views = this.#viewsOf(this.#maps);
  #dot: PlanePoint = [0.42, 0.44];
  #ruler: Ruler = "space";
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  /** The patch as each ruler fills it; of the present patch, unless the ruler is stale. */
  readonly #filled: Record<Ruler, FilledPatch | null> = { square: null, plane: null, space: null };
  readonly #stale = new Set<Ruler>();
  readonly #means = new Map<Ruler, { readonly text: HTMLElement; readonly bar: HTMLElement }>();
  #rest = 0;
  #isFront = false;
  #isHandled = false;
  #isLed = false;
  #lit: string | null = null;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    this.#isFront = values.word("show") === "front";
    this.#corners = patches[values.word("patch")] ?? startCorners;
    if (this.#corners !== startCorners) this.#camera.distance = wideDistance;
    const panel = (name: Panel, title: string): HTMLElement =>
      element(
        "div",
        { class: `twin ${name}` },
        element("div", { class: "head" }, element("b", {}, title), this.#notes[name]),
        this.#stages[name].element,
      );
    host.append(
      this.#notice,
      element(
        "div",
        { class: "triplets" },
        panel("square", "Unit square"),
        panel("plane", "Stretched square"),
        panel("space", "Surface"),
      ),
    );
    if (this.#isFront) {
      host.append(this.#player.element, this.#choices);
      for (const ruler of rulers) this.#choices.append(this.#rulerButton(ruler));
    }
    host.append(this.#status);
    if (this.#isFront) this.#engine = await loadPlaneFront();
    for (const name of panels)
      this.#stages[name].setHandles([
        ...(this.#isFront ? [] : [this.#dotHandle(name)]),
        ...(name === "space" ? names.map((_name, index) => this.#cornerHandle(index)) : []),
      ]);
    let isFirst = true;
    effect(() => {
      const bulge = values.number("bulge");
      this.#isHandled ||= !isFirst && !this.#isLed;
      isFirst = false;
      untracked(() => this.#change(this.#corners, bulge));
    });
    this.#choose("square");
    this.#fillRest();
    this.#player.seek(this.#filled.square?.film.stepCount ?? 0);
  }

  /** A ruler to choose, with the mean angle that it leads to. */
  #rulerButton(ruler: Ruler): HTMLButtonElement {
    const made = button({ "data-ruler": ruler }, "", () => {
      this.#isHandled = true;
      this.#choose(ruler);
    });
    const mean = { text: element("b"), bar: element("i") };
    this.#means.set(ruler, mean);
    made.append(
      element("span", {}, rulerTexts[ruler]),
      mean.text,
      element("span", { class: "mean" }, mean.bar),
    );
    return made;
  }

  go({ at, patch, bulge, ruler, step }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    if (bulge !== undefined) this.#values?.ask("bulge", Number(bulge));
    this.#isLed = false;
    const chosen = rulers.find((each) => each === ruler);
    if (chosen) this.#choose(chosen);
    const film = this.#filled[this.#ruler]?.film;
    if (step !== undefined && film)
      this.#player.glideTo(
        { middle: Math.round(film.stepCount * 0.6), end: film.stepCount }[step] ?? Number(step),
        0,
      );
    const [from, dot] = [this.#corners, this.#dot];
    const [to, toDot] = [patches[patch ?? ""] ?? from, dots[at ?? ""] ?? dot];
    if (to === from && toDot === dot) return this.#report();
    this.#motion.run(600, (t) => {
      this.#dot = [dot[0] + (toDot[0] - dot[0]) * t, dot[1] + (toDot[1] - dot[1]) * t];
      const corners = from.map((each, i) => betweenPositions(each, to[i] ?? each, t)) as unknown as Corners;
      this.#change(corners, this.#values?.number("bulge") ?? 1);
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#requestDraw();
  }

  #requestDraw(): void {
    for (const name of panels) this.#stages[name].requestDraw();
  }

  #dotHandle(name: Panel): HandleOptions {
    return {
      name: `dot-${name}`,
      label: `Dot, ${{ square: "unit square", plane: "stretched square", space: "surface" }[name]}`,
      look: "active solid",
      at: () => this.#at(name, this.#dot),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const [xi, eta] = this.#unitOf(name, pixel);
        this.#isHandled = true;
        this.#dot = [clamp(xi, dotMargin, 1 - dotMargin), clamp(eta, dotMargin, 1 - dotMargin)];
        this.#report();
      },
      describe: () => `at ${digits(this.#dot[0], 2)}, ${digits(this.#dot[1], 2)}`,
    };
  }

  #cornerHandle(index: number): HandleOptions {
    const corner = (): Position => this.#corners[index] ?? [0, 0, 0];
    return {
      name: `corner-${names[index] ?? ""}`,
      label: `Corner ${names[index] ?? ""} of the surface`,
      at: () => this.#camera.pixel(corner()),
      begin: () => {
        this.#motion.stop();
        this.#player.pause();
      },
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, corner(), this.#camera.axes[2]);
        if (!hit) return;
        this.#isHandled = true;
        const to = hit.map((x, i) => clamp(x, -(reach[i] ?? 1), reach[i] ?? 1)) as unknown as Position;
        this.#change(this.#corners.with(index, to) as unknown as Corners, this.#values?.number("bulge") ?? 1);
      },
      end: () => {
        this.#notice.textContent = "";
        this.#fillRest();
      },
    };
  }

  /** A patch that folds over has no plane: the corners stay, and the figure says why. */
  #change(corners: Corners, bulge: number): void {
    const maps = new SurfaceMaps(corners, bulge);
    this.#notice.textContent = maps.isSound ? "" : "The surface would fold over, or become too narrow.";
    if (!maps.isSound) return;
    this.#corners = corners;
    this.#maps = maps;
    this.#views = this.#viewsOf(maps);
    for (const ruler of rulers) this.#stale.add(ruler);
    this.#setFilm();
    clearTimeout(this.#rest);
    if (this.#isFront) this.#rest = window.setTimeout(() => this.#fillNext(), restTime);
  }

  #choose(ruler: Ruler): void {
    this.#ruler = ruler;
    for (const node of this.#choices.children)
      node.setAttribute("aria-pressed", String((node as HTMLElement).dataset["ruler"] === ruler));
    this.#setFilm();
  }

  /** Fills the patch by a ruler, unless it is known already. */
  #fill(ruler: Ruler): void {
    if (!this.#engine || !this.#stale.delete(ruler)) return;
    this.#filled[ruler] = fillPatch(this.#engine, this.#maps, ruler);
  }

  /** Fills by one more ruler that is not shown, and soon by the next: a drag that goes on waits for one of them at most. */
  #fillNext(): void {
    const [ruler] = this.#stale;
    if (ruler === undefined) return;
    this.#fill(ruler);
    this.#report();
    this.#rest = window.setTimeout(() => this.#fillNext(), restTime);
  }

  /** Fills by all rulers that are not shown, too. */
  #fillRest(): void {
    clearTimeout(this.#rest);
    if (!this.#isFront || this.#stale.size === 0) return;
    for (const ruler of rulers) this.#fill(ruler);
    this.#report();
  }

  #setFilm(): void {
    this.#fill(this.#ruler);
    const film = this.#filled[this.#ruler]?.film;
    if (film) this.#player.setFilm(film);
    else this.#report();
  }

  #triangleIn(name: Panel): readonly (PlanePoint | Position)[] {
    return this.#maps.evenTriangle(this.#dot, triangleRadius).map((corner) => {
      const step: PlanePoint = [corner[0] - this.#dot[0], corner[1] - this.#dot[1]];
      if (name === "square") return step;
      if (name === "plane") return this.#maps.stepToPlane(this.#dot, step);
      const { alongXi, alongEta } = this.#maps.pointAt(this.#dot);
      return addScaled(addScaled([0, 0, 0], alongXi, step[0]), alongEta, step[1]);
    });
  }

  #report(): void {
    const { xB, xC, xD, yD } = this.#maps;
    const [x, y] = this.#maps.toPlane(this.#dot);
    const angles = {
      square: anglesOf(this.#triangleIn("square")),
      plane: anglesOf(this.#triangleIn("plane")),
    };
    const filled = this.#filled[this.#ruler];
    this.#values?.put({
      lostsquare: lossOf(angles.square),
      lostplane: lossOf(angles.plane),
      xi: this.#dot[0],
      eta: this.#dot[1],
      x,
      y,
      xb: xB,
      xc: xC,
      xd: xD,
      yd: yD,
      triangles: filled?.film.triangles.length ?? 0,
      angle: filled?.worst.angle ?? 0,
      square: this.#filled.square?.means.space ?? 0,
      plane: this.#filled.plane?.means.space ?? 0,
      space: this.#filled.space?.means.space ?? 0,
      ruler: this.#ruler,
      bysquare: this.#ruler === "square",
      handled: this.#isHandled,
      step: this.#player.finished,
      steps: filled?.film.stepCount ?? 0,
    });
    if (this.#isFront) this.#reportFront();
    else this.#reportDot(angles);
    this.#requestDraw();
  }

  #reportDot(angles: Readonly<Record<"square" | "plane", readonly number[]>>): void {
    for (const name of ["square", "plane"] as const)
      this.#notes[name].replaceChildren(
        element("b", { class: "active" }, `${digits(lossOf(angles[name]), 0)}°`),
        " lost",
      );
    this.#notes.space.replaceChildren("three angles of ", element("b", { class: "active" }, "60°"));
  }

  #reportFront(): void {
    const filled = this.#filled[this.#ruler];
    const strong = (text: string, look = ""): HTMLElement => element("b", { class: look }, text);
    if (!filled) return this.#status.replaceChildren("The front cannot fill this patch.");
    this.#status.replaceChildren(
      "The bars show the smallest angle of a triangle on the surface, on average: 60° would be perfect. ",
      strong(String(filled.film.triangles.length)),
      " triangles; the worst has ",
      strong(`${digits(filled.worst.angle, 0)}°`, "refused"),
      ".",
    );
    for (const name of panels)
      this.#notes[name].replaceChildren(strong(`${digits(filled.means[name], 0)}°`, "active"), " on average");
    for (const [ruler, { text, bar }] of this.#means) {
      const mean = this.#filled[ruler]?.means.space ?? 0;
      text.textContent = `${digits(mean, 0)}°`;
      bar.style.width = `${(100 * mean) / bestAngle}%`;
    }
  }

  #viewsOf({ plane }: SurfaceMaps): Views {
    const [xs, ys] = [plane.map(([x]) => x), plane.map(([, y]) => y)];
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const margin = 0.1 * Math.max(right - left, high - low);
    return {
      square: new PlaneView(this.#stages.square, [-0.12, -0.12, 1.12, 1.12]),
      plane: new PlaneView(this.#stages.plane, [left - margin, low - margin, right + margin, high + margin]),
    };
  }

  /** Returns the pixel of a point of the unit square in a panel. */
  #at(name: Panel, unit: PlanePoint): Pixel {
    if (name === "space") return this.#camera.pixel(this.#maps.pointAt(unit).position);
    return this.#views[name].pixel(name === "square" ? unit : this.#maps.toPlane(unit));
  }

  /** Returns the point of the unit square at a pixel; on the surface the nearest one. */
  #unitOf(name: Panel, pixel: Pixel): PlanePoint {
    if (name === "square") return this.#views.square.point(pixel);
    if (name === "plane") return this.#maps.toUnit(this.#views.plane.point(pixel));
    let [best, spacing] = [this.#dot, 0.1];
    const away = (unit: PlanePoint): number => {
      const [x, y] = this.#at("space", unit);
      return Math.hypot(x - pixel[0], y - pixel[1]);
    };
    while (spacing > 1e-4) {
      const [xi, eta] = best;
      const around = [-1, 0, 1].flatMap((i) =>
        [-1, 0, 1].map((j): PlanePoint => [clamp(xi + i * spacing, 0, 1), clamp(eta + j * spacing, 0, 1)]),
      );
      const next = around.reduce((nearest, unit) => (away(unit) < away(nearest) ? unit : nearest), best);
      if (next === best) spacing /= 2;
      best = next;
    }
    return best;
  }

  #drawFlat(name: "square" | "plane"): void {
    const stage = this.#stages[name];
    const pen = new Pen(stage.context);
    const filled = this.#filled[this.#ruler];
    if (this.#isFront) {
      if (filled) {
        const { film, unit } = filled;
        const corners = this.#ruler === "square" ? unitCorners : this.#maps.plane;
        const pixels = unit.map((node) => this.#at(name, node));
        const pixelOf = new Map<PlanePoint, Pixel>(film.nodes.map((node, i) => [node, pixels[i] ?? [0, 0]]));
        corners.forEach((corner, i) => pixelOf.set(corner, this.#at(name, unitCorners[i] ?? corner)));
        const at = (node: PlanePoint): Pixel => pixelOf.get(node) ?? [0, 0];
        const drawing = new FrontDrawing(pen, at, 0.7);
        drawing.draw({
          film,
          loops: [corners],
          step: this.#player.step,
          beat: 0,
          lit: this.#lit === "front" ? "front" : null,
        });
        this.#drawSkewed(pen, filled, (node) => pixels[node] ?? [0, 0]);
      }
    } else {
      drawNet(pen, (unit) => this.#at(name, unit), this.#lit === "net");
      const [x, y] = this.#at(name, this.#dot);
      const { scale } = this.#views[name];
      const corners = this.#triangleIn(name).map(([dx = 0, dy = 0]): Pixel => [
        x + dx * scale,
        y - dy * scale,
      ]);
      this.#drawTriangle(stage, pen, [x, y], corners, anglesOf(this.#triangleIn(name)));
    }
    this.#nameCorners(name);
  }

  #drawSpace(): void {
    const stage = this.#stages.space;
    const pen = new Pen(stage.context);
    const filled = this.#isFront ? this.#filled[this.#ruler] : null;
    const { step } = this.#player;
    const c = colours();
    const positionOf = (node: number): Position => filled?.space[node] ?? [0, 0, 0];
    const span = Math.max(12, (filled?.film.triangles.length ?? 0) / 5);
    const isFull = filled !== null && step === filled.film.stepCount;
    const triangles = (filled?.film.triangles ?? [])
      .map((triangle, index) => ({ ...triangle, skew: skewOf(filled?.smallest[index] ?? 60) }))
      .filter(({ born }) => born <= step)
      .map(({ corners, born, skew }): SurfaceTriangle => {
        const age = isFull ? 1 : clamp(((step - born) / span) * 1.2, 0, 1);
        const fill = mix(mix(c["new-soft"], c.stone, age), c.refused, skew);
        return { corners: corners.map(positionOf), fill, edge: c.edge };
      });
    const sides = (filled?.film.sides ?? [])
      .filter(({ born, died }) => born <= step && died > step)
      .map(({ ends }) => [positionOf(ends[0]), positionOf(ends[1])] as const);
    drawSurface(stage.context, this.#camera, {
      maps: this.#maps,
      hasNet: !this.#isFront,
      isNetLit: this.#lit === "net",
      triangles,
      isCovered: isFull,
      sides,
    });
    if (filled && this.#lit === "worst")
      this.#drawWorst(pen, filled, (node) => this.#camera.pixel(positionOf(node)));
    if (!this.#isFront) {
      const middle = this.#maps.pointAt(this.#dot).position;
      const corners = this.#triangleIn("space").map(([x = 0, y = 0, z = 0]) =>
        this.#camera.pixel([middle[0] + x, middle[1] + y, middle[2] + z]),
      );
      this.#drawTriangle(stage, pen, this.#camera.pixel(middle), corners, [60, 60, 60]);
    }
    this.#nameCorners("space");
  }

  #drawTriangle(
    stage: Stage,
    pen: Pen,
    middle: Pixel,
    corners: readonly Pixel[],
    angles: readonly number[],
  ): void {
    const c = colours();
    const isLit = this.#lit === "triangle";
    pen.polygon(corners, c.plate, 0.8);
    pen.polygon(corners, c.active, isLit ? 0.5 : 0.3, { colour: c.active, width: isLit ? 5 : 3 });
    if (this.#lit === "dot") pen.circle(middle, 16, c.active, { alpha: 0.35 });
    corners.forEach(([x, y], i) => {
      const [dx, dy] = [x - middle[0], y - middle[1]];
      const length = Math.max(1, Math.hypot(dx, dy));
      const look = Math.abs((angles[i] ?? 60) - 60) > 20 ? "refused plate" : "active plate";
      const at: Pixel = [x + (22 * dx) / length, y + (15 * dy) / length];
      stage.label(`${digits(angles[i] ?? 0, 0)}°`, this.#besideHandles(stage, at), { look });
    });
  }

  /** Returns where a label stands that would cover a corner of the surface: beside it. */
  #besideHandles(stage: Stage, [x, y]: Pixel): Pixel {
    if (stage !== this.#stages.space) return [x, y];
    for (const corner of this.#corners) {
      const [u, v] = this.#camera.pixel(corner);
      const away = Math.hypot(x - u, y - v);
      if (away >= labelDistance) continue;
      const by =
        away < 1 ? [0, labelDistance] : [(x - u) * (labelDistance / away), (y - v) * (labelDistance / away)];
      return [u + (by[0] ?? 0), v + (by[1] ?? 0)];
    }
    return [x, y];
  }

  /** Triangles that are skewed on the surface are red in the planes, too. */
  #drawSkewed(pen: Pen, filled: FilledPatch, at: (node: number) => Pixel): void {
    const c = colours();
    filled.film.triangles.forEach(({ corners, born }, index) => {
      const skew = skewOf(filled.smallest[index] ?? 60);
      if (skew > 0 && born <= this.#player.step)
        pen.polygon(corners.map(at), mix(c.stone, c.refused, skew), 1, { colour: c.edge, width: 0.7 });
    });
    if (this.#lit === "worst") this.#drawWorst(pen, filled, at);
  }

  #drawWorst(pen: Pen, { film, worst }: FilledPatch, at: (node: number) => Pixel): void {
    const triangle = film.triangles[worst.triangle];
    if (!triangle || triangle.born > this.#player.step) return;
    const c = colours();
    pen.polygon(triangle.corners.map(at), c.refused, 0.6, { colour: c.refused, width: 4 });
  }

  #nameCorners(name: Panel): void {
    const look = this.#lit === "corners" ? "active" : "";
    const middle = this.#at(name, [0.5, 0.5]);
    const covered = name === "space" ? sampledUnits.map((unit) => this.#at(name, unit)) : [middle];
    const away = name === "space" ? 21 : 13;
    unitCorners.forEach((corner, i) => {
      const [x, y] = this.#at(name, corner);
      const places = directions.map(([u, v]): Pixel => [x + away * u, y + away * v]);
      const rooms = places.map(([u, v]) => Math.min(...covered.map(([p, q]) => Math.hypot(p - u, q - v))));
      const freest = places[rooms.indexOf(Math.max(...rooms))] ?? [x, y];
      this.#stages[name].label(`*${names[i] ?? ""}*`, freest, { look });
    });
  }
}

/** How red a triangle is, by its smallest angle in degrees: not at all from 42° on. */
const skewOf = (angle: number): number => 0.62 * clamp((42 - angle) / 22, 0, 1);
