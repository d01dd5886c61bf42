/** The sweeps of the optimizer over a cube, as the engine recorded them. The reader scrubs through them. */
import { loadTrace, type TracedSweep } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { mean } from "../../../../document/vectors";
import { colours, mix } from "../../kit/colours";
import { digits, element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { FilmPlayer, lastBeat } from "../../kit/film-player";
import { lit, paint, softShadow, type Facet } from "../../kit/matte";
import { clamp } from "../../kit/motion";
import { Pen } from "../../kit/pen";
import { Camera } from "../../kit/space";
import { Stage, type Pixel } from "../../kit/stage";
import type { Values } from "../../kit/values";
import type { Four } from "../sliver/sliver-rules";
import address from "./cube.tft?url";
import { Histogram } from "./histogram";
import { SliverLens } from "./sliver-lens";
import { SweepFilm } from "./sweep-film";

const sweepTexts: Readonly<Record<string, string>> = {
  swap: "Edges are removed, and the elements around them replaced.",
  move: "Nodes go to the mean of their elements' circumcentres, weighted by volume.",
  newton: "Nodes move down the slope of the costs.",
  split: "Long edges are split.",
  collapse: "Nodes are removed where they are crowded.",
  improve: "The worst elements are improved one by one.",
  "last-resort": "The last poor elements are worked on for longer.",
};
const sweepNames: Readonly<Record<string, string>> = {
  swap: "Swap",
  move: "Move",
  newton: "Newton",
  split: "Split",
  collapse: "Collapse",
  improve: "The worst elements",
  "last-resort": "The last poor elements",
};
/** What a sweep has done, in words. */
function textOf(sweep: TracedSweep | null): string {
  if (!sweep) return "The mesh of the front, before the first sweep.";
  const { kind, movedNodes, addedNodes, removedNodes, changedElements } = sweep;
  return movedNodes + addedNodes + removedNodes + changedElements > 0
    ? (sweepTexts[kind] ?? "")
    : `${sweepNames[kind] ?? kind}: nothing to do.`;
}
/** More dots than these hide the cube. */
const maxDots = 260;
/** Faces of the cube whose shadows cover that of the whole. */
const cubeShadow: readonly (readonly Position[])[] = [0, 1].map((z) => [
  [0, 0, z],
  [1, 0, z],
  [1, 1, z],
  [0, 1, z],
]);
const cubeEdges: readonly (readonly [number, number])[] = [
  [0, 1],
  [2, 3],
  [4, 5],
  [6, 7],
  [0, 2],
  [1, 3],
  [4, 6],
  [5, 7],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
];

export class SweepsFigure implements Figure {
  readonly #stage = new Stage(() => this.#draw());
  readonly #camera = new Camera(this.#stage, {
    target: [0.5, 0.5, 0.43],
    distance: 3.35,
    yaw: 0.5,
    pitch: 0.4,
  });
  readonly #pen = new Pen(this.#stage.context);
  readonly #lens = new SliverLens(this.#stage, this.#camera, this.#pen);
  readonly #histogram = new Histogram();
  readonly #status = element("p", { class: "status", role: "status" });
  readonly #player: FilmPlayer = new FilmPlayer({
    beats: ["1", "2", "3", "4", "5"],
    onChange: () => this.#changed(),
    describe: () => `sweep ${this.#player.finished}, ${this.#values?.number("poor") ?? 0} poor elements`,
  });
  #film: SweepFilm | null = null;
  #values: Values | null = null;
  #lit: string | null = null;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    host.append(this.#stage.element, this.#histogram.element, this.#player.element, this.#status);
    const answer = await fetch(address);
    const trace = await loadTrace(new Uint8Array(await answer.arrayBuffer()));
    if (!trace.success) throw new Error(trace.errors[0].message);
    this.#film = new SweepFilm(trace.value);
    this.#player.setFilm(this.#film);
    // Before the first sweep, there is nothing to compare.
    this.#player.seek(1);
  }

  go({ sweep }: Readonly<Record<string, string>>): void {
    if (sweep !== undefined)
      this.#player.glideTo(sweep === "end" ? (this.#film?.stepCount ?? 0) : Number(sweep), 0);
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#stage.requestDraw();
  }

  #changed(): void {
    const film = this.#film;
    if (!film || !this.#values) return;
    const state = this.#player.finished;
    const { dihedral, tetrahedra, nodes, outOfRange } = film.measuresAt(state);
    const sweep = film.sweepOf(state);
    const kind = textOf(sweep);
    this.#values.put({
      sweep: state,
      sweeps: film.stepCount,
      elements: tetrahedra,
      nodes,
      poor: outOfRange,
      least: dihedral.min,
      most: dihedral.max,
      moved: sweep?.movedNodes ?? 0,
      added: sweep?.addedNodes ?? 0,
      removed: sweep?.removedNodes ?? 0,
      changed: sweep?.changedElements ?? 0,
      worse: film.isWorse(state),
      clean: outOfRange === 0 && film.sizes.indexOf(0) === state,
      handled: this.#player.isHandled,
      kind,
    });
    const poor = element("b", outOfRange > 0 ? { class: "refused" } : {}, String(outOfRange));
    this.#status.replaceChildren(
      element("b", {}, `Sweep ${state} of ${film.stepCount}`),
      `. ${kind} `,
      poor,
      ` poor of ${tetrahedra} elements, angles from ${digits(dihedral.min, 1)}° to ${digits(dihedral.max, 1)}°.`,
    );
    this.#histogram.element.setAttribute(
      "aria-label",
      `Smallest angles of ${tetrahedra} elements; ${outOfRange} elements are poor`,
    );
    this.#stage.requestDraw();
  }

  #draw(): void {
    const film = this.#film;
    if (!film) return;
    const { step, beat } = this.#player;
    const t = Math.min(1, beat / lastBeat);
    softShadow(this.#pen, this.#camera, cubeShadow);
    this.#drawCube(true);
    const now = film.stateAt(step);
    const next = t > 0 ? film.stateAt(step + 1) : now;
    this.#drawPoor(now.poor, 1 - t);
    if (t > 0) this.#drawPoor(next.poor, t);
    this.#drawChanges(t > 0 ? next.changed : now.changed, t > 0 ? Math.sin(Math.PI * t) : 0.55);
    this.#drawCube(false);
    this.#lens.draw(film.sliver, film.elementAt(t > 0.5 ? step + 1 : step, mean(film.sliver)));
    const bars = now.bars.map((count, bar) => count + ((next.bars[bar] ?? 0) - count) * t);
    this.#histogram.show(bars, film.stateAt(0).bars, this.#lit === "histogram");
  }

  /** The edges of the cube: those behind the elements, then those in front of them. */
  #drawCube(isBehind: boolean): void {
    const c = colours();
    const corner = (bits: number): Position => [bits & 1, (bits >> 1) & 1, (bits >> 2) & 1];
    const depths = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => this.#camera.depth(corner(bits)));
    const farthest = depths.indexOf(Math.max(...depths));
    for (const [a, b] of cubeEdges)
      if ((a === farthest || b === farthest) === isBehind)
        this.#pen.line(
          this.#camera.pixel(corner(a)),
          this.#camera.pixel(corner(b)),
          c.ink,
          isBehind ? 1.25 : 2,
          {
            alpha: isBehind ? 0.4 : 0.9,
          },
        );
    if (!isBehind) return;
    for (const [axis, side] of [
      [0, 0],
      [0, 1],
      [1, 0],
      [1, 1],
      [2, 0],
    ] as const) {
      const wall = [
        [0, 0],
        [1, 0],
        [1, 1],
        [0, 1],
      ].map(([u = 0, v = 0]): Position => {
        const at: [number, number, number] = [0, 0, 0];
        at[axis] = side;
        at[(axis + 1) % 3] = u;
        at[(axis + 2) % 3] = v;
        return at;
      });
      const isFar = this.#camera.depth(mean(wall)) > this.#camera.depth([0.5, 0.5, 0.5]);
      if (isFar)
        this.#pen.polygon(
          wall.map((each) => this.#camera.pixel(each)),
          lit(c.stone, wall, this.#camera.eye),
        );
    }
  }

  #drawPoor(poor: readonly Four[], alpha: number): void {
    const c = colours();
    if (alpha <= 0.01) return;
    const edge = { colour: c.groove, width: this.#lit === "poor" ? 1.75 : 0.9 };
    const middle = this.#camera.depth([0.5, 0.5, 0.5]);
    const facets = poor.flatMap((four) => {
      // Near ones are full red, far ones fade into the walls.
      const depth = clamp((this.#camera.depth(mean(four)) - middle) / 1.3 + 0.5, 0, 1);
      const base = mix(mix(c.refused, c.plate, 0.12), c.rock, 0.68 * depth);
      return [0, 1, 2, 3].map((left): Facet => {
        const corners = four.filter((_corner, i) => i !== left);
        return { corners, colour: lit(base, corners, this.#camera.eye), edge };
      });
    });
    this.#pen.context.globalAlpha = alpha;
    paint(this.#pen, this.#camera, facets);
    this.#pen.context.globalAlpha = 1;
  }

  #drawChanges(changed: readonly Position[], alpha: number): void {
    const c = colours();
    const every = Math.max(1, Math.ceil(changed.length / maxDots));
    const radius = this.#lit === "changed" ? 4 : 2.5;
    changed.forEach((position, index) => {
      if (index % every !== 0) return;
      const [x, y]: Pixel = this.#camera.pixel(position);
      this.#pen.circle([x, y], radius, c.new, { alpha });
    });
  }
}
