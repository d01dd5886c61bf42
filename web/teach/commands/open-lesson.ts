import { createStore, type StoreApi } from "zustand/vanilla";
import type { App } from "../../app/app";

/** The open lesson, as an address names it. */
export interface OpenLesson {
  /** Place of the lesson in the course, from 1; null: the list of the lessons is open. */
  readonly number: number | null;
  /** Rules by which its model was run, or shall be run, besides the lesson's own. */
  readonly runs: readonly string[];
}

const stores = new WeakMap<App, StoreApi<OpenLesson>>();

export function openLessonOf(app: App): StoreApi<OpenLesson> {
  const made = stores.get(app) ?? createStore<OpenLesson>(() => ({ number: null, runs: [] }));
  stores.set(app, made);
  return made;
}
