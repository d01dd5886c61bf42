/** Draws a pocket as an open vessel: its far walls matte, deeper blue the farther away; what is refused is hatched, what is new is gold. */
import type { Position } from "../../../../document/position";
import { add, cross, dot, mean, scale, subtract } from "../../../../document/vectors";
import { colours, mix } from "../../kit/colours";
import { depthColour, hatch, lit, looksTo, paint, softShadow, type Facet } from "../../kit/matte";
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
    softShadow(
      this.pen,
      this.camera,
      pocket.faces.map((face) => this.#cornersOf(pocket, face)),
    );
    for (const painted of this.#sorted(pocket, far)) this.#drawWall(drawn, painted, true);
    this.#drawEdges(drawn, false);
    this.#drawDiagonals(drawn);
    if (drawn.kernelStrength > 0) this.#drawKernel(drawn);
    if (drawn.trial) this.#drawTrial(drawn, drawn.trial);
    if (node) this.#drawSpokes(drawn, node);
    for (const painted of this.#sorted(pocket, near)) this.#drawWall(drawn, painted, false);
    this.#drawEdges(drawn, true);
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
    const base = isNew ? mix(c.new, c.plate, 0.35) : c.rock;
    const facets = moved.flatMap((own) =>
      facesOf([0, 1, 2, 3]).flatMap((face): Facet[] => {
        // Inward faces of an element look away from the eye when they are its near ones.
        const [a, b, d] = face.map((corner) => own[corner] ?? [0, 0, 0]) as [Position, Position, Position];
        if (!looksTo([a, d, b], this.camera.eye)) return [];
        const colour = lit(base, [a, d, b], this.camera.eye);
        return [{ corners: [a, d, b], colour, edge: { colour: c.groove, width: 1.4 } }];
      }),
    );
    softShadow(
      this.pen,
      this.camera,
      facets.map(({ corners: own }) => own),
      Math.min(0, ...moved.flat().map(([, , z]) => z)),
    );
    paint(this.pen, this.camera, facets);
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

  #cornersOf(pocket: Pocket, face: Face): readonly [Position, Position, Position] {
    return face.map((corner) => pocket.corners[corner] ?? [0, 0, 0]) as unknown as readonly [
      Position,
      Position,
      Position,
    ];
  }

  /** Far walls are opaque. Near ones are open, so that one looks inside; those that are not seen are hatched. */
  #drawWall({ pocket, seen, lit: part }: DrawnPocket, { face, index }: Painted, isFar: boolean): void {
    const c = colours();
    const corners = this.#cornersOf(pocket, face);
    const isSeen = seen[index] !== false;
    const isLit = part === "walls" || (part === "ends" && index < 2);
    const pixels = corners.map((corner) => this.#pixel(corner));
    if (isFar) {
      const depth = this.#depthOf(pocket, middleOf(pocket, face));
      const base = isSeen ? depthColour(1.1 * depth - (isLit ? 0.3 : 0.02)) : mix(c.refused, c.plate, 0.5);
      this.pen.polygon(pixels, lit(base, corners, this.camera.eye));
    } else if (isLit) this.pen.polygon(pixels, c.active, 0.3);
    if (!isSeen) hatch(this.pen, pixels, c.refused, isFar ? 0.55 : 0.9);
  }

  /** Returns 0 for what is nearest of a pocket, 1 for what is farthest. */
  #depthOf({ corners }: Pocket, position: Position): number {
    const depths = corners.map((corner) => this.camera.depth(corner));
    const [near, far] = [Math.min(...depths), Math.max(...depths)];
    return (this.camera.depth(position) - near) / (far - near || 1);
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
    this.pen.context.globalAlpha = kernelStrength;
    const facets = kernel.map((corners): Facet => ({
      corners,
      colour: lit(mix(c.new, c.plate, 0.3), corners, this.camera.eye),
      edge: { colour: c["new-text"], width: 1.25 },
    }));
    paint(this.pen, this.camera, facets);
    this.pen.context.globalAlpha = 1;
  }

  #drawTrial({ pocket }: DrawnPocket, { element, verdict, culprits }: Trial): void {
    const c = colours();
    const fits = verdict === "fits";
    const own = element.map((corner): Position => pocket.corners[corner] ?? [0, 0, 0]);
    const base = fits ? mix(c.new, c.plate, 0.35) : mix(c.refused, c.plate, 0.62);
    const facets = facesOf([0, 1, 2, 3]).map((face): Facet => {
      const corners = face.map((corner): Position => own[corner] ?? [0, 0, 0]);
      const edge = { colour: fits ? c.groove : c.refused, width: widths.front };
      return { corners, colour: lit(base, corners, this.camera.eye), edge };
    });
    paint(this.pen, this.camera, facets);
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
      if (seen[index] !== false || isFine) return;
      const to = this.#pixel(middleOf(pocket, face));
      this.pen.line(at, to, c.refused, 1.75, { dash: [6, 5], alpha: 0.9 });
      this.pen.cross(to, 6, c.refused, 3);
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
        look: "soft plate",
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
