/** Four points in space. The reader moves them, or flattens their square, and sees the six dihedral angles. */
import { effect, untracked } from "@preact/signals-core";
import type { Position } from "../../../../document/position";
import {
  add,
  addScaled,
  between as betweenPositions,
  cross,
  dot,
  length,
  mean,
  scale,
  subtract,
  unit,
  zero,
} from "../../../../document/vectors";
import { AngleScale } from "../../kit/angle-scale";
import { colours, type Colour } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { lit, looksTo, softShadow } from "../../kit/matte";
import { Motion } from "../../kit/motion";
import { Pen, widths } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { drawGround } from "../ideal/ground";
import {
  kindOf,
  measureFour,
  poorAngles,
  tetrahedronEdges,
  type Four,
  type FourKind,
  type FourMeasures,
} from "./sliver-rules";

/** The lift that makes the tetrahedron regular. */
const regularLift = 0.88;
/** Half the diagonal of the square. */
const half = regularLift / Math.SQRT2;
/** Height of the middle of the points above the ground. */
const height = 0.5;
const reach = 1.15;
/** Radius of the sectors that show the angles. */
const sectorRadius = 0.17;
const sectorSteps = 14;
/** Pixels between a point and the nearest label. */
const handleRoom = 32;
/** The angle of the regular tetrahedron, arccos 1/3. */
const regularAngle = 70.53;

/** The corners of a square, two opposite ones lifted and the two others lowered. */
const lifted = (lift: number): Four => [
  [half, 0, height + lift / 2],
  [-half, 0, height + lift / 2],
  [0, half, height - lift / 2],
  [0, -half, height - lift / 2],
];

/** Shapes beside the lifted square, as displacements from it; the lift is that of the shape. */
const poses: Readonly<Record<string, { readonly lift: number; readonly four: Four }>> = {
  cap: {
    lift: 0.2,
    four: [
      [0.72, 0, 0.3],
      [-0.36, 0.62, 0.3],
      [-0.36, -0.62, 0.3],
      [0.02, 0.01, 0.4],
    ],
  },
  needle: {
    lift: 0.8,
    four: [
      [0.1, 0, 0.06],
      [-0.05, 0.09, 0.06],
      [-0.05, -0.09, 0.06],
      [0.05, 0.03, 1.05],
    ],
  },
  wedge: {
    lift: 0.7,
    four: [
      [0.06, 0, 0.85],
      [-0.06, 0, 0.85],
      [0.02, 0.66, 0.2],
      [0.02, -0.66, 0.2],
    ],
  },
};

const kindTexts: Readonly<Record<FourKind, string>> = {
  good: "All six angles are good.",
  sliver: "This is a sliver.",
  cap: "This is a cap.",
  needle: "This is a needle.",
  wedge: "This is a wedge.",
  poor: "Its angles are poor.",
};

export class SliverFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0, 0, 0.46],
    distance: 2.95,
    yaw: 0.16,
    pitch: 0.5,
  });
  readonly #pen = new Pen(this.#stage.context);
  readonly #motion = new Motion();
  readonly #scale = new AngleScale(poorAngles, regularAngle, 6);
  readonly #status = element("p", { class: "status", role: "status" });
  #values: Values | null = null;
  /** What the reader has moved, or a pose, beside the lifted square. */
  #offsets: Four = [zero, zero, zero, zero];
  #four: Four = lifted(0);
  #measures: FourMeasures = measureFour(lifted(0.5));
  #lit: string | null = null;
  #isHandled = false;
  #isLed = false;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    host.append(this.#stage.element, this.#scale.element, this.#status);
    this.#stage.setHandles([0, 1, 2, 3].map((index) => this.#handle(index)));
    this.#isLed = true;
    effect(() => {
      values.number("lift");
      untracked(() => {
        if (!this.#isLed) this.#isHandled = true;
        this.#compute();
      });
    });
    this.#isLed = false;
  }

  go({ lift, pose }: Readonly<Record<string, string>>): void {
    const values = this.#values;
    if (!values) return;
    this.#isHandled = false;
    const target = pose === undefined ? undefined : poses[pose];
    const from = { lift: values.number("lift"), offsets: this.#offsets };
    const toLift = lift === undefined ? (target?.lift ?? from.lift) : Number(lift);
    const square = lifted(toLift);
    const to = square.map((corner, i) =>
      target ? subtract(target.four[i] ?? corner, corner) : zero,
    ) as unknown as Four;
    this.#motion.run(900, (t) => {
      this.#offsets = from.offsets.map((each, i) =>
        betweenPositions(each, to[i] ?? zero, t),
      ) as unknown as Four;
      this.#isLed = true;
      values.ask("lift", from.lift + (toLift - from.lift) * t);
      this.#isLed = false;
      this.#compute();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #handle(index: number): HandleOptions {
    const corner = (): Position => this.#four[index] ?? zero;
    return {
      name: `point-${index + 1}`,
      label: `Point ${index + 1}: arrow keys move it across the view`,
      look: "active solid",
      at: () => this.#camera.pixel(corner()),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, corner(), this.#camera.axes[2]);
        if (!hit || Math.hypot(hit[0], hit[1]) > reach || hit[2] < 0 || hit[2] > reach) return;
        this.#offsets = this.#offsets.map((offset, i) =>
          i === index ? add(offset, subtract(hit, corner())) : offset,
        ) as unknown as Four;
        this.#isHandled = true;
        this.#compute();
      },
      describe: () =>
        `angles from ${digits(Math.min(...this.#measures.angles), 0)} to ${digits(Math.max(...this.#measures.angles), 0)} degrees`,
    };
  }

  #compute(): void {
    const values = this.#values;
    if (!values) return;
    this.#four = lifted(values.number("lift")).map((corner, i) =>
      add(corner, this.#offsets[i] ?? zero),
    ) as unknown as Four;
    this.#measures = measureFour(this.#four);
    const { edges, angles, volume, radiusRatio } = this.#measures;
    const kind = kindOf(this.#measures);
    values.put({
      least: Math.min(...angles),
      most: Math.max(...angles),
      large: angles.filter((angle) => angle > poorAngles.max).length,
      longest: Math.max(...edges),
      shortest: Math.min(...edges),
      uneven: Math.max(...edges) / Math.min(...edges),
      volume,
      shape: radiusRatio,
      moved: this.#offsets.some((offset) => length(offset) > 0.01),
      handled: this.#isHandled,
      kind: kindTexts[kind],
    });
    this.#scale.show(angles);
    const look = kind === "good" ? {} : { class: "refused" };
    this.#status.replaceChildren(
      element("b", look, kindTexts[kind]),
      ` Angles from ${digits(Math.min(...angles), 1)}° to ${digits(Math.max(...angles), 1)}°, edges from ${digits(Math.min(...edges), 2)} to ${digits(Math.max(...edges), 2)}.`,
    );
    this.#stage.requestDraw();
  }

  #draw(): void {
    const c = colours();
    const pen = this.#pen;
    const at = (position: Position): Pixel => this.#camera.pixel(position);
    drawGround(pen, this.#camera, c.ink);
    this.#drawShadow();
    if (this.#lit === "circle") this.#drawCircle();
    const pixels = this.#four.map(at);
    this.#drawFarFaces();
    tetrahedronEdges.forEach(([a, b], edge) => {
      const isHidden = this.#isHidden(edge);
      const isLit = this.#lit === "edges";
      const [from, to] = [pixels[a], pixels[b]] as [Pixel, Pixel];
      pen.line(
        from,
        to,
        c.ink,
        isLit ? 4 : isHidden ? 1.25 : widths.front,
        isHidden && !isLit ? { dash: [4, 5] } : {},
      );
    });
    tetrahedronEdges.forEach((_ends, edge) => this.#drawAngle(edge));
  }

  /** Returns the faces, counter-clockwise as seen from outside. */
  get #faces(): readonly (readonly Position[])[] {
    const middle = mean(this.#four);
    return [0, 1, 2, 3].map((left) => {
      const corners = this.#four.filter((_corner, i) => i !== left);
      return looksTo(corners, middle) ? corners.toReversed() : corners;
    });
  }

  /** The element is open to the eye, so that the sectors inside it are seen. */
  #drawFarFaces(): void {
    const c = colours();
    for (const face of this.#faces)
      if (!looksTo(face, this.#camera.eye))
        this.#pen.polygon(
          face.map((corner) => this.#camera.pixel(corner)),
          lit(c.rock, face, this.#camera.eye),
        );
  }

  /** The points' places on the ground show how they lie in space. */
  #drawShadow(): void {
    softShadow(this.#pen, this.#camera, this.#faces);
    for (const corner of this.#four)
      this.#pen.line(
        this.#camera.pixel(corner),
        this.#camera.pixel([corner[0], corner[1], 0]),
        colours().ink,
        1,
        { alpha: 0.22, dash: [2, 4] },
      );
  }

  /** The circle through the three first points. */
  #drawCircle(): void {
    const c = colours();
    const [a, b, p] = [this.#four[0], this.#four[2], this.#four[1]];
    const [u, v] = [subtract(b, a), subtract(p, a)];
    const normal = cross(u, v);
    const size = 2 * dot(normal, normal);
    if (size < 1e-9) return;
    const toCentre = scale(
      add(scale(cross(normal, u), dot(v, v)), scale(cross(v, normal), dot(u, u))),
      1 / size,
    );
    const centre = add(a, toCentre);
    const [first, second] = [subtract(a, centre), cross(unit(normal) ?? [0, 0, 1], subtract(a, centre))];
    const circle = Array.from({ length: 96 }, (_none, i): Pixel => {
      const angle = (i * Math.PI) / 48;
      return this.#camera.pixel(
        addScaled(addScaled(centre, first, Math.cos(angle)), second, Math.sin(angle)),
      );
    });
    this.#pen.polygon(circle, c.active, 0.07, { colour: c.active, width: 2 });
  }

  /** Returns whether both faces at an edge look away from the eye. */
  #isHidden(edge: number): boolean {
    const [a, b] = tetrahedronEdges[edge] ?? [0, 1];
    const others = tetrahedronEdges[(edge + 3) % 6] ?? [2, 3];
    const middle = mean(this.#four);
    return others.every((other) => {
      const normal = cross(
        subtract(this.#four[b], this.#four[a]),
        subtract(this.#four[other], this.#four[a]),
      );
      const outward = dot(normal, subtract(this.#four[a], middle)) < 0 ? -1 : 1;
      return outward * dot(normal, subtract(this.#camera.eye, this.#four[a])) < 0;
    });
  }

  /** A sector across an edge, from one of its faces to the other. */
  #drawAngle(edge: number): void {
    const c = colours();
    const [a, b] = tetrahedronEdges[edge] ?? [0, 1];
    const [p, q] = tetrahedronEdges[(edge + 3) % 6] ?? [2, 3];
    const [from, to] = [this.#four[a], this.#four[b]];
    const axis = unit(subtract(to, from));
    if (!axis) return;
    const across = (other: Position): Position => {
      const away = subtract(other, from);
      return unit(addScaled(away, axis, -dot(away, axis))) ?? zero;
    };
    const [u, v] = [across(this.#four[p]), across(this.#four[q])];
    const angle = this.#measures.angles[edge] ?? 0;
    const turn = (angle * Math.PI) / 180;
    const w = unit(addScaled(v, u, -dot(u, v))) ?? unit(cross(axis, u)) ?? zero;
    const middle = betweenPositions(from, to, 0.5);
    const arc = Array.from({ length: sectorSteps + 1 }, (_none, i): Pixel => {
      const t = (turn * i) / sectorSteps;
      return this.#camera.pixel(
        add(middle, scale(addScaled(scale(u, Math.cos(t)), w, Math.sin(t)), sectorRadius)),
      );
    });
    const isPoor = angle < poorAngles.min || angle > poorAngles.max;
    const isLit =
      this.#lit === "angles" ||
      (this.#lit === "large" && angle > poorAngles.max) ||
      (this.#lit === "small" && angle < poorAngles.min);
    const colour: Colour = isPoor ? c.refused : c.active;
    this.#pen.polygon([this.#camera.pixel(middle), ...arc], colour, isLit ? 0.85 : 0.55, {
      colour,
      width: isLit ? 3 : 1.5,
    });
    const away = unit(subtract(middle, mean(this.#four))) ?? [0, 0, 1];
    const at = this.#besideHandles(this.#camera.pixel(addScaled(middle, away, 0.14)));
    this.#stage.label(`${digits(angle, 0)}°`, at, { look: isPoor ? "refused plate" : "active plate" });
  }

  /** Moves a label away from the points. */
  #besideHandles([x, y]: Pixel): Pixel {
    for (const corner of this.#four) {
      const [u, v] = this.#camera.pixel(corner);
      const far = Math.hypot(x - u, y - v);
      if (far >= handleRoom) continue;
      const [dx, dy] = far < 1 ? [0, -1] : [(x - u) / far, (y - v) / far];
      return [u + dx * handleRoom, v + dy * handleRoom];
    }
    return [x, y];
  }
}
