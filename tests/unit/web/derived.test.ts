import { describe, expect, it } from "vitest";
import { createStore } from "zustand/vanilla";
import { derived, sameItems } from "../../../web/session/derived";
import { LatestTask, LatestTasks, pause } from "../../../web/session/latest-task";

describe("a derived value", () => {
  it("is never old, in whatever order listeners are called", () => {
    const store = createStore(() => ({ count: 1 }));
    const seen: number[] = [];
    let double = () => 0;
    store.subscribe(() => seen.push(double()));
    const value = derived((read) => 2 * read(store).count);
    double = value.getState;
    value.subscribe(() => undefined);
    store.setState({ count: 2 });
    store.setState({ count: 3 });
    expect(seen).toEqual([4, 6]);
  });

  it("is computed once for each change, and only when it is read", () => {
    const store = createStore(() => ({ count: 1, other: 0 }));
    let computed = 0;
    const count = derived((read) => read(store).count);
    const square = derived((read) => {
      computed += 1;
      return read(count) ** 2;
    });
    expect(computed).toBe(0);
    expect([square.getState(), square.getState()]).toEqual([1, 1]);
    store.setState({ other: 1 });
    expect([square.getState(), computed]).toEqual([1, 1]);
    store.setState({ count: 3 });
    expect([square.getState(), computed]).toEqual([9, 2]);
  });

  it("tells its listeners of changes only, with the value before, and follows what it has read last", () => {
    const [which, a, b] = [createStore(() => "a"), createStore(() => 1), createStore(() => 10)];
    const value = derived((read) => read(read(which) === "a" ? a : b));
    const told: (readonly [number, number])[] = [];
    const stop = value.subscribe((now, before) => told.push([now, before]));
    b.setState(11, true);
    a.setState(2, true);
    which.setState("b", true);
    a.setState(3, true);
    b.setState(12, true);
    stop();
    b.setState(13, true);
    expect(told).toEqual([
      [2, 1],
      [11, 2],
      [12, 11],
    ]);
    expect(value.getState()).toBe(13);
  });

  it("keeps its value, and is silent, if nothing of it has changed", () => {
    const store = createStore<readonly { id: number; name: string }[]>(() => [{ id: 1, name: "one" }]);
    const ids = derived((read, before: readonly number[] | undefined) =>
      sameItems(
        read(store).map(({ id }) => id),
        before,
      ),
    );
    const first = ids.getState();
    let changes = 0;
    ids.subscribe(() => (changes += 1));
    store.setState([{ id: 1, name: "first" }], true);
    expect(ids.getState()).toBe(first);
    store.setState([{ id: 2, name: "two" }], true);
    expect([changes, ids.getState()]).toEqual([1, [2]]);
  });

  it("tells each listener the last value once if a listener changes it", () => {
    const store = createStore(() => 1);
    const value = derived((read) => read(store));
    const told: string[] = [];
    value.subscribe((now) => {
      told.push(`first ${now}`);
      if (now === 2) store.setState(3, true);
    });
    value.subscribe((now) => told.push(`second ${now}`));
    store.setState(2, true);
    expect(told).toEqual(["first 2", "first 3", "second 3"]);
  });
});

describe("the latest task", () => {
  /** Work that ends when it is told to. */
  const waiting = () => {
    const ends: ((answer: string | Error) => void)[] = [];
    const work = (): Promise<string> =>
      new Promise((resolve, reject) => {
        ends.push((answer) => (answer instanceof Error ? reject(answer) : resolve(answer)));
      });
    return { ends, work };
  };

  it("uses the answer to what was asked last, and no error of what was asked before", async () => {
    const { ends, work } = waiting();
    const task = new LatestTask();
    const answers: string[] = [];
    const first = task.run(work, (answer) => answers.push(answer));
    const second = task.run(work, (answer) => answers.push(answer));
    ends[1]?.("new");
    ends[0]?.(new Error("ended"));
    await Promise.all([first, second]);
    expect(answers).toEqual(["new"]);
    await expect(task.run(() => Promise.reject(new Error("no memory")))).rejects.toThrow("no memory");
  });

  it("aborts what it ends, each key by itself", async () => {
    const tasks = new LatestTasks<string>();
    const signals: AbortSignal[] = [];
    const runs = ["a", "b", "c"].map((key) =>
      tasks.of(key).run(async (signal) => {
        signals.push(signal);
        await pause(60_000, signal);
      }),
    );
    tasks.of("a").cancel();
    tasks.cancelBut(new Set(["b"]));
    expect(signals.map(({ aborted }) => aborted)).toEqual([true, false, true]);
    tasks.cancelBut(new Set());
    await Promise.all(runs);
  });
});
