import type { Position } from "./position";
import { distance } from "./vectors";

interface Entry<Value> {
  readonly position: Position;
  readonly value: Value;
}

/** Finds points within a tolerance of a position, in a hash grid. Among several, the first one added. */
export class PointIndex<Value> {
  /** By the hash of the cell, which cells far from each other may share. */
  readonly #cells = new Map<number, Entry<Value>[]>();
  readonly #tolerance: number;

  /** The tolerance is a length above 0. */
  constructor(tolerance: number) {
    this.#tolerance = tolerance;
  }

  add(position: Position, value: Value): void {
    const key = this.#key(position, 0, 0, 0);
    const cell = this.#cells.get(key);
    if (cell) cell.push({ position, value });
    else this.#cells.set(key, [{ position, value }]);
  }

  find(position: Position): Value | undefined {
    const reach = this.#tolerance;
    let last: number | undefined;
    // The cells that a ball around the position may reach: mostly one.
    for (const x of [-reach, reach])
      for (const y of [-reach, reach])
        for (const z of [-reach, reach]) {
          const key = this.#key(position, x, y, z);
          if (key === last) continue;
          last = key;
          const found = this.#cells.get(key)?.find((entry) => distance(entry.position, position) <= reach);
          if (found) return found.value;
        }
    return undefined;
  }

  #key([px, py, pz]: Position, x: number, y: number, z: number): number {
    const size = 4 * this.#tolerance;
    const [i, j, k] = [Math.floor((px + x) / size), Math.floor((py + y) / size), Math.floor((pz + z) / size)];
    return Math.imul(i, 73856093) ^ Math.imul(j, 19349663) ^ Math.imul(k, 83492791);
  }
}
