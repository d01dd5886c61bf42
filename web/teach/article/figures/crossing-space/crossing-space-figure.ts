/** Two triangles in space whose corners move; the chosen pair of a side and a face is drawn as the path of equation (1). */
import { effect } from "@preact/signals-core";
import type { Position } from "../../../../document/position";
import { addScaled, between as betweenPositions, length, subtract } from "../../../../document/vectors";
import type { Triangle } from "../../../player/crossing";
import { ValueBar } from "../../kit/bars";
import { colours, mix, type ColourName } from "../../kit/colours";
import { button, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { lit, softShadow } from "../../kit/matte";
import { Motion } from "../../kit/motion";
import { between, Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { LayerCard } from "../crossing/layer-cards";
import { drawGround } from "../ideal/ground";
import { isStoppedByFourth, pairsOf, type SpacePair } from "./pairs";
import { paintedPieces } from "./painted-pieces";
import { decidingLayer } from "./space-layers";

interface Faces {
  readonly front: Triangle;
  readonly added: Triangle;
}

const front: Triangle = [
  [-0.9, -0.45, 0.05],
  [0.85, -0.5, 0],
  [0.1, 0.95, 0.05],
];
const poses: Readonly<Record<string, Faces>> = {
  through: {
    front,
    added: [
      [-0.3, 0, 0.75],
      [0.35, -0.12, -0.55],
      [0.75, 0.35, 0.7],
    ],
  },
  above: {
    front,
    added: [
      [-0.3, 0, 0.85],
      [0.3, -0.12, 0.22],
      [0.75, 0.35, 0.8],
    ],
  },
  beside: {
    front,
    added: [
      [1, -0.1, 0.75],
      [1.15, -0.3, -0.5],
      [1.5, 0.2, 0.4],
    ],
  },
};
const reach = 1.7;
/** A meeting point farther away than this is not drawn. */
const farAway = 3;
const minArea = 0.08;
/** Height of the ground below both faces. */
const ground = -0.72;

export class CrossingSpaceFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0.1, 0.15, 0.02],
    distance: 4.15,
    yaw: 0.35,
    pitch: 0.46,
  });
  readonly #pen = new Pen(this.#stage.context);
  readonly #motion = new Motion();
  readonly #bars = ["*α*^1", "*α*^2", "*α*^3", "*α*^4"].map((name) => new ValueBar(name));
  readonly #boxes = new LayerCard("a Boxes", "· cost 1", []);
  readonly #planes = new LayerCard("b Planes of the faces", "· cost about 10", []);
  readonly #sides = new LayerCard("c Sides through faces", "· cost about 100", this.#bars);
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #buttons = Array.from({ length: 6 }, (_none, index) =>
    button(
      { "data-pair": String(index + 1) },
      index < 3 ? `new side ${index + 1}` : `front side ${index - 2}`,
      () => this.#choose(index),
    ),
  );
  #faces: Faces = poses["through"] as Faces;
  #pairs: readonly SpacePair[] = [];
  /** The pair that the reader has chosen; null for the one nearest to a crossing. */
  #chosen: number | null = null;
  #shown = 0;
  #values: Values | null = null;
  #lit: string | null = null;
  /** Whether the reader has made the present state, and not a word of the text. */
  #isHandled = false;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    const choices = element(
      "div",
      { class: "choices", role: "group", "aria-label": "Pair of a side and a face" },
      ...this.#buttons,
    );
    const cards = [this.#boxes, this.#planes, this.#sides].map((card) => card.element);
    const layers = element("div", { class: "layers" }, ...cards);
    host.append(element("div", { class: "with-layers" }, this.#stage.element, layers), choices, this.#status);
    this.#stage.setHandles([0, 1, 2, 3, 4, 5].map((index) => this.#handle(index)));
    effect(() => {
      values.number("t");
      this.#compute();
    });
  }

  go({ pose = "" }: Readonly<Record<string, string>>): void {
    const target = poses[pose];
    if (!target) return;
    this.#isHandled = false;
    const from = this.#faces;
    this.#chosen = null;
    const moved = (a: Triangle, b: Triangle, t: number): Triangle =>
      a.map((corner, i) => betweenPositions(corner, b[i] as Position, t)) as unknown as Triangle;
    this.#motion.run(700, (t) => {
      this.#faces = { front: moved(from.front, target.front, t), added: moved(from.added, target.added, t) };
      this.#compute();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #choose(index: number): void {
    this.#chosen = this.#chosen === index ? null : index;
    this.#compute();
  }

  /** Corners move in the plane through them that faces the reader. */
  #handle(index: number): HandleOptions {
    const face = index < 3 ? "front" : "added";
    const corner = (): Position => this.#faces[face][index % 3] as Position;
    return {
      name: `${face}-${(index % 3) + 1}`,
      label: `Corner ${(index % 3) + 1} of the ${face === "front" ? "face of the front" : "new face"}`,
      look: face === "front" ? "active solid" : "new solid",
      at: () => this.#camera.pixel(corner()),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, corner(), this.#camera.axes[2]);
        if (!hit || length(hit) > reach) return;
        const triangle = this.#faces[face].map((old, i) =>
          i === index % 3 ? hit : old,
        ) as unknown as Triangle;
        if (areaOf(triangle) < minArea) return;
        this.#faces = { ...this.#faces, [face]: triangle };
        this.#isHandled = true;
        this.#compute();
      },
    };
  }

  #compute(): void {
    const values = this.#values;
    if (!values) return;
    const tolerance = values.number("t");
    this.#pairs = pairsOf(this.#faces.added, this.#faces.front);
    const hits = this.#pairs.filter(({ excess }) => excess <= tolerance).length;
    const excesses = this.#pairs.map(({ excess }) => excess);
    this.#shown = this.#chosen ?? excesses.indexOf(Math.min(...excesses));
    const pair = this.#pairs[this.#shown] as SpacePair;
    const [a1, a2, a3, a4] = pair.alphas;
    const layer = decidingLayer(this.#faces.added, this.#faces.front, tolerance);
    this.#showLayers(layer, hits);
    values.put({
      layer,
      crossing: hits > 0,
      hits,
      pair: this.#shown + 1,
      a1,
      a2,
      a3,
      a4,
      excess: pair.excess,
      onlyfourth: hits === 0 && this.#pairs.some((each) => isStoppedByFourth(each, tolerance)),
      handled: this.#isHandled,
      verdict: hits > 0 ? "refused" : "allowed",
    });
    this.#bars.forEach((bar, i) => bar.show([pair.alphas[i] ?? 0], tolerance));
    this.#buttons.forEach((node, i) => {
      node.setAttribute("aria-pressed", String(i === this.#shown));
      node.classList.toggle("refused", (this.#pairs[i]?.excess ?? Infinity) <= tolerance);
    });
    const count = element("b", hits > 0 ? { class: "refused" } : {}, `${hits} of 6`);
    this.#status.replaceChildren(
      count,
      hits > 0 ? " pairs cross: the new face is refused." : " pairs cross: the new face is allowed.",
    );
    this.#stage.requestDraw();
  }

  #showLayers(layer: 1 | 2 | 3, hits: number): void {
    if (layer === 1) this.#boxes.show("apart", "Apart. Nothing more is asked.");
    else this.#boxes.show("passed", "The boxes overlap: ask on.");
    if (layer === 1) this.#planes.show("idle", "Not asked.");
    else if (layer === 2) this.#planes.show("apart", "All corners beyond one plane: apart.");
    else this.#planes.show("passed", "Each plane cuts the other face: ask on.");
    if (layer < 3) this.#sides.show("idle", "Not asked.");
    else if (hits > 0) this.#sides.show("crossing", "All four lie in the band: refused.");
    else this.#sides.show("apart", "One value lies outside: no crossing.");
  }

  #draw(): void {
    const c = colours();
    const pen = this.#pen;
    const { front: frontFace, added } = this.#faces;
    const { eye } = this.#camera;
    const tolerance = this.#values?.number("t") ?? 0;
    drawGround(pen, this.#camera, c.ink, ground);
    softShadow(pen, this.#camera, [frontFace, added], ground);
    const at = (position: Position): Pixel => this.#camera.pixel(position);
    for (const { corners, sides, isFirst } of paintedPieces(frontFace, added, eye)) {
      const isLit = this.#lit === (isFirst ? "front" : "new");
      const base = isFirst
        ? mix(c.plate, c.active, isLit ? 0.5 : 0.28)
        : mix(c.new, c.plate, isLit ? 0.2 : 0.5);
      pen.polygon(corners.map(at), lit(base, corners, eye));
      sides.forEach((side, i) => {
        if (side === null) return;
        const index = isFirst ? 3 + side : side;
        const isRefused = (this.#pairs[index]?.excess ?? Infinity) <= tolerance;
        const isShown = index === this.#shown || isLit;
        pen.line(
          at(corners[i] ?? eye),
          at(corners[(i + 1) % corners.length] ?? eye),
          isRefused ? c.refused : isFirst ? c.ink : c["new-text"],
          isShown ? 4 : 2.5,
          isRefused && index !== this.#shown ? { dash: [8, 7] } : {},
        );
      });
    }
    // What lies behind a face shows through it as a thin line.
    for (const triangle of [frontFace, added])
      triangle.forEach((corner, i) =>
        pen.line(at(corner), at(triangle[(i + 1) % 3] ?? corner), c.ink, 1, { alpha: 0.32, dash: [3, 5] }),
      );
    this.#drawCut(tolerance);
    this.#drawPath(tolerance);
  }

  /** The piece of a line that both triangles have in common. */
  #drawCut(tolerance: number): void {
    const ends = this.#pairs.flatMap(({ at, excess }) =>
      at && excess <= Math.min(0, tolerance) ? [at] : [],
    );
    const [from, to] = ends;
    if (!from || !to) return;
    const [start, end] = [this.#camera.pixel(from), this.#camera.pixel(to)];
    this.#pen.line(start, end, colours().refused, this.#lit === "cut" ? 9 : 6);
    const isStart = start[0] > end[0];
    const isSmall = this.#stage.width < 560;
    this.#stage.label(isSmall ? "the cut" : "the cut of both faces", isStart ? start : end, {
      look: "refused plate",
      dx: isSmall ? 42 : 92,
      dy: -3,
    });
  }

  #drawPath(tolerance: number): void {
    const pair = this.#pairs[this.#shown];
    if (!pair) return;
    const { face, side, at, alphas, excess } = pair;
    const pixel = (position: Position): Pixel => this.#camera.pixel(position);
    const look: ColourName & ("refused" | "active") = excess <= tolerance ? "refused" : "active";
    const colour = colours()[look];
    this.#stage.label("**x**_f", pixel(face[0]), { dx: -20, dy: 18, look: "plate" });
    this.#stage.label("**x**_s", pixel(side[0]), { dx: -20, dy: -18, look: "plate" });
    if (!at || length(at) > farAway) return;
    const corner = addScaled(face[0], subtract(face[1], face[0]), alphas[0]);
    const isLit = this.#lit === "path";
    const [start, turn, end] = [pixel(face[0]), pixel(corner), pixel(at)];
    for (const [u, v] of [
      [start, turn],
      [turn, end],
    ] as const)
      this.#pen.line(u, v, colour, isLit ? 7 : 4);
    this.#pen.line(pixel(side[0]), end, colour, isLit ? 7 : 4);
    if (excess <= tolerance) this.#pen.cross(end, 9, colour, 3.5);
    else this.#pen.circle(end, 6, colours().plate, { stroke: colour, width: 2.5 });
    this.#beside("*α*^1**g**_1", start, turn, look);
    this.#beside("*α*^2**g**_2", end, turn, look, -24);
    this.#beside("*α*^3**g**_3", pixel(side[0]), end, look, 30);
  }

  /** Puts a label beside the middle of a line: on its left or below, with a negative distance on the other side. */
  #beside(text: string, from: Pixel, to: Pixel, look: string, far = 24): void {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const length = Math.max(1, Math.hypot(dx, dy));
    const [u, v] = [-dy / length, dx / length];
    const turn = (Math.abs(v) > 0.5 ? v : -u) < 0 ? -1 : 1;
    this.#stage.label(text, between(from, to, 0.5), {
      dx: turn * u * (far + 8 * Math.sign(far)),
      dy: turn * v * far,
      look: `${look} plate`,
    });
  }
}

function areaOf([a, b, c]: Triangle): number {
  const [u, v] = [subtract(b, a), subtract(c, a)];
  return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}
