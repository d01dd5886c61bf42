import { create, type Patches } from "mutative";
import type { Edit, Replacement } from "../document/edit";
import { applyPatches } from "./apply-patches";

export interface HistoryEntry {
  readonly label: string;
  readonly mergeKey: string | undefined;
  /** Milliseconds, any origin. */
  readonly at: number;
  readonly forward: Patches;
  readonly backward: Patches;
}

/** The state with the way back and the way forth. Plain data; every function returns a new one. */
export interface History<State> {
  readonly present: State;
  readonly past: readonly HistoryEntry[];
  readonly future: readonly HistoryEntry[];
}

/** Two edits of the same field within this time are one act of the user. */
const mergeWindowMs = 600;
/** Patches are small; this bounds the memory of a day's work. */
const maxEntries = 500;

export function startHistory<State>(present: State): History<State> {
  return { present, past: [], future: [] };
}

/**
 * The history after an edit at `now`, which is `held` if a key that is held down makes it again: however slowly the
 * page follows, that is one act. Returns the same object if the edit changes nothing.
 */
export function commit<State extends object>(
  history: History<State>,
  edit: Edit<State>,
  now: number,
  held = false,
): History<State> {
  const [present, forward, backward] =
    "change" in edit
      ? create(history.present, edit.change, { enablePatches: true })
      : replaceAll(history.present, edit.replace);
  if (forward.length === 0) return history;
  const last = history.past.at(-1);
  const merges =
    last !== undefined &&
    edit.mergeKey !== undefined &&
    last.mergeKey === edit.mergeKey &&
    (held || now - last.at <= mergeWindowMs) &&
    history.future.length === 0;
  const entry: HistoryEntry = {
    label: edit.label,
    mergeKey: edit.mergeKey,
    at: now,
    forward: merges ? [...last.forward, ...forward] : forward,
    backward: merges ? [...backward, ...last.backward] : backward,
  };
  const kept = merges ? history.past.slice(0, -1) : history.past.slice(1 - maxEntries);
  return { present, past: [...kept, entry], future: [] };
}

function replaceAll<State extends object>(
  state: State,
  replace: Replacement["replace"],
): readonly [State, Patches, Patches] {
  const patch = (path: readonly string[], value: unknown): Patches[number] => ({
    op: "replace",
    path: [...path],
    value,
  });
  const presentAt = (path: readonly string[]): unknown =>
    path.reduce<unknown>((value, step) => (value as Readonly<Record<string, unknown>>)[step], state);
  const changed = replace.filter(([path, value]) => presentAt(path) !== value);
  const forward = changed.map(([path, value]) => patch(path, value));
  const backward = changed.map(([path]) => patch(path, presentAt(path)));
  return [applyPatches(state, forward), forward, backward];
}

/** One step back, or the same object if there is none. */
export function undo<State extends object>(history: History<State>): History<State> {
  const entry = history.past.at(-1);
  if (entry === undefined) return history;
  return {
    present: applyPatches(history.present, entry.backward),
    past: history.past.slice(0, -1),
    future: [entry, ...history.future],
  };
}

/** One step forth, or the same object if there is none. */
export function redo<State extends object>(history: History<State>): History<State> {
  const [entry, ...rest] = history.future;
  if (entry === undefined) return history;
  return {
    present: applyPatches(history.present, entry.forward),
    past: [...history.past, { ...entry, mergeKey: undefined }],
    future: rest,
  };
}
