/** Draws a pocket as a vessel: deep blue inside, its near walls like glass; what is refused is red, what is new is gold. */
import type { Position } from "../../../../document/position";
import { add, cross, dot, mean, scale, subtract, unit } from "../../../../document/vectors";
import { colours, mix, type Colour } from "../../kit/colours";
import { between, widths, type Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel, Stage } from "../../kit/stage";
import type { ConvexBody } from "./kernel";
import {
  edgesOf,
  facesOf,
  type Diagonal,
  type Element,
  type Face,
  type Pair,
  type Pocket,
  type Trial,
} from "./pocket-rules";

/** Where the light comes from. */
const light: Position = unit([-0.55, -0.6, 0.58]) ?? [0, 0, 1];
/** The colour of shadows in both themes. */
const shadow: Colour = [20, 26, 36];
/** Pixels between a corner and its number. */
const nameDistance = 20;
/** How far opened elements move, as a share of the way from the middle of the pocket. */
const opening = 0.75;

export interface DrawnPocket {
  /** In the units of the scene. */
  readonly pocket: Pocket;
  /** Per face whether the node sees it; all if there is no node. */
  readonly seen: readonly boolean[];
  readonly node: Position | null;
  /** Positions that see all faces. */
  readonly kernel: ConvexBody;
  /** 0 to 1: how strongly the kernel is drawn. */
  readonly kernelStrength: number;
  readonly diagonals: readonly Diagonal[];
  /** The tetrahedron that is tried. */
  readonly trial: Trial | null;
  /** Edges drawn as active ones. */
  readonly strong: readonly Pair[];
  readonly lit: string | null;
  readonly areCornersNamed: boolean;
  /** Whether there are many edges, so that all are thin. */
  readonly isFine?: boolean;
}

export interface DrawnElements {
  /** Corners of the pocket and new nodes. */
  readonly positions: readonly Position[];
  readonly elements: readonly Element[];
  /** 0: closed, 1: opened. */
  readonly open: number;
  /** Whether they are newest: gold, and not stone. */
  readonly isNew: boolean;
}

export class PocketDrawing {
  constructor(
    readonly stage: Stage,
    readonly camera: Camera,
    readonly pen: Pen,
  ) {}

  /** Draws a pocket that is still open. */
  drawPocket(drawn: DrawnPocket): void {
    const { pocket, node } = drawn;
    const [far, near] = [true, false].map((isFar) =>
      pocket.faces.flatMap((face, index) => (this.#isFar(pocket, face) === isFar ? [{ face, index }] : [])),
    ) as unknown as readonly [readonly Painted[], readonly Painted[]];
    for (const painted of this.#sorted(pocket, far)) this.#drawWall(drawn, painted, true);
    this.#drawEdges(drawn, false);
    this.#drawDiagonals(drawn);
    if (drawn.kernelStrength > 0) this.#drawKernel(drawn);
    if (drawn.trial) this.#drawTrial(drawn, drawn.trial);
    if (node) this.#drawSpokes(drawn, node);
    for (const painted of this.#sorted(pocket, near)) this.#drawWall(drawn, painted, false);
    this.#drawEdges(drawn, true);
    pocket.faces.forEach((face, index) => {
      if (drawn.seen[index] !== false) return;
      const [size, width] = drawn.isFine ? [4.5, 2] : [7, 3];
      this.pen.cross(this.#pixel(middleOf(pocket, face)), size, colours().refused, width);
    });
    if (drawn.areCornersNamed) this.#nameCorners(pocket);
  }

  /** Draws the elements of a closed pocket, moved apart. */
  drawElements({ positions, elements, open, isNew }: DrawnElements): void {
    const c = colours();
    const corners = (element: Element): readonly Position[] =>
      element.map((corner) => positions[corner] ?? [0, 0, 0]);
    const middle = mean(elements.map((element) => mean(corners(element))));
    const moved = elements.map((element) => {
      const own = corners(element);
      const by = scale(subtract(mean(own), middle), opening * open);
      return own.map((corner) => add(corner, by));
    });
    const depths = moved.map((own) => this.camera.depth(mean(own)));
    const order = moved.map((_own, index) => index).sort((a, b) => (depths[b] ?? 0) - (depths[a] ?? 0));
    for (const index of order) {
      const own = moved[index] ?? [];
      for (const face of facesOf([0, 1, 2, 3])) {
        // Inward faces of an element look away from the eye when they are its near ones.
        const [a, b, d] = face.map((corner) => own[corner] ?? [0, 0, 0]) as [Position, Position, Position];
        const normal = unit(cross(subtract(d, a), subtract(b, a)));
        if (!normal || dot(normal, subtract(this.camera.eye, a)) <= 0) continue;
        const shade = 0.5 + 0.5 * dot(normal, light);
        const base = isNew ? mix(c.new, c.plate, 0.45) : c.stone;
        this.pen.polygon(
          [a, b, d].map((each) => this.#pixel(each)),
          mix(mix(base, shadow, 0.34), base, shade),
          1,
          {
            colour: c.ink,
            width: 1.4,
          },
        );
      }
    }
  }

  #pixel(position: Position): Pixel {
    return this.camera.pixel(position);
  }

  /** Returns whether a wall is seen from its empty side, through the pocket. */
  #isFar({ corners }: Pocket, face: Face): boolean {
    const [a, b, c] = face.map((corner) => corners[corner] ?? [0, 0, 0]) as [Position, Position, Position];
    return dot(cross(subtract(b, a), subtract(c, a)), subtract(this.camera.eye, a)) > 0;
  }

  #sorted(pocket: Pocket, painted: readonly Painted[]): readonly Painted[] {
    const depth = ({ face }: Painted): number => this.camera.depth(middleOf(pocket, face));
    return [...painted].sort((a, b) => depth(b) - depth(a));
  }

  #drawWall({ pocket, seen, lit, isFine }: DrawnPocket, { face, index }: Painted, isFar: boolean): void {
    const c = colours();
    const corners = face.map((corner) => pocket.corners[corner] ?? [0, 0, 0]) as [
      Position,
      Position,
      Position,
    ];
    const normal = unit(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))) ?? [
      0, 0, 1,
    ];
    const shade = 0.5 - 0.5 * dot(normal, light) * (isFar ? -1 : 1);
    const isSeen = seen[index] !== false;
    const deep = isSeen ? c.active : c.refused;
    const fill: Colour = isFar
      ? mix(mix(deep, shadow, 0.3), mix(c.void, deep, 0.36), shade)
      : mix(deep, c.plate, 0.5 * shade);
    const isLit = lit === "walls" || (lit === "ends" && index < 2);
    const pixels = corners.map((corner) => this.#pixel(corner));
    this.pen.polygon(pixels, fill, (isFar ? 0.78 : isSeen ? 0.13 : 0.26) + (isLit ? 0.2 : 0));
    if (isSeen || isFine) return;
    const middle: Pixel = [0, 1].map((i) =>
      pixels.reduce((sum, pixel) => sum + (pixel[i] ?? 0) / 3, 0),
    ) as unknown as Pixel;
    pixels.forEach((pixel, i) =>
      this.pen.line(
        between(pixel, middle, 0.09),
        between(pixels[(i + 1) % 3] ?? pixel, middle, 0.09),
        c.refused,
        1.75,
        {
          dash: [7, 6],
          alpha: isFar ? 0.6 : 0.9,
        },
      ),
    );
  }

  /** Edges of near walls are full, and those behind the pocket thin. */
  #drawEdges({ pocket, strong, lit, isFine }: DrawnPocket, isNear: boolean): void {
    const c = colours();
    const near = new Set(
      pocket.faces
        .filter((face) => !this.#isFar(pocket, face))
        .flatMap((face) => face.map((from, i) => keyOf([from, face[(i + 1) % 3] ?? 0]))),
    );
    for (const edge of edgesOf(pocket)) {
      if (near.has(keyOf(edge)) !== isNear) continue;
      const [from, to] = edge.map((corner) => this.#pixel(pocket.corners[corner] ?? [0, 0, 0])) as [
        Pixel,
        Pixel,
      ];
      const isStrong = strong.some((each) => keyOf(each) === keyOf(edge));
      if (isStrong && lit === "bent") this.pen.glow(from, to, c.active);
      else if (isStrong) this.pen.line(from, to, c.active, isNear ? 4 : 3, { alpha: isNear ? 1 : 0.75 });
      else
        this.pen.line(from, to, c.ink, (isNear ? widths.front : 1.25) * (isFine ? 0.55 : 1), {
          alpha: isNear ? 1 : 0.6,
        });
    }
  }

  #drawDiagonals({ pocket, diagonals, lit }: DrawnPocket): void {
    if (lit !== "missing") return;
    for (const { ends, run } of diagonals) this.#drawDiagonal(pocket, ends, run === "inside");
  }

  #drawDiagonal(pocket: Pocket, ends: Pair, isInside: boolean): void {
    const c = colours();
    const [from, to] = ends.map((corner) => this.#pixel(pocket.corners[corner] ?? [0, 0, 0])) as [
      Pixel,
      Pixel,
    ];
    if (isInside) this.pen.line(from, to, c.new, 4);
    else {
      this.pen.line(from, to, c.refused, 4, { dash: [10, 8] });
      this.pen.cross(between(from, to, 0.5), 8, c.refused, 3.5);
    }
  }

  #drawKernel({ kernel, kernelStrength }: DrawnPocket): void {
    const c = colours();
    for (const polygon of kernel)
      this.pen.polygon(
        polygon.map((corner) => this.#pixel(corner)),
        c.new,
        0.2 * kernelStrength,
        {
          colour: c.new,
          width: 1,
          alpha: 0.75 * kernelStrength,
        },
      );
  }

  #drawTrial({ pocket }: DrawnPocket, { element, verdict, culprits }: Trial): void {
    const c = colours();
    const fits = verdict === "fits";
    const pixels = element.map((corner) => this.#pixel(pocket.corners[corner] ?? [0, 0, 0]));
    for (const face of facesOf([0, 1, 2, 3]))
      this.pen.polygon(
        face.map((corner) => pixels[corner] ?? [0, 0]),
        fits ? c.new : c.refused,
        fits ? 0.3 : 0.14,
        {
          colour: fits ? c.new : c.refused,
          width: widths.front,
          alpha: fits ? 1 : 0.55,
        },
      );
    for (const ends of culprits) this.#drawDiagonal(pocket, ends, false);
  }

  #drawSpokes({ pocket, seen, lit, isFine }: DrawnPocket, node: Position): void {
    const c = colours();
    const at = this.#pixel(node);
    const seesAll = !seen.includes(false);
    const floor = Math.min(...pocket.corners.map((corner) => corner[2]));
    const ground = this.#pixel([node[0], node[1], floor]);
    this.pen.line(at, ground, c.ink, 1, { alpha: 0.35, dash: [2, 4] });
    this.pen.circle(ground, 3, c.ink, { alpha: 0.35 });
    pocket.faces.forEach((face, index) => {
      if (seen[index] === false && !isFine)
        this.pen.line(at, this.#pixel(middleOf(pocket, face)), c.refused, 1.75, { dash: [6, 5], alpha: 0.9 });
    });
    if (seesAll)
      for (const corner of pocket.corners)
        this.pen.line(at, this.#pixel(corner), c.new, lit === "node" ? 4 : 2.5);
    if (lit === "node") this.pen.circle(at, 18, seesAll ? c.new : c.refused, { alpha: 0.3 });
  }

  #nameCorners({ corners }: Pocket): void {
    const middle = this.#pixel(mean(corners));
    corners.forEach((corner, index) => {
      const [x, y] = this.#pixel(corner);
      const size = Math.hypot(x - middle[0], y - middle[1]) || 1;
      const by = nameDistance / size;
      this.stage.label(String(index + 1), [x + (x - middle[0]) * by, y + (y - middle[1]) * by], {
        look: "soft",
      });
    });
  }
}

interface Painted {
  readonly face: Face;
  readonly index: number;
}

const keyOf = ([a, b]: Pair): string => (a < b ? `${a} ${b}` : `${b} ${a}`);

const middleOf = ({ corners }: Pocket, face: Face): Position =>
  mean(face.map((corner) => corners[corner] ?? [0, 0, 0]));
