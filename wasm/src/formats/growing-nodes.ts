/** Nodes of a surface to which more are added; one that is added near another added one is the same. */
import { lengthOf, minus, pointOf, type Vector } from "../base/vectors.js";

export class GrowingNodes {
  readonly #given: Float64Array;
  readonly #added: Vector[] = [];
  readonly #cells = new Map<string, number[]>();
  readonly #tolerance: number;

  constructor(given: Float64Array, tolerance: number) {
    this.#given = given;
    this.#tolerance = tolerance;
  }

  get count(): number {
    return this.#given.length / 3 + this.#added.length;
  }

  positionOf(node: number): Vector {
    const first = this.#given.length / 3;
    return node < first ? pointOf(this.#given, node) : (this.#added[node - first] ?? [0, 0, 0]);
  }

  /** Returns the node added within the tolerance, or a new one. */
  add(position: Vector): number {
    const cell = position.map((x) => Math.floor(x / (2 * this.#tolerance)));
    for (const key of keysAround(cell)) {
      for (const node of this.#cells.get(key) ?? []) {
        if (lengthOf(minus(this.positionOf(node), position)) <= this.#tolerance) return node;
      }
    }
    const node = this.count;
    this.#added.push(position);
    const key = cell.join();
    this.#cells.set(key, [...(this.#cells.get(key) ?? []), node]);
    return node;
  }

  /** Returns x y z of all nodes. */
  all(): Float64Array {
    const points = new Float64Array(3 * this.count);
    points.set(this.#given);
    this.#added.forEach((position, i) => points.set(position, this.#given.length + 3 * i));
    return points;
  }
}

function keysAround(cell: readonly number[]): string[] {
  return cell
    .reduce<number[][]>((all, x) => all.flatMap((key) => [-1, 0, 1].map((step) => [...key, x + step])), [[]])
    .map((key) => key.join());
}
