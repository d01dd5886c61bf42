/**
 * Three structures that answer one question: which nodes are within a circle? A list, a quadtree (Löhner & Parikh 1988, second
 * section 6), and a grid of equal cells (as in cpp/src/search/face_grid.h). Each tells what it has looked at, in order.
 */
import type { PlanePoint } from "../../kit/plane-view";

export interface Circle {
  readonly at: PlanePoint;
  readonly radius: number;
}

/** An axis-parallel square: its lower left corner and its side. */
export interface Cell {
  readonly at: PlanePoint;
  readonly side: number;
}

/** Something that a search has looked at: a cell, or a node that it has compared. */
export type Visit = { readonly cell: Cell } | { readonly node: number };

export interface Answer {
  /** Nodes within the circle, in ascending order. */
  readonly found: readonly number[];
  readonly visits: readonly Visit[];
}

export interface Structure {
  /** Its cells, for display. */
  readonly cells: readonly Cell[];
  find(circle: Circle): Answer;
}

const isWithin = ([x, y]: PlanePoint, { at, radius }: Circle): boolean =>
  (x - at[0]) ** 2 + (y - at[1]) ** 2 <= radius * radius;

/** Whether a cell has a point in common with a circle. */
function touches({ at: [x, y], side }: Cell, { at, radius }: Circle): boolean {
  const away = (low: number, value: number): number => Math.max(low - value, 0, value - low - side);
  return away(x, at[0]) ** 2 + away(y, at[1]) ** 2 <= radius * radius;
}

/** Compares nodes, and notes what it has compared. */
function compare(
  nodes: readonly PlanePoint[],
  among: readonly number[],
  circle: Circle,
  into: { found: number[]; visits: Visit[] },
): void {
  for (const node of among) {
    into.visits.push({ node });
    if (isWithin(nodes[node] ?? [NaN, NaN], circle)) into.found.push(node);
  }
}

const answer = ({ found, visits }: { found: number[]; visits: Visit[] }): Answer => ({
  found: found.sort((a, b) => a - b),
  visits,
});

export class ListSearch implements Structure {
  readonly cells: readonly Cell[] = [];

  constructor(readonly nodes: readonly PlanePoint[]) {}

  find(circle: Circle): Answer {
    const into = { found: [], visits: [] };
    compare(this.nodes, [...this.nodes.keys()], circle, into);
    return answer(into);
  }
}

/** A cell with more nodes is cut into four. */
const leafNodes = 4;
/** Nodes in one position would be cut forever. */
const maxDepth = 14;

interface Branch extends Cell {
  readonly nodes: readonly number[];
  readonly children: readonly Branch[];
}

export class Quadtree implements Structure {
  readonly cells: readonly Cell[];
  /** Cells above each other, at most. */
  readonly depth: number;
  readonly #root: Branch;

  constructor(
    readonly nodes: readonly PlanePoint[],
    whole: Cell,
  ) {
    const cells: Cell[] = [];
    let depth = 0;
    const branch = (cell: Cell, own: readonly number[], level: number): Branch => {
      cells.push(cell);
      depth = Math.max(depth, level);
      if (own.length <= leafNodes || level >= maxDepth) return { ...cell, nodes: own, children: [] };
      const half = cell.side / 2;
      const [left, low] = cell.at;
      const children = [0, 1, 2, 3].map((quarter) => {
        const [right, up] = [quarter % 2 === 1, quarter >= 2];
        const inside = own.filter((node) => {
          const [x, y] = nodes[node] ?? [NaN, NaN];
          return x >= left + half === right && y >= low + half === up;
        });
        const at: PlanePoint = [left + (right ? half : 0), low + (up ? half : 0)];
        return branch({ at, side: half }, inside, level + 1);
      });
      return { ...cell, nodes: [], children };
    };
    this.#root = branch(whole, [...nodes.keys()], 1);
    this.cells = cells;
    this.depth = depth;
  }

  find(circle: Circle): Answer {
    const into: { found: number[]; visits: Visit[] } = { found: [], visits: [] };
    const open = (branch: Branch): void => {
      into.visits.push({ cell: branch });
      compare(this.nodes, branch.nodes, circle, into);
      // What does not touch the circle is left out, with all that is in it; so is what is empty.
      for (const child of branch.children)
        if ((child.nodes.length > 0 || child.children.length > 0) && touches(child, circle)) open(child);
    };
    open(this.#root);
    return answer(into);
  }
}

export class HashGrid implements Structure {
  readonly cells: readonly Cell[];
  readonly #nodesOf = new Map<string, number[]>();

  /** @param side Side of the cells. */
  constructor(
    readonly nodes: readonly PlanePoint[],
    readonly side: number,
  ) {
    nodes.forEach((at, node) => {
      const key = this.#keyOf(this.#indexOf(at));
      const own = this.#nodesOf.get(key);
      if (own) own.push(node);
      else this.#nodesOf.set(key, [node]);
    });
    this.cells = [...this.#nodesOf.keys()].map((key) =>
      this.#cellOf(key.split(" ").map(Number) as [number, number]),
    );
  }

  find(circle: Circle): Answer {
    const into: { found: number[]; visits: Visit[] } = { found: [], visits: [] };
    const { at, radius } = circle;
    const low = this.#indexOf([at[0] - radius, at[1] - radius]);
    const high = this.#indexOf([at[0] + radius, at[1] + radius]);
    for (let j = low[1]; j <= high[1]; j++)
      for (let i = low[0]; i <= high[0]; i++) {
        const cell = this.#cellOf([i, j]);
        if (!touches(cell, circle)) continue;
        into.visits.push({ cell });
        compare(this.nodes, this.#nodesOf.get(this.#keyOf([i, j])) ?? [], circle, into);
      }
    return answer(into);
  }

  /** The formula that leads from a position to its cell. */
  #indexOf([x, y]: PlanePoint): PlanePoint {
    return [Math.floor(x / this.side), Math.floor(y / this.side)];
  }

  #keyOf([i, j]: PlanePoint): string {
    return `${i} ${j}`;
  }

  #cellOf([i, j]: PlanePoint): Cell {
    return { at: [i * this.side, j * this.side], side: this.side };
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
  quadtree: new Quadtree(nodes, whole),
  grid: new HashGrid(nodes, gridSide),
});
