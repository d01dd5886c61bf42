/** A twisted prism. The reader twists it, tries the tetrahedra on its corners, and moves a node that must see all faces. */
import { effect, untracked } from "@preact/signals-core";
import type { Position } from "../../../../document/position";
import { between as betweenPositions } from "../../../../document/vectors";
import { colours } from "../../kit/colours";
import { button, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { drawGround } from "../ideal/ground";
import { bodyVolume, kernelOf, type ConvexBody } from "./kernel";
import { nodeHandle } from "./node-handle";
import { PocketDrawing } from "./pocket-drawing";
import {
  diagonalsOf,
  fillingsOf,
  seenFrom,
  trialsIn,
  volumeOf,
  type Diagonal,
  type Element,
  type Pair,
  type Trial,
} from "./pocket-rules";
import { nameOf, TrialTiles } from "./trial-tiles";
import { prismDirection, prismHeight, twistedPrism } from "./twisted-prism";

type Shown = "pocket" | "own" | "star";

/** The diagonals that divide the walls. */
const wallDiagonals: readonly Pair[] = [
  [0, 4],
  [1, 5],
  [2, 3],
];
const middle: Position = [0, 0, prismHeight / 2];
const nodePlaces: Readonly<Record<string, Position>> = {
  middle,
  low: [0.1, -0.05, 0.12],
  wall: [0.34, -0.3, 0.72],
};
const nodeBox = [
  [-0.8, -0.8, 0.02],
  [0.8, 0.8, prismHeight - 0.02],
] as const;
const numbers = ["No", "One", "Two", "Three", "Four", "Five", "Six"];

export class PocketFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0, 0, 0.5],
    distance: 3.6,
    yaw: -0.25,
    pitch: 0.46,
    // Seen edge-on, a corner could not be dragged around.
    pitches: [0.25, 1.25],
  });
  readonly #drawing = new PocketDrawing(this.#stage, this.#camera, new Pen(this.#stage.context));
  readonly #motion = new Motion();
  readonly #opening = new Motion();
  readonly #tiles = new TrialTiles((index) => this.#choose(index));
  readonly #notice = element("div", { class: "notice", role: "status" });
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #choices = new Map<Shown, HTMLButtonElement>();
  #values: Values | null = null;
  #isAboutNode = false;
  #pocket = twistedPrism(0);
  #node: Position = nodePlaces["wall"] ?? middle;
  #seen: readonly boolean[] = [];
  #kernel: ConvexBody = [];
  #diagonals: readonly Diagonal[] = [];
  #trials: readonly Trial[] = [];
  #fillings: readonly (readonly Element[])[] = [];
  #chosen: number | null = null;
  #shown: Shown = "pocket";
  #open = 0;
  #lit: string | null = null;
  /** Whether the reader has made the present state, and not a word of the text. */
  #isHandled = false;
  #isLed = false;

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    this.#isAboutNode = values.word("about") === "node";
    const choices = element("div", { class: "choices", role: "group", "aria-label": "What is shown" });
    const offered: readonly (readonly [Shown, string])[] = this.#isAboutNode
      ? [
          ["pocket", "The pocket"],
          ["star", "Its star"],
        ]
      : [
          ["pocket", "The pocket"],
          ["own", "Filled with its own corners"],
        ];
    for (const [shown, label] of offered) {
      const made = button({}, label, () => this.#show(shown));
      this.#choices.set(shown, made);
      choices.append(made);
    }
    host.append(
      this.#stage.element,
      this.#notice,
      ...(this.#isAboutNode ? [] : [this.#tiles.element]),
      choices,
      this.#status,
    );
    this.#stage.setHandles([
      ...[3, 4, 5].map((corner) => this.#cornerHandle(corner)),
      ...(this.#isAboutNode ? [this.#nodeHandle()] : []),
    ]);
    this.#isLed = true;
    effect(() => {
      values.number("twist");
      untracked(() => {
        if (!this.#isLed) this.#isHandled = true;
        this.#compute();
      });
    });
    this.#isLed = false;
  }

  go({ twist, node, show, trial }: Readonly<Record<string, string>>): void {
    const values = this.#values;
    if (!values) return;
    this.#isHandled = false;
    this.#shown = "pocket";
    if (trial !== undefined) this.#chosen = trial === "none" ? null : Number(trial) - 1;
    const from = { twist: values.number("twist"), node: this.#node };
    const to = {
      twist: twist === undefined ? from.twist : Number(twist),
      node: nodePlaces[node ?? ""] ?? from.node,
    };
    this.#motion.run(
      from.twist === to.twist && from.node === to.node ? 0 : 800,
      (t) => {
        this.#node = betweenPositions(from.node, to.node, t);
        this.#isLed = true;
        values.ask("twist", from.twist + (to.twist - from.twist) * t);
        this.#isLed = false;
        this.#compute();
      },
      () => {
        if (show !== undefined) this.#show(show as Shown, true);
      },
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #cornerHandle(corner: number): HandleOptions {
    return {
      name: `corner-${corner + 1}`,
      label: `Corner ${corner + 1}: turns the upper triangle`,
      look: "active solid",
      at: () => this.#camera.pixel(this.#pocket.corners[corner] ?? middle),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, [0, 0, prismHeight], [0, 0, 1]);
        if (!hit) return;
        const turned = (Math.atan2(hit[1], hit[0]) * 180) / Math.PI - prismDirection(corner);
        this.#values?.ask("twist", ((turned + 540) % 360) - 180);
      },
      describe: () => `twist ${this.#values?.number("twist").toFixed(0) ?? ""} degrees`,
    };
  }

  #nodeHandle(): HandleOptions {
    return nodeHandle(this.#camera, nodeBox, {
      at: () => this.#node,
      begin: () => this.#motion.stop(),
      moveTo: (position) => {
        this.#node = position;
        this.#isHandled = true;
        this.#compute();
      },
      describe: () => `sees ${this.#seen.filter(Boolean).length} of ${this.#seen.length} faces`,
    });
  }

  #choose(index: number): void {
    this.#chosen = this.#chosen === index ? null : index;
    this.#shown = "pocket";
    this.#compute();
  }

  /** Opens the filling, or shows the pocket again. If there is no filling, the figure says why. */
  #show(shown: Shown, isLed = false): void {
    const reason = this.#reasonAgainst(shown);
    this.#notice.textContent = reason ?? "";
    if (reason !== null) {
      setTimeout(() => (this.#notice.textContent = ""), 2600);
      return;
    }
    this.#isHandled = !isLed;
    this.#shown = shown;
    this.#opening.run(1100, (t) => {
      this.#open = t;
      this.#stage.requestDraw();
    });
    this.#compute();
  }

  #reasonAgainst(shown: Shown): string | null {
    if (shown === "own" && this.#fillings.length === 0) return "No tetrahedron on its own corners fits.";
    if (shown === "star" && this.#seen.includes(false)) return "The node does not see all eight faces.";
    return null;
  }

  #compute(): void {
    const values = this.#values;
    if (!values) return;
    this.#pocket = twistedPrism(values.number("twist"));
    this.#trials = trialsIn(this.#pocket);
    this.#fillings = fillingsOf(this.#pocket, this.#trials);
    this.#diagonals = diagonalsOf(this.#pocket);
    this.#seen = seenFrom(this.#pocket, this.#node);
    this.#kernel = kernelOf(this.#pocket);
    if (this.#reasonAgainst(this.#shown) !== null) this.#shown = "pocket";
    const fits = this.#trials.filter(({ verdict }) => verdict === "fits").length;
    const seen = this.#seen.filter(Boolean).length;
    values.put({
      faces: this.#pocket.faces.length,
      trials: this.#trials.length,
      fits,
      ways: this.#fillings.length,
      seen,
      room: 100 * Math.min(1, bodyVolume(this.#kernel) / volumeOf(this.#pocket)),
      shown: this.#shown === "pocket" ? 0 : 1,
      handled: this.#isHandled,
      closes: this.#fillings.length > 0 ? "can be filled" : "cannot be filled",
      fitting: fits === 0 ? "not one" : String(fits),
      sight: this.#seen.includes(false)
        ? `sees ${seen} of ${this.#seen.length} faces`
        : `sees all ${seen} faces`,
    });
    for (const [shown, node] of this.#choices) {
      node.setAttribute("aria-pressed", String(shown === this.#shown));
      node.toggleAttribute("data-off", this.#reasonAgainst(shown) !== null);
    }
    this.#stage.handle("node")?.node.classList.toggle("refused", this.#seen.includes(false));
    this.#stage.element.classList.toggle("playing", this.#shown !== "pocket");
    this.#say(fits);
    this.#stage.requestDraw();
  }

  #say(fits: number): void {
    const chosen = this.#chosen === null ? undefined : this.#trials[this.#chosen];
    if (this.#isAboutNode) {
      const isStar = !this.#seen.includes(false);
      const count = element(
        "b",
        isStar ? {} : { class: "refused" },
        `${this.#seen.filter(Boolean).length} of 8`,
      );
      this.#status.replaceChildren(
        "The node sees ",
        count,
        isStar ? " faces: it closes the pocket." : " faces.",
      );
      return;
    }
    const count = element("b", fits > 0 ? {} : { class: "refused" }, `${fits} of ${this.#trials.length}`);
    const ways = this.#fillings.length;
    const sentence =
      ways > 0 ? `; they fill the pocket in ${(numbers[ways] ?? String(ways)).toLowerCase()} ways.` : ".";
    this.#status.replaceChildren(
      count,
      ` tetrahedra fit${sentence}`,
      ...(chosen ? [` ${nameOf(chosen)}.`] : []),
    );
  }

  #draw(): void {
    drawGround(this.#drawing.pen, this.#camera, colours().ink);
    if (!this.#isAboutNode) this.#tiles.show(this.#pocket, this.#trials, this.#chosen, this.#camera);
    if (this.#shown !== "pocket") return this.#drawFilling();
    const isHeld = this.#stage.handle("node")?.isHeld === true;
    this.#drawing.drawPocket({
      pocket: this.#pocket,
      seen: this.#isAboutNode ? this.#seen : [],
      node: this.#isAboutNode ? this.#node : null,
      kernel: this.#kernel,
      kernelStrength: this.#lit === "room" ? 1 : isHeld ? 0.5 : 0,
      diagonals: this.#diagonals,
      trial: this.#chosen === null ? null : (this.#trials[this.#chosen] ?? null),
      strong: wallDiagonals,
      lit: this.#lit,
      areCornersNamed: !this.#isAboutNode,
    });
    if (this.#isAboutNode) {
      const look = this.#seen.includes(false) ? "refused" : "new";
      const text = String(this.#values?.word("sight"));
      this.#stage.label(text, this.#camera.pixel(this.#node), { dy: -26, look: `${look} plate` });
    }
  }

  #drawFilling(): void {
    const { corners, faces } = this.#pocket;
    const isStar = this.#shown === "star";
    const own = [...this.#fillings].sort((a, b) => a.length - b.length)[0] ?? [];
    const star = faces.map(([a, b, c]): Element => [a, b, c, corners.length]);
    this.#drawing.drawElements({
      positions: [...corners, this.#node],
      elements: isStar ? star : own,
      open: this.#open,
      isNew: isStar,
    });
  }
}
