/** One face of the front and its ideal point. The reader moves the corners, the point, and the size. */
import { effect, untracked } from "@preact/signals-core";
import type { Position } from "../../../../document/position";
import { between as betweenPositions, distance, length, subtract } from "../../../../document/vectors";
import { colours, mix } from "../../kit/colours";
import { button, digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { lit as matteLit, looksTo, softShadow } from "../../kit/matte";
import { clamp, Motion } from "../../kit/motion";
import { between, Pen, widths } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { drawGround, sectorPoints } from "./ground";
import {
  doubleArea,
  idealRules,
  isPose,
  isWithin,
  placeIdealPoint,
  poses,
  type Corners,
  type IdealPoint,
  type RadiusLimit,
  type SizeLimit,
} from "./ideal-rules";

const sideNames = ["first", "second", "third"] as const;
const reach = 1.3;
const minDoubleArea = 0.12;

const sizeTexts: Readonly<Record<SizeLimit, string>> = {
  none: "",
  small: `h is held at ${idealRules.kMinSizePerBase} of the face`,
  large: `h is held at ${idealRules.kMaxSizePerBase} times the face`,
};
const radiusTexts: Readonly<Record<RadiusLimit, string>> = {
  none: "",
  low: `R counts as ${idealRules.kMaxCircumradius} h`,
  high: `R counts as ${idealRules.kMinCircumradius} h`,
};
const limitText = ({ sizeLimit, radiusLimit }: IdealPoint): string => {
  // The text stands in one line, also on a phone.
  if (sizeLimit !== "none" && radiusLimit !== "none") return `h is held, and ${radiusTexts[radiusLimit]}.`;
  const met = `${sizeTexts[sizeLimit]}${radiusTexts[radiusLimit]}`;
  return met === "" ? "No limit is met." : `${met}.`;
};

export class IdealFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, { target: [0, 0, 0.5], distance: 3.1, yaw: 0.24, pitch: 0.5 });
  readonly #pen = new Pen(this.#stage.context);
  readonly #motion = new Motion();
  #values: Values | null = null;
  #corners: Corners = poses.even;
  #point: IdealPoint = placeIdealPoint(this.#corners, 1, false);
  #isOverCentre = false;
  /** Whether the reader has made the present state, and not a word of the text. */
  #isHandled = false;
  /** The last size that was not asked for by the reader. */
  #ledSize = 0;
  #lit: string | null = null;
  #isPointHeld = false;
  readonly #choices = new Map<"mean" | "centre", HTMLButtonElement>();
  readonly #notice = element("div", { class: "notice", role: "status" });

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    this.#isOverCentre = values.word("foot") === "centre";
    const choose = (foot: "mean" | "centre", label: string): HTMLButtonElement => {
      const made = button({}, label, () => this.#setFoot(foot === "centre"));
      this.#choices.set(foot, made);
      return made;
    };
    const choices = element(
      "div",
      { class: "choices", role: "group", "aria-label": "Foot of the height" },
      choose("mean", "Over the mean"),
      choose("centre", "Over the centre"),
    );
    host.append(this.#stage.element, this.#notice, choices);
    this.#stage.setHandles([
      ...sideNames.map((_name, index) => this.#cornerHandle(index)),
      this.#pointHandle(),
    ]);
    this.#ledSize = values.number("size");
    effect(() => {
      const isAsked = values.number("size") !== this.#ledSize;
      if (isAsked) this.#isHandled = true;
      untracked(() => this.#compute());
      // A size that is dragged in the text moves the point; the reader's hand moves it within the view.
      if (isAsked && !this.#isPointHeld) this.#frame();
    });
  }

  go({ pose, foot, size }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    if (size !== undefined) {
      this.#ledSize = Number(size);
      this.#values?.ask("size", this.#ledSize);
    }
    if (foot !== undefined) this.#isOverCentre = foot === "centre";
    const target = isPose(pose) ? poses[pose] : this.#corners;
    const from = this.#corners;
    this.#motion.run(
      700,
      (t) => {
        this.#corners = [0, 1, 2].map((i) =>
          betweenPositions(from[i] as Position, target[i] as Position, t),
        ) as unknown as Corners;
        this.#compute();
      },
      () => this.#frame(),
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #setFoot(isOverCentre: boolean): void {
    this.#isHandled = true;
    this.#isOverCentre = isOverCentre;
    this.#compute();
    this.#frame();
  }

  #cornerHandle(index: number): HandleOptions {
    const corner = (): Position => this.#corners[index] as Position;
    return {
      name: `corner-${index + 1}`,
      label: `Corner ${index + 1} of the face`,
      look: "active solid",
      at: () => this.#camera.pixel(corner()),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, [0, 0, 0], [0, 0, 1]);
        if (!hit) return;
        const factor = Math.min(1, reach / length(hit));
        this.#moveCorner(index, [hit[0] * factor, hit[1] * factor, 0]);
      },
      end: () => {
        this.#notice.textContent = "";
        this.#frame();
      },
      describe: () => `new edge of ${digits(this.#point.edges[index] ?? 0, 2)}`,
    };
  }

  /** A face without area has no circle: the corner stays, and the figure says why. */
  #moveCorner(index: number, to: Position): void {
    const corners = this.#corners.map((corner, i) => (i === index ? to : corner)) as unknown as Corners;
    const isFlat = doubleArea(corners) < minDoubleArea;
    this.#notice.textContent = isFlat
      ? "The three corners would lie in one line, or change their sense."
      : "";
    if (isFlat) return;
    this.#corners = corners;
    this.#isHandled = true;
    this.#compute();
  }

  /** The point moves up and down. Its height decides the size that gives it. */
  #pointHandle(): HandleOptions {
    return {
      name: "ideal-point",
      label: "Ideal point: up and down changes the size",
      look: "new solid",
      at: () => this.#camera.pixel(this.#point.position),
      begin: () => {
        this.#motion.stop();
        this.#isPointHeld = true;
      },
      move: (pixel) => {
        const [, , towards] = this.#camera.axes;
        const hit = this.#camera.onPlane(pixel, this.#point.position, [towards[0], towards[1], 0]);
        if (hit)
          this.#values?.ask(
            "size",
            Math.hypot(Math.max(0, hit[2]), this.#point.radius) / idealRules.kEdgePerTarget,
          );
      },
      end: () => {
        this.#isPointHeld = false;
        this.#frame();
      },
      describe: () => `height ${digits(this.#point.height, 2)}`,
    };
  }

  #compute(): void {
    const values = this.#values;
    if (!values) return;
    const point = placeIdealPoint(this.#corners, values.number("size"), this.#isOverCentre);
    this.#point = point;
    const { edges, radius, used, wanted, h, height, sizeLimit, radiusLimit } = point;
    values.put({
      h,
      wanted,
      held: sizeLimit !== "none",
      radius,
      used,
      height,
      square: point.square,
      base: point.base,
      ratio: height / h,
      edge1: edges[0],
      edge2: edges[1],
      edge3: edges[2],
      uneven: Math.max(...edges) / Math.min(...edges),
      inside: isWithin(point.foot, this.#corners),
      blunt: !isWithin(point.centre, this.#corners),
      centred: this.#isOverCentre,
      low: radiusLimit === "low",
      handled: this.#isHandled,
      limit: limitText(point),
      foot: this.#isOverCentre ? "centre" : "mean",
    });
    for (const [foot, node] of this.#choices)
      node.setAttribute("aria-pressed", String((foot === "centre") === this.#isOverCentre));
    this.#stage.requestDraw();
  }

  /** Brings everything into view once the reader lets go. */
  #frame(): void {
    const { position, foot, centre, radius } = this.#point;
    const all = [...this.#corners, position, foot, ...sectorPoints(centre, 0.55 * radius)];
    const low = [0, 1, 2].map((i) => Math.min(...all.map((each) => each[i] ?? 0)));
    const high = [0, 1, 2].map((i) => Math.max(...all.map((each) => each[i] ?? 0)));
    const middle = low.map((x, i) => (x + (high[i] ?? 0)) / 2) as unknown as Position;
    const size = distance(low as unknown as Position, high as unknown as Position);
    const camera = this.#camera;
    const from = { target: camera.target, distance: camera.distance };
    this.#motion.run(600, (t) => {
      camera.target = betweenPositions(from.target, middle, t);
      camera.distance = from.distance + (clamp(1.95 * size, 3.1, 8) - from.distance) * t;
      this.#stage.requestDraw();
    });
  }

  #draw(): void {
    const c = colours();
    const pen = this.#pen;
    const at = (position: Position): Pixel => this.#camera.pixel(position);
    const { position, foot, centre, radius } = this.#point;
    const corners = this.#corners.map(at);
    const [apex, base] = [at(position), at(foot)];
    const lit = (part: string): boolean => this.#lit === part;
    drawGround(pen, this.#camera, c.ink);
    const sides = this.#corners.map((corner, i) => [
      corner,
      this.#corners[(i + 1) % 3] as Position,
      position,
    ]);
    softShadow(pen, this.#camera, [this.#corners, ...sides]);
    const circle = sectorPoints(centre, radius).map(at);
    pen.polygon(circle, c.active, lit("circle") ? 0.12 : 0.03, {
      colour: lit("circle") ? c.active : c.faint,
      width: lit("circle") ? 2.5 : 1.25,
    });
    pen.polygon(corners, mix(c.plate, c.active, lit("face") ? 0.6 : 0.32));
    this.#drawFarFaces(sides);
    corners.forEach((corner, i) =>
      pen.line(corner, corners[(i + 1) % 3] as Pixel, c.active, lit("face") ? widths.active : 3.5),
    );
    this.#drawRightTriangle(base, apex);
    this.#drawNewEdges(corners, apex);
    if (this.#isOverCentre || lit("foot"))
      pen.circle(at(this.#point.mean), 4, c.ground, { stroke: c.soft, width: 2 });
    pen.circle(base, lit("foot") ? 8 : 4.5, c.ink);
    if (lit("ideal")) pen.circle(apex, 16, c.new, { alpha: 0.3 });
    this.#stage.label("ideal point", apex, { dy: -24 });
  }

  /** The element is open to the eye: only the faces behind the right triangle are filled. */
  #drawFarFaces(sides: readonly (readonly Position[])[]): void {
    const c = colours();
    for (const side of sides)
      if (!looksTo(side, this.#camera.eye))
        this.#pen.polygon(
          side.map((corner) => this.#camera.pixel(corner)),
          matteLit(mix(c.rock, c.plate, 0.25), side, this.#camera.eye),
        );
  }

  /** Edges behind two faces that look away are thin and dashed. */
  #drawNewEdges(corners: readonly Pixel[], apex: Pixel): void {
    const c = colours();
    const looksAway = corners.map((corner, i) => {
      const next = corners[(i + 1) % 3] as Pixel;
      return (
        (next[0] - corner[0]) * (apex[1] - corner[1]) - (next[1] - corner[1]) * (apex[0] - corner[0]) > 0
      );
    });
    corners.forEach((corner, i) => {
      const isHidden = looksAway[i] === true && looksAway[(i + 2) % 3] === true;
      const isLit = this.#lit === "edges";
      this.#pen.line(
        corner,
        apex,
        isLit ? c.new : c.ink,
        isLit ? widths.active : isHidden ? 1.25 : widths.front,
        isHidden ? { dash: [4, 5] } : {},
      );
    });
  }

  /** The leg R points to the corner that shows it best. */
  #drawRightTriangle(base: Pixel, apex: Pixel): void {
    const c = colours();
    const pen = this.#pen;
    const { foot, radius, used, h, height, square } = this.#point;
    const [, , view] = this.#camera.axes;
    const sideways = this.#corners.map((corner) => {
      const to = subtract(corner, foot);
      return Math.abs((to[0] * view[0] + to[1] * view[1]) / (Math.hypot(to[0], to[1]) || 1));
    });
    const shown = sideways.indexOf(Math.min(...sideways));
    const to = this.#corners[shown] as Position;
    const end3 = betweenPositions(foot, to, radius / (distance(foot, to) || 1));
    const end = this.#camera.pixel(end3);
    const lit = (part: string): boolean => this.#lit === part;
    // If a limit of R is met, its leg has not the length that the height is made from, and h is no slope.
    const isRight = Math.abs(Math.sqrt(Math.max(0, square)) - height) < 1e-9;
    pen.polygon([base, end, apex], mix(c.new, c.plate, 0.5), isRight ? 0.92 : 0.5);
    pen.line(base, end, c.active, lit("radius") ? 7 : 4);
    pen.line(end, apex, c.ink, lit("slope") ? 7 : 4, isRight ? {} : { dash: [7, 7] });
    pen.line(base, apex, c.new, lit("height") ? 8 : widths.active);
    const isRightward = end[0] > base[0];
    this.#rightAngle(base, end, apex);
    this.#stage.label(`*R* = ${digits(radius, 2)}`, between(base, end, 0.62), {
      look: "active plate",
      dy: 20,
    });
    if (isRight)
      this.#stage.label(`*h* = ${digits(h, 2)}`, between(end, apex, 0.5), {
        dx: isRightward ? 52 : -52,
      });
    else
      this.#stage.label(
        `counts as ${digits(used / h, 2)} *h* = ${digits(used, 2)}`,
        between(base, end, 0.62),
        {
          dy: 42,
          look: "soft plate",
        },
      );
    // Inside the right triangle, where no edge passes.
    this.#stage.label(digits(height, 2), between(base, apex, 0.3), {
      look: "on-new",
      dx: isRightward ? 26 : -26,
    });
    this.#labelEdges(shown, apex);
  }

  /** The lengths of the new edges, beside them and above the face; only one of them if all are alike. `shown` has *h* at its edge. */
  #labelEdges(shown: number, apex: Pixel): void {
    const { edges, position } = this.#point;
    const pixels = this.#corners.map((corner) => this.#camera.pixel(corner));
    const isEven = Math.max(...edges) / Math.min(...edges) < 1.01;
    const xs = pixels.map(([x]) => x);
    const leftmost = xs.indexOf(Math.min(...xs.map((x, i) => (i === shown ? Infinity : x))));
    this.#corners.forEach((corner, i) => {
      if (isEven && i !== leftmost) return;
      const x = xs[i] ?? 0;
      // An edge at the border of the picture has its label outside; one in the middle has it higher up, on itself.
      const side = x === Math.min(...xs) ? -1 : x === Math.max(...xs) ? 1 : 0;
      const up = side === 0 ? 0.62 : i === shown ? 0.24 : 0.46;
      const pixel = this.#camera.pixel(betweenPositions(corner, position, up));
      const dx = side === 0 ? (x > apex[0] ? 6 : -6) : side * 30;
      this.#stage.label(digits(edges[i] ?? 0, 2), pixel, { look: "soft plate", dx });
    });
  }

  #rightAngle(base: Pixel, end: Pixel, apex: Pixel): void {
    const unit = (to: Pixel): Pixel => {
      const size = Math.hypot(to[0] - base[0], to[1] - base[1]) || 1;
      const by = Math.min(12, size / 3) / size;
      return [(to[0] - base[0]) * by, (to[1] - base[1]) * by];
    };
    const [u, v] = [unit(end), unit(apex)];
    const corner: Pixel = [base[0] + u[0] + v[0], base[1] + u[1] + v[1]];
    this.#pen.line([base[0] + u[0], base[1] + u[1]], corner, colours().ink, 1.25);
    this.#pen.line([base[0] + v[0], base[1] + v[1]], corner, colours().ink, 1.25);
  }
}
