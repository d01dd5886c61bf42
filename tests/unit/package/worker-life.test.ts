import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { receiveWatched, watchLife, type LifeReply } from "../../../wasm/src/calls/worker-life";

type Granted = () => unknown;

/** Grants the locks that are requested when the test says so. */
let requests: Granted[] = [];

beforeEach(() => {
  requests = [];
  vi.useFakeTimers();
  const request = (...values: unknown[]): Promise<void> => {
    requests.push(values.at(-1) as Granted);
    return Promise.resolve();
  };
  vi.stubGlobal("navigator", { locks: { request } });
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

describe("watching the life of a worker", () => {
  test("a worker that dies before it holds its lock is noticed, once", () => {
    const onEnd = vi.fn();
    watchLife(onEnd);
    vi.advanceTimersByTime(30_000);
    expect(onEnd).not.toHaveBeenCalled();
    vi.advanceTimersByTime(300_000);
    expect(onEnd).toHaveBeenCalledTimes(1);
  });

  test("a worker that holds its lock may be busy for any time, until the lock is released", () => {
    const onEnd = vi.fn();
    watchLife(onEnd)?.begin();
    vi.advanceTimersByTime(300_000);
    expect(onEnd).not.toHaveBeenCalled();
    requests[0]?.();
    expect(onEnd).toHaveBeenCalledTimes(1);
  });

  test("a worker that was stopped is not reported", () => {
    const onEnd = vi.fn();
    watchLife(onEnd)?.stop();
    vi.advanceTimersByTime(300_000);
    expect(onEnd).not.toHaveBeenCalled();
  });

  test("a worker begins no call before it holds its lock", () => {
    const events: (string | LifeReply)[] = [];
    const receive = receiveWatched<{ readonly name: string }>(
      ({ name }) => events.push(name),
      (reply) => events.push(reply),
    );
    receive({ kind: "live", lock: "of this worker" });
    receive({ name: "first" });
    receive({ name: "second" });
    expect(events).toEqual([]);
    requests[0]?.();
    receive({ name: "third" });
    expect(events).toEqual([{ kind: "lives" }, "first", "second", "third"]);
  });
});
