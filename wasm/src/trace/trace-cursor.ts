/** Reads the numbers of a trace one after the other. Failures name the byte. */
import { failureAt } from "../formats/read-result.js";

export const TRACE_REMEDY = "Record the trace again, or copy the file again.";

/** Numbers of more bits occur in no trace. */
const MAX_VARINT_BYTES = 5;

const scratch = new DataView(new ArrayBuffer(4));

/** Returns the float with these 32 bits. */
function floatOf(bits: number): number {
  scratch.setInt32(0, bits);
  return scratch.getFloat32(0);
}

export class TraceCursor {
  /** Offset of the next byte. */
  at: number;
  readonly #bytes: Uint8Array;
  readonly #view: DataView;

  constructor(bytes: Uint8Array, at = 0) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = at;
  }

  /** All bytes of the file. */
  get file(): Uint8Array {
    return this.#bytes;
  }

  /** Number of unread bytes. */
  get ahead(): number {
    return this.#bytes.length - this.at;
  }

  /** Returns the next byte, which stays unread. */
  peek(): number {
    return this.#view.getUint8(this.at);
  }

  byte(): number {
    return this.#view.getUint8(this.#advance(1));
  }

  /** Reads an unsigned LEB128 integer below 2^35. */
  varint(): number {
    const begin = this.at;
    let value = 0;
    let weight = 1;
    for (let i = 0; i < MAX_VARINT_BYTES; i++) {
      const byte = this.byte();
      value += (byte & 0x7f) * weight;
      if (byte < 0x80) return value;
      weight *= 0x80;
    }
    return this.fail("a number has too many bytes", begin);
  }

  /** Reads a signed integer. */
  zigzag(): number {
    const value = this.varint();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  /** Reads a number of items, each of which has at least `minBytes` bytes. */
  count(what: string, minBytes: number): number {
    const begin = this.at;
    const count = this.varint();
    return count * minBytes <= this.ahead
      ? count
      : this.fail(`the file is too short for ${count} ${what}`, begin);
  }

  float(): number {
    const at = this.#advance(4);
    return this.#finite(this.#view.getFloat32(at, true), at);
  }

  /** Reads the upper three bytes of a float; the last one is 0. */
  shorterFloat(): number {
    const at = this.#advance(3);
    const bits = (this.#view.getUint16(at, true) << 8) | (this.#view.getUint8(at + 2) << 24);
    return this.#finite(floatOf(bits), at);
  }

  /** Reads the upper half of a float; the lower half is 0. */
  score(): number {
    const at = this.#advance(2);
    return this.#finite(floatOf(this.#view.getUint16(at, true) << 16), at);
  }

  double(): number {
    const at = this.#advance(8);
    return this.#finite(this.#view.getFloat64(at, true), at);
  }

  /** Reads the next `count` bytes. */
  bytes(count: number): Uint8Array {
    const at = this.#advance(count);
    return this.#bytes.subarray(at, at + count);
  }

  /** Fails at a byte, by default the next one. */
  fail(message: string, offset = this.at): never {
    throw failureAt({ offset }, message, TRACE_REMEDY);
  }

  #finite(value: number, at: number): number {
    return Number.isFinite(value) ? value : this.fail(`expected a finite number, found ${value}`, at);
  }

  #advance(bytes: number): number {
    const { at } = this;
    if (this.ahead < bytes) this.fail("the file ends in the middle of an event", this.#bytes.length);
    this.at += bytes;
    return at;
  }
}
