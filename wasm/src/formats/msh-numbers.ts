/** Numbers of a Gmsh file, whose widths depend on its version and on whether it is text. */
import type { ByteReader } from "./byte-reader.js";

export class MshNumbers {
  readonly #reader: ByteReader;
  readonly isBinary: boolean;
  /** Version 4.1, which lists nodes and elements in blocks by their entities; else 2.2. */
  readonly hasBlocks: boolean;

  constructor(reader: ByteReader, isBinary: boolean, hasBlocks: boolean) {
    this.#reader = reader;
    this.isBinary = isBinary;
    this.hasBlocks = hasBlocks;
  }

  int(): number {
    return this.isBinary ? this.#reader.integer(4, true) : this.#reader.number("a number");
  }

  /** A count, or the tag of a node or an element: of 8 bytes in version 4.1. */
  size(): number {
    if (!this.isBinary) return this.#reader.number("a number");
    return this.hasBlocks ? this.#reader.integer(8, false) : this.#reader.integer(4, true);
  }

  double(): number {
    return this.isBinary ? this.#reader.float(8) : this.#reader.number("a coordinate");
  }

  /** A number at a node, which may be none. */
  value(): number {
    return this.isBinary ? this.#reader.float(8) : this.#reader.number("a value", true);
  }

  /** A `size` that there can be so many of `what`. */
  count(what: string): number {
    return this.#reader.count(this.size(), what);
  }

  async skipInts(count: number): Promise<void> {
    for (let i = 0; i < count; i++) {
      if (this.#reader.isLow) await this.#reader.fill();
      this.int();
    }
  }
}
