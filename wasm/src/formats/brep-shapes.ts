/**
 * Checks the table of shapes at the end of a BREP file before OpenCascade reads it. OpenCascade follows wrong indices into memory, and
 * does not notice the end of a file. The grammar is that of OpenCascade's documentation, "BREP format", version 1; of other versions,
 * only the number of shapes is checked.
 */
import { PAUSE, STEP, type Steps } from "../base/steps.js";

/** Numbers of entries of the tables before. */
export type TableCounts = ReadonlyMap<string, number>;

/** What is wrong, and where. */
export interface WrongShape {
  /** Index of the line, from 0. */
  readonly line: number;
  readonly message: string;
}

interface Reading {
  readonly lines: readonly string[];
  readonly counts: TableCounts;
  readonly shapes: number;
}

const KINDS: Readonly<Record<string, string>> = {
  Ve: "vertex",
  Ed: "edge",
  Wi: "wire",
  Fa: "face",
  Sh: "shell",
  So: "solid",
  CS: "compsolid",
  Co: "compound",
};

const article = (name: string) => (name === "edge" ? "an" : "a");

/**
 * Arguments of the representations of an edge or a vertex, by their number; 0 ends the list. Numbers of tables are named, "l" is a
 * location, "x" a number, "c" a continuity.
 */
const OF_EDGE: Readonly<Record<string, readonly string[]>> = {
  1: ["Curves", "l", "x", "x"],
  2: ["Curve2ds", "Surfaces", "l", "x", "x"],
  3: ["Curve2ds", "Curve2ds", "c", "Surfaces", "l", "x", "x"],
  4: ["c", "Surfaces", "l", "Surfaces", "l"],
  5: ["Polygon3D", "l"],
  6: ["PolygonOnTriangulations", "Triangulations", "l"],
  7: ["PolygonOnTriangulations", "PolygonOnTriangulations", "Triangulations", "l"],
};
const OF_VERTEX: Readonly<Record<string, readonly string[]>> = {
  1: ["Curves", "l"],
  2: ["Curve2ds", "Surfaces", "l"],
  3: ["x", "Surfaces", "l"],
};

/** Returns what is wrong in the table of shapes, which begins at line `begin`; undefined if nothing is. O(n). */
export function* wrongShapes(
  lines: readonly string[],
  begin: number,
  counts: TableCounts,
): Steps<WrongShape | undefined> {
  const shapes = counts.get("TShapes") ?? 0;
  const isKnown = lines.slice(0, HEAD_LINES).some((line) => line.startsWith("CASCADE Topology V1"));
  if (!isKnown) return missingShapes(lines, begin, shapes);
  const parser = new ShapeParser({ lines, counts, shapes }, begin);
  for (let shape = 1; shape <= shapes; shape++) {
    const wrong = parser.wrongShape(shape);
    if (wrong !== undefined) return wrong;
    if (shape % STEP === 0) yield PAUSE;
  }
  return parser.wrongReference(shapes + 1)
    ? parser.wrong("the reference to the whole shape", shapes)
    : undefined;
}

/** The version is among the first lines. */
const HEAD_LINES = 10;

/** Each shape ends with an asterisk. */
function missingShapes(lines: readonly string[], begin: number, shapes: number): WrongShape | undefined {
  let ends = 0;
  for (let i = begin; i < lines.length; i++) if (/(^|\s)\*\s*$/.test(lines[i] ?? "")) ends++;
  if (ends >= shapes) return undefined;
  let line = lines.length - 1;
  while (line > 0 && (lines[line] ?? "").trim() === "") line--;
  return {
    line,
    message: `it announces ${shapes} shapes, but contains ${ends}; it is truncated, or lines are missing`,
  };
}

class ShapeParser {
  readonly #reading: Reading;
  #line: number;
  #words: string[] = [];
  #last = "";

  constructor(reading: Reading, begin: number) {
    this.#reading = reading;
    this.#line = begin - 1;
  }

  /** Reads one shape. */
  wrongShape(shape: number): WrongShape | undefined {
    const kind = this.#next();
    const name = KINDS[kind];
    const wrong = (expected: string) =>
      this.wrong(`${expected} of shape ${shape}${name ? `, ${article(name)} ${name}` : ""}`, shape - 1);
    if (name === undefined) return wrong("the kind");
    if (kind === "Ve" && !(this.#numbers(4) && this.#representations(OF_VERTEX, true)))
      return wrong("the geometry");
    if (kind === "Ed" && !(this.#numbers(4) && this.#representations(OF_EDGE, false)))
      return wrong("the geometry");
    if (kind === "Fa" && !this.#face()) return wrong("the surface");
    if (!/^[01]{7}$/.test(this.#next())) return wrong("the seven flags");
    for (let sub = this.#next(); sub !== "*"; sub = this.#next()) {
      this.#words.unshift(sub);
      if (this.wrongReference(shape)) return wrong("a part");
    }
    return undefined;
  }

  /** Reads a reference to a shape before shape number `before`, such as "+12 0". */
  wrongReference(before: number): boolean {
    const [, number] = /^[+\-ie](\d+)$/.exec(this.#next()) ?? [];
    const index = this.#reading.shapes + 1 - Number(number ?? NaN);
    return !(index >= 1 && index < before && this.#argument("l"));
  }

  wrong(expected: string, last: number): WrongShape {
    const found = this.#last === "" ? "the end of the file: it is truncated" : `"${this.#last.slice(0, 24)}"`;
    const read = last === 0 ? "" : `; before it, ${last} of ${this.#reading.shapes} shapes are complete`;
    return { line: this.#line, message: `expected ${expected}, found ${found}${read}` };
  }

  /** Returns the next word; an empty text at the end of the file. */
  #next(): string {
    while (this.#words.length === 0 && this.#line < this.#reading.lines.length - 1) {
      const line = this.#reading.lines[++this.#line] ?? "";
      this.#words = line.split(/\s+/).filter((word) => word !== "");
    }
    this.#last = this.#words.shift() ?? "";
    return this.#last;
  }

  #numbers(count: number): boolean {
    for (let i = 0; i < count; i++) if (!this.#argument("x")) return false;
    return true;
  }

  #argument(kind: string): boolean {
    const word = this.#next();
    if (kind === "x") return word !== "" && !Number.isNaN(Number(word));
    if (kind === "c") return /^(C[0123N]|G[12])$/.test(word);
    const least = kind === "l" ? 0 : 1;
    const most = this.#reading.counts.get(kind === "l" ? "Locations" : kind) ?? 0;
    return /^\d+$/.test(word) && Number(word) >= least && Number(word) <= most;
  }

  #representations(kinds: Readonly<Record<string, readonly string[]>>, hasParameter: boolean): boolean {
    for (;;) {
      if (hasParameter && !this.#argument("x")) return false;
      const kind = this.#next();
      if (kind === "0") return true;
      const args = kinds[kind];
      if (args === undefined) return false;
      for (const [i, argument] of args.entries()) {
        // The second curve and the continuity are one word: "30CN".
        if (args[i + 1] === "c") this.#splitWord();
        if (!this.#argument(argument)) return false;
      }
    }
  }

  #splitWord(): void {
    const word = this.#next();
    const [, number, rest] = /^(\d+)([CG]\w)$/.exec(word) ?? [];
    if (number === undefined || rest === undefined) this.#words.unshift(word);
    else this.#words.unshift(number, rest);
  }

  /** Reads whether a face is bounded, its tolerance, surface and location, and its triangulation, on a line of its own. */
  #face(): boolean {
    const isRead = this.#numbers(2) && this.#surface() && this.#argument("l");
    const next = this.#reading.lines[this.#line + 1] ?? "";
    if (!isRead || this.#words.length > 0 || !next.startsWith("2")) return isRead;
    this.#next();
    return this.#argument("Triangulations");
  }

  /** A face of triangles only has surface 0. */
  #surface(): boolean {
    const word = this.#next();
    const most = this.#reading.counts.get("Surfaces") ?? 0;
    return /^\d+$/.test(word) && Number(word) <= most;
  }
}
