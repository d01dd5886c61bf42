/** One question in space: the reader moves a ball through a front, and a list, an octree and a grid answer. */
import { effect, untracked } from "@preact/signals-core";
import type { Position } from "../../../../document/position";
import { addScaled, between } from "../../../../document/vectors";
import { button, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { clamp, Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import type { Answer, Query, Structure } from "./search-rules";
import {
  makeSpaceFront,
  spaceStructureNames,
  spaceStructuresOf,
  type SpaceFront,
  type SpaceStructureName,
} from "./space-front";
import { SpaceSearchDrawing } from "./space-search-drawing";
import { VisitPlayer } from "./visit-player";

const titles: Readonly<Record<SpaceStructureName, string>> = {
  list: "List",
  octree: "Octree",
  grid: "Hash grid",
};
const places: Readonly<Record<string, Position>> = {
  wall: [0.22, -0.2, 0.24],
  bay: [-0.2, -0.06, 0.1],
  hollow: [0.06, 0, -0.04],
};
/** How far the ball can go from the middle of the cube, along each axis. */
const reach = 0.42;
/** Pixels between the ball and the handle of its radius. */
const gap = 18;

interface Searched {
  readonly front: SpaceFront;
  readonly structures: Readonly<Record<SpaceStructureName, Structure<Position>>>;
}

interface Choice {
  readonly node: HTMLButtonElement;
  readonly count: HTMLElement;
  readonly bar: HTMLElement;
}

export class SpaceSearchFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0, 0, -0.06],
    distance: 3,
    yaw: 0.5,
    pitch: 0.34,
  });
  readonly #drawing = new SpaceSearchDrawing(this.#camera, new Pen(this.#stage.context));
  readonly #choices: Readonly<Record<SpaceStructureName, Choice>>;
  readonly #play = new VisitPlayer(
    () => Math.max(...spaceStructureNames.map((name) => this.#answers?.[name].visits.length ?? 0)),
    () => this.#show(),
  );
  readonly #status = element("p", { class: "status" });
  readonly #motion = new Motion();
  readonly #known = new Map<number, Searched>();
  #at: Position = places["wall"] ?? [0, 0, 0];
  #shown: SpaceStructureName = "octree";
  #answers: Readonly<Record<SpaceStructureName, Answer<Position>>> | null = null;
  #values: Values | null = null;
  #isHandled = false;
  #isLed = false;
  #lit: string | null = null;

  constructor() {
    const choice = (name: SpaceStructureName): Choice => {
      const [count, bar] = [element("span"), element("i")];
      const node = button({ "data-structure": name }, "", () => this.#choose(name));
      node.append(element("span", {}, titles[name]), count, element("span", { class: "mean" }, bar));
      return { node, count, bar };
    };
    this.#choices = { list: choice("list"), octree: choice("octree"), grid: choice("grid") };
  }

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    const choices = element(
      "div",
      { class: "choices rulers visits", role: "group", "aria-label": "Structure whose visits are shown" },
      ...spaceStructureNames.map((name) => this.#choices[name].node),
    );
    const panel = element("div", { class: "visit-panel" }, choices, this.#play.button);
    host.append(element("div", { class: "with-layers" }, this.#stage.element, panel), this.#status);
    this.#stage.setHandles([this.#ballHandle(), this.#radiusHandle()]);
    let isFirst = true;
    effect(() => {
      values.number("parts");
      values.number("radius");
      this.#isHandled ||= !isFirst && !this.#isLed;
      isFirst = false;
      untracked(() => this.#ask());
    });
  }

  go({ at, show, parts, radius }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    if (parts !== undefined) this.#values?.ask("parts", Number(parts));
    if (radius !== undefined) this.#values?.ask("radius", Number(radius));
    this.#isLed = false;
    this.#shown = spaceStructureNames.find((name) => name === show) ?? this.#shown;
    const [from, to] = [this.#at, places[at ?? ""] ?? this.#at];
    this.#motion.run(700, (t) => {
      this.#at = between(from, to, t);
      this.#ask();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  get #query(): Query<Position> {
    return { at: this.#at, radius: this.#values?.number("radius") ?? 0.1 };
  }

  #searched(parts: number): Searched {
    const known = this.#known.get(parts);
    if (known) return known;
    const front = makeSpaceFront(parts);
    const made = { front, structures: spaceStructuresOf(front.nodes) };
    this.#known.set(parts, made);
    return made;
  }

  #choose(name: SpaceStructureName): void {
    this.#shown = name;
    this.#show();
  }

  /** The ball moves in the plane that faces the reader. */
  #ballHandle(): HandleOptions {
    return {
      name: "ball",
      label: "Ball",
      look: "active solid",
      at: () => this.#camera.pixel(this.#at),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const hit = this.#camera.onPlane(pixel, this.#at, this.#camera.axes[2]);
        if (!hit) return;
        this.#isHandled = true;
        this.#at = hit.map((x) => clamp(x, -reach, reach)) as unknown as Position;
        this.#ask();
      },
      describe: () => this.#status.textContent,
    };
  }

  #radiusHandle(): HandleOptions {
    const pixelsOf = (radius: number): number => {
      const [right] = this.#camera.axes;
      return this.#camera.pixel(addScaled(this.#at, right, radius))[0] - this.#camera.pixel(this.#at)[0];
    };
    return {
      name: "radius",
      label: "Radius",
      look: "active",
      at: (): Pixel => {
        const [x, y] = this.#camera.pixel(this.#at);
        return [x + pixelsOf(this.#query.radius) + gap, y];
      },
      begin: () => this.#motion.stop(),
      move: ([x]) => {
        this.#isHandled = true;
        const away = x - gap - this.#camera.pixel(this.#at)[0];
        this.#values?.ask("radius", away / pixelsOf(1));
      },
      describe: () => this.#query.radius.toFixed(3),
    };
  }

  #ask(): void {
    const values = this.#values;
    if (!values) return;
    this.#play.stop();
    const { front, structures } = this.#searched(values.number("parts"));
    const query = this.#query;
    const answers = {
      list: structures.list.find(query),
      octree: structures.octree.find(query),
      grid: structures.grid.find(query),
    };
    this.#answers = answers;
    const [list, octree, grid] = [
      answers.list.visits.length,
      answers.octree.visits.length,
      answers.grid.visits.length,
    ];
    const share = (100 * octree) / list;
    const found = answers.list.found.length;
    const opened = answers.grid.visits.filter((visit) => "cell" in visit).length;
    const nodes = front.nodes.length;
    const [x, y, z] = this.#at;
    values.put({ list, octree, grid, share, found, opened, nodes, x, y, z, handled: this.#isHandled });
    this.#status.replaceChildren(
      "All three find the same ",
      element("b", {}, String(found)),
      ` of ${nodes} nodes. The grid opens `,
      element("b", {}, String(opened)),
      opened === 1 ? " cell." : " cells.",
    );
    this.#show();
  }

  #show(): void {
    const answers = this.#answers;
    if (!answers) return;
    const longest = Math.max(...spaceStructureNames.map((name) => answers[name].visits.length));
    for (const name of spaceStructureNames) {
      const visits = this.#play.of(answers[name].visits.length);
      const { node, count, bar } = this.#choices[name];
      count.replaceChildren(element("b", {}, String(visits)), visits === 1 ? " visit" : " visits");
      bar.style.width = `${((100 * visits) / longest).toFixed(2)}%`;
      node.setAttribute("aria-pressed", String(name === this.#shown));
    }
    this.#stage.requestDraw();
  }

  #draw(): void {
    const answer = this.#answers?.[this.#shown];
    if (!answer) return;
    const { front, structures } = this.#searched(this.#values?.number("parts") ?? 1);
    this.#drawing.draw({
      front,
      query: this.#query,
      visits: answer.visits.slice(0, this.#play.of(answer.visits.length)),
      found: new Set(answer.found),
      cells: structures[this.#shown].cells,
      isPlaying: this.#play.isPlaying,
      lit: this.#lit,
    });
  }
}
