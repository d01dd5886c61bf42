import { tooManyNumbers } from "./read-result.js";

/** Numbers collected one by one, in pages: growing moves nothing, and memory follows what was collected. */

type Numbers = Float64Array | Uint32Array;

const PAGE_BITS = 13;
const PAGE = 1 << PAGE_BITS;
/** Positions are 32-bit numbers, the largest of which stands for none. */
const MOST = 0xfffffffe;

export class Column<T extends Numbers> {
  readonly #pages: T[] = [];
  #last: T;
  #filled = PAGE;
  readonly #type: new (length: number) => T;

  readonly #most: number;

  /** Throws a ReadFailure where it should hold more than so many. */
  constructor(type: new (length: number) => T, most = MOST) {
    this.#type = type;
    this.#most = most;
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

  /** All of them in one array; the column is empty afterwards. */
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
    if (this.length >= this.#most) throw tooManyNumbers(this.#most);
    this.#last = new this.#type(PAGE);
    this.#pages.push(this.#last);
    this.#filled = 0;
  }
}
