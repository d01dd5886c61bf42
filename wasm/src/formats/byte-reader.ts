/**
 * Reads numbers, words and lines of a text, and the bytes that may follow it, from the window of a file.
 *
 * A line ends with a line feed, a carriage return, or both. A UTF-8 byte-order mark before a word or a line counts
 * as white space: files begin with it, and concatenated files contain it.
 */
import type { ByteSource } from "./byte-source.js";
import { ByteWindow, type ByteWindowOptions } from "./byte-window.js";
import { decimalIn, otherNumber } from "./decimal.js";
import { type FileLocation, ReadFailure, truncatedAt } from "./read-result.js";
import { indexOf, MARK_BYTES, startsWithMark, textOf } from "./text-bytes.js";

const LINE_FEED = 10;
const CARRIAGE_RETURN = 13;
const SPACE = 32;
/** Digits, signs and the decimal point. */
const NUMBER_BEGINS = new TextEncoder().encode("0123456789+-.");
/** Smallest byte that is part of a multi-byte UTF-8 character. */
const FIRST_OF_SEVERAL = 0x80;
/** Longer comments are not passed to `onComment`, in bytes. */
const MAX_COMMENT_BYTES = 1 << 12;
/** Largest number of characters of a word quoted in a message. */
const SHOWN = 24;

export interface ByteReaderOptions extends ByteWindowOptions {
  /** Character that starts a comment, which ends with its line. */
  readonly comment?: string;
  /** Character that, at the end of a line, continues the line on the next one. It has no effect in comments. */
  readonly continuation?: string;
  /** Called with the text of each comment below MAX_COMMENT_BYTES, without the comment character. */
  readonly onComment?: (comment: string) => void;
}

export class ByteReader extends ByteWindow {
  #line = 1;
  /** Line of the item read last. */
  #lastLine = 1;
  /** Line of the number that was read last. */
  #numberLine = 0;
  /** Whether everything read so far is text; locations are then given as lines. */
  #isText = true;
  /** Whether a line read so far ended with a lone carriage return. */
  #hasLoneReturns = false;
  readonly #comment: number;
  readonly #continuation: number;
  readonly #onComment: ByteReaderOptions["onComment"];

  private constructor(source: ByteSource, options: ByteReaderOptions) {
    super(source, options);
    const { comment, continuation, onComment } = options;
    this.#comment = comment?.charCodeAt(0) ?? NaN;
    this.#continuation = continuation?.charCodeAt(0) ?? NaN;
    this.#onComment = onComment;
  }

  /** Runs `read` on a file and releases the file in any case. Throws a ReadFailure if the file is empty. */
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
      await reader.close();
    }
  }

  /** Reads the next word of this line or a later one; empty at the end of the file. */
  word(): string {
    this.#skipBlanks(true);
    return this.#text(this.#wordEnd());
  }

  /** Reads the next word of this line; empty at the end of the line. */
  wordInLine(): string {
    this.#skipBlanks(false);
    return this.#text(this.#wordEnd());
  }

  /** Returns whether the next word, in this line or a later one, begins like a number. */
  startsNumber(): boolean {
    this.#skipBlanks(true);
    return NUMBER_BEGINS.includes(this.buffer[this.at] ?? 0);
  }

  /**
   * Consumes the next word if it equals `word`, which is in lower case, ignoring the case in the file. Returns
   * whether it did.
   */
  accepts(word: string): boolean {
    this.#skipBlanks(true);
    const end = this.#wordEnd();
    if (end - this.at !== word.length) return false;
    for (let i = 0; i < word.length; i++) {
      const byte = this.buffer[this.at + i] ?? 0;
      const isCapital = byte >= 65 && byte <= 90;
      if ((isCapital ? byte + 32 : byte) !== word.charCodeAt(i)) return false;
    }
    this.at = end;
    return true;
  }

  /** Consumes the next word like `accepts`; any other word is a failure. */
  expect(word: string): void {
    if (this.accepts(word)) return;
    this.failAtWord(`"${word}"`, [word]);
  }

  /** Fails at the next word; `words`: what could be there, of which a part may be left at the end of the file. */
  failAtWord(expected: string, words: readonly string[] = []): never {
    if (this.#wordEnd() === this.at || this.#isCutFrom(words)) this.failAtEnd(expected);
    return this.fail(`expected ${expected}, found ${this.#shown()}`);
  }

  /** Fails because the file ends where something should follow. */
  failAtEnd(expected: string): never {
    throw truncatedAt(this.location, `where ${expected} should follow`);
  }

  /** Fails because of the word that was read last, of which a part may be left at the end of the file. */
  failUnknown(what: string, word: string): never {
    if (this.isAtEnd) this.failAtEnd(`the rest of a ${what}`);
    return this.fail(`unknown ${what} "${word.slice(0, SHOWN)}"`);
  }

  /** Returns whether the next word is the last of the file, without a line end, and the beginning of one of these. */
  #isCutFrom(words: readonly string[]): boolean {
    const end = this.#wordEnd();
    if (!this.#isCutAt(end)) return false;
    const found = textOf(this.buffer.subarray(this.at, end)).toLowerCase();
    return words.some((word) => word.startsWith(found));
  }

  /** Returns whether the file ends with a word that ends at `end`. */
  #isCutAt(end: number): boolean {
    return this.isWhole && end === this.buffer.length && end > this.at;
  }

  /**
   * Reads the next word as a finite number. With `mayBeNone`, as for values at nodes, NaN and infinities are
   * accepted. `what` names the number in messages.
   */
  number(what: string, mayBeNone = false): number {
    const before = this.#lastLine;
    this.#skipBlanks(true);
    const end = this.#wordEnd();
    if (end === this.at) this.failAtEnd(what);
    let value: number | undefined = decimalIn(this.buffer, this.at, end);
    if (!Number.isFinite(value)) value = mayBeNone ? otherNumber(this.buffer, this.at, end) : undefined;
    if (value === undefined) return this.#failAtNumber(what, end, before);
    this.at = end;
    this.#numberLine = this.#line;
    return value;
  }

  /** `before`: line of the item before the number. */
  #failAtNumber(what: string, end: number, before: number): never {
    const expected = `expected ${what}, found ${this.#shown()}`;
    const found = textOf(this.buffer.subarray(this.at, end));
    if (this.#isCutAt(end) && /^[-+]?\d*\.?\d*(e[-+]?\d*)?$/i.test(found))
      this.failAtEnd(`the rest of ${what}`);
    if (/^[a-z_]/i.test(found) && !/^(nan|inf)/i.test(found)) {
      // A line of numbers; after a keyword, numbers begin in the next line.
      const isMissing = this.#isText && this.#lastLine > before && this.#numberLine === before;
      if (isMissing)
        this.fail(`expected ${what}, found the end of the line, then ${this.#shown()}`, { line: before });
      this.fail(`${expected}, which is not a number`);
    }
    const points = found.replace(",", ".");
    if (points.includes(".") && Number.isFinite(Number(points))) {
      this.fail(`${expected}, which has a decimal comma`, this.location, "Export it with decimal points.");
    }
    return this.fail(`${expected}, which is not a finite number`);
  }

  /** Reads the next word as a whole number from 0 to `limit` - 1. */
  index(what: string, limit: number): number {
    const value = this.number(what);
    return Number.isInteger(value) && value >= 0 && value < limit
      ? value
      : this.fail(`expected ${what} (a whole number from 0 to ${limit - 1}), found ${value}`);
  }

  /** Returns whether this line has another word. */
  hasWordInLine(): boolean {
    this.#skipBlanks(false);
    return this.#wordEnd() > this.at;
  }

  /**
   * Skips blanks and comments up to the next word. It may stop early when the window is low: call `fill`, then call
   * it again.
   */
  skipComments(): void {
    this.#skipBlanks(true, true);
  }

  /** Skips the rest of this line and the lines that continue it. */
  skipLine(): void {
    for (;;) {
      const begin = this.at;
      const end = this.#lineEnd();
      this.at = end;
      const last = this.buffer[end - 1] === CARRIAGE_RETURN ? end - 2 : end - 1;
      if (last < begin || !this.#isContinued(last)) return;
      this.#passLineEnd();
      this.#line++;
    }
  }

  /** Reads the rest of this line and moves to the next one. Removes white space and byte-order marks from both ends. */
  line(): string {
    const end = this.#lineEnd();
    const text = textOf(this.buffer.subarray(this.at, end));
    this.at = end;
    if (end < this.buffer.length) this.#passLineEnd();
    this.#lastLine = this.#line++;
    return text.trim();
  }

  /** Consumes the line end between a text header and binary numbers. */
  endLine(): void {
    this.#skipBlanks(false);
    if (!this.#isLineEnd(this.at)) this.failAtWord("the end of the line");
    this.#passLineEnd();
    this.#lastLine = this.#line++;
  }

  /** Moves past the next occurrence of `text` and the rest of its line. */
  async skipPast(text: string): Promise<void> {
    const encoded = new TextEncoder().encode(text);
    for (;;) {
      await this.fill();
      const found = indexOf(this.buffer, encoded, this.at);
      if (found >= 0) {
        this.#moveTo(found + encoded.length);
        await this.fill();
        this.skipLine();
        return;
      }
      // Keep the bytes at the end of the window that may be the beginning of `text`.
      this.#moveTo(Math.max(this.at, this.buffer.length - encoded.length + 1));
      if (this.isWhole) this.failAtEnd(`"${text}"`);
    }
  }

  /**
   * Returns `count` if it is a whole number of at least 0; any other value is a failure. The file may still hold
   * fewer items.
   */
  count(count: number, what: string): number {
    if (Number.isNaN(count)) this.fail(`expected the number of ${what}`);
    return Number.isSafeInteger(count) && count >= 0
      ? count
      : this.fail(`expected the number of ${what}, found ${count}`);
  }

  override get location(): FileLocation {
    return this.#isText ? { line: this.#lastLine } : super.location;
  }

  /** Moves within the window over lines that are not parsed. */
  #moveTo(at: number): void {
    if (this.#isText) {
      for (let end = this.at; end < at; end++) if (this.#isLineEnd(end)) this.#line++;
    }
    this.at = at;
    this.#lastLine = this.#line;
  }

  /** A carriage return before a line feed counts as a blank. */
  #isLineEnd(at: number): boolean {
    const byte = this.buffer[at];
    return byte === LINE_FEED || (byte === CARRIAGE_RETURN && this.buffer[at + 1] !== LINE_FEED);
  }

  /** Returns whether the byte at `at` continues its line on the next one. */
  #isContinued(at: number): boolean {
    const after = this.buffer[at + 1];
    return this.buffer[at] === this.#continuation && (after === LINE_FEED || after === CARRIAGE_RETURN);
  }

  #passLineEnd(): void {
    if (this.buffer[this.at++] === CARRIAGE_RETURN) this.#hasLoneReturns = true;
  }

  /** Marks the following numbers as binary. */
  protected override leaveText(): void {
    if (!this.#isText) return;
    if (this.#hasLoneReturns) {
      // The first byte of a number may be a line feed, and would then be taken for the second half of a line end.
      this.fail("binary numbers must not follow lines that end with a lone carriage return");
    }
    this.#isText = false;
  }

  #skipBlanks(alsoLineEnds: boolean, mayPause = false): void {
    const bytes = this.buffer;
    for (; this.at < bytes.length; this.at++) {
      const byte = bytes[this.at] ?? 0;
      if (byte > SPACE) {
        if (startsWithMark(bytes, this.at)) {
          this.at += MARK_BYTES - 1;
          continue;
        }
        if (byte === this.#continuation && this.#isContinued(this.at)) {
          const isPair = bytes[this.at + 1] === CARRIAGE_RETURN && bytes[this.at + 2] === LINE_FEED;
          this.at += isPair ? 2 : 1;
          this.#line++;
          continue;
        }
        if (byte !== this.#comment) break;
        const begin = this.at + 1;
        this.at = this.#lineEnd();
        if (this.at - begin < MAX_COMMENT_BYTES) this.#onComment?.(textOf(bytes.subarray(begin, this.at)));
        if (mayPause && this.isLow) break;
        this.at--;
      } else if ((byte === LINE_FEED || byte === CARRIAGE_RETURN) && this.#isLineEnd(this.at)) {
        if (!alsoLineEnds) break;
        if (byte === CARRIAGE_RETURN) this.#hasLoneReturns = true;
        this.#line++;
      }
    }
    this.#lastLine = this.#line;
    if (this.at === bytes.length) this.checkEdge();
  }

  #wordEnd(): number {
    const bytes = this.buffer;
    let end = this.at;
    for (; end < bytes.length; end++) {
      const byte = bytes[end] ?? 0;
      if (byte <= SPACE || byte === this.#comment) return end;
      if (byte === this.#continuation && this.#isContinued(end)) return end;
    }
    this.checkEdge();
    return end;
  }

  #lineEnd(): number {
    let end = this.at;
    while (end < this.buffer.length && !this.#isLineEnd(end)) end++;
    // A carriage return as the last byte of the window may be followed by a line feed.
    if (end + 1 >= this.buffer.length && this.buffer[end] !== LINE_FEED) this.checkEdge();
    return end;
  }

  #text(end: number): string {
    const begin = this.at;
    this.at = end;
    let text = "";
    for (let i = begin; i < end; i++) {
      const byte = this.buffer[i] ?? 0;
      if (byte >= FIRST_OF_SEVERAL) return textOf(this.buffer.subarray(begin, end));
      text += String.fromCharCode(byte);
    }
    return text;
  }

  /** Returns the current word in quotes, shortened for a message. */
  #shown(): string {
    const end = this.#wordEnd();
    const text = String.fromCharCode(...this.buffer.subarray(this.at, Math.min(end, this.at + SHOWN)));
    return end - this.at > SHOWN ? `"${text}…"` : `"${text}"`;
  }
}

/** Location for problems of a file's first line. */
export const FIRST_LINE: FileLocation = { line: 1 };
