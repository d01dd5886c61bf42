/** Priority queue of numbered items: highest priority first; of equal priorities the lowest number. */

export class EarQueue {
  /** Binary heap (Williams 1964) of all entries ever put; an entry is outdated if its item was put again. */
  readonly #heap: { readonly item: number; readonly priority: number; readonly version: number }[] = [];
  /** Per item: how often it was put. */
  readonly #versions: Uint32Array;

  constructor(count: number) {
    this.#versions = new Uint32Array(count);
  }

  /** Sets the priority of an item. Items with a priority of 0 or less are never taken. O(log n). */
  put(item: number, priority: number): void {
    const version = (this.#versions[item] ?? 0) + 1;
    this.#versions[item] = version;
    if (!(priority > 0)) return;
    const heap = this.#heap;
    let at = heap.length;
    const entry = { item, priority, version };
    for (heap.push(entry); at > 0;) {
      const above = (at - 1) >> 1;
      const other = heap[above] ?? entry;
      if (!isBefore(entry, other)) break;
      heap[at] = other;
      at = above;
    }
    heap[at] = entry;
  }

  /** Removes and returns the item of highest priority; undefined if the queue is empty. */
  take(): number | undefined {
    for (;;) {
      const first = this.#pop();
      if (first === undefined || this.#versions[first.item] === first.version) return first?.item;
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
  readonly priority: number;
}

function isBefore(one: Ranked, other: Ranked): boolean {
  return one.priority !== other.priority ? one.priority > other.priority : one.item < other.item;
}
