/** Splits the text of a lesson into its blocks: text, figures, tasks, and walks with their stops. */
import type { NoteMistake } from "./lesson-error.ts";

export interface Field {
  readonly name: string;
  readonly value: string;
  readonly line: number;
}

/** Markdown; `line` is the first line of the text in the file, from 1. */
export interface TextBlock {
  readonly kind: "text";
  readonly line: number;
  readonly text: string;
}

export interface FigureBlock {
  readonly kind: "figure";
  readonly line: number;
  /** What stands after `figure`: kind and letter. */
  readonly head: string;
  readonly fields: readonly Field[];
}

export interface TaskBlock {
  readonly kind: "task";
  readonly line: number;
  readonly fields: readonly Field[];
}

/** A paragraph of a walk, and the state of the figure that belongs to it. */
export interface Stop {
  readonly line: number;
  /** What stands after `@`, such as `A step=0 beat=2`. */
  readonly destination: string;
  /** Text and tasks, in their order. */
  readonly parts: readonly (TextBlock | TaskBlock)[];
}

export interface WalkBlock {
  readonly kind: "walk";
  readonly line: number;
  readonly figure: FigureBlock | null;
  readonly stops: readonly Stop[];
}

export type LessonBlock = TextBlock | FigureBlock | TaskBlock | WalkBlock;

export interface LessonParts {
  readonly title: string;
  readonly lead: TextBlock | null;
  readonly blocks: readonly LessonBlock[];
}

/** Returns the parts of a lesson. Mistakes are noted, and what is readable is returned. */
export function splitLesson(source: string, note: NoteMistake): LessonParts {
  // Some editors begin a file with a byte order mark.
  return new Splitter(source.replace(/^\uFEFF/, "").split(/\r?\n/), note).split();
}

class Splitter {
  #next = 0;

  constructor(
    readonly lines: readonly string[],
    readonly note: NoteMistake,
  ) {}

  split(): LessonParts {
    this.#skipBlank();
    const title = /^# (.+)$/.exec(this.#line)?.[1] ?? "";
    if (title === "")
      this.note(
        this.#isOver ? 1 : this.#next + 1,
        "The title is missing.",
        'Begin the file with a line "# Title".',
      );
    else this.#next++;
    this.#skipBlank();
    return { title, lead: this.#lead(), blocks: this.#blocks() };
  }

  get #line(): string {
    return this.lines[this.#next] ?? "";
  }

  get #isOver(): boolean {
    return this.#next >= this.lines.length;
  }

  #skipBlank(): void {
    while (!this.#isOver && this.#line.trim() === "") this.#next++;
  }

  #lead(): TextBlock | null {
    const line = this.#next + 1;
    const text: string[] = [];
    for (; this.#line.startsWith(">"); this.#next++) text.push(this.#line.replace(/^> ?/, ""));
    return text.length === 0 ? null : { kind: "text", line, text: text.join("\n") };
  }

  #blocks(): readonly LessonBlock[] {
    const blocks: LessonBlock[] = [];
    while (!this.#isOver) {
      const fenced = this.#fenced();
      if (fenced) blocks.push(fenced);
      else if (/^::: walk\s*$/.test(this.#line)) blocks.push(this.#walk());
      else if (this.#line.startsWith(":::")) this.#unknownDivision();
      else blocks.push(this.#text((line) => line.startsWith(":::")));
    }
    return blocks;
  }

  #unknownDivision(): void {
    this.note(
      this.#next + 1,
      `"${this.#line.trim()}" does not belong here.`,
      'Begin a walk with "::: walk", end it with ":::".',
    );
    this.#next++;
  }

  /** Reads lines up to a figure, a task, or a line that ends the text. */
  #text(ends: (line: string) => boolean): TextBlock {
    const line = this.#next + 1;
    const text: string[] = [];
    for (; !this.#isOver; this.#next++) {
      if (/^```(figure|task)\b/.test(this.#line) || (text.length > 0 && ends(this.#line))) break;
      text.push(this.#line);
    }
    return { kind: "text", line, text: text.join("\n") };
  }

  #fenced(): FigureBlock | TaskBlock | null {
    const [, kind, head = ""] = /^```(figure|task)\b(.*)$/.exec(this.#line) ?? [];
    if (kind === undefined) return null;
    const line = ++this.#next;
    const fields: Field[] = [];
    for (; !this.#isOver && !this.#line.startsWith("```"); this.#next++) {
      if (this.#line.trim() === "") continue;
      const [, name, value] = /^([a-z][\w-]*):\s*(.+)$/i.exec(this.#line.trim()) ?? [];
      const last = fields.at(-1);
      if (name !== undefined && value !== undefined) fields.push({ name, value, line: this.#next + 1 });
      // A long value goes on in indented lines.
      else if (last && /^\s+\S/.test(this.#line))
        fields.push({ ...last, value: `${fields.pop()?.value ?? ""} ${this.#line.trim()}` });
      else this.note(this.#next + 1, `"${this.#line.trim()}" is no field.`, 'Write "name: value".');
    }
    if (this.#isOver) this.note(line, `The block "${kind}" does not end.`, "Close it with a line ```.");
    this.#next++;
    return kind === "task" ? { kind, line, fields } : { kind: "figure", line, head: head.trim(), fields };
  }

  #walk(): WalkBlock {
    const line = ++this.#next;
    let figure: FigureBlock | null = null;
    let textLine: number | null = null;
    for (; !this.#isOver && !/^::: stops\s*$/.test(this.#line) && this.#line !== ":::";) {
      const block = this.#fenced();
      if (block?.kind === "figure") figure = block;
      else if (block || this.#line.trim() !== "") textLine ??= block?.line ?? this.#next + 1;
      if (!block) this.#next++;
    }
    if (!figure) this.note(line, "The walk has no figure.", 'Add a block ```figure before "::: stops".');
    if (!/^::: stops/.test(this.#line)) {
      this.note(line, "The walk has no stops.", 'Add "::: stops" after the figure.');
      // Its end, or that of the file.
      this.#next++;
      return { kind: "walk", line, figure, stops: [] };
    }
    if (textLine !== null)
      this.note(textLine, "A walk begins with its figure.", 'Put the text after "::: stops".');
    this.#next++;
    return { kind: "walk", line, figure, stops: this.#stops(line) };
  }

  /** Reads the text and the tasks of a stop. */
  #stopParts(endsStop: (line: string) => boolean): Stop["parts"] {
    const parts: (TextBlock | TaskBlock)[] = [];
    while (!this.#isOver && !(parts.length > 0 && endsStop(this.#line))) {
      const fenced = this.#fenced();
      if (fenced?.kind === "figure")
        this.note(fenced.line, "A walk has one figure.", "Put the other figure after the walk.");
      else parts.push(fenced ?? this.#text(endsStop));
    }
    return parts;
  }

  #stops(walkLine: number): readonly Stop[] {
    const stops: Stop[] = [];
    const endsStop = (line: string): boolean => line.startsWith("@") || line.startsWith(":::");
    while (!this.#isOver && !this.#line.startsWith(":::")) {
      if (!this.#line.startsWith("@")) {
        if (this.#line.trim() !== "")
          this.note(
            this.#next + 1,
            "This text belongs to no stop.",
            'Begin the stop with a line such as "@ A step=0 beat=1".',
          );
        this.#next++;
        continue;
      }
      const destination = this.#line.slice(1).trim();
      const line = ++this.#next;
      stops.push({ line, destination, parts: this.#stopParts(endsStop) });
    }
    if (this.#isOver) this.note(walkLine, "The walk does not end.", 'End it with a line ":::".');
    this.#next++;
    return stops;
  }
}
