/** Draws the front in space, the cells and nodes that a search has looked at, and the ball that asks. */
import type { Position } from "../../../../document/position";
import { addScaled, mean } from "../../../../document/vectors";
import { colours, css, mix, type Colour } from "../../kit/colours";
import { lit, looksTo, paint, softShadow, type Facet } from "../../kit/matte";
import { clamp } from "../../kit/motion";
import type { Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel } from "../../kit/stage";
import type { Cell, Query, Visit } from "./search-rules";
import type { SpaceFront } from "./space-front";

export interface DrawnSearch {
  readonly front: SpaceFront;
  readonly query: Query<Position>;
  /** The visits that are shown, in their order. */
  readonly visits: readonly Visit<Position>[];
  readonly found: ReadonlySet<number>;
  /** All cells of the structure. */
  readonly cells: readonly Cell<Position>[];
  /** Whether the last visit is emphasized: the search is being played. */
  readonly isPlaying: boolean;
  readonly lit: string | null;
}

/** Height of the ground, below the cube of the front. */
const ground = -0.52;
/** Points of a circle in space. */
const circlePoints = 64;
/** The twelve edges of a cube: pairs of corners, whose bits are its upper sides. */
const cubeEdges = [
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
] as const;
/** The six faces of a cube. */
const cubeFaces = [
  [0, 1, 3, 2],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [2, 3, 7, 6],
  [0, 2, 6, 4],
  [1, 3, 7, 5],
] as const;

export class SpaceSearchDrawing {
  constructor(
    readonly camera: Camera,
    readonly pen: Pen,
  ) {}

  draw(drawn: DrawnSearch): void {
    const c = colours();
    this.#drawShadow(drawn);
    this.#drawFront(drawn);
    const areLit = drawn.lit === "cells";
    if (areLit) for (const cell of drawn.cells) this.#drawCell(cell, c.soft, 0.75, 0.35, 0);
    for (const visit of drawn.visits)
      if ("cell" in visit)
        this.#drawCell(
          visit.cell,
          c.active,
          areLit ? 1.75 : 1.1,
          areLit ? 1 : 0.8,
          visit.cell.side < 0.2 ? 0.05 : 0,
        );
    this.#drawBall(drawn);
    this.#drawNodes(drawn);
  }

  #pixel = (position: Position): Pixel => this.camera.pixel(position);

  #drawShadow({ front, query }: DrawnSearch): void {
    const { camera, pen } = this;
    const wide = (radius: number, [x, y]: readonly [number, number]): readonly Position[] =>
      circle((cosine, sine) => [x + radius * cosine, y + radius * sine, ground]);
    const reach = front.nodes.reduce((most, [x, y]) => Math.max(most, Math.hypot(x, y)), 0);
    softShadow(pen, camera, [wide(0.85 * reach, [0, 0])], ground, 0.55);
    // Where the ball stands: a line down to the ground, and its outline there.
    const c = colours();
    const [x, y] = query.at;
    pen.polygon(wide(query.radius, [x, y]).map(this.#pixel), c.new, 0.28, {
      colour: c.ink,
      width: 1,
      alpha: 0.5,
    });
  }

  /** The half of the front that is turned away is a wall; the half before it would hide what is inside, and is only outlined. */
  #drawFront({ front, lit: part }: DrawnSearch): void {
    const c = colours();
    const { eye } = this.camera;
    const isLit = part === "front";
    const walls: Facet[] = [];
    const outlines: (readonly Position[])[] = [];
    for (const face of front.faces) {
      const corners = face.map((node) => front.nodes[node] ?? eye);
      if (looksTo(corners, eye)) {
        outlines.push(corners);
        continue;
      }
      const depth = clamp((mean(corners)[1] + 0.45) / 0.9, 0, 1);
      walls.push({
        corners,
        colour: lit(mix(c.void, c.rim, 0.08 + 0.3 * depth), corners, eye),
        edge: { colour: c.ink, width: isLit ? 1.5 : 1, alpha: isLit ? 0.8 : 0.28 },
      });
    }
    paint(this.pen, this.camera, walls);
    const closed = outlines.map((corners) => [...corners, ...corners.slice(0, 1)].map(this.#pixel));
    this.pen.polylines(closed, c.ink, isLit ? 1.25 : 0.75, isLit ? 0.5 : 0.1);
  }

  #drawCell(cell: Cell<Position>, colour: Colour, width: number, alpha: number, fill: number): void {
    const { pen } = this;
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
      this.#pixel([
        cell.at[0] + (bits % 2 === 1 ? cell.side : 0),
        cell.at[1] + ((bits >> 1) % 2 === 1 ? cell.side : 0),
        cell.at[2] + (bits >> 2 === 1 ? cell.side : 0),
      ]),
    );
    const at = (corner: number): Pixel => corners[corner] ?? [0, 0];
    if (fill > 0) for (const face of cubeFaces) pen.polygon(face.map(at), colour, fill);
    const edges = cubeEdges.map(([a, b]) => [at(a), at(b)]);
    pen.polylines(edges, colour, width, alpha);
  }

  #drawBall({ query: { at, radius } }: DrawnSearch): void {
    const c = colours();
    const { pen, camera } = this;
    const middle = camera.pixel(at);
    const [right] = camera.axes;
    const [x] = camera.pixel(addScaled(at, right, radius));
    pen.circle(middle, x - middle[0], c.new, { alpha: 0.2, stroke: c.ink, width: 2.25 });
    const equator = circle((cosine, sine) => [at[0] + radius * cosine, at[1] + radius * sine, at[2]]);
    for (let i = 0; i < equator.length; i++) {
      const [from, to] = [equator[i] ?? at, equator[(i + 1) % equator.length] ?? at];
      const isBehind = camera.depth(from) > camera.depth(at);
      pen.line(camera.pixel(from), camera.pixel(to), c.ink, 1.25, { alpha: isBehind ? 0.22 : 0.75 });
    }
    pen.line(middle, camera.pixel([at[0], at[1], ground]), c.ink, 1, { alpha: 0.55, dash: [2, 4] });
  }

  #drawNodes({ front, visits, found, isPlaying, lit: part }: DrawnSearch): void {
    const c = colours();
    const { pen, camera } = this;
    const dot = front.nodes.length > 700 ? 1.3 : front.nodes.length > 300 ? 1.7 : 2.2;
    const pixels = front.nodes.map(this.#pixel);
    // Dots that are far from the eye are pale. Those of one shade are drawn at once.
    const middle = camera.depth([0, 0, 0]);
    const shadeOf = (node: Position): number =>
      clamp(Math.floor(2 - 4 * (camera.depth(node) - middle)), 0, 3);
    for (let shade = 0; shade < 4; shade++) {
      pen.context.beginPath();
      front.nodes.forEach((node, i) => {
        const [x, y] = pixels[i] ?? [0, 0];
        if (shadeOf(node) !== shade) return;
        pen.context.moveTo(x + dot, y);
        pen.context.arc(x, y, dot, 0, 2 * Math.PI);
      });
      pen.context.fillStyle = css(c.ink, 0.35 + 0.18 * shade);
      pen.context.fill();
    }
    for (const visit of visits)
      if ("node" in visit && !found.has(visit.node))
        pen.circle(pixels[visit.node] ?? [0, 0], dot + (part === "visited" ? 3 : 1.1), c.active);
    for (const visit of visits)
      if ("node" in visit && found.has(visit.node))
        pen.circle(pixels[visit.node] ?? [0, 0], dot + (part === "found" ? 4.5 : 2.4), c.new, {
          stroke: c.ink,
          width: 1,
        });
    const last = visits.at(-1);
    if (isPlaying && last && "node" in last)
      pen.circle(pixels[last.node] ?? [0, 0], 9, null, { stroke: c.active, width: 2.5 });
  }
}

const circle = (at: (cosine: number, sine: number) => Position): readonly Position[] =>
  Array.from({ length: circlePoints }, (_none, i) => {
    const angle = (2 * Math.PI * i) / circlePoints;
    return at(Math.cos(angle), Math.sin(angle));
  });
