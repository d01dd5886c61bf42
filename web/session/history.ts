import { create, type Patches } from "mutative";
import type { Change, Edit, Replacement } from "../document/edit";
import { memorySize, textSize } from "../document/memory-size";
import { applyPatches } from "./apply-patches";

/** One step of undo. */
export interface HistoryEntry {
  readonly label: string;
  readonly mergeKey: string | undefined;
  /** Time of the last edit in this entry; milliseconds, any origin. */
  readonly at: number;
  readonly forward: Patches;
  readonly backward: Patches;
  /** Estimated memory of the patches without long texts. */
  readonly bytes: number;
  /** Long texts of the patches, which they share with other steps. */
  readonly longTexts?: readonly string[];
}

/** A state and the steps before and after it. Plain data; every function returns a new history. */
export interface History<State> {
  readonly present: State;
  /** The oldest step first. */
  readonly past: readonly HistoryEntry[];
  /** The next step first. */
  readonly future: readonly HistoryEntry[];
}

/** Edits of the same field within this time are one step. */
const mergeWindowMs = 600;

/** Limit of the memory of all steps. The last step is kept even if it is larger. */
export const maxHistoryBytes = 64 * 2 ** 20;

export function startHistory<State>(present: State): History<State> {
  return { present, past: [], future: [] };
}

/** What a change does to a state. Without patches it does nothing. */
export interface Step<State> {
  readonly present: State;
  readonly forward: Patches;
  readonly backward: Patches;
}

export function stepFrom<State extends object>(state: State, change: Change<State>): Step<State> {
  if ("replace" in change) return replaceAll(state, change.replace);
  const [present, forward, backward] = create(state, change.change, { enablePatches: true });
  return { present, forward, backward };
}

/**
 * Returns the history after a step, which removes the steps that could be redone; the same object if the step
 * is empty.
 */
export function addStep<State>(
  history: History<State>,
  label: string,
  step: Step<State>,
  now: number,
): History<State> {
  return append(history, history.past, { label, mergeKey: undefined, at: now, ...step });
}

/**
 * Returns the history after an edit at `now`, or the same object if the edit changes nothing. The edit is
 * `held` if it comes from a key that is held down: all repetitions are one step, however slow. `stepOf` makes the step
 * of a change.
 */
export function commit<State extends object>(
  history: History<State>,
  edit: Edit<State>,
  now: number,
  held = false,
  stepOf: (state: State, change: Change<State>) => Step<State> = stepFrom,
): History<State> {
  const step = stepOf(history.present, edit);
  const { label, mergeKey } = edit;
  const last = history.past.at(-1);
  const merges =
    last !== undefined &&
    mergeKey !== undefined &&
    last.mergeKey === mergeKey &&
    (held || now - last.at <= mergeWindowMs) &&
    // After an undo, the user has gone back to the last step: never merge into it.
    history.future.length === 0;
  if (!merges) return append(history, history.past, { label, mergeKey, at: now, ...step });
  return append(history, history.past.slice(0, -1), { label, mergeKey, at: now, ...joined(last, step) });
}

/** Returns the state one step back, or the same object if there is none. */
export function undo<State extends object>(history: History<State>): History<State> {
  const entry = history.past.at(-1);
  if (entry === undefined) return history;
  return {
    present: applyPatches(history.present, entry.backward),
    past: history.past.slice(0, -1),
    future: [entry, ...history.future],
  };
}

/** Returns the state one step forward, or the same object if there is none. */
export function redo<State extends object>(history: History<State>): History<State> {
  const [entry, ...rest] = history.future;
  if (entry === undefined) return history;
  return {
    present: applyPatches(history.present, entry.forward),
    past: [...history.past, { ...entry, mergeKey: undefined }],
    future: rest,
  };
}

function append<State>(
  history: History<State>,
  past: readonly HistoryEntry[],
  {
    present,
    label,
    mergeKey,
    at,
    forward,
    backward,
  }: Omit<HistoryEntry, "bytes" | "longTexts"> & Step<State>,
): History<State> {
  if (forward.length === 0) return history;
  const texts = new Set<string>();
  const bytes = memorySize(forward, texts) + memorySize(backward, texts);
  const longTexts = texts.size > 0 && { longTexts: [...texts] };
  return {
    present,
    past: withinLimit([...past, { label, mergeKey, at, forward, backward, bytes, ...longTexts }]),
    future: [],
  };
}

/** Returns the memory of an entry, in bytes. Each long text counts for the first entry that has it. */
export function entryBytes({ bytes, longTexts = [] }: HistoryEntry, counted: Set<string>): number {
  const added = longTexts.filter((text) => !counted.has(text));
  for (const text of added) counted.add(text);
  return added.reduce((total, text) => total + textSize(text), bytes);
}

/** Drops the oldest entries if all together exceed the limit. */
function withinLimit(entries: readonly HistoryEntry[]): readonly HistoryEntry[] {
  const counted = new Set<string>();
  let bytes = 0;
  for (let i = entries.length - 1; i >= 0; --i) {
    const entry = entries[i];
    bytes += entry ? entryBytes(entry, counted) : 0;
    if (bytes > maxHistoryBytes) return entries.slice(Math.min(i + 1, entries.length - 1));
  }
  return entries;
}

/** Two steps as one. New values of the same fields replace each other, so that a held key takes no more memory. */
function joined<State>(last: HistoryEntry, step: Step<State>): Step<State> {
  const replaces = replacesSame(last.forward, step.forward) && replacesSame(last.backward, step.backward);
  return {
    present: step.present,
    forward: replaces ? step.forward : [...last.forward, ...step.forward],
    backward: replaces ? last.backward : [...step.backward, ...last.backward],
  };
}

function replacesSame(first: Patches, second: Patches): boolean {
  return (
    first.length === second.length &&
    first.every(({ op, path }, i) => {
      const other = second[i];
      return op === "replace" && other?.op === "replace" && String(path) === String(other.path);
    })
  );
}

function replaceAll<State extends object>(state: State, replace: Replacement["replace"]): Step<State> {
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
  return { present: applyPatches(state, forward), forward, backward };
}
