import { describe, expect, it } from "vitest";
import {
  commit as commitState,
  entryBytes,
  maxHistoryBytes,
  redo,
  startHistory,
  undo,
  type History,
} from "../../../web/session/history";

interface Edit<State> {
  readonly label: string;
  readonly mergeKey?: string;
  readonly change: (state: State) => State;
}

const commit = <State extends object>(
  history: History<State>,
  edit: Edit<State>,
  now: number,
  held = false,
): History<State> => commitState(history, edit, edit.change(history.present), now, held);

interface State {
  readonly a: number;
  readonly list: readonly number[];
}

const set = (a: number, mergeKey?: string): Edit<State> => ({
  label: `Set ${a}`,
  ...(mergeKey !== undefined && { mergeKey }),
  change: (state) => ({ ...state, a }),
});

describe("history", () => {
  it("undoes and redoes any number of edits, and names them", () => {
    const states: State[] = [{ a: 0, list: [] }];
    let history = startHistory(states[0] as State);
    for (let i = 1; i <= 20; ++i) {
      history = commit(
        history,
        {
          label: `Edit ${i}`,
          change: ({ list }) => ({ a: i * i, list: i % 3 === 0 ? list.slice(0, -1) : [...list, i] }),
        },
        1000 * i,
      );
      states.push(history.present);
    }
    expect(history.past.map(({ label }) => label)).toEqual(states.slice(1).map((_, i) => `Edit ${i + 1}`));
    for (let i = 19; i >= 0; --i) {
      history = undo(history);
      expect(history.present).toEqual(states[i]);
    }
    expect(undo(history)).toBe(history);
    for (let i = 1; i <= 20; ++i) {
      history = redo(history);
      expect(history.present).toEqual(states[i]);
    }
    expect(redo(history)).toBe(history);
  });

  it("merges only edits with the same key within the time window", () => {
    let history = startHistory<State>({ a: 0, list: [] });
    history = commit(history, set(1, "a"), 0);
    history = commit(history, set(2, "a"), 500);
    history = commit(history, set(3, "a"), 1000);
    expect(history.past).toHaveLength(1);
    history = commit(history, set(4, "b"), 1100);
    history = commit(history, set(5, "b"), 5000);
    expect(history.past).toHaveLength(3);
    history = undo(undo(undo(history)));
    expect(history.present.a).toBe(0);
    expect(redo(history).present.a).toBe(3);
  });

  it("merges the edits of one held key, however slow", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1, "a"), 0);
    history = commit(history, set(2, "a"), 5_000, true);
    history = commit(history, set(3, "a"), 10_000, true);
    expect(history.past).toHaveLength(1);
    history = commit(history, set(4, "b"), 15_000, true);
    expect(history.past).toHaveLength(2);
    expect(undo(undo(history)).present.a).toBe(0);
  });

  it("does not merge into a step while another one can be redone", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1, "a"), 0);
    history = commit(history, set(2, "b"), 100);
    history = commit(undo(history), set(3, "a"), 200);
    expect(history.past).toHaveLength(2);
    expect(history.future).toEqual([]);
    expect(undo(history).present.a).toBe(1);
    expect(redo(undo(history)).present.a).toBe(3);
  });

  it("does not merge into a redone step", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1, "a"), 0);
    history = commit(redo(undo(history)), set(2, "a"), 100);
    expect(undo(history).present.a).toBe(1);
  });

  it("stores one value of a field changed by a held key, and all parts of other merged edits", () => {
    let history = startHistory<State>({ a: 0, list: [] });
    for (let a = 1; a <= 1000; ++a) history = commit(history, set(a, "a"), a, true);
    expect(history.past[0]?.change).toEqual({ fields: { a: { from: 0, to: 1000 } } });
    expect(undo(history).present.a).toBe(0);
    expect(redo(undo(history)).present.a).toBe(1000);

    const shorten = (length: number): Edit<State> => ({
      label: "Shorten",
      mergeKey: "list",
      change: (state) => ({ ...state, list: state.list.slice(0, length) }),
    });
    history = commit(startHistory<State>({ a: 0, list: [1, 2, 3, 4, 5] }), shorten(3), 0);
    history = commit(history, shorten(1), 1);
    expect(history.past).toHaveLength(1);
    expect(undo(history).present.list).toEqual([1, 2, 3, 4, 5]);
    expect(redo(undo(history)).present.list).toEqual([1]);
  });

  it("drops the oldest steps beyond its memory limit, however many there are", () => {
    // The patch that restores a text shares it with the step before.
    const stepBytes = maxHistoryBytes / 16;
    const write = (i: number): Edit<{ readonly text: string }> => ({
      label: `Write ${i}`,
      change: () => ({ text: String(i).padEnd(stepBytes) }),
    });
    let history = startHistory({ text: "".padEnd(stepBytes) });
    for (let i = 1; i <= 40; ++i) history = commit(history, write(i), 1000 * i);
    expect(history.past.length).toBeGreaterThanOrEqual(14);
    expect(history.past.length).toBeLessThanOrEqual(16);
    expect(history.past.at(-1)?.label).toBe("Write 40");
    expect(history.past[0]?.label).toBe(`Write ${41 - history.past.length}`);
    const counted = new Set<string>();
    const bytes = history.past.reduce((sum, entry) => sum + entryBytes(entry, counted), 0);
    expect(bytes).toBeGreaterThan(0.8 * maxHistoryBytes);
    expect(bytes).toBeLessThanOrEqual(maxHistoryBytes);

    let small = startHistory<State>({ a: 0, list: [] });
    for (let i = 1; i <= 2000; ++i) small = commit(small, set(i), 1000 * i);
    expect(small.past).toHaveLength(2000);
  });

  it("keeps the latest step even if it exceeds the limit", () => {
    const text = "".padEnd(maxHistoryBytes);
    let history = commitState(startHistory({ text: "before" }), { label: "Small" }, { text: "x" }, 0);
    history = commitState(history, { label: "Huge" }, { text }, 1000);
    expect(history.past.map(({ label }) => label)).toEqual(["Huge"]);
    expect(undo(history).present.text).toBe("x");
  });

  it("forgets undone steps after another edit", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1), 0);
    history = commit(undo(history), set(2), 10);
    expect(history.future).toEqual([]);
    expect(history.present.a).toBe(2);
  });

  it("does not record an edit that changes nothing", () => {
    const history = startHistory<State>({ a: 0, list: [] });
    expect(commit(history, { label: "Nothing", change: (state) => state }, 0)).toBe(history);
  });

  it("forgets a merged step that leads back to the state before it", () => {
    const history = startHistory<State>({ a: 0, list: [] });
    const there = commit(history, set(1, "a"), 0);
    const back = commit(there, set(0, "a"), 100);
    expect(back).toEqual(history);
  });

  it("shares what a step has not changed", () => {
    const before = { big: [{ id: 1 }], other: { list: [{ id: 2 }] }, b: 1 };
    const after = { ...before, b: 2 };
    const history = commitState(startHistory(before), { label: "Change" }, after, 0);
    expect(history.present).toBe(after);
    expect(undo(history).present).toEqual(before);
    expect(undo(history).present.big).toBe(before.big);
    expect(redo(undo(history)).present.other).toBe(before.other);
    expect(commitState(history, { label: "Nothing" }, { ...after }, 0)).toBe(history);
  });
});
