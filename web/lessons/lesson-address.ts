/** The open lesson in the address of the page: `lesson=7&runs=first-in,random`. */
import { FRONT_ORDERS, type FrontOrder } from "tetrafront";

export interface LessonAddress {
  /** Place of the lesson in the course, from 1. */
  readonly number: number;
  /** Orders in which the model of the lesson is run besides the lesson's own, in the order of the runs. */
  readonly runs: readonly FrontOrder[];
}

/** Returns the lesson that an address names; null if it names none. Unknown orders are left out. */
export function lessonIn(query: URLSearchParams): LessonAddress | null {
  const number = query.get("lesson");
  if (number === null) return null;
  const runs = (query.get("runs") ?? "").split(",").flatMap((name) => {
    const order = FRONT_ORDERS.find((known) => known === name.trim());
    return order ? [order] : [];
  });
  return { number: Number(number), runs: [...new Set(runs)] };
}

/** Returns the address with another lesson, or without any. */
export function withLesson(address: string, lesson: LessonAddress | null): URL {
  const changed = new URL(address);
  for (const start of ["model", "new", "lesson", "runs"]) changed.searchParams.delete(start);
  if (!lesson) return changed;
  changed.searchParams.set("lesson", String(lesson.number));
  if (lesson.runs.length > 0) changed.searchParams.set("runs", lesson.runs.join(","));
  return changed;
}
