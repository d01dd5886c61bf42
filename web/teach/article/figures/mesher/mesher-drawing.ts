/** Draws a front that the reader advances, or a finished mesh, in the plane and in space: pieces from far to near. */
import type { Position } from "../../../../document/position";
import { add, between, mean, scale, subtract } from "../../../../document/vectors";
import { colours, css, mix, type Colour } from "../../kit/colours";
import { between as betweenPixels, type Pen, widths } from "../../kit/pen";
import type { Pixel } from "../../kit/stage";
import { cornersOf, measuresOf, type Board, type Refused } from "./board";
import type { Mesh } from "./levels";
import { newFacets, normalOf, sidesOf } from "./simplices";

/** How a shape is seen. */
export interface Sight {
  readonly pixel: (position: Position) => Pixel;
  /** Distance from the eye; the same for all in the plane. */
  readonly depth: (position: Position) => number;
  /** Where the eye is; null in the plane. */
  readonly eye: Position | null;
}

export interface Preview {
  readonly at: Position;
  readonly refused: Refused | null;
}

/** Elements in space are drawn smaller, so that each can be seen; those of a finished mesh apart from each other, too. */
const shrinking = 0.9;
const spread = 0.34;
const dotRadius = 3;

interface Piece {
  readonly depth: number;
  readonly draw: () => void;
}

export class MesherDrawing {
  constructor(
    readonly pen: Pen,
    readonly sight: Sight,
    readonly boldness: number,
  ) {}

  /** The board with the active facet, the element that a choice would make, and where a new node is proposed. */
  drawBoard(
    board: Board,
    active: readonly number[] | null,
    preview: Preview | null,
    proposal: Position,
    lit: string | null,
  ): void {
    const c = colours();
    const { eye } = this.sight;
    if (!eye) this.#fillEmpty(board);
    const pieces = board.elements.flatMap((element, i) =>
      this.#element(
        board.positions(element),
        i === board.elements.length - 1 ? c["new-soft"] : c.stone,
        null,
      ),
    );
    for (const facet of board.front) pieces.push(this.#facet(board.positions(facet), lit === "front"));
    this.#drawSorted(pieces);
    const corners = active && board.positions(active);
    if (corners) this.#active(corners);
    if (corners && preview) this.#preview(board, corners, preview);
    else if (corners) this.#proposal(corners, proposal);
  }

  /** A finished mesh, with its worst element and what is left of its front. In space it is opened. */
  drawMesh({ nodes, elements }: Mesh, left: readonly (readonly Position[])[], lit: string | null): void {
    const c = colours();
    const middle = mean(nodes);
    const { worst } = measuresOf(nodes, elements, 0);
    const pieces = elements.flatMap((element, i) => {
      const corners = cornersOf(nodes, element);
      const away = this.sight.eye ? scale(subtract(mean(corners), middle), spread) : ([0, 0, 0] as const);
      const moved = corners.map((corner) => add(corner, away));
      const isWorst = i === worst;
      const colour = isWorst ? mix(c.stone, c.active, lit === "worst" ? 0.6 : 0.32) : c.stone;
      return this.#element(moved, colour, isWorst ? c.active : null);
    });
    for (const facet of left) pieces.push(this.#left(facet));
    this.#drawSorted(pieces);
  }

  /** Crosses where choices were refused. */
  drawRefused(refused: readonly Refused[], isLit: boolean): void {
    for (const { at } of refused)
      this.pen.cross(
        this.sight.pixel(at),
        (isLit ? 8 : 5.5) * this.boldness,
        colours().refused,
        isLit ? 3.5 : 2.5,
      );
  }

  #drawSorted(pieces: readonly Piece[]): void {
    for (const { draw } of pieces.toSorted((a, b) => b.depth - a.depth)) draw();
  }

  #piece(corners: readonly Position[], draw: (pixels: readonly Pixel[]) => void): Piece {
    const pixels = corners.map(this.sight.pixel);
    return { depth: this.sight.depth(mean(corners)), draw: () => draw(pixels) };
  }

  /** Empty is cool: what the front encloses. */
  #fillEmpty(board: Board): void {
    const { context } = this.pen;
    loopsOf(board.front).forEach((loop, i) =>
      this.pen.path(board.positions(loop).map(this.sight.pixel), i === 0),
    );
    if (board.front.length === 0) return;
    context.fillStyle = css(colours().void);
    context.fill();
  }

  /** Where the golden point would complete an element. */
  #proposal(corners: readonly Position[], at: Position): void {
    const apex = this.sight.pixel(at);
    for (const corner of corners)
      this.pen.line(this.sight.pixel(corner), apex, colours().new, 1.6 * this.boldness, { dash: [3, 5] });
  }

  #element(corners: readonly Position[], colour: Colour, rim: Colour | null): readonly Piece[] {
    const c = colours();
    const edge = { colour: rim ?? c.edge, width: (rim ? 3 : widths.mesh) * this.boldness };
    const { eye } = this.sight;
    if (!eye) return [this.#piece(corners, (pixels) => this.pen.polygon(pixels, colour, 1, edge))];
    const middle = mean(corners);
    const small = corners.map((corner) => between(middle, corner, shrinking));
    return small.flatMap((apex, i) => {
      const face = small.filter((_corner, k) => k !== i);
      const light = lightOf(face, apex, eye);
      if (light <= 0) return [];
      return [
        this.#piece(face, (pixels) =>
          this.pen.polygon(pixels, mix(c.edge, colour, 0.62 + 0.38 * light), 1, edge),
        ),
      ];
    });
  }

  #facet(corners: readonly Position[], isLit: boolean): Piece {
    const c = colours();
    const width = (isLit ? widths.strong : widths.front) * this.boldness;
    const { eye } = this.sight;
    return this.#piece(corners, (pixels) => {
      const [a, b] = pixels;
      if (!eye) {
        if (a && b) this.pen.line(a, b, c.ink, width);
        for (const pixel of pixels) this.pen.circle(pixel, dotRadius * this.boldness, c.ink);
        return;
      }
      // Seen from the empty side, a face is the wall of the hollow; from behind, it would hide the hollow, and is an outline.
      const isWall = facing(corners, eye) > 0;
      if (isWall) {
        const shade = mix(c.rim, c.hollow, 0.12 + 0.4 * facing(corners, eye));
        this.pen.polygon(pixels, shade, 0.9, { colour: c.ink, width: 0.7 * width });
      } else
        this.pen.polygon(pixels, null, 1, { colour: c.ink, width: 0.7 * width, alpha: isLit ? 0.9 : 0.35 });
    });
  }

  #active(corners: readonly Position[]): void {
    const c = colours();
    const pixels = corners.map(this.sight.pixel);
    if (pixels.length === 3) this.pen.polygon(pixels, c.active, 0.28);
    for (const [a, b] of sidesOf(pixels)) this.pen.glow(a, b, c.active, this.boldness);
  }

  #preview(board: Board, corners: readonly Position[], { at, refused }: Preview): void {
    const c = colours();
    const colour = refused ? c.refused : c.new;
    for (const facet of newFacets(corners, at))
      this.pen.polygon(facet.map(this.sight.pixel), colour, corners.length === 3 ? 0.1 : 0);
    this.pen.polygon([...corners, at].map(this.sight.pixel), colour, corners.length === 2 ? 0.16 : 0);
    const apex = this.sight.pixel(at);
    const dash = refused ? [6, 5] : [];
    for (const corner of corners)
      this.pen.line(this.sight.pixel(corner), apex, colour, 2.4 * this.boldness, { dash });
    for (const facet of refused?.inTheWay ?? [])
      for (const [a, b] of sidesOf(board.positions(facet).map(this.sight.pixel)))
        this.pen.line(a, b, c.refused, 4 * this.boldness);
    if (refused) this.pen.cross(apex, 7, c.refused);
  }

  #left(corners: readonly Position[]): Piece {
    const c = colours();
    return this.#piece(corners, (pixels) => {
      if (pixels.length === 3) this.pen.polygon(pixels, c.refused, 0.16);
      for (const [a, b] of sidesOf(pixels))
        this.pen.line(a, b, c.refused, 3 * this.boldness, { dash: [7, 5] });
      const [a, b] = pixels;
      if (pixels.length === 2 && a && b) this.pen.cross(betweenPixels(a, b, 0.5), 5, c.refused, 2.5);
    });
  }
}

/** Returns the nodes of the closed loops that the sides of a front form in the plane. */
function loopsOf(front: readonly (readonly number[])[]): readonly (readonly number[])[] {
  const left = new Set(front);
  const loops: number[][] = [];
  for (const first of front) {
    if (!left.delete(first)) continue;
    const loop = [...first];
    for (;;) {
      const next = [...left].find(([start]) => start === loop.at(-1));
      if (!next) break;
      left.delete(next);
      loop.push(next[1] ?? 0);
    }
    loops.push(loop);
  }
  return loops;
}

const facing = (corners: readonly Position[], eye: Position): number => {
  const normal = normalOf(corners);
  const [base = eye] = corners;
  const to = subtract(eye, base);
  return (
    (normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2]) / (Math.hypot(...normal) * Math.hypot(...to))
  );
};

/** Returns how much a face of an element is turned to the eye; not above 0 if it is turned away. `apex`: the corner opposite. */
function lightOf(face: readonly Position[], apex: Position, eye: Position): number {
  const towardsApex = facing(face, apex);
  const towardsEye = facing(face, eye);
  return towardsApex > 0 ? -towardsEye : towardsEye;
}
