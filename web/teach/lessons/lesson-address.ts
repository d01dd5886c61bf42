/** The open lesson in the address of the page: `lesson=7&runs=first-in,strict`. */
import { integerIn } from "../player/shared-front";
import { nameOfRules, rulesNamed } from "./run-rules";

export interface LessonAddress {
  /** Place of the lesson in the course, from 1; NaN if the address has something else. */
  readonly number: number;
  /** Names of the rules by which the model is run besides the lesson's own, in the order of the runs (run-rules.ts). */
  readonly runs: readonly string[];
  /** State of the front that is shown first; null for the one where the lesson begins. */
  readonly step: number | null;
}

/** Returns the lesson that an address names; null if it names none. Unknown rules are left out. */
export function lessonIn(query: URLSearchParams): LessonAddress | null {
  const number = query.get("lesson");
  if (number === null) return null;
  const runs = (query.get("runs") ?? "").split(",").flatMap((name) => {
    const rules = rulesNamed(name);
    const known = rules ? nameOfRules(rules) : "";
    return known === "" ? [] : [known];
  });
  return { number: Number(number), runs: [...new Set(runs)], step: integerIn(query.get("step")) };
}

/** Returns the address with another lesson, or without any. */
export function withLesson(address: string, lesson: Omit<LessonAddress, "step"> | null): URL {
  const changed = new URL(address);
  for (const start of ["model", "new", "lesson", "runs"]) changed.searchParams.delete(start);
  if (!lesson) return changed;
  changed.searchParams.set("lesson", String(lesson.number));
  if (lesson.runs.length > 0) changed.searchParams.set("runs", lesson.runs.join(","));
  return changed;
}
