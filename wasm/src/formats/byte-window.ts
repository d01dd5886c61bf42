/**
 * A window of a file that is read while it arrives. `fill` extends the window to at least LOOKAHEAD bytes ahead, or to the end
 * of the file. Bytes and binary numbers are read from the window synchronously, so that reading a number needs no promise. A
 * reader calls `fill` when `isLow` is true, once per entry (a point, a face).
 */
import { Yielder } from "../calls/yielder.js";
import { type ByteSource, piecesOf } from "./byte-source.js";
import { joined } from "./bytes.js";
import { failureAt, type FileLocation, truncatedAt } from "./read-result.js";
import { inUtf8 } from "./utf16.js";

/** Longest entry of a file, in bytes; a face of ten thousand corners fits. */
const LOOKAHEAD = 1 << 18;
/** Bytes requested at once, so that the rest of the window is rarely copied. */
const WINDOW = 1 << 19;

export interface ByteWindowOptions {
  /** Advice given with every failure. */
  readonly remedy: string;
  /** Aborting it cancels reading after an entry that took long (`requestYield`). */
  readonly signal?: AbortSignal | undefined;
}

export class ByteWindow {
  isLittleEndian = true;
  protected buffer: Uint8Array<ArrayBuffer> = new Uint8Array();
  /** Index of the next byte in `buffer`. */
  protected at = 0;
  /** Whether the window reaches the end of the file. */
  protected isWhole = false;
  #view = new DataView(new ArrayBuffer(0));
  /** Number of bytes of the file before the window. */
  #before = 0;
  /** Whether to yield before the next entry. */
  #mustYield = false;
  readonly #yielder: Yielder;
  readonly #pieces: AsyncIterator<Uint8Array>;
  readonly #remedy: string;

  protected constructor(source: ByteSource, { remedy, signal }: ByteWindowOptions) {
    this.#yielder = new Yielder(signal);
    this.#pieces = inUtf8(piecesOf(source));
    this.#remedy = remedy;
  }

  /** Releases the file. */
  protected async close(): Promise<void> {
    await this.#pieces.return?.();
  }

  get isLow(): boolean {
    return this.#mustYield || this.#isShort;
  }

  get #isShort(): boolean {
    return !this.isWhole && this.buffer.length - this.at < LOOKAHEAD;
  }

  /** Requests a pause after an entry that took long: the next `fill` yields, and rejects if reading was cancelled. */
  readonly requestYield = (): void => {
    this.#mustYield = true;
  };

  /** Whether every byte has been read. */
  get isAtEnd(): boolean {
    return this.isWhole && this.at === this.buffer.length;
  }

  /** Number of bytes from the beginning of the file. */
  get offset(): number {
    return this.#before + this.at;
  }

  /** Number of unread bytes in the window. */
  get ahead(): number {
    return this.buffer.length - this.at;
  }

  /** Skips the given number of bytes. */
  skip(bytes: number): void {
    this.#advance(bytes);
  }

  /** Extends the window far enough for the next entry. */
  async fill(): Promise<void> {
    if (this.#mustYield) {
      this.#mustYield = false;
      await this.#yielder.yield();
    }
    if (!this.#isShort) return;
    const parts: Uint8Array[] = [this.buffer.subarray(this.at)];
    let length = this.buffer.length - this.at;
    while (length < WINDOW) {
      const next = await this.#pieces.next();
      if (next.done === true) {
        this.isWhole = true;
        break;
      }
      parts.push(next.value);
      length += next.value.length;
    }
    this.#before += this.at;
    this.at = 0;
    this.buffer = joined(parts);
    this.#view = new DataView(this.buffer.buffer, this.buffer.byteOffset, length);
  }

  /**
   * Reads the next `count` bytes, or fewer at the end of the file. Memory use grows with the file, not with
   * `count`.
   */
  async bytes(count: number): Promise<Uint8Array<ArrayBuffer>> {
    this.leaveText();
    const parts: Uint8Array[] = [];
    let length = 0;
    while (length < count) {
      await this.fill();
      const part = this.buffer.subarray(this.at, this.at + count - length);
      if (part.length === 0) break;
      this.at += part.length;
      length += part.length;
      parts.push(part);
    }
    return joined(parts);
  }

  /** Returns up to `count` unread bytes of the window without consuming them. */
  peek(count: number): Uint8Array {
    return this.buffer.subarray(this.at, this.at + count);
  }

  /** Reads a whole number of 1, 2, 4 or 8 bytes. Numbers of 8 bytes are exact up to 2^53. */
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

  /** Current location, for problems that are detected later. */
  get location(): FileLocation {
    return { offset: this.offset };
  }

  fail(message: string, location = this.location, remedy = this.#remedy): never {
    throw failureAt(location, message, remedy);
  }

  /** Called before bytes are read. */
  protected leaveText(): void {}

  #advance(bytes: number): number {
    this.leaveText();
    if (this.buffer.length - this.at < bytes) {
      this.checkEdge();
      throw truncatedAt(this.location, "in the middle of a number");
    }
    this.at += bytes;
    return this.at - bytes;
  }

  /** Throws a ReadFailure if an entry reaches the end of the window before the end of the file. */
  protected checkEdge(): void {
    if (!this.isWhole) this.fail(`a line or an entry is longer than ${LOOKAHEAD} bytes`);
  }
}
