/** One plate: its head with the error, the mesh in the colours of stress with handles, and the gauge. */
import { colours, css, onTheme } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import { Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import { highestStress, type Hole } from "./exact-plate";
import { plate } from "./plate-mesh";
import type { SolvedPlate } from "./solve-plate";
import { Gauge, stressColours } from "./stress-scale";
import { forceLines, TruthPicture } from "./truth-picture";

export interface ShownPlate {
  readonly hole: Hole;
  readonly solved: SolvedPlate;
  /** x from which on the truth is shown; null for the mesh alone. */
  readonly curtain: number | null;
  readonly lit: string | null;
}

/** Room around the plate, for the arrows. */
const frame = [-plate[0] - 0.11, -plate[1] - 0.03, plate[0] + 0.11, plate[1] + 0.03] as const;
/** Pixels from the edge of the hole to the handles of its width and height. */
const handleDistance = 13;
const forceLineCount = 22;
/** Width of the stage in pixels below which labels stand nearer to their places. */
const smallStage = 420;

export class PlatePanel {
  readonly element: HTMLElement;
  readonly stage = new Stage(() => this.#draw());
  readonly view = new PlaneView(this.stage, frame);
  readonly pen = new Pen(this.stage.context);
  readonly #gauge = new Gauge();
  readonly #count = element("span", { class: "count" });
  readonly #error = element("b", {});
  readonly #picture = new TruthPicture();
  #lines: { readonly key: string; readonly lines: readonly (readonly PlanePoint[])[] } = {
    key: "",
    lines: [],
  };
  #shown: ShownPlate | null = null;

  /** @param drawMore Draws over the plate what belongs to the kind of the mesh. */
  constructor(
    title: string,
    readonly drawMore: (panel: PlatePanel) => void = () => undefined,
  ) {
    this.element = element(
      "div",
      { class: "plate-panel" },
      element("div", { class: "head" }, element("b", { class: "title" }, title), this.#count, this.#error),
      this.stage.element,
      this.#gauge.element,
    );
    onTheme(
      () => this.#shown && this.#gauge.show(this.#shown.solved.answer, highestStress(this.#shown.hole)),
    );
  }

  show(shown: ShownPlate, isBest: boolean): void {
    this.#shown = shown;
    const { mesh, answer, error } = shown.solved;
    this.#count.textContent = `${mesh.triangles.length / 3} triangles`;
    this.#error.textContent = `${digits(error, error < 9.95 ? 1 : 0)} % off`;
    this.element.toggleAttribute("data-best", isBest);
    this.#gauge.show(answer, highestStress(shown.hole));
    this.stage.requestDraw();
  }

  /** The handles of the hole: its middle, its width and its height. */
  holeHandles(hole: () => Hole, change: (hole: Hole) => void, begin: () => void): readonly HandleOptions[] {
    const at = ([x, y]: PlanePoint, [dx, dy]: Pixel): Pixel => {
      const [px, py] = this.view.pixel([hole().at[0] + x, hole().at[1] + y]);
      return [px + dx, py + dy];
    };
    const to = ([px, py]: Pixel, [dx, dy]: Pixel): PlanePoint => {
      const [x, y] = this.view.point([px - dx, py - dy]);
      return [x - hole().at[0], y - hole().at[1]];
    };
    const [right, up] = [[handleDistance, 0] as const, [0, -handleDistance] as const];
    return [
      {
        name: "hole",
        label: "Hole",
        look: "active",
        at: () => at([0, 0], [0, 0]),
        begin,
        move: (pixel) => change({ ...hole(), at: this.view.point(pixel) }),
        describe: () => `${digits(hole().at[0], 2)}, ${digits(hole().at[1], 2)}`,
      },
      {
        name: "wide",
        label: "Width of the hole",
        look: "active small",
        at: () => at([hole().a, 0], right),
        begin,
        move: (pixel) => change({ ...hole(), a: to(pixel, right)[0] }),
        describe: () => digits(2 * hole().a, 2),
      },
      {
        name: "high",
        label: "Height of the hole",
        look: "active small",
        at: () => at([0, hole().b], up),
        begin,
        move: (pixel) => change({ ...hole(), b: to(pixel, up)[1] }),
        describe: () => digits(2 * hole().b, 2),
      },
    ];
  }

  get shown(): ShownPlate | null {
    return this.#shown;
  }

  #draw(): void {
    const shown = this.#shown;
    if (!shown) return;
    const { context } = this.stage;
    const colour = stressColours(highestStress(shown.hole));
    this.#drawPull(shown.lit === "pull");
    if (shown.curtain === null) this.#drawMesh(shown, colour);
    else {
      const [left, top] = this.view.pixel([-plate[0], plate[1]]);
      const [right, bottom] = this.view.pixel([plate[0], -plate[1]]);
      const [x] = this.view.pixel([shown.curtain, 0]);
      context.save();
      context.beginPath();
      context.rect(left - 2, top - 2, x - left + 2, bottom - top + 4);
      context.clip();
      this.#drawMesh(shown, colour);
      context.restore();
      context.save();
      context.beginPath();
      context.rect(x, top, right - x, bottom - top);
      context.clip();
      this.#drawTruth(shown, colour);
      context.restore();
      const outline = { colour: colours().edge, width: 1 };
      this.pen.polygon(
        [
          [x, top],
          [right, top],
          [right, bottom],
          [x, bottom],
        ],
        null,
        1,
        outline,
      );
      this.#drawCurtain(shown, x, [top, bottom]);
    }
    if (shown.lit === "hole") this.#drawRim(shown.hole);
    this.drawMore(this);
    this.#drawPeak(shown);
  }

  #drawMesh(
    { solved, lit }: ShownPlate,
    colour: (stress: number) => readonly [number, number, number],
  ): void {
    const { context } = this.stage;
    const { points, triangles } = solved.mesh;
    const pixels = Array.from({ length: points.length / 2 }, (_none, node) =>
      this.view.pixel([points[2 * node] ?? 0, points[2 * node + 1] ?? 0]),
    );
    const count = triangles.length / 3;
    const cornersOf = (triangle: number): readonly Pixel[] =>
      [0, 1, 2].map((i) => pixels[triangles[3 * triangle + i] ?? 0] ?? [0, 0]);
    context.lineWidth = 1;
    for (let triangle = 0; triangle < count; triangle++) {
      this.pen.path(cornersOf(triangle));
      context.fillStyle = context.strokeStyle = css(colour(solved.stresses[triangle] ?? 0));
      context.fill();
      // Over the seam to the next triangle.
      context.stroke();
    }
    context.beginPath();
    for (let triangle = 0; triangle < count; triangle++) this.pen.path(cornersOf(triangle), false);
    const isLit = lit === "mesh";
    const isFine = count > 1200;
    context.strokeStyle = css(colours().ink, isLit ? 0.75 : isFine ? 0.22 : 0.34);
    context.lineWidth = isLit ? 1.1 : isFine ? 0.5 : 0.8;
    context.stroke();
    this.pen.polygon(cornersOf(solved.peak), null, 1, {
      colour: colours().ink,
      width: lit === "peak" ? 4 : 2.25,
    });
  }

  #drawTruth({ hole, lit }: ShownPlate, colour: (stress: number) => readonly [number, number, number]): void {
    const { context } = this.stage;
    const [x, y] = this.view.pixel(hole.at);
    const { scale } = this.view;
    context.save();
    context.beginPath();
    context.rect(0, 0, this.stage.width, this.stage.height);
    context.ellipse(x, y, hole.a * scale, hole.b * scale, 0, 0, 2 * Math.PI);
    context.clip("evenodd");
    context.save();
    context.translate(x, y);
    context.scale(scale, scale);
    this.#picture.draw(context, hole, colour);
    context.restore();
    const key = JSON.stringify(hole);
    if (this.#lines.key !== key) this.#lines = { key, lines: forceLines(hole, forceLineCount) };
    context.strokeStyle = css(colours().ink, lit === "lines" ? 0.9 : 0.4);
    context.lineWidth = lit === "lines" ? 1.8 : 1;
    context.beginPath();
    for (const line of this.#lines.lines)
      line.forEach((point, i) =>
        i === 0 ? context.moveTo(...this.view.pixel(point)) : context.lineTo(...this.view.pixel(point)),
      );
    context.stroke();
    context.restore();
  }

  #drawCurtain({ curtain }: ShownPlate, x: number, [top, bottom]: readonly [number, number]): void {
    const { ink } = colours();
    this.pen.line([x, top - 8], [x, bottom + 8], ink, 2.25);
    if (curtain === null) return;
    if (x - this.view.pixel([-plate[0], 0])[0] > 60)
      this.stage.label("the mesh", [x, top + 16], { dx: -44, look: "plate" });
    if (this.view.pixel([plate[0], 0])[0] - x > 60)
      this.stage.label("the truth", [x, top + 16], { dx: 44, look: "plate" });
  }

  #drawPull(isLit: boolean): void {
    const c = colours();
    const colour = isLit ? c.active : c.faint;
    const size = Math.min(7, this.stage.width / 90);
    for (const side of [-1, 1])
      for (const y of [-0.4, -0.2, 0, 0.2, 0.4]) {
        const [from, to] = [
          this.view.pixel([side * (plate[0] + 0.02), y]),
          this.view.pixel([side * (plate[0] + 0.095), y]),
        ];
        this.pen.line(from, to, colour, isLit ? 3 : 1.75);
        for (const by of [-1, 1])
          this.pen.line(to, [to[0] - side * size, to[1] + by * size * 0.75], colour, isLit ? 3 : 1.75);
      }
  }

  #drawRim({ at, a, b }: Hole): void {
    const rim = Array.from({ length: 72 }, (_none, i) => {
      const angle = (Math.PI * i) / 36;
      return this.view.pixel([at[0] + a * Math.cos(angle), at[1] + b * Math.sin(angle)]);
    });
    this.pen.polygon(rim, null, 1, { colour: colours().active, width: 3.5 });
  }

  /** The triangle with the highest stress, and its value. */
  #drawPeak({ solved, hole, curtain, lit }: ShownPlate): void {
    const c = colours();
    const { points, triangles } = solved.mesh;
    const corners = [0, 1, 2].map((i): PlanePoint => {
      const node = triangles[3 * solved.peak + i] ?? 0;
      return [points[2 * node] ?? 0, points[2 * node + 1] ?? 0];
    });
    const middle: PlanePoint = [
      corners.reduce((sum, [x]) => sum + x / 3, 0),
      corners.reduce((sum, [, y]) => sum + y / 3, 0),
    ];
    const isLit = lit === "peak";
    const [x, y] = this.view.pixel(middle);
    // Only what is on this side of the line is seen of the triangle.
    const at: Pixel = [curtain === null ? x : Math.min(x, this.view.pixel([curtain, 0])[0] - 5), y];
    if (isLit) this.pen.circle(at, 20, null, { stroke: c.refused, width: 2.5 });
    const isBelow = middle[1] < hole.at[1];
    // Away from the hole, and from the handle of its height.
    const isLeft = curtain !== null || middle[0] < hole.at[0] - 1e-6;
    if (curtain === null || middle[0] < curtain + 0.05)
      this.#drawValue(digits(solved.answer, 2), at, isLeft, isBelow);
    if (curtain === null || curtain > hole.at[0] + 0.02) return;
    const tip = this.view.pixel([hole.at[0], hole.at[1] + (isBelow ? -hole.b : hole.b)]);
    this.pen.circle(tip, 5, c.plate, { stroke: c.ink, width: 2 });
    this.#drawValue(`${digits(highestStress(hole), 2)} in truth`, tip, false, isBelow);
  }

  /** A value beside a place, tied to it by a line. */
  #drawValue(text: string, [x, y]: Pixel, isLeft: boolean, isBelow: boolean): void {
    const { ink } = colours();
    const far = this.stage.width < smallStage ? 0.55 : 1;
    const [dx, dy] = [(isLeft ? -1 : 1) * 62 * far, (isBelow ? 1 : -1) * 46 * far];
    this.pen.line([x, y], [x + dx, y + dy], ink, 1.25);
    this.pen.circle([x, y], 2.5, ink);
    this.stage.label(text, [x + dx, y + dy], { look: "plate strong", dx: isLeft ? -16 : 16 });
  }
}
