import { tooManyNumbers } from "./read-result.js";

/** Collects numbers one by one in pages, so that growing copies nothing and memory use is proportional to the count. */

type Numbers = Float64Array | Uint32Array;

const PAGE_BITS = 13;
const PAGE = 1 << PAGE_BITS;
/** Indices are 32-bit numbers, the largest of which means "none". */
const MAX_COUNT = 0xfffffffe;

export class Column<T extends Numbers> {
  readonly #pages: T[] = [];
  #last: T;
  #filled = PAGE;
  readonly #type: new (length: number) => T;

  readonly #max: number;

  /** Throws a ReadFailure when more than `max` numbers are pushed. */
  constructor(type: new (length: number) => T, max = MAX_COUNT) {
    this.#type = type;
    this.#max = max;
    this.#last = new type(0);
  }

  get length(): number {
    return (this.#pages.length - 1) * PAGE + this.#filled;
  }

  push(value: number): void {
    if (this.#filled === PAGE) this.#turnPage();
    this.#last[this.#filled++] = value;
  }

  at(index: number): number {
    return this.#pages[index >>> PAGE_BITS]?.[index & (PAGE - 1)] ?? 0;
  }

  /** Returns all numbers in one array and empties the column. */
  taken(): T {
    const { length } = this;
    const all = new this.#type(length);
    let at = 0;
    for (let page = this.#pages.shift(); page !== undefined; page = this.#pages.shift()) {
      all.set(page.subarray(0, Math.min(PAGE, length - at)), at);
      at += PAGE;
    }
    this.#filled = PAGE;
    return all;
  }

  #turnPage(): void {
    if (this.length >= this.#max) throw tooManyNumbers(this.#max);
    this.#last = new this.#type(PAGE);
    this.#pages.push(this.#last);
    this.#filled = 0;
  }
}
