/** One question, three structures: the reader drags the circle, and all of them answer, each with what it has looked at. */
import { effect, untracked } from "@preact/signals-core";
import { colours, css, onTheme } from "../../kit/colours";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { clamp, Motion } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { PlaneView, type PlanePoint } from "../../kit/plane-view";
import { Stage, type HandleOptions, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import { drawCostChart } from "./cost-chart";
import {
  CellTree,
  makeFront,
  structureNames,
  structuresOf,
  type Answer,
  type Cell,
  type Query,
  type Structure,
  type StructureName,
} from "./search-rules";
import { VisitPlayer } from "./visit-player";

const titles: Readonly<Record<StructureName, string>> = {
  list: "List",
  quadtree: "Quadtree",
  grid: "Hash grid",
};
const places: Readonly<Record<string, PlanePoint>> = {
  bay: [0.26, 0.66],
  bow: [0.83, 0.6],
  middle: [0.5, 0.5],
};
/** Numbers of nodes for which the chart counts. */
export const chartCounts = [60, 120, 240, 480, 960] as const;

type Structures = Readonly<Record<StructureName, Structure>>;
interface Panel {
  readonly stage: Stage;
  readonly view: PlaneView;
  readonly count: HTMLElement;
  readonly bar: HTMLElement;
}

export class SearchFigure implements Figure {
  readonly #panels: Readonly<Record<StructureName, Panel>>;
  readonly #chart = element("canvas", { "aria-hidden": "true" });
  readonly #play = new VisitPlayer(
    () => Math.max(...structureNames.map((name) => this.#answers?.[name].visits.length ?? 0)),
    () => this.#show(),
  );
  readonly #status = element("p", { class: "status" });
  readonly #motion = new Motion();
  readonly #known = new Map<
    number,
    { readonly nodes: readonly PlanePoint[]; readonly structures: Structures }
  >();
  #at: PlanePoint = places["bow"] ?? [0.5, 0.5];
  #answers: Readonly<Record<StructureName, Answer>> | null = null;
  #values: Values | null = null;
  #isHandled = false;
  #isLed = false;
  #lit: string | null = null;

  constructor() {
    const panel = (name: StructureName): Panel => {
      const stage = new Stage(() => this.#draw(name));
      const view = new PlaneView(stage, [0.03, 0.06, 0.97, 0.94]);
      return { stage, view, count: element("span"), bar: element("i") };
    };
    this.#panels = { list: panel("list"), quadtree: panel("quadtree"), grid: panel("grid") };
  }

  mount(host: HTMLElement, values: Values): void {
    this.#values = values;
    const panels = structureNames.map((name) => {
      const { stage, count, bar } = this.#panels[name];
      const head = element("div", { class: "head" }, element("b", {}, titles[name]), count);
      stage.setHandles([this.#circleHandle(name), this.#radiusHandle(name)]);
      return element(
        "div",
        { class: "twin" },
        head,
        element("div", { class: "visit-bar" }, bar),
        stage.element,
      );
    });
    host.append(
      element("div", { class: "searches" }, ...panels),
      element(
        "div",
        { class: "player cost" },
        this.#play.button,
        element("div", { class: "cost-chart" }, this.#chart),
      ),
      this.#status,
    );
    new ResizeObserver(() => this.#drawChart()).observe(this.#chart);
    onTheme(() => this.#drawChart());
    let isFirst = true;
    effect(() => {
      values.number("nodes");
      values.number("radius");
      this.#isHandled ||= !isFirst && !this.#isLed;
      isFirst = false;
      untracked(() => this.#ask());
    });
  }

  go({ at, nodes, radius }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    if (nodes !== undefined) this.#values?.ask("nodes", Number(nodes));
    if (radius !== undefined) this.#values?.ask("radius", Number(radius));
    this.#isLed = false;
    const [from, to] = [this.#at, places[at ?? ""] ?? this.#at];
    this.#motion.run(600, (t) => {
      this.#at = [from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t];
      this.#ask();
    });
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#requestDraw();
    this.#drawChart();
  }

  get #circle(): Query {
    return { at: this.#at, radius: this.#values?.number("radius") ?? 0.1 };
  }

  #knownFor(count: number): { readonly nodes: readonly PlanePoint[]; readonly structures: Structures } {
    const known = this.#known.get(count);
    if (known) return known;
    const nodes = makeFront(count);
    const made = { nodes, structures: structuresOf(nodes) };
    this.#known.set(count, made);
    return made;
  }

  #circleHandle(name: StructureName): HandleOptions {
    return {
      name: `circle-${name}`,
      label: `Circle, ${titles[name]}`,
      look: "active solid",
      at: () => this.#panels[name].view.pixel(this.#at),
      begin: () => this.#motion.stop(),
      move: (pixel) => {
        const [x, y] = this.#panels[name].view.point(pixel);
        this.#isHandled = true;
        this.#at = [clamp(x, 0.08, 0.92), clamp(y, 0.1, 0.9)];
        this.#ask();
      },
      describe: () => this.#status.textContent,
    };
  }

  #radiusHandle(name: StructureName): HandleOptions {
    const { view } = this.#panels[name];
    return {
      name: `radius-${name}`,
      label: `Radius, ${titles[name]}`,
      look: "active",
      // Outside the circle, so that a small circle can be dragged, too.
      at: () => {
        const [x, y] = view.pixel(this.#at);
        return [x + this.#side * (this.#circle.radius * view.scale + this.#gap), y];
      },
      begin: () => this.#motion.stop(),
      move: ([x]) => {
        this.#isHandled = true;
        const away = this.#side * (x - view.pixel(this.#at)[0]) - this.#gap;
        this.#values?.ask("radius", away / view.scale);
      },
      describe: () => `${this.#circle.radius.toFixed(3)}`,
    };
  }

  /** Pixels between the circle and the handle of its radius: on a phone, both are wide. */
  get #gap(): number {
    return window.innerWidth > 700 ? 16 : 36;
  }

  /** On which side of the circle its radius is dragged: where there is room. */
  get #side(): 1 | -1 {
    return this.#at[0] > 0.55 ? -1 : 1;
  }

  #ask(): void {
    const values = this.#values;
    if (!values) return;
    this.#play.stop();
    const count = values.number("nodes");
    const { structures } = this.#knownFor(count);
    const answers = {
      list: structures.list.find(this.#circle),
      quadtree: structures.quadtree.find(this.#circle),
      grid: structures.grid.find(this.#circle),
    };
    this.#answers = answers;
    const { quadtree } = structures;
    values.put({
      list: answers.list.visits.length,
      quadtree: answers.quadtree.visits.length,
      grid: answers.grid.visits.length,
      share: (100 * answers.quadtree.visits.length) / count,
      found: answers.list.found.length,
      cells: quadtree.cells.length,
      depth: quadtree instanceof CellTree ? quadtree.depth : 0,
      x: this.#at[0],
      y: this.#at[1],
      handled: this.#isHandled,
    });
    this.#status.replaceChildren(
      "All three find the same ",
      element("b", {}, String(answers.list.found.length)),
      ` of ${count} nodes. `,
      element("b", {}, `${((100 * answers.quadtree.visits.length) / count).toFixed(1)} %`),
      " of the list’s visits are enough for the quadtree.",
    );
    this.#show();
    this.#drawChart();
  }

  #show(): void {
    const answers = this.#answers;
    if (!answers) return;
    const longest = Math.max(...structureNames.map((name) => answers[name].visits.length));
    for (const name of structureNames) {
      const total = answers[name].visits.length;
      const visits = this.#play.of(total);
      const { count, bar } = this.#panels[name];
      count.replaceChildren(
        element("b", { class: "active" }, String(visits)),
        visits === 1 ? " visit" : " visits",
      );
      bar.style.width = `${((100 * visits) / longest).toFixed(2)}%`;
      bar.classList.toggle("done", visits === total && this.#play.isPlaying);
    }
    this.#requestDraw();
  }

  #requestDraw(): void {
    for (const name of structureNames) this.#panels[name].stage.requestDraw();
  }

  #draw(name: StructureName): void {
    const answer = this.#answers?.[name];
    if (!answer) return;
    const { stage, view } = this.#panels[name];
    const c = colours();
    const pen = new Pen(stage.context);
    const { nodes, structures } = this.#knownFor(this.#values?.number("nodes") ?? 0);
    const at = (point: PlanePoint): Pixel => view.pixel(point);
    const visits = answer.visits.slice(0, this.#play.of(answer.visits.length));
    const square = ({ at: [x, y], side }: Cell): readonly Pixel[] =>
      [
        [x, y],
        [x + side, y],
        [x + side, y + side],
        [x, y + side],
      ].map(([u = 0, v = 0]) => at([u, v]));
    pen.polygon(nodes.map(at), c.void, 0.75);
    const isDense = nodes.length > 400;
    const areLit = this.#lit === "cells";
    for (const cell of structures[name].cells)
      pen.polygon(square(cell), null, 1, {
        colour: c.soft,
        width: areLit ? 1.5 : 0.75,
        alpha: areLit ? 0.9 : 0.42,
      });
    for (const visit of visits)
      if ("cell" in visit)
        pen.polygon(square(visit.cell), c.active, areLit ? 0.2 : 0.11, { colour: c.active, width: 1.25 });
    const isFrontLit = this.#lit === "front";
    pen.polygon(nodes.map(at), null, 1, { colour: c.ink, width: isFrontLit ? 4 : isDense ? 1 : 1.5 });
    // In a small picture, the dots of neighbours would become one thick line.
    const dot = (isDense ? 1.3 : nodes.length > 160 ? 1.9 : 2.6) * clamp(view.scale / 280, 0.55, 1);
    for (const node of nodes) pen.circle(at(node), dot, c.ink);
    const found = new Set(answer.found);
    const isVisitedLit = this.#lit === "visited";
    const last = visits.at(-1);
    for (const visit of visits)
      if ("node" in visit && !found.has(visit.node))
        pen.circle(at(nodes[visit.node] ?? [0, 0]), dot + (isVisitedLit ? 3 : isDense ? 0.9 : 1.4), c.active);
    for (const visit of visits)
      if ("node" in visit && found.has(visit.node))
        pen.circle(at(nodes[visit.node] ?? [0, 0]), dot + (this.#lit === "found" ? 4.5 : 2.4), c.new, {
          stroke: c.ink,
          width: 1,
        });
    if (last && "node" in last && this.#play.isPlaying)
      pen.circle(at(nodes[last.node] ?? [0, 0]), 9, null, { stroke: c.active, width: 2.5 });
    const { radius } = this.#circle;
    const middle = at(this.#at);
    const end: Pixel = [middle[0] + this.#side * (radius * view.scale + this.#gap - 6), middle[1]];
    pen.circle(middle, radius * view.scale, c.new, { alpha: 0.16, stroke: c.ink, width: 2.25 });
    pen.line(middle, end, c.active, 1.5, { dash: [3, 3] });
  }

  #drawChart(): void {
    const values = this.#values;
    if (!values || !this.#answers) return;
    const rows = structureNames.map((name) => ({
      name: titles[name].toLowerCase(),
      counts: chartCounts.map(
        (count) => this.#knownFor(count).structures[name].find(this.#circle).visits.length,
      ),
      present: this.#answers?.[name].visits.length ?? 0,
    }));
    const c = colours();
    drawCostChart(this.#chart, {
      nodes: chartCounts,
      rows,
      present: values.number("nodes"),
      ink: css(c.ink),
      soft: css(c.soft),
      rule: css(c.rule),
      active: css(c.active),
      isLit: this.#lit === "chart",
    });
  }
}
