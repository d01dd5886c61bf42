import type { Position } from "./position";
import { distance } from "./vectors";

/** Finds points within a tolerance of a position, in a hash grid. Among several, the first one added. */
export class PointIndex<Value> {
  readonly #cells = new Map<string, { readonly position: Position; readonly value: Value }[]>();
  readonly #tolerance: number;
  readonly #cellSize: number;

  /** The tolerance is a length above 0. */
  constructor(tolerance: number) {
    this.#tolerance = tolerance;
    this.#cellSize = 4 * tolerance;
  }

  add(position: Position, value: Value): void {
    const key = this.#key(position);
    const cell = this.#cells.get(key);
    if (cell) cell.push({ position, value });
    else this.#cells.set(key, [{ position, value }]);
  }

  find(position: Position): Value | undefined {
    for (const key of this.#keysAround(position)) {
      const found = this.#cells
        .get(key)
        ?.find((entry) => distance(entry.position, position) <= this.#tolerance);
      if (found) return found.value;
    }
    return undefined;
  }

  #key(position: Position): string {
    return position.map((x) => Math.floor(x / this.#cellSize)).join(" ");
  }

  /** The keys of the cells that a ball around the position may reach: mostly one. */
  #keysAround(position: Position): ReadonlySet<string> {
    const reach = this.#tolerance;
    const keys = new Set<string>();
    for (const x of [-reach, reach])
      for (const y of [-reach, reach])
        for (const z of [-reach, reach])
          keys.add(this.#key([position[0] + x, position[1] + y, position[2] + z]));
    return keys;
  }
}
