/**
 * Three structures that answer one question: which nodes are within a circle, or in space within a ball? A list, a tree of cells
 * (quadtree and octree: Löhner & Parikh 1988, second section 6), and a grid of equal cells (as in cpp/src/search/face_grid.h).
 * Each tells what it has looked at, in order.
 */
import type { PlanePoint } from "../../kit/plane-view";

/** A position in the plane or in space: its coordinates. */
export type Point = readonly number[];

/** A circle, or a ball. */
export interface Query<P extends Point = PlanePoint> {
  readonly at: P;
  readonly radius: number;
}

/** An axis-parallel square or cube: its lowest corner and its side. */
export interface Cell<P extends Point = PlanePoint> {
  readonly at: P;
  readonly side: number;
}

/** Something that a search has looked at: a cell, or a node that it has compared. */
export type Visit<P extends Point = PlanePoint> = { readonly cell: Cell<P> } | { readonly node: number };

export interface Answer<P extends Point = PlanePoint> {
  /** Nodes within the query, in ascending order. */
  readonly found: readonly number[];
  readonly visits: readonly Visit<P>[];
}

export interface Structure<P extends Point = PlanePoint> {
  /** Its cells, for display. */
  readonly cells: readonly Cell<P>[];
  find(query: Query<P>): Answer<P>;
}

interface Notes<P extends Point> {
  readonly found: number[];
  readonly visits: Visit<P>[];
}

/** Returns a point whose coordinates are computed from those of another one. */
const mapped = <P extends Point>(point: P, act: (x: number, axis: number) => number): P =>
  point.map(act) as unknown as P;

function isWithin(point: Point, { at, radius }: Query<Point>): boolean {
  let square = 0;
  for (let i = 0; i < at.length; i++) square += ((point[i] ?? NaN) - (at[i] ?? NaN)) ** 2;
  return square <= radius * radius;
}

/** Whether a cell has a point in common with a query. */
function touches({ at: low, side }: Cell<Point>, { at, radius }: Query<Point>): boolean {
  let square = 0;
  for (let i = 0; i < at.length; i++) {
    const [from, x] = [low[i] ?? NaN, at[i] ?? NaN];
    square += Math.max(from - x, 0, x - from - side) ** 2;
  }
  return square <= radius * radius;
}

/** Compares nodes, and notes what it has compared. */
function compare<P extends Point>(
  nodes: readonly P[],
  among: Iterable<number>,
  query: Query<P>,
  into: Notes<P>,
): void {
  for (const node of among) {
    into.visits.push({ node });
    const at = nodes[node];
    if (at && isWithin(at, query)) into.found.push(node);
  }
}

const answer = <P extends Point>({ found, visits }: Notes<P>): Answer<P> => ({
  found: found.sort((a, b) => a - b),
  visits,
});

export class ListSearch<P extends Point> implements Structure<P> {
  readonly cells: readonly Cell<P>[] = [];

  constructor(readonly nodes: readonly P[]) {}

  find(query: Query<P>): Answer<P> {
    const into: Notes<P> = { found: [], visits: [] };
    compare(this.nodes, this.nodes.keys(), query, into);
    return answer(into);
  }
}

/** A cell with more nodes is cut into four, in space into eight. */
const leafNodes = 4;
/** Nodes in one position would be cut forever. */
const maxDepth = 14;

interface Branch<P extends Point> extends Cell<P> {
  readonly nodes: readonly number[];
  readonly children: readonly Branch<P>[];
}

/** A quadtree of nodes in the plane, an octree of nodes in space. */
export class CellTree<P extends Point> implements Structure<P> {
  readonly cells: readonly Cell<P>[];
  /** Cells above each other, at most. */
  readonly depth: number;
  readonly #root: Branch<P>;

  constructor(
    readonly nodes: readonly P[],
    whole: Cell<P>,
  ) {
    const cells: Cell<P>[] = [];
    let depth = 0;
    const branch = (cell: Cell<P>, own: readonly number[], level: number): Branch<P> => {
      cells.push(cell);
      depth = Math.max(depth, level);
      if (own.length <= leafNodes || level >= maxDepth) return { ...cell, nodes: own, children: [] };
      const half = cell.side / 2;
      // A bit per axis: whether a node lies in the upper half.
      const parts: number[][] = Array.from({ length: 2 ** cell.at.length }, () => []);
      for (const node of own)
        parts[
          cell.at.reduce((bits, low, i) => bits + ((nodes[node]?.[i] ?? NaN) >= low + half ? 2 ** i : 0), 0)
        ]?.push(node);
      const children = parts.map((inside, bits) => {
        const at = mapped(cell.at, (low, i) => low + ((bits >> i) % 2 === 1 ? half : 0));
        return branch({ at, side: half }, inside, level + 1);
      });
      return { ...cell, nodes: [], children };
    };
    this.#root = branch(whole, [...nodes.keys()], 1);
    this.cells = cells;
    this.depth = depth;
  }

  find(query: Query<P>): Answer<P> {
    const into: Notes<P> = { found: [], visits: [] };
    const open = (branch: Branch<P>): void => {
      into.visits.push({ cell: branch });
      compare(this.nodes, branch.nodes, query, into);
      // What does not touch the circle is left out, with all that is in it; so is what is empty.
      for (const child of branch.children)
        if ((child.nodes.length > 0 || child.children.length > 0) && touches(child, query)) open(child);
    };
    open(this.#root);
    return answer(into);
  }
}

export class HashGrid<P extends Point> implements Structure<P> {
  readonly cells: readonly Cell<P>[];
  readonly #nodesOf = new Map<string, number[]>();

  /** @param side Side of the cells. */
  constructor(
    readonly nodes: readonly P[],
    readonly side: number,
  ) {
    const cells: Cell<P>[] = [];
    nodes.forEach((at, node) => {
      const index = this.#indexOf(at);
      const key = index.join(" ");
      const own = this.#nodesOf.get(key);
      if (own) own.push(node);
      else {
        this.#nodesOf.set(key, [node]);
        cells.push(this.#cellOf(index));
      }
    });
    this.cells = cells;
  }

  find(query: Query<P>): Answer<P> {
    const into: Notes<P> = { found: [], visits: [] };
    const { at, radius } = query;
    const low = this.#indexOf(mapped(at, (x) => x - radius));
    const high = this.#indexOf(mapped(at, (x) => x + radius));
    const counts = low.map((from, i) => (high[i] ?? from) - from + 1);
    const total = counts.reduce((product, count) => product * count, 1);
    for (let n = 0; n < total; n++) {
      let rest = n;
      const index = mapped(low, (from, i) => {
        const along = rest % (counts[i] ?? 1);
        rest = (rest - along) / (counts[i] ?? 1);
        return from + along;
      });
      const cell = this.#cellOf(index);
      if (!touches(cell, query)) continue;
      into.visits.push({ cell });
      compare(this.nodes, this.#nodesOf.get(index.join(" ")) ?? [], query, into);
    }
    return answer(into);
  }

  /** The formula that leads from a position to its cell. */
  #indexOf(at: P): P {
    return mapped(at, (x) => Math.floor(x / this.side));
  }

  #cellOf(index: P): Cell<P> {
    return { at: mapped(index, (i) => i * this.side), side: this.side };
  }
}

// ---- the front that is searched

/** The front lies in the square from (0, 0) to (1, 1). */
export const whole: Cell = { at: [0, 0], side: 1 };
/** Points in which the curve of the front is measured. */
const samples = 2000;

/** A closed curve with a deep bay, and the size there: small in the bay, large outside. */
function curveAt(t: number): { readonly at: PlanePoint; readonly size: number } {
  const turn = 2 * Math.PI * t;
  const radius =
    0.3 + 0.085 * Math.cos(3 * turn + 0.5) + 0.055 * Math.sin(2 * turn) + 0.03 * Math.cos(5 * turn);
  const at: PlanePoint = [0.5 + 1.12 * radius * Math.cos(turn), 0.48 + 1.12 * radius * Math.sin(turn)];
  const away = Math.hypot(at[0] - 0.24, at[1] - 0.66);
  return { at, size: 0.1 + 0.9 * Math.min(1, away / 0.5) ** 1.4 };
}

/** Returns a front of `count` nodes: the curve is cut where its length in sizes has grown by equal parts, as in lesson 2. */
export function makeFront(count: number): readonly PlanePoint[] {
  const points = Array.from({ length: samples + 1 }, (_none, i) => curveAt(i / samples));
  const grown = [0];
  points.slice(1).forEach(({ at, size }, i) => {
    const from = points[i]?.at ?? at;
    grown.push((grown[i] ?? 0) + Math.hypot(at[0] - from[0], at[1] - from[1]) / size);
  });
  const total = grown[samples] ?? 1;
  let k = 0;
  return Array.from({ length: count }, (_none, node): PlanePoint => {
    const target = (node / count) * total;
    while (k < samples - 1 && (grown[k + 1] ?? 0) <= target) k++;
    const [a, b] = [points[k]?.at ?? [0, 0], points[k + 1]?.at ?? [0, 0]];
    const t = (target - (grown[k] ?? 0)) / ((grown[k + 1] ?? 1) - (grown[k] ?? 0));
    return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
  });
}

export const structureNames = ["list", "quadtree", "grid"] as const;
export type StructureName = (typeof structureNames)[number];

/** Side of the cells of the grid. */
const gridSide = 0.05;

export const structuresOf = (nodes: readonly PlanePoint[]): Readonly<Record<StructureName, Structure>> => ({
  list: new ListSearch(nodes),
  quadtree: new CellTree(nodes, whole),
  grid: new HashGrid(nodes, gridSide),
});
