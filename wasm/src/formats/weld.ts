/** Exact welding: points with the same three coordinates become one. No tolerance; -0 equals 0. */
import { Column } from "./column.js";

const EMPTY = 0xffffffff;
const FEWEST_SLOTS = 16;

/** Welds points while they arrive. O(1) expected for each: open addressing over the bits of the coordinates. */
export class PointWelder {
  readonly #points = new Column(Float64Array);
  #table = new Uint32Array(FEWEST_SLOTS).fill(EMPTY);
  #count = 0;
  readonly #key = new Float64Array(3);
  readonly #bits = new Uint32Array(this.#key.buffer);

  /** The number of different points so far. */
  get count(): number {
    return this.#count;
  }

  /** The position of this finite point among the different ones, in order of first appearance. */
  add(x: number, y: number, z: number): number {
    // Adding 0 turns -0 into 0 and leaves every other value alone.
    const slot = this.#slotOf(x + 0, y + 0, z + 0);
    const known = this.#table[slot] ?? EMPTY;
    if (known !== EMPTY) return known;
    const position = this.#count++;
    this.#table[slot] = position;
    this.#points.push(x + 0);
    this.#points.push(y + 0);
    this.#points.push(z + 0);
    if (2 * this.#count > this.#table.length) this.#grow();
    return position;
  }

  /** x y z of the different points; nothing can be added afterwards. */
  taken(): Float64Array {
    this.#table = new Uint32Array(FEWEST_SLOTS).fill(EMPTY);
    this.#count = 0;
    return this.#points.taken();
  }

  /** Where in the table the point is, or else belongs. */
  #slotOf(x: number, y: number, z: number): number {
    const points = this.#points;
    const mask = this.#table.length - 1;
    for (let slot = this.#hash(x, y, z) & mask; ; slot = (slot + 1) & mask) {
      const known = this.#table[slot] ?? EMPTY;
      if (known === EMPTY) return slot;
      const at = 3 * known;
      if (points.at(at) === x && points.at(at + 1) === y && points.at(at + 2) === z) return slot;
    }
  }

  #grow(): void {
    const points = this.#points;
    this.#table = new Uint32Array(2 * this.#table.length).fill(EMPTY);
    for (let p = 0; p < this.#count; p++) {
      this.#table[this.#slotOf(points.at(3 * p), points.at(3 * p + 1), points.at(3 * p + 2))] = p;
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
  /** Per given point: its position in `points`. */
  readonly positions: Uint32Array;
}

/** Welds x y z triples. O(n) expected. */
export function weldPoints(given: Float64Array): WeldedPoints {
  const welder = new PointWelder();
  const positions = new Uint32Array(given.length / 3);
  for (let i = 0; i < positions.length; i++) {
    positions[i] = welder.add(given[3 * i] ?? 0, given[3 * i + 1] ?? 0, given[3 * i + 2] ?? 0);
  }
  return { points: welder.taken(), positions };
}
