/** Exact welding: points with the same three coordinates become one. There is no tolerance; -0 equals 0. */
import { type Steps, stepwise } from "../base/steps.js";
import { tooManyNumbers } from "./read-result.js";

/** Indices are 32-bit numbers; this one means "none". */
const EMPTY = 0xffffffff;
/** Tables grow independently, so that a single growth never takes long, however many points there are. */
const TABLE_BITS = 8;
const MIN_SLOTS = 8;
const PAGE_BITS = 12;
const PAGE = 1 << PAGE_BITS;

/** Welds points while they arrive. O(1) expected per point: open addressing by the bits of the coordinates. */
export class PointWelder {
  /** x y z of point p in page p >> PAGE_BITS. */
  readonly #pages: Float64Array[] = [];
  #count = 0;
  /** The highest bits of a point's hash select the table, the lowest ones the slot. */
  readonly #tables: Uint32Array[] = [];
  readonly #filled = new Uint32Array(1 << TABLE_BITS);
  readonly #key = new Float64Array(3);
  readonly #bits = new Uint32Array(this.#key.buffer);

  /** Number of different points so far. */
  get count(): number {
    return this.#count;
  }

  /** Returns the index of this finite point among the different ones, in order of first appearance. */
  add(givenX: number, givenY: number, givenZ: number): number {
    // Adding 0 turns -0 into 0 and keeps every other value.
    const [x, y, z] = [givenX + 0, givenY + 0, givenZ + 0];
    const hash = this.#hash(x, y, z);
    const t = hash >>> (32 - TABLE_BITS);
    const table = this.#tables[t] ?? this.#newTable(t, MIN_SLOTS);
    const mask = table.length - 1;
    for (let slot = hash & mask; ; slot = (slot + 1) & mask) {
      const known = table[slot] ?? EMPTY;
      if (known === EMPTY) {
        table[slot] = this.#count;
        const filled = (this.#filled[t] ?? 0) + 1;
        this.#filled[t] = filled;
        this.#append(x, y, z);
        if (2 * filled > table.length) this.#grow(t, table);
        return this.#count - 1;
      }
      const page = this.#pages[known >>> PAGE_BITS];
      const at = 3 * (known & (PAGE - 1));
      if (page?.[at] === x && page[at + 1] === y && page[at + 2] === z) return known;
    }
  }

  /** Returns x y z of the different points; no point can be added afterwards. */
  taken(): Float64Array {
    this.#tables.length = 0;
    const length = 3 * this.#count;
    const points = new Float64Array(length);
    let at = 0;
    for (let page = this.#pages.shift(); page !== undefined; page = this.#pages.shift()) {
      points.set(page.subarray(0, Math.min(page.length, length - at)), at);
      at += page.length;
    }
    return points;
  }

  #append(x: number, y: number, z: number): void {
    const at = 3 * (this.#count & (PAGE - 1));
    if (at === 0) this.#newPage();
    const page = this.#pages[this.#count >>> PAGE_BITS];
    if (page === undefined) return;
    page[at] = x;
    page[at + 1] = y;
    page[at + 2] = z;
    this.#count++;
  }

  #newPage(): void {
    // Coordinates are addressed by 32-bit indices too.
    if (3 * (this.#count + PAGE) > EMPTY) throw tooManyNumbers(EMPTY);
    this.#pages.push(new Float64Array(3 * PAGE));
  }

  #newTable(t: number, slots: number): Uint32Array {
    return (this.#tables[t] = new Uint32Array(slots).fill(EMPTY));
  }

  #grow(t: number, full: Uint32Array): void {
    const table = this.#newTable(t, 2 * full.length);
    const mask = table.length - 1;
    for (const point of full) {
      if (point === EMPTY) continue;
      const page = this.#pages[point >>> PAGE_BITS];
      const at = 3 * (point & (PAGE - 1));
      let slot = this.#hash(page?.[at] ?? 0, page?.[at + 1] ?? 0, page?.[at + 2] ?? 0) & mask;
      while (table[slot] !== EMPTY) slot = (slot + 1) & mask;
      table[slot] = point;
    }
  }

  #hash(x: number, y: number, z: number): number {
    this.#key[0] = x;
    this.#key[1] = y;
    this.#key[2] = z;
    let h = 0x811c9dc5;
    for (let i = 0; i < 6; i++) {
      h = Math.imul(h ^ (this.#bits[i] ?? 0), 0x9e3779b1);
      h ^= h >>> 15;
    }
    return h >>> 0;
  }
}

export interface WeldedPoints {
  /** x y z of the different points, in order of first appearance. */
  readonly points: Float64Array;
  /** Per given point: its index in `points`. */
  readonly indices: Uint32Array;
}

/** Welds x y z triples. O(n) expected. */
export function* weldPoints(given: Float64Array): Steps<WeldedPoints> {
  const welder = new PointWelder();
  const indices = new Uint32Array(given.length / 3);
  yield* stepwise(indices.length, (i) => {
    indices[i] = welder.add(given[3 * i] ?? 0, given[3 * i + 1] ?? 0, given[3 * i + 2] ?? 0);
  });
  return { points: welder.taken(), indices };
}
