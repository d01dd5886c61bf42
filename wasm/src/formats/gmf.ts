/**
 * The binary form of Medit's files (GMF: `.meshb`, `.solb`), versions 1 to 4, after the manual of libMeshb (Maréchal). A file is
 * the number 1, which shows the byte order, the version, and sections: a keyword, the offset of the next section, and, for most
 * keywords, a count and rows of numbers. Version 1 has reals of 4 bytes, version 3 offsets of 8, version 4 integers of 8.
 */
import type { Part } from "./bytes.js";
import { ReadFailure } from "./read-result.js";

export const GMF_DIMENSION = 3;
export const GMF_VERTICES = 4;
export const GMF_TRIANGLES = 6;
export const GMF_QUADRILATERALS = 7;
export const GMF_TETRAHEDRA = 8;
export const GMF_END = 54;
export const GMF_SOLUTION = 62;

const MAX_VERSION = 4;
/** Size of a file whose offsets no longer fit into signed 32-bit numbers. */
const LARGE = 2 ** 31 - 1;

/** Reads numbers and sections of a file in memory. */
export class GmfReader {
  readonly #view: DataView;
  readonly #remedy: string;
  readonly #isLittle: boolean;
  readonly #version: number;
  #at = 0;

  /** Throws a ReadFailure if the bytes are no such file. */
  constructor(bytes: Uint8Array, remedy: string) {
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.#remedy = remedy;
    if (bytes.length < 8) this.fail("the file is truncated: it has no version");
    this.#isLittle = this.#view.getInt32(0, true) === 1;
    if (!this.#isLittle && this.#view.getInt32(0, false) !== 1) {
      this.fail("the file does not begin with the number 1, as binary Medit files do");
    }
    this.#at = 4;
    this.#version = this.int();
    if (this.#version < 1 || this.#version > MAX_VERSION) {
      this.fail(`the version is ${this.#version}; it must be 1 to ${MAX_VERSION}`);
    }
  }

  get realBytes(): number {
    return this.#version === 1 ? 4 : 8;
  }

  get #indexBytes(): number {
    return this.#version === MAX_VERSION ? 8 : 4;
  }

  /** Yields each section up to the end; its content, which may be left unread, begins at the position of the reader. */
  *sections(): Generator<{ readonly keyword: number }, void> {
    let before = this.#at;
    while (this.#at + 4 <= this.#view.byteLength) {
      const keyword = this.int();
      if (keyword === GMF_END) return;
      const next = this.#version < 3 ? this.int() : this.#long();
      if (keyword === GMF_DIMENSION) {
        const dimension = this.int();
        if (dimension !== 3) this.fail(`the dimension is ${dimension}, but it must be 3`);
      } else {
        yield { keyword };
      }
      if (next === 0) return;
      if (next <= before || next > this.#view.byteLength) {
        this.fail(`the next section is said to begin at byte ${next}, which is not after this one`);
      }
      before = next;
      this.#at = next;
    }
  }

  /** Returns the number of rows of a section. */
  count(): number {
    const count = this.index();
    if (count < 0 || count > this.#view.byteLength) this.fail(`the number of rows is ${count}`);
    return count;
  }

  /** Fails if the file has fewer bytes left. */
  require(bytes: number): void {
    if (this.#at + bytes > this.#view.byteLength) this.fail("the file is truncated: values are missing");
  }

  /** Returns an integer of the elements: a node or a reference. */
  index(): number {
    return this.#indexBytes === 8 ? this.#long() : this.int();
  }

  /** Fails if fewer rows are left, each of these numbers of reals and indices. */
  requireRows(count: number, reals: number, indices: number): void {
    this.require(count * (reals * this.realBytes + indices * this.#indexBytes));
  }

  int(): number {
    this.require(4);
    const value = this.#view.getInt32(this.#at, this.#isLittle);
    this.#at += 4;
    return value;
  }

  #long(): number {
    this.require(8);
    const value = Number(this.#view.getBigInt64(this.#at, this.#isLittle));
    this.#at += 8;
    return value;
  }

  real(): number {
    this.require(this.realBytes);
    const value =
      this.#version === 1
        ? this.#view.getFloat32(this.#at, this.#isLittle)
        : this.#view.getFloat64(this.#at, this.#isLittle);
    this.#at += this.realBytes;
    return value;
  }

  fail(message: string): never {
    throw new ReadFailure({
      message: `byte ${this.#at}: ${message}`,
      remedy: this.#remedy,
      offset: this.#at,
    });
  }
}

/** A section to be written. */
export interface GmfSection {
  readonly keyword: number;
  readonly count: number;
  /** Size of the content after the count. */
  readonly bytes: number;
  readonly parts: readonly Part[];
}

/** Returns the bytes of a file in the byte order of the machine; version 2, or 3 if the file is large. */
export function gmfFile(sections: readonly GmfSection[]): Part[] {
  const total = sections.reduce((sum, { bytes }) => sum + bytes + 16, 64);
  const isLarge = total > LARGE;
  const offsetBytes = isLarge ? 8 : 4;
  const offset = (value: number): Part => (isLarge ? BigInt64Array.of(BigInt(value)) : Int32Array.of(value));
  let end = 8 + 4 + offsetBytes + 4;
  const parts: Part[] = [Int32Array.of(1, isLarge ? 3 : 2, GMF_DIMENSION), offset(end), Int32Array.of(3)];
  for (const { keyword, count, bytes, parts: content } of sections) {
    end += 4 + offsetBytes + 4 + bytes;
    parts.push(Int32Array.of(keyword), offset(end), Int32Array.of(count), ...content);
  }
  return [...parts, Int32Array.of(GMF_END), offset(0)];
}
