import { describe, expect, it } from "vitest";
import type { Edit } from "../../../web/document/edit";
import { commit, redo, startHistory, undo } from "../../../web/session/history";

interface State {
  readonly a: number;
  readonly list: readonly number[];
}

const set = (a: number, mergeKey?: string): Edit<State> => ({
  label: `Set ${a}`,
  ...(mergeKey !== undefined && { mergeKey }),
  change: (draft) => {
    draft.a = a;
  },
});

describe("history", () => {
  it("goes back and forth over any number of edits, and names them", () => {
    const states: State[] = [{ a: 0, list: [] }];
    let history = startHistory(states[0] as State);
    for (let i = 1; i <= 20; ++i) {
      history = commit(
        history,
        {
          label: `Edit ${i}`,
          change: (draft) => {
            draft.a = i * i;
            if (i % 3 === 0) draft.list.pop();
            else draft.list.push(i);
          },
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

  it("merges edits of one key within the window, and only those", () => {
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

  it("merges what one held key does, however slowly", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1, "a"), 0);
    history = commit(history, set(2, "a"), 5_000, true);
    history = commit(history, set(3, "a"), 10_000, true);
    expect(history.past).toHaveLength(1);
    history = commit(history, set(4, "b"), 15_000, true);
    expect(history.past).toHaveLength(2);
    expect(undo(undo(history)).present.a).toBe(0);
  });

  it("forgets what was undone once something else is done", () => {
    let history = commit(startHistory<State>({ a: 0, list: [] }), set(1), 0);
    history = commit(undo(history), set(2), 10);
    expect(history.future).toEqual([]);
    expect(history.present.a).toBe(2);
  });

  it("does not record an edit that changes nothing", () => {
    const history = startHistory<State>({ a: 0, list: [] });
    expect(commit(history, { label: "Nothing", change: () => undefined }, 0)).toBe(history);
  });

  it("replaces values as they are, sharing the rest, and goes back", () => {
    interface Nested {
      readonly a: { readonly big: readonly number[]; readonly other: object };
      readonly b: number;
    }
    const other = {};
    const before: Nested = { a: { big: [1], other }, b: 1 };
    const big = [1, 2, 3];
    const replaced = commit(
      startHistory(before),
      {
        label: "Replace",
        replace: [
          [["a", "big"], big],
          [["b"], 2],
        ],
      },
      0,
    );
    expect(replaced.present).toEqual({ a: { big, other }, b: 2 });
    expect(replaced.present.a.big).toBe(big);
    expect(replaced.present.a.other).toBe(other);
    expect(undo(replaced).present).toEqual(before);
    expect(redo(undo(replaced)).present.a.big).toBe(big);
    const same = startHistory(before);
    expect(commit(same, { label: "Nothing", replace: [[["b"], 1]] }, 0)).toBe(same);
  });
});
