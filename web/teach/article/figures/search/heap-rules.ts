/** A binary heap of the sides of a front, the shortest on top, that notes its comparisons; and a front that takes from it. */
import type { PlaneFront } from "tetrafront/trace";
import type { PlanePoint } from "../../kit/plane-view";
import { filmOf, type FrontFilm } from "../front/front-film";

/** An entry: a side of the front, and how often its candidates were all refused, which counts first. */
export interface Entry {
  readonly side: number;
  readonly pass: number;
  readonly length: number;
}

const isBefore = (a: Entry, b: Entry): boolean =>
  a.pass !== b.pass ? a.pass < b.pass : a.length !== b.length ? a.length < b.length : a.side < b.side;

export class Heap {
  readonly #entries: Entry[] = [];
  comparisons = 0;

  /** The sides by their slots: slot i has the slots 2 i + 1 and 2 i + 2 below it. */
  get slots(): readonly number[] {
    return this.#entries.map(({ side }) => side);
  }

  get size(): number {
    return this.#entries.length;
  }

  get top(): Entry | undefined {
    return this.#entries[0];
  }

  push(entry: Entry): void {
    this.#entries.push(entry);
    this.#rise(this.size - 1);
  }

  /** Takes a slot out: the last entry comes into its place. */
  lift(side: number): number | null {
    const slot = this.#entries.findIndex((entry) => entry.side === side);
    const last = this.#entries.at(-1);
    if (slot < 0 || !last) return null;
    this.#entries.pop();
    if (last.side === side) return null;
    this.#entries[slot] = last;
    return slot;
  }

  /** Brings the entry of a slot to where it belongs. */
  settle(slot: number): void {
    if (this.#rise(slot) === slot) this.#sink(slot);
  }

  remove(side: number): void {
    const slot = this.lift(side);
    if (slot !== null) this.settle(slot);
  }

  #isBefore(a: number, b: number): boolean {
    const [first, second] = [this.#entries[a], this.#entries[b]];
    this.comparisons++;
    return first !== undefined && second !== undefined && isBefore(first, second);
  }

  #swap(a: number, b: number): void {
    const [first, second] = [this.#entries[a], this.#entries[b]];
    if (first && second) [this.#entries[a], this.#entries[b]] = [second, first];
  }

  #rise(slot: number): number {
    let at = slot;
    while (at > 0) {
      const above = (at - 1) >> 1;
      if (!this.#isBefore(at, above)) break;
      this.#swap(at, above);
      at = above;
    }
    return at;
  }

  #sink(slot: number): void {
    let at = slot;
    for (;;) {
      const [left, right] = [2 * at + 1, 2 * at + 2];
      if (left >= this.size) return;
      const child = right < this.size && this.#isBefore(right, left) ? right : left;
      if (!this.#isBefore(child, at)) return;
      this.#swap(child, at);
      at = child;
    }
  }
}

/** A step of the front: the heap before it, and after each of its beats. */
export interface HeapStep {
  readonly base: number;
  /** Slots of the sides: before, with the last one on top, after it has sunk, without the closed sides, with the new ones. */
  readonly states: readonly (readonly number[])[];
  readonly comparisons: number;
  /** Comparisons with which a list finds its smallest entry. */
  readonly listComparisons: number;
}

export interface HeapFilm {
  readonly film: FrontFilm;
  readonly steps: readonly HeapStep[];
  /** Lengths of all sides. */
  readonly lengths: readonly number[];
}

/** Fills a polygon, the shortest side first, and plays its heap; null if the polygon cannot be filled. */
export function heapFilm(front: PlaneFront, corners: readonly PlanePoint[], size: number): HeapFilm | null {
  const sources = [{ position: corners[0] ?? [0, 0], size: size / 2, distance: 0.1, growth: 0.35 }] as const;
  const filled = front.fill([corners], { size, sources }, { order: "smallest-first", improve: false });
  if (!filled.success) return null;
  const film = filmOf(filled);
  // The engine compares lengths with the digits of a float.
  const lengths = film.sides.map(({ ends }) => {
    const [[x, y], [u, v]] = [film.nodes[ends[0]] ?? [0, 0], film.nodes[ends[1]] ?? [0, 0]];
    return Math.fround(Math.hypot(u - x, v - y));
  });
  const heap = new Heap();
  const push = (side: number, pass: number): void => heap.push({ side, pass, length: lengths[side] ?? 0 });
  const bornAt = (state: number): readonly number[] =>
    film.sides.flatMap(({ born, died }, side) => (born === state && died > state ? [side] : []));
  for (const side of bornAt(0)) push(side, 0);
  const steps = Array.from({ length: film.stepCount }, (_none, k): HeapStep => {
    const base = film.stepAt(k)?.base ?? 0;
    const pass = heap.top?.pass ?? 0;
    heap.comparisons = 0;
    const listComparisons = heap.size - 1;
    const states = [heap.slots];
    const slot = heap.lift(base);
    states.push(heap.slots);
    if (slot !== null) heap.settle(slot);
    states.push(heap.slots);
    film.sides.forEach(({ died }, side) => {
      if (died === k + 1 && side !== base) heap.remove(side);
    });
    states.push(heap.slots);
    // A side without a candidate comes again, after all others.
    if ((film.sides[base]?.died ?? 0) > k + 1) push(base, pass + 1);
    for (const side of bornAt(k + 1)) push(side, 0);
    states.push(heap.slots);
    return { base, states, comparisons: heap.comparisons, listComparisons };
  });
  return { film, steps, lengths };
}
