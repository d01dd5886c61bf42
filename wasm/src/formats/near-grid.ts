/** Finds points near a position: a grid of cells, hashed into a table of chains. */
import { type Steps, stepwise } from "../base/steps.js";

const NONE = 0xffffffff;
/** Side of a cell / reach: most searches visit a few cells, and few points out of reach. */
const CELL = 4;

/** Distance along each axis. */
export type Reach = readonly [number, number, number];

export class NearGrid {
  readonly #points: Float64Array;
  readonly #cell: Reach;
  readonly #heads: Uint32Array;
  /** The next point of the same chain. */
  readonly #next: Uint32Array;

  private constructor(points: Float64Array, cell: Reach) {
    const count = points.length / 3;
    this.#points = points;
    this.#cell = cell;
    this.#heads = new Uint32Array(2 ** Math.ceil(Math.log2(Math.max(2, count)))).fill(NONE);
    this.#next = new Uint32Array(count).fill(NONE);
  }

  /** Makes a grid of these nodes, by default all. `reach`: largest distance of near points along each axis. O(n). */
  static *of(points: Float64Array, reach: Reach, nodes?: Uint32Array): Steps<NearGrid> {
    const grid = new NearGrid(points, [CELL * reach[0], CELL * reach[1], CELL * reach[2]]);
    yield* stepwise(nodes?.length ?? points.length / 3, (i) => grid.#add(nodes?.[i] ?? i));
    return grid;
  }

  /** Calls `visit` with each other point of the grid in the cells within `reach` of point p, until it returns false. */
  near(p: number, reach: Reach, visit: (other: number) => boolean): void {
    const [x = 0, y = 0, z = 0] = this.#points.subarray(3 * p, 3 * p + 3);
    const [iEnd, jEnd, kEnd] = this.#cellAt(x + reach[0], y + reach[1], z + reach[2]);
    const [iBegin, jBegin, kBegin] = this.#cellAt(x - reach[0], y - reach[1], z - reach[2]);
    for (let i = iBegin; i <= iEnd; i++) {
      for (let j = jBegin; j <= jEnd; j++) {
        for (let k = kBegin; k <= kEnd; k++) {
          if (!this.#visit(i, j, k, p, visit)) return;
        }
      }
    }
  }

  #visit(i: number, j: number, k: number, p: number, visit: (other: number) => boolean): boolean {
    for (let q = this.#heads[this.#slotOf(i, j, k)] ?? NONE; q !== NONE; q = this.#next[q] ?? NONE) {
      if (q === p) continue;
      // Other cells may have the same slot.
      const [x, y, z] = this.#cellOf(q);
      if (x === i && y === j && z === k && !visit(q)) return false;
    }
    return true;
  }

  #add(p: number): void {
    const slot = this.#slotOf(...this.#cellOf(p));
    this.#next[p] = this.#heads[slot] ?? NONE;
    this.#heads[slot] = p;
  }

  #cellOf(p: number): [number, number, number] {
    return this.#cellAt(this.#points[3 * p] ?? 0, this.#points[3 * p + 1] ?? 0, this.#points[3 * p + 2] ?? 0);
  }

  #cellAt(x: number, y: number, z: number): [number, number, number] {
    return [Math.floor(x / this.#cell[0]), Math.floor(y / this.#cell[1]), Math.floor(z / this.#cell[2])];
  }

  #slotOf(x: number, y: number, z: number): number {
    let h = Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35);
    h ^= h >>> 15;
    return (Math.imul(h, 0x2c1b3c6d) >>> 7) & (this.#heads.length - 1);
  }
}
