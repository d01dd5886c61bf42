import { memorySize, textSize } from "../document/memory-size";
import { differenceOf, reversed, withDifference, type Difference } from "./difference";

/** One step of undo. */
export interface HistoryEntry {
  readonly label: string;
  readonly mergeKey: string | undefined;
  /** Time of the last edit in this entry; milliseconds, any origin. */
  readonly at: number;
  /** The state after the step compared with the state before it. */
  readonly change: Difference;
  /** Estimated memory of the change without long texts. */
  readonly bytes: number;
  /** Long texts of the change, which it shares with other steps. */
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

/** What a step of undo is called, and with which other steps it merges. */
export type StepName = Pick<HistoryEntry, "label"> & { readonly mergeKey?: string | undefined };

/**
 * Returns the history after a step to another state, which removes the steps that could be redone; the same object if the
 * states are equal. The step is `held` if it comes from a key that is held down: all repetitions are one step, however slow.
 */
export function commit<State extends object>(
  history: History<State>,
  { label, mergeKey }: StepName,
  present: State,
  now: number,
  held = false,
): History<State> {
  const change = differenceOf(history.present, present);
  if (!change) return history;
  const last = history.past.at(-1);
  const merges =
    last !== undefined &&
    mergeKey !== undefined &&
    last.mergeKey === mergeKey &&
    (held || now - last.at <= mergeWindowMs) &&
    // After an undo, the user has gone back to the last step: never merge into it.
    history.future.length === 0;
  const past = merges ? history.past.slice(0, -1) : history.past;
  const whole = merges ? differenceOf(undo(history).present, present) : change;
  const added = whole ? [entryOf({ label, mergeKey, at: now, change: whole })] : [];
  return { present, past: withinLimit([...past, ...added]), future: [] };
}

/** Returns the history with another present state, as if the last step had led to it; without steps, it begins there. */
export function amend<State extends object>(history: History<State>, present: State): History<State> {
  const { past, future } = history;
  const last = past.at(-1);
  if (!last) return { past, present, future };
  const { label, mergeKey, at } = last;
  const change = differenceOf(undo(history).present, present);
  const added = change ? [entryOf({ label, mergeKey, at, change })] : [];
  return { present, past: withinLimit([...past.slice(0, -1), ...added]), future };
}

/** Returns the state one step back, or the same object if there is none. */
export function undo<State extends object>(history: History<State>): History<State> {
  const entry = history.past.at(-1);
  if (entry === undefined) return history;
  return {
    present: withDifference(history.present, reversed(entry.change)),
    past: history.past.slice(0, -1),
    future: [entry, ...history.future],
  };
}

/** Returns the state one step forward, or the same object if there is none. */
export function redo<State extends object>(history: History<State>): History<State> {
  const [entry, ...rest] = history.future;
  if (entry === undefined) return history;
  return {
    present: withDifference(history.present, entry.change),
    past: [...history.past, { ...entry, mergeKey: undefined }],
    future: rest,
  };
}

/** Redoes a number of steps, or undoes them if it is negative; fewer if there are not so many. */
export function goBy<State extends object>(history: History<State>, steps: number): History<State> {
  let moved = history;
  for (let i = 0; i < Math.abs(steps); ++i) moved = steps < 0 ? undo(moved) : redo(moved);
  return moved;
}

/** Returns an entry with its memory. */
export function entryOf(step: Omit<HistoryEntry, "bytes" | "longTexts">): HistoryEntry {
  const texts = new Set<string>();
  const bytes = memorySize(step.change, texts);
  return { ...step, bytes, ...(texts.size > 0 && { longTexts: [...texts] }) };
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
