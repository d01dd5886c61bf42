/** A mistake of a lesson: where it is, what is wrong, and what to do. */
export interface LessonMistake {
  /** Path of the file, as the compiler was given it. */
  readonly file: string;
  /** Line, from 1. */
  readonly line: number;
  readonly problem: string;
  /** What the author does about it; begins with a verb. */
  readonly remedy: string;
}

/** Reports all mistakes of a lesson at once, one line each. */
export class LessonError extends Error {
  constructor(readonly mistakes: readonly LessonMistake[]) {
    super(
      mistakes.map(({ file, line, problem, remedy }) => `${file}:${line}: ${problem} ${remedy}`).join("\n"),
    );
    this.name = "LessonError";
  }
}

/** Notes a mistake in a line of the file. */
export type NoteMistake = (line: number, problem: string, remedy: string) => void;

/** Returns names as a sentence lists them: "a, b or c". */
export function listOf(names: readonly string[], last = "or"): string {
  if (names.length === 0) return "none";
  return names.length === 1 ? `${names[0]}` : `${names.slice(0, -1).join(", ")} ${last} ${names.at(-1)}`;
}
