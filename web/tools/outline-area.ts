import type { ScreenPoint } from "../viewer/screen";

/** A box on the screen. */
export interface ScreenBox {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Where something lies: inside the outline, outside of it, or perhaps both. */
export type Place = "inside" | "outside" | "mixed";

/** Points of an outline that are nearer to the way between their neighbours say nothing more, in CSS pixels. */
const tolerance = 0.25;
/** Largest number of cells in each direction. */
const maxCells = 128;

/** An edge of the outline. */
interface Edge {
  readonly from: ScreenPoint;
  readonly to: ScreenPoint;
}

/**
 * The inside of a closed outline. A coarse grid over its box knows which cells lie wholly inside or outside, and which edges
 * run through the others: a question takes a time that hardly depends on the number of points of a lasso.
 */
export class OutlineArea {
  readonly box: ScreenBox;
  /** Number of pairs of segments that were compared: the cost of the answers. */
  comparisons = 0;
  readonly #edges: readonly Edge[];
  readonly #count: number;
  readonly #width: number;
  readonly #height: number;
  /** Edges that may run through a cell, by cell, row by row. */
  readonly #through: readonly (readonly Edge[])[];
  /** Edges that a row of cells may contain a part of. */
  readonly #rows: readonly (readonly Edge[])[];
  readonly #places: readonly Place[];

  constructor(points: readonly ScreenPoint[]) {
    const outline = simplified(points);
    this.#edges = outline.map((from, i) => ({ from, to: outline[(i + 1) % outline.length] ?? from }));
    this.box = boxAround(outline);
    this.#count = Math.max(1, Math.min(maxCells, Math.ceil(Math.sqrt(4 * outline.length))));
    this.#width = (this.box.right - this.box.left) / this.#count || 1;
    this.#height = (this.box.bottom - this.box.top) / this.#count || 1;
    const cells = Array.from({ length: this.#count ** 2 }, (): Edge[] => []);
    const rows = Array.from({ length: this.#count }, (): Edge[] => []);
    for (const edge of this.#edges) {
      const [top, bottom] = this.#rowRange(boxAround([edge.from, edge.to]));
      for (let row = top; row <= bottom; ++row) rows[row]?.push(edge);
      this.#visitCells(edge.from, edge.to, (cell) => cells[cell]?.push(edge));
    }
    this.#rows = rows;
    this.#through = cells;
    this.#places = cells.map((edges, cell) => {
      if (edges.length > 0) return "mixed";
      const x = this.box.left + ((cell % this.#count) + 0.5) * this.#width;
      const y = this.box.top + (Math.floor(cell / this.#count) + 0.5) * this.#height;
      return this.#isInsideByRow({ x, y }) ? "inside" : "outside";
    });
  }

  /** Returns whether a point lies inside. */
  contains(at: ScreenPoint): boolean {
    const { left, right, top, bottom } = this.box;
    if (at.x < left || at.x > right || at.y < top || at.y > bottom) return false;
    const place = this.#places[this.#column(at.x) + this.#count * this.#row(at.y)];
    return place === "mixed" ? this.#isInsideByRow(at) : place === "inside";
  }

  /** Returns whether a segment crosses the outline. */
  crosses(a: ScreenPoint, b: ScreenPoint): boolean {
    const { left, right, top, bottom } = this.box;
    if (Math.max(a.x, b.x) < left || Math.min(a.x, b.x) > right) return false;
    if (Math.max(a.y, b.y) < top || Math.min(a.y, b.y) > bottom) return false;
    let isCrossed = false;
    this.#visitCells(a, b, (cell) => {
      if (isCrossed) return;
      const edges = this.#through[cell] ?? [];
      this.comparisons += edges.length;
      isCrossed = edges.some(({ from, to }) => segmentsCross(a, b, from, to));
    });
    return isCrossed;
  }

  /** Returns where all that appears within a box lies. */
  placeOf(box: ScreenBox): Place {
    const { left, right, top, bottom } = this.box;
    if (box.right < left || box.left > right || box.bottom < top || box.top > bottom) return "outside";
    const [firstRow, lastRow] = this.#rowRange(box);
    const [first, last] = [this.#column(box.left), this.#column(box.right)];
    const place = this.#places[first + this.#count * firstRow] ?? "mixed";
    for (let row = firstRow; row <= lastRow; ++row)
      for (let column = first; column <= last; ++column)
        if (this.#places[column + this.#count * row] !== place) return "mixed";
    const isCovered = box.left >= left && box.right <= right && box.top >= top && box.bottom <= bottom;
    return place === "inside" && !isCovered ? "mixed" : place;
  }

  #column(x: number): number {
    return clamped(Math.floor((x - this.box.left) / this.#width), this.#count);
  }

  #row(y: number): number {
    return clamped(Math.floor((y - this.box.top) / this.#height), this.#count);
  }

  #rowRange({ top, bottom }: ScreenBox): readonly [number, number] {
    return [this.#row(top), this.#row(bottom)];
  }

  /** Calls `visit` with each cell that a segment may run through, also those beside its way by rounding. */
  #visitCells(a: ScreenPoint, b: ScreenPoint, visit: (cell: number) => void): void {
    const [upper, lower] = a.y <= b.y ? [a, b] : [b, a];
    const slope = lower.y > upper.y ? (lower.x - upper.x) / (lower.y - upper.y) : 0;
    const [first, last] = [this.#row(upper.y), this.#row(lower.y)];
    const slack = 1e-9 * (Math.abs(a.x) + Math.abs(b.x) + this.#width);
    for (let row = first; row <= last; ++row) {
      // The part of the segment within the row, from its upper to its lower end.
      const from = row === first ? upper.x : upper.x + slope * (this.box.top + row * this.#height - upper.y);
      const to =
        row === last ? lower.x : upper.x + slope * (this.box.top + (row + 1) * this.#height - upper.y);
      const begin = this.#column(Math.min(from, to) - slack);
      const end = this.#column(Math.max(from, to) + slack);
      for (let column = begin; column <= end; ++column) visit(column + this.#count * row);
    }
  }

  /** Counts the edges to the right of a point, among those of its row. */
  #isInsideByRow({ x, y }: ScreenPoint): boolean {
    const edges = this.#rows[this.#row(y)] ?? [];
    this.comparisons += edges.length;
    let isInside = false;
    for (const { from, to } of edges) {
      const isAtHeight = from.y > y !== to.y > y;
      if (isAtHeight && x < from.x + ((y - from.y) / (to.y - from.y)) * (to.x - from.x)) isInside = !isInside;
    }
    return isInside;
  }
}

const clamped = (index: number, count: number): number => Math.max(0, Math.min(count - 1, index));

/** Returns the box around points of the screen. */
export function boxAround(points: Iterable<ScreenPoint>): ScreenBox {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { x, y } of points) {
    left = Math.min(left, x);
    top = Math.min(top, y);
    right = Math.max(right, x);
    bottom = Math.max(bottom, y);
  }
  return { left, top, right, bottom };
}

/** Leaves out points that lie almost on the way from the last one kept to the next. */
function simplified(points: readonly ScreenPoint[]): readonly ScreenPoint[] {
  const kept: ScreenPoint[] = [];
  let skipped: ScreenPoint[] = [];
  points.forEach((point, i) => {
    const [last, next] = [kept.at(-1), points[i + 1]];
    const isNeeded = !last || !next || [...skipped, point].some((one) => isBeside(one, last, next));
    // A slow drag makes many points within one pixel; a long list of skipped ones would make this slow.
    if (isNeeded || skipped.length === 32) {
      kept.push(point);
      skipped = [];
    } else skipped.push(point);
  });
  return kept;
}

/** Returns whether a point is away from the segment between two others. */
function isBeside(point: ScreenPoint, a: ScreenPoint, b: ScreenPoint): boolean {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const along = (point.x - a.x) * dx + (point.y - a.y) * dy;
  const share = Math.min(1, Math.max(0, along / (dx * dx + dy * dy) || 0));
  return Math.hypot(a.x + share * dx - point.x, a.y + share * dy - point.y) > tolerance;
}

function segmentsCross(a: ScreenPoint, b: ScreenPoint, c: ScreenPoint, d: ScreenPoint): boolean {
  return side(a, b, c) !== side(a, b, d) && side(c, d, a) !== side(c, d, b);
}

/** Returns whether c lies to the left of the way from a to b. */
const side = (a: ScreenPoint, b: ScreenPoint, c: ScreenPoint): boolean =>
  (b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x);
