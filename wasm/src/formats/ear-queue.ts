/** Numbered items by their worth, the best first; of equal ones the lowest number. */

export class EarQueue {
  /** A heap (Williams 1964) of items as they were put; those put again stay in it, out of date. */
  readonly #heap: { readonly item: number; readonly worth: number; readonly turn: number }[] = [];
  /** Per item: how often it was put. */
  readonly #turns: Uint32Array;

  constructor(count: number) {
    this.#turns = new Uint32Array(count);
  }

  /** In place of the item's earlier worth; only what is above 0 is ever taken. O(log n). */
  put(item: number, worth: number): void {
    const turn = (this.#turns[item] ?? 0) + 1;
    this.#turns[item] = turn;
    if (!(worth > 0)) return;
    const heap = this.#heap;
    let at = heap.length;
    const entry = { item, worth, turn };
    for (heap.push(entry); at > 0;) {
      const above = (at - 1) >> 1;
      const other = heap[above] ?? entry;
      if (!isBefore(entry, other)) break;
      heap[at] = other;
      at = above;
    }
    heap[at] = entry;
  }

  /** The best, which is in no more; undefined where there is none. */
  take(): number | undefined {
    for (;;) {
      const first = this.#pop();
      if (first === undefined || this.#turns[first.item] === first.turn) return first?.item;
    }
  }

  #pop() {
    const heap = this.#heap;
    const first = heap[0];
    const last = heap.pop();
    if (last === undefined || heap.length === 0) return first;
    let at = 0;
    for (;;) {
      let below = 2 * at + 1;
      const [left = last, right = last] = [heap[below], heap[below + 1]];
      if (isBefore(right, left)) below++;
      const best = isBefore(right, left) ? right : left;
      if (!isBefore(best, last)) break;
      heap[at] = best;
      at = below;
    }
    heap[at] = last;
    return first;
  }
}

interface Ranked {
  readonly item: number;
  readonly worth: number;
}

function isBefore(one: Ranked, other: Ranked): boolean {
  return one.worth !== other.worth ? one.worth > other.worth : one.item < other.item;
}
