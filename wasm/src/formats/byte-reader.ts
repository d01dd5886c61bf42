/**
 * Walks through a file while it arrives. A window on it is kept in memory: `fill` makes it reach at least
 * LOOKAHEAD bytes ahead, or to the end of the file; all other calls are plain functions on the window, so
 * that a number costs no promise. Readers call `fill` where `isLow` says so, once per entry (a point, a face).
 *
 * Lines end with a line feed, a carriage return or both. A byte-order mark of UTF-8 before a word or a line is white
 * space: files begin with one, and where such files were joined it stands inside.
 */
import { failureAt, ReadFailure, type FilePlace } from "./read-result.js";
import { piecesOf, type ByteSource } from "./byte-source.js";
import { decimalIn, otherNumber } from "./decimal.js";
import { Breather } from "./steps.js";

const LINE_FEED = 10;
const CARRIAGE_RETURN = 13;
const SPACE = 32;
/** The byte-order mark in UTF-8. */
const MARK = [0xef, 0xbb, 0xbf] as const;
/** An entry of a file may be as long as this; a face of ten thousand corners is. */
const LOOKAHEAD = 1 << 18;
/** As much is asked for at once, so that what is left of the window is seldom moved. */
const WINDOW = 1 << 19;
/** Digits, signs, the point. */
const NUMBER_BEGINS = new TextEncoder().encode("0123456789+-.");
/** From here on a byte is part of a character of several, in UTF-8. */
const FIRST_OF_SEVERAL = 0x80;
/** Longer comments are no words to anyone. */
const HEARD = 1 << 12;
/** No more of a word than a reader of messages can use. */
const SHOWN = 24;

export interface ByteReaderOptions {
  /** What `fail` advises. */
  readonly remedy: string;
  /** A character that hides the rest of its line. */
  readonly comment?: string;
  /** A character that, as the last of a line, continues it on the next; not in comments. */
  readonly continuation?: string;
  /** Is told what stands behind it, where that is short. */
  readonly heard?: (comment: string) => void;
  /** Ends the reading behind entries that took long (`rest`). */
  readonly signal?: AbortSignal | undefined;
}

export class ByteReader {
  isLittleEndian = true;
  #bytes: Uint8Array<ArrayBuffer> = new Uint8Array();
  #view = new DataView(new ArrayBuffer(0));
  #at = 0;
  /** Bytes of the file before the window. */
  #before = 0;
  #line = 1;
  /** The line of what was read last. */
  #lastLine = 1;
  /** Whether all that was read is text, whose places are best told by their lines. */
  #isText = true;
  /** Whether a line that was read ended with a carriage return alone. */
  #hasLoneReturns = false;
  #isWhole = false;
  /** Whether others are to run before the next entry. */
  #isTired = false;
  readonly #breather: Breather;
  readonly #pieces: AsyncIterator<Uint8Array>;
  readonly #comment: number;
  readonly #continuation: number;
  readonly #remedy: string;
  readonly #heard: ByteReaderOptions["heard"];

  private constructor(source: ByteSource, options: ByteReaderOptions) {
    const { remedy, comment, continuation, heard, signal } = options;
    this.#breather = new Breather(signal);
    this.#pieces = piecesOf(source);
    this.#comment = comment?.charCodeAt(0) ?? NaN;
    this.#continuation = continuation?.charCodeAt(0) ?? NaN;
    this.#remedy = remedy;
    this.#heard = heard;
  }

  /** Runs `read` on a file and lets go of the file whatever happens. An empty file is a failure. */
  static async over<T>(
    source: ByteSource,
    options: ByteReaderOptions,
    read: (reader: ByteReader) => Promise<T>,
  ): Promise<T> {
    const reader = new ByteReader(source, options);
    try {
      await reader.fill();
      if (reader.isAtEnd) {
        const { remedy } = options;
        throw new ReadFailure({ code: "empty-file", message: "the file is empty", remedy, offset: 0 });
      }
      return await read(reader);
    } finally {
      await reader.#pieces.return?.();
    }
  }

  get isLow(): boolean {
    return this.#isTired || this.#isShort;
  }

  get #isShort(): boolean {
    return !this.#isWhole && this.#bytes.length - this.#at < LOOKAHEAD;
  }

  /** Says that an entry took long: the next `fill` lets others run, and ends the reading where it is cancelled. */
  readonly rest = (): void => {
    this.#isTired = true;
  };

  /** No byte is left. */
  get isAtEnd(): boolean {
    return this.#isWhole && this.#at === this.#bytes.length;
  }

  /** Bytes from the begin of the file. */
  get offset(): number {
    return this.#before + this.#at;
  }

  /** Bytes in the window from here on. */
  get ahead(): number {
    return this.#bytes.length - this.#at;
  }

  /** Moves on over so many bytes. */
  skip(bytes: number): void {
    this.#advance(bytes);
  }

  /** Makes the window reach far enough for the next entry. */
  async fill(): Promise<void> {
    if (this.#isTired) {
      this.#isTired = false;
      await this.#breather.breathe();
    }
    if (!this.#isShort) return;
    const parts: Uint8Array[] = [this.#bytes.subarray(this.#at)];
    let length = this.#bytes.length - this.#at;
    while (length < WINDOW) {
      const next = await this.#pieces.next();
      if (next.done === true) {
        this.#isWhole = true;
        break;
      }
      parts.push(next.value);
      length += next.value.length;
    }
    this.#before += this.#at;
    this.#at = 0;
    this.#bytes = concatenated(parts, length);
    this.#view = new DataView(this.#bytes.buffer, this.#bytes.byteOffset, length);
  }

  /** The next `count` bytes; fewer at the end of the file. Memory grows with the file, not with `count`. */
  async bytes(count: number): Promise<Uint8Array<ArrayBuffer>> {
    this.#leaveText();
    const parts: Uint8Array[] = [];
    let length = 0;
    while (length < count) {
      await this.fill();
      const part = this.#bytes.subarray(this.#at, this.#at + count - length);
      if (part.length === 0) break;
      this.#at += part.length;
      length += part.length;
      parts.push(part);
    }
    return concatenated(parts, length);
  }

  /** What is in the window from here on, up to `count` bytes, without moving. */
  peek(count: number): Uint8Array {
    return this.#bytes.subarray(this.#at, this.#at + count);
  }

  /** The next word, in this line or a later one; empty at the end of the file. */
  word(): string {
    this.#skipBlanks(true);
    return this.#text(this.#wordEnd());
  }

  /** The next word of this line; empty at its end. */
  wordInLine(): string {
    this.#skipBlanks(false);
    return this.#text(this.#wordEnd());
  }

  /** Whether the next word, in this line or a later one, begins like a number. */
  startsNumber(): boolean {
    this.#skipBlanks(true);
    return NUMBER_BEGINS.includes(this.#bytes[this.#at] ?? 0);
  }

  /** Moves behind the next word if it is this one (in small letters here), in capitals or not. */
  accepts(word: string): boolean {
    this.#skipBlanks(true);
    const end = this.#wordEnd();
    if (end - this.#at !== word.length) return false;
    for (let i = 0; i < word.length; i++) {
      const byte = this.#bytes[this.#at + i] ?? 0;
      const isCapital = byte >= 65 && byte <= 90;
      if ((isCapital ? byte + 32 : byte) !== word.charCodeAt(i)) return false;
    }
    this.#at = end;
    return true;
  }

  /** As `accepts`, but any other word is a failure. */
  expect(word: string): void {
    if (this.accepts(word)) return;
    const found = this.#shown();
    this.fail(
      found === "" ? `the file ends where "${word}" should be` : `"${found}" where "${word}" should be`,
    );
  }

  /**
   * The next word as a number, a finite one unless it `mayBeNone`, as values at nodes may; `what` names it where it is
   * missing or is none.
   */
  number(what: string, mayBeNone = false): number {
    this.#skipBlanks(true);
    const end = this.#wordEnd();
    if (end === this.#at) this.fail(`the file ends where ${what} should be`);
    let value: number | undefined = decimalIn(this.#bytes, this.#at, end);
    if (!Number.isFinite(value)) value = mayBeNone ? otherNumber(this.#bytes, this.#at, end) : undefined;
    if (value === undefined) return this.fail(`"${this.#shown()}" is not a finite number (${what})`);
    this.#at = end;
    return value;
  }

  /** The next word as a whole number from 0 to `limit` - 1. */
  index(what: string, limit: number): number {
    const value = this.number(what);
    return Number.isInteger(value) && value >= 0 && value < limit
      ? value
      : this.fail(`${value} is not a whole number from 0 to ${limit - 1} (${what})`);
  }

  /** Whether a word is left in this line. */
  hasWordInLine(): boolean {
    this.#skipBlanks(false);
    return this.#wordEnd() > this.#at;
  }

  /** Skips blanks and comments up to the next word, or until more of the file should be there: `fill`, and call again. */
  skipComments(): void {
    this.#skipBlanks(true, true);
  }

  /** Skips what is left of this line, and the lines that continue it. */
  skipLine(): void {
    for (;;) {
      const begin = this.#at;
      const end = this.#lineEnd();
      this.#at = end;
      const last = this.#bytes[end - 1] === CARRIAGE_RETURN ? end - 2 : end - 1;
      if (last < begin || !this.#isContinued(last)) return;
      this.#passLineEnd();
      this.#line++;
    }
  }

  /** The rest of this line without blanks (for `trim` a byte-order mark is one) around it; the place is then the begin of the next. */
  line(): string {
    const end = this.#lineEnd();
    const text = textOf(this.#bytes.subarray(this.#at, end));
    this.#at = end;
    if (end < this.#bytes.length) this.#passLineEnd();
    this.#lastLine = this.#line++;
    return text.trim();
  }

  /** Moves behind the line end that closes the words before binary numbers. */
  endLine(): void {
    this.#skipBlanks(false);
    if (!this.#isLineEnd(this.#at)) this.fail("the line should end here");
    this.#passLineEnd();
    this.#lastLine = this.#line++;
  }

  /** Moves behind the next place where the file says `text`, and the rest of that line. */
  async skipPast(text: string): Promise<void> {
    const wanted = new TextEncoder().encode(text);
    for (;;) {
      await this.fill();
      const found = indexOf(this.#bytes, wanted, this.#at);
      if (found >= 0) {
        this.#moveTo(found + wanted.length);
        await this.fill();
        this.skipLine();
        return;
      }
      // The begin of the text may stand at the window's end.
      this.#moveTo(Math.max(this.#at, this.#bytes.length - wanted.length + 1));
      if (this.#isWhole) this.fail(`the file ends where "${text}" should be`);
    }
  }

  /** A whole number of 1, 2, 4 or 8 bytes; the last is exact up to 2^53 only. */
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

  /** `count` if it is one that can be; that so many items follow is seen only when they do. */
  count(count: number, what: string): number {
    if (Number.isNaN(count)) this.fail(`the number of ${what} should be here`);
    return Number.isSafeInteger(count) && count >= 0 ? count : this.fail(`${count} is no number of ${what}`);
  }

  /** Where the reader is, for what is judged only later. */
  get place(): FilePlace {
    return this.#isText ? { line: this.#lastLine } : { offset: this.offset };
  }

  fail(message: string, place = this.place, remedy = this.#remedy): never {
    throw failureAt(place, message, remedy);
  }

  /** Moves on within the window over lines that are not looked at. */
  #moveTo(at: number): void {
    if (this.#isText) {
      for (let end = this.#at; end < at; end++) if (this.#isLineEnd(end)) this.#line++;
    }
    this.#at = at;
    this.#lastLine = this.#line;
  }

  /** A carriage return before a line feed is a blank. */
  #isLineEnd(at: number): boolean {
    const byte = this.#bytes[at];
    return byte === LINE_FEED || (byte === CARRIAGE_RETURN && this.#bytes[at + 1] !== LINE_FEED);
  }

  /** Whether the byte here continues its line on the next. */
  #isContinued(at: number): boolean {
    const after = this.#bytes[at + 1];
    return this.#bytes[at] === this.#continuation && (after === LINE_FEED || after === CARRIAGE_RETURN);
  }

  #passLineEnd(): void {
    if (this.#bytes[this.#at++] === CARRIAGE_RETURN) this.#hasLoneReturns = true;
  }

  /** From here on numbers are binary. */
  #leaveText(): void {
    if (!this.#isText) return;
    if (this.#hasLoneReturns) {
      // The first byte of a number may be a line feed: the two would be taken for one line end.
      this.fail("binary numbers cannot follow lines that end with carriage returns alone");
    }
    this.#isText = false;
  }

  #advance(bytes: number): number {
    this.#leaveText();
    if (this.#bytes.length - this.#at < bytes) {
      this.#checkEdge();
      this.fail("the file ends in the middle of a number");
    }
    this.#at += bytes;
    return this.#at - bytes;
  }

  #skipBlanks(alsoLineEnds: boolean, mayPause = false): void {
    const bytes = this.#bytes;
    for (; this.#at < bytes.length; this.#at++) {
      const byte = bytes[this.#at] ?? 0;
      if (byte > SPACE) {
        if (byte === MARK[0] && startsWithMark(bytes, this.#at)) {
          this.#at += MARK.length - 1;
          continue;
        }
        if (byte === this.#continuation && this.#isContinued(this.#at)) {
          const isPair = bytes[this.#at + 1] === CARRIAGE_RETURN && bytes[this.#at + 2] === LINE_FEED;
          this.#at += isPair ? 2 : 1;
          this.#line++;
          continue;
        }
        if (byte !== this.#comment) break;
        const begin = this.#at + 1;
        this.#at = this.#lineEnd();
        if (this.#at - begin < HEARD) this.#heard?.(textOf(bytes.subarray(begin, this.#at)));
        if (mayPause && this.isLow) break;
        this.#at--;
      } else if ((byte === LINE_FEED || byte === CARRIAGE_RETURN) && this.#isLineEnd(this.#at)) {
        if (!alsoLineEnds) break;
        if (byte === CARRIAGE_RETURN) this.#hasLoneReturns = true;
        this.#line++;
      }
    }
    this.#lastLine = this.#line;
    if (this.#at === bytes.length) this.#checkEdge();
  }

  #wordEnd(): number {
    const bytes = this.#bytes;
    let end = this.#at;
    for (; end < bytes.length; end++) {
      const byte = bytes[end] ?? 0;
      if (byte <= SPACE || byte === this.#comment) return end;
      if (byte === this.#continuation && this.#isContinued(end)) return end;
    }
    this.#checkEdge();
    return end;
  }

  #lineEnd(): number {
    let end = this.#at;
    while (end < this.#bytes.length && !this.#isLineEnd(end)) end++;
    // What follows the last byte is not known.
    if (end + 1 >= this.#bytes.length && this.#bytes[end] !== LINE_FEED) this.#checkEdge();
    return end;
  }

  /** The end of the window must be that of the file. */
  #checkEdge(): void {
    if (!this.#isWhole) this.fail(`a line or an entry is longer than ${LOOKAHEAD} bytes`);
  }

  #text(end: number): string {
    const begin = this.#at;
    this.#at = end;
    let text = "";
    for (let i = begin; i < end; i++) {
      const byte = this.#bytes[i] ?? 0;
      if (byte >= FIRST_OF_SEVERAL) return textOf(this.#bytes.subarray(begin, end));
      text += String.fromCharCode(byte);
    }
    return text;
  }

  /** The word here, shortened, for a message. */
  #shown(): string {
    const end = this.#wordEnd();
    const text = String.fromCharCode(...this.#bytes.subarray(this.#at, Math.min(end, this.#at + SHOWN)));
    return end - this.#at > SHOWN ? `${text}…` : text;
  }
}

function startsWithMark(bytes: Uint8Array, at = 0): boolean {
  return MARK.every((byte, i) => bytes[at + i] === byte);
}

/** Every byte leaves something, for "" means that there was none. */
function textOf(bytes: Uint8Array): string {
  return new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes);
}

/** Where these bytes are next, or -1. */
export function indexOf(bytes: Uint8Array, wanted: Uint8Array, from: number): number {
  const first = wanted[0] ?? 0;
  for (let at = bytes.indexOf(first, from); at >= 0; at = bytes.indexOf(first, at + 1)) {
    if (wanted.every((byte, i) => bytes[at + i] === byte)) return at;
  }
  return -1;
}

function concatenated(parts: readonly Uint8Array[], length: number): Uint8Array<ArrayBuffer> {
  const joined = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    joined.set(part, at);
    at += part.length;
  }
  return joined;
}

/** Of text, for what its first line should have said. */
export const FIRST_LINE: FilePlace = { line: 1 };
