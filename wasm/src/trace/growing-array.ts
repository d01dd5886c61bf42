/** A typed array that grows, and whose entries can be changed. */

type Numbers = Float64Array | Float32Array | Uint32Array | Uint16Array | Uint8Array;

const FIRST_CAPACITY = 256;

export class GrowingArray<T extends Numbers> {
  #array: T;
  #length = 0;
  readonly #type: new (length: number) => T;

  constructor(type: new (length: number) => T) {
    this.#type = type;
    this.#array = new type(FIRST_CAPACITY);
  }

  get length(): number {
    return this.#length;
  }

  push(value: number): void {
    if (this.#length === this.#array.length) this.#grow(this.#length + 1);
    this.#array[this.#length++] = value;
  }

  /** Returns the entry; 0 beyond the end. */
  at(index: number): number {
    return this.#array[index] ?? 0;
  }

  set(index: number, value: number): void {
    this.#array[index] = value;
  }

  /** Entries up to the new length get the value `filling`; those beyond it are dropped. */
  resize(length: number, filling = 0): void {
    if (length > this.#array.length) this.#grow(length);
    if (length > this.#length) this.#array.fill(filling, this.#length, length);
    this.#length = length;
  }

  #grow(length: number): void {
    const larger = new this.#type(Math.max(length, 2 * this.#array.length));
    larger.set(this.#array);
    this.#array = larger;
  }

  /** Returns a copy of the entries from `begin` on. */
  copy(begin = 0): T {
    return this.#array.slice(begin, this.#length) as T;
  }
}
