import { ReadFailure } from "../read-result.js";

const LINE_FEED = 10;
const SPACE = 32;

/** Walks through a text file word by word and knows the line it is in, from 1. */
export class TextScanner {
  #position = 0;
  #line = 1;
  readonly #text: string;
  readonly #comment: number | undefined;
  readonly #remedy: string;

  /** `comment`: a character that hides the rest of its line. `remedy`: what `fail` advises. */
  constructor(bytes: Uint8Array, options: { comment?: string; remedy: string }) {
    this.#text = decoded(bytes);
    this.#comment = options.comment?.charCodeAt(0);
    this.#remedy = options.remedy;
  }

  get line(): number {
    return this.#line;
  }

  /** The next word, or undefined at the end of the file. */
  next(): string | undefined {
    this.#skipBlanks(true);
    return this.#word();
  }

  /** The next word of this line, or undefined at its end. */
  nextInLine(): string | undefined {
    this.#skipBlanks(false);
    return this.#text.charCodeAt(this.#position) === LINE_FEED ? undefined : this.#word();
  }

  /** Skips what is left of this line. */
  skipLine(): void {
    const end = this.#text.indexOf("\n", this.#position);
    this.#position = end < 0 ? this.#text.length : end;
  }

  /** The next word as a finite number; `what` names it where it is missing or is none. */
  number(what: string): number {
    const word = this.next();
    if (word === undefined) return this.fail(`the file ends where ${what} should be`);
    const value = Number(word);
    if (!Number.isFinite(value)) return this.fail(`"${clipped(word)}" is not a finite number (${what})`);
    return value;
  }

  /** The next word as a whole number from 0 to `limit` - 1. */
  index(what: string, limit: number): number {
    const value = this.number(what);
    if (!Number.isInteger(value) || value < 0 || value >= limit) {
      return this.fail(`${value} is not a whole number from 0 to ${limit - 1} (${what})`);
    }
    return value;
  }

  fail(message: string): never {
    throw new ReadFailure({
      message: `line ${this.#line}: ${message}`,
      remedy: this.#remedy,
      line: this.#line,
    });
  }

  #word(): string | undefined {
    const begin = this.#position;
    while (this.#position < this.#text.length) {
      const code = this.#text.charCodeAt(this.#position);
      if (code <= SPACE || code === this.#comment) break;
      this.#position++;
    }
    return this.#position === begin ? undefined : this.#text.slice(begin, this.#position);
  }

  #skipBlanks(alsoLineEnds: boolean): void {
    for (; this.#position < this.#text.length; this.#position++) {
      const code = this.#text.charCodeAt(this.#position);
      if (code === this.#comment) {
        this.skipLine();
        this.#position--;
      } else if (code === LINE_FEED) {
        if (!alsoLineEnds) return;
        this.#line++;
      } else if (code > SPACE) return;
    }
  }
}

function decoded(bytes: Uint8Array): string {
  try {
    return new TextDecoder().decode(bytes);
  } catch {
    // JavaScript has a longest string, of half a thousand million characters in V8.
    const message = `the text of ${bytes.length} bytes is too long to be read`;
    throw new ReadFailure({ message, remedy: "Use a binary format, for example binary STL." });
  }
}

/** Words come from files of any kind: no more of them in a message than a reader can use. */
function clipped(word: string): string {
  return word.length > 24 ? `${word.slice(0, 24)}…` : word;
}
