import { ReadFailure } from "../read-result.js";

const LATIN1 = new TextDecoder("latin1");
const LINE_FEED = 10;
const SPACE = 32;

/** Walks through a file in which lines of text and binary numbers alternate. */
export class ByteCursor {
  position = 0;
  isLittleEndian = true;
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  readonly #remedy: string;

  /** `remedy`: what `fail` advises. */
  constructor(bytes: Uint8Array, remedy: string) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.#remedy = remedy;
  }

  get left(): number {
    return this.#bytes.length - this.position;
  }

  /** The rest of this line, without its end. */
  line(): string {
    const end = this.#bytes.indexOf(LINE_FEED, this.position);
    const line = this.#text(this.position, end < 0 ? this.#bytes.length : end);
    this.position = end < 0 ? this.#bytes.length : end + 1;
    return line.replace(/\r$/, "");
  }

  /** The next word, in this line or a later one. Empty at the end of the file. */
  word(): string {
    while (this.left > 0 && (this.#bytes[this.position] ?? 0) <= SPACE) this.position++;
    const begin = this.position;
    while (this.left > 0 && (this.#bytes[this.position] ?? 0) > SPACE) this.position++;
    return this.#text(begin, this.position);
  }

  /** The next word as a finite number. */
  number(): number {
    const word = this.word();
    const value = word === "" ? NaN : Number(word);
    return Number.isFinite(value) ? value : this.fail(`"${word.slice(0, 24)}" is not a finite number`);
  }

  int32(): number {
    return this.#view.getInt32(this.#advance(4), this.isLittleEndian);
  }

  /** A whole number of 1, 2, 4 or 8 bytes; the last only up to 2^53. */
  integer(bytes: 1 | 2 | 4 | 8, isSigned: boolean): number {
    const at = this.#advance(bytes);
    const little = this.isLittleEndian;
    switch (bytes) {
      case 1:
        return isSigned ? this.#view.getInt8(at) : this.#view.getUint8(at);
      case 2:
        return isSigned ? this.#view.getInt16(at, little) : this.#view.getUint16(at, little);
      case 4:
        return isSigned ? this.#view.getInt32(at, little) : this.#view.getUint32(at, little);
      case 8:
        return Number(isSigned ? this.#view.getBigInt64(at, little) : this.#view.getBigUint64(at, little));
    }
  }

  float(bytes: 4 | 8): number {
    const at = this.#advance(bytes);
    return bytes === 4
      ? this.#view.getFloat32(at, this.isLittleEndian)
      : this.#view.getFloat64(at, this.isLittleEndian);
  }

  /** As a number, exact up to 2^53. */
  uint64(): number {
    return Number(this.#view.getBigUint64(this.#advance(8), this.isLittleEndian));
  }

  float64(): number {
    return this.#view.getFloat64(this.#advance(8), this.isLittleEndian);
  }

  /** `count` if so many items of at least so many bytes can still follow: memory grows with the file. */
  count(count: number, leastBytes: number, what: string): number {
    if (!(Number.isInteger(count) && count >= 0 && count * leastBytes <= this.left)) {
      return this.fail(`${count} ${what} are announced, but ${this.left} bytes are left`);
    }
    return count;
  }

  /** Moves behind the next line that is `text`. */
  skipPast(text: string): void {
    const wanted = new TextEncoder().encode(`\n${text}`);
    const first = wanted[0] ?? LINE_FEED;
    for (
      let at = this.#bytes.indexOf(first, this.position);
      at >= 0;
      at = this.#bytes.indexOf(first, at + 1)
    ) {
      if (wanted.every((byte, i) => this.#bytes[at + i] === byte)) {
        this.position = at + wanted.length;
        this.line();
        return;
      }
    }
    this.fail(`the file ends where "${text}" should be`);
  }

  fail(message: string): never {
    throw new ReadFailure({
      message: `byte ${this.position}: ${message}`,
      remedy: this.#remedy,
      offset: this.position,
    });
  }

  #advance(bytes: number): number {
    if (this.left < bytes) this.fail("the file ends in the middle of a number");
    this.position += bytes;
    return this.position - bytes;
  }

  #text(begin: number, end: number): string {
    return LATIN1.decode(this.#bytes.subarray(begin, end));
  }
}
