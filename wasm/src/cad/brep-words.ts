/** Reads the words of a BREP file: OpenCascade's text format of shapes. */
import type { Vector } from "../base/vectors.js";
import { CadFileError, type PlaneVector } from "./trimmed-model.js";

const REMEDY = "Export the part again as BREP, or in another format.";
const SPACE = 32;

export class BrepWords {
  readonly #text: string;
  readonly #fileName: string;
  #at = 0;

  constructor(text: string, fileName: string) {
    this.#text = text;
    this.#fileName = fileName;
  }

  /** Skips all words up to a table, and returns its number of entries. Throws if the table is missing. */
  table(name: string): number {
    const found = new RegExp(`^${name}[ \\t]+`, "m");
    const rest = found.exec(this.#text.slice(this.#at));
    if (rest === null) throw this.wrong(`expected the table "${name}"`);
    this.#at += rest.index + rest[0].length;
    return this.count();
  }

  /** Returns the next word; throws at the end of the file. */
  word(): string {
    const text = this.#text;
    let begin = this.#at;
    while (begin < text.length && text.charCodeAt(begin) <= SPACE) begin++;
    let end = begin;
    while (end < text.length && text.charCodeAt(end) > SPACE) end++;
    if (end === begin) throw this.wrong("expected another entry, found the end of the file");
    this.#at = end;
    return text.slice(begin, end);
  }

  number(): number {
    const word = this.word();
    const value = Number(word);
    if (!Number.isFinite(value)) throw this.wrong(`expected a number, found "${word.slice(0, 20)}"`);
    return value;
  }

  /** Returns a whole number from 0 to `most`. */
  count(most = 0xffffffff): number {
    const value = this.number();
    if (!(Number.isInteger(value) && value >= 0 && value <= most))
      throw this.wrong(`expected a whole number from 0 to ${most}, found ${value}`);
    return value;
  }

  flag(): boolean {
    return this.count(1) === 1;
  }

  vector(): Vector {
    return [this.number(), this.number(), this.number()];
  }

  planeVector(): PlaneVector {
    return [this.number(), this.number()];
  }

  numbers(count: number): Float64Array {
    if (count > this.#text.length - this.#at)
      throw this.wrong(`${count} numbers are more than the file contains`);
    return Float64Array.from({ length: count }, () => this.number());
  }

  /** Returns an error at the last word that was read. */
  wrong(message: string): CadFileError {
    const line = this.#text.slice(0, this.#at).split("\n").length;
    return new CadFileError(this.#fileName, `line ${line}: ${message}`, REMEDY);
  }
}
