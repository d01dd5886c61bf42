/** The pockets of a real front that has stalled, stretched to a box: stretching changes neither what crosses nor what is seen. */
import type { Position } from "../../../../document/position";
import { between as betweenPositions } from "../../../../document/vectors";
import { colours } from "../../kit/colours";
import { button, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { drawGround } from "../ideal/ground";
import { bodyVolume, kernelOf, type ConvexBody } from "../pocket/kernel";
import { nodeHandle } from "../pocket/node-handle";
import { PocketDrawing } from "../pocket/pocket-drawing";
import { seenFrom, volumeOf, type Pocket } from "../pocket/pocket-rules";
import { rodPockets, type RodPocket } from "./rod-pockets";

const names = ["First pocket", "Second pocket", "Third pocket"];
/** Width, depth and height of the box in the scene. */
const box: Position = [1.15, 1.15, 1.1];
/** Where the node begins, as shares of the box of the pocket. */
const start: Position = [0.62, 0.3, 0.7];
/** The rod has 64 sides, each of two needles. */
const rodSides = 64;

interface Scaled extends RodPocket {
  readonly low: Position;
  readonly high: Position;
  readonly toScene: (position: Position) => Position;
  readonly toRod: (position: Position) => Position;
  /** Whether the whole rod is drawn, with one scale across. */
  readonly isWhole: boolean;
  readonly kernel: ConvexBody;
}

const mapped = (position: Position, map: (x: number, axis: number) => number): Position =>
  position.map(map) as unknown as Position;

function scaled(each: RodPocket): Scaled {
  const { corners } = each.pocket;
  const bound = (pick: (...values: number[]) => number): Position =>
    [0, 1, 2].map((axis) => pick(...corners.map((corner) => corner[axis] ?? 0))) as unknown as Position;
  const [low, high] = [bound(Math.min), bound(Math.max)];
  const isWhole = high[0] - low[0] > 0.5;
  const span = (axis: number): number =>
    (isWhole && axis < 2 ? 2 : (high[axis] ?? 0) - (low[axis] ?? 0)) || 1;
  const factor = (axis: number): number => ((box[axis] ?? 1) * (isWhole && axis < 2 ? 1.25 : 1)) / span(axis);
  const middle = (axis: number): number =>
    isWhole && axis < 2 ? 0 : ((low[axis] ?? 0) + (high[axis] ?? 0)) / 2;
  const lift = (axis: number): number => (axis === 2 ? box[2] / 2 : 0);
  return {
    ...each,
    low,
    high,
    isWhole,
    toScene: (position) => mapped(position, (x, axis) => (x - middle(axis)) * factor(axis) + lift(axis)),
    toRod: (position) => mapped(position, (x, axis) => (x - lift(axis)) / factor(axis) + middle(axis)),
    kernel: kernelOf(each.pocket),
  };
}

export class StallFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0, 0, 0.54],
    distance: 3.1,
    yaw: 0.5,
    pitch: 0.44,
    pitches: [0.25, 1.2],
  });
  readonly #drawing = new PocketDrawing(this.#stage, this.#camera, new Pen(this.#stage.context));
  readonly #motion = new Motion();
  readonly #all = rodPockets.map(scaled);
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #buttons = names.map((name, index) =>
    button({ "data-pocket": String(index + 1) }, name, () => this.#choose(index)),
  );
  readonly #closing = button({}, "As Tetrafront closed it", () => this.#show(!this.#isClosed));
  #values: Values | null = null;
  #index = 0;
  /** In the coordinates of the rod. */
  #node: Position = [0, 0, 0];
  #seen: readonly boolean[] = [];
  #isClosed = false;
  #open = 0;
  #lit: string | null = null;
  #isHandled = false;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    const choices = element(
      "div",
      { class: "choices", role: "group", "aria-label": "Pocket" },
      ...this.#buttons,
      this.#closing,
    );
    host.append(this.#stage.element, choices, this.#status);
    this.#stage.setHandles([
      nodeHandle(
        this.#camera,
        [
          [-1.3, -1.3, 0.01],
          [1.3, 1.3, box[2] - 0.01],
        ],
        {
          at: () => this.#shown.toScene(this.#node),
          begin: () => this.#motion.stop(),
          moveTo: (position) => {
            this.#node = this.#shown.toRod(position);
            this.#isHandled = true;
            this.#compute();
          },
          describe: () => String(this.#values?.word("sight")),
        },
      ),
    ]);
    this.#node = this.#startOf(this.#index);
    this.#compute();
  }

  go({ pocket, node, show }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isClosed = false;
    const index =
      pocket === undefined ? this.#index : Math.min(this.#all.length, Math.max(1, Number(pocket))) - 1;
    if (index !== this.#index) {
      this.#index = index;
      this.#node = this.#startOf(index);
    }
    const from = this.#node;
    const to =
      node === "engine" ? (this.#shown.node ?? from) : node === "start" ? this.#startOf(index) : from;
    this.#motion.run(
      from === to ? 0 : 700,
      (t) => {
        this.#node = betweenPositions(from, to, t);
        this.#compute();
      },
      () => show !== undefined && this.#show(show === "closed"),
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  get #shown(): Scaled {
    return this.#all[this.#index] as Scaled;
  }

  #startOf(index: number): Position {
    const { low, high } = this.#all[index] as Scaled;
    return mapped(low, (x, axis) => x + ((high[axis] ?? x) - x) * (start[axis] ?? 0));
  }

  #choose(index: number): void {
    this.#index = index;
    this.#isClosed = false;
    this.#isHandled = true;
    this.#node = this.#startOf(index);
    this.#compute();
  }

  #show(isClosed: boolean): void {
    this.#isClosed = isClosed;
    this.#motion.run(1100, (t) => {
      this.#open = t;
      this.#stage.requestDraw();
    });
    this.#compute();
  }

  #compute(): void {
    const { pocket, kernel, elements, node } = this.#shown;
    this.#seen = seenFrom(pocket, this.#node);
    const [seen, faces] = [this.#seen.filter(Boolean).length, pocket.faces.length];
    this.#values?.put({
      pocket: this.#index + 1,
      faces,
      seen,
      room: 100 * Math.min(1, bodyVolume(kernel) / volumeOf(pocket)),
      elements: elements.length,
      shown: this.#isClosed,
      handled: this.#isHandled,
      sight: seen === faces ? `sees all ${faces} faces` : `sees ${seen} of ${faces} faces`,
    });
    this.#buttons.forEach((each, index) => each.setAttribute("aria-pressed", String(index === this.#index)));
    this.#closing.setAttribute("aria-pressed", String(this.#isClosed));
    this.#stage.handle("node")?.node.classList.toggle("refused", seen < faces);
    this.#stage.element.classList.toggle("playing", this.#isClosed);
    const count = element("b", seen < faces ? { class: "refused" } : {}, `${seen} of ${faces}`);
    const way = node ? "a star" : "the exact fill";
    if (this.#isClosed)
      this.#status.replaceChildren(element("b", {}, String(elements.length)), ` elements, made by ${way}.`);
    else this.#status.replaceChildren("The node sees ", count, " faces.");
    this.#stage.requestDraw();
  }

  #draw(): void {
    const { pocket, toScene, isWhole, kernel, positions, elements, node } = this.#shown;
    const pen = this.#drawing.pen;
    if (isWhole) this.#drawRod(toScene);
    else drawGround(pen, this.#camera, colours().ink);
    if (this.#isClosed)
      return this.#drawing.drawElements({
        positions: positions.map(toScene),
        elements: elements.map(([a, b, c, d]) => [a, b, c, d]),
        open: this.#open,
        isNew: node !== null,
      });
    const drawn: Pocket = { corners: pocket.corners.map(toScene), faces: pocket.faces };
    const at = toScene(this.#node);
    this.#drawing.drawPocket({
      pocket: drawn,
      seen: this.#seen,
      node: at,
      kernel: kernel.map((polygon) => polygon.map(toScene)),
      kernelStrength: this.#lit === "room" ? 1 : 0,
      diagonals: [],
      trial: null,
      strong: [],
      lit: this.#lit,
      areCornersNamed: false,
      isFine: isWhole,
    });
  }

  /** The needles around the pocket. */
  #drawRod(toScene: (position: Position) => Position): void {
    const pen = this.#drawing.pen;
    const c = colours();
    const alpha = this.#lit === "rod" ? 0.4 : 0.13;
    const ends = [0, 8].map((z) =>
      Array.from({ length: rodSides }, (_none, i): Position => {
        const angle = (2 * Math.PI * i) / rodSides;
        return toScene([Math.cos(angle), Math.sin(angle), z]);
      }),
    );
    for (const end of ends)
      pen.polygon(
        end.map((position) => this.#camera.pixel(position)),
        null,
        1,
        { colour: c.ink, width: 1.25, alpha: 2 * alpha },
      );
    ends[0]?.forEach((position, i) =>
      pen.line(this.#camera.pixel(position), this.#camera.pixel(ends[1]?.[i] ?? position), c.ink, 1, {
        alpha,
      }),
    );
  }
}
