/** Reads the numbers of a Gmsh file. Their widths depend on the version and on whether the file is text. */
import type { ByteReader } from "./byte-reader.js";

export class MshNumbers {
  readonly #reader: ByteReader;
  readonly isBinary: boolean;
  /** Whether the file has version 4.1, with nodes and elements in blocks by entity; otherwise it has version 2.2. */
  readonly hasBlocks: boolean;

  constructor(reader: ByteReader, isBinary: boolean, hasBlocks: boolean) {
    this.#reader = reader;
    this.isBinary = isBinary;
    this.hasBlocks = hasBlocks;
  }

  int(): number {
    return this.isBinary ? this.#reader.integer(4, true) : this.#reader.number("a number");
  }

  /** Reads a count, or the tag of a node or element; 8 bytes in version 4.1. */
  size(): number {
    if (!this.isBinary) return this.#reader.number("a number");
    return this.hasBlocks ? this.#reader.integer(8, false) : this.#reader.integer(4, true);
  }

  double(): number {
    return this.isBinary ? this.#reader.float(8) : this.#reader.number("a coordinate");
  }

  /** Reads a value at a node, which may be NaN or infinite. */
  value(): number {
    return this.isBinary ? this.#reader.float(8) : this.#reader.number("a value", true);
  }

  /** Reads a `size` that is a valid number of items. `what` names them in messages. */
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
