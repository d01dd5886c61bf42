/** The lessons, loaded once, and which of their tasks are done, kept in the browser. */
import { createStore, type StoreApi } from "zustand/vanilla";
import { loadCourse, type Course } from "./lesson-files";
import type { Lesson } from "./lesson";

const storageKey = "tetrafront-lessons";

/** Numbers of the tasks done, from 0, by lesson. */
export type Progress = Readonly<Record<string, readonly number[]>>;

/** Progress is the same for all apps of a page. */
export const progress: StoreApi<Progress> = createStore<Progress>(() => keptProgress());

function keptProgress(): Progress {
  try {
    return progressIn(JSON.parse(localStorage.getItem(storageKey) ?? "{}"));
  } catch {
    // Without storage, or with a damaged entry, no task is done.
    return {};
  }
}

/** Returns what of a value is progress. */
export function progressIn(value: unknown): Progress {
  if (typeof value !== "object" || value === null) return {};
  const isTask = (task: unknown): task is number => Number.isInteger(task) && Number(task) >= 0;
  return Object.fromEntries(
    Object.entries(value).flatMap(([lesson, tasks]) =>
      Array.isArray(tasks) ? [[lesson, tasks.filter(isTask)]] : [],
    ),
  );
}

function setProgress(changed: Progress): void {
  progress.setState(changed, true);
  try {
    localStorage.setItem(storageKey, JSON.stringify(changed));
  } catch {
    // Without storage, progress ends with the page.
  }
}

export function finishTask({ id }: Pick<Lesson, "id">, task: number): void {
  const done = progress.getState()[id] ?? [];
  if (!done.includes(task)) setProgress({ ...progress.getState(), [id]: [...done, task] });
}

/** Forgets what is done of a lesson. */
export function restart({ id }: Pick<Lesson, "id">): void {
  setProgress(Object.fromEntries(Object.entries(progress.getState()).filter(([lesson]) => lesson !== id)));
}

export function isFinished({ id, tasks }: Lesson, done: Progress): boolean {
  return tasks.every((_, task) => done[id]?.includes(task) ?? false);
}

let loading: Promise<Course> | null = null;

/** Loads the lessons once; a failed load is repeated by the next call. */
export function course(): Promise<Course> {
  loading ??= loadCourse().catch((error: unknown) => {
    loading = null;
    throw error;
  });
  return loading;
}
