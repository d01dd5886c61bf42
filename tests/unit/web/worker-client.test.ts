import { MessageChannel } from "node:worker_threads";
import { describe, expect, it, vi } from "vitest";
import { serveCalls, type Handlers, type WorkerScope } from "../../../web/workers/serve-calls";
import { copyForTransfer } from "../../../web/workers/transfer";
import {
  callOnce,
  onWorkerLost,
  WorkerClient,
  type Call,
  type WorkerPort,
} from "../../../web/workers/worker-client";

interface TestProtocol {
  readonly double: { readonly argument: number; readonly answer: number };
  readonly fail: { readonly argument: string; readonly answer: never };
  readonly later: { readonly argument: string; readonly answer: string };
}

/** A worker in the same thread; each message is delivered in a separate task. */
class FakeWorker implements WorkerPort {
  onmessage: WorkerPort["onmessage"] = null;
  onerror: WorkerPort["onerror"] = null;
  isTerminated = false;
  readonly #scope: WorkerScope;

  constructor(handlers: Handlers<TestProtocol>) {
    this.#scope = {
      onmessage: null,
      postMessage: (data) => {
        if (!this.isTerminated) this.onmessage?.call(this as never, { data } as MessageEvent);
      },
    };
    serveCalls(handlers, this.#scope);
  }

  postMessage(data: unknown): void {
    queueMicrotask(() => this.#scope.onmessage?.({ data } as MessageEvent<Call>));
  }

  terminate(): void {
    this.isTerminated = true;
  }

  crash(): void {
    this.onerror?.call(this as never, new Event("error", { cancelable: true }) as never);
  }
}

function testWorkers(release: (name: string) => Promise<string> = (name) => Promise.resolve(name)) {
  const workers: FakeWorker[] = [];
  const start = (): FakeWorker => {
    const worker = new FakeWorker({
      double: (value) => ({ answer: 2 * value }),
      fail: (reason) => {
        throw new Error(reason);
      },
      later: async (name) => ({ answer: await release(name) }),
    });
    workers.push(worker);
    return worker;
  };
  return { workers, start };
}

describe("WorkerClient", () => {
  it("starts its worker with the first call and matches answers by id, in any order", async () => {
    const releases = new Map<string, () => void>();
    const { workers, start } = testWorkers(
      (name) => new Promise((resolve) => releases.set(name, () => resolve(name))),
    );
    const client = new WorkerClient<TestProtocol>(start);
    expect(workers).toHaveLength(0);
    const first = client.call("later", "first");
    const second = client.call("later", "second");
    await vi.waitFor(() => expect(releases.size).toBe(2));
    releases.get("second")?.();
    expect(await second).toBe("second");
    releases.get("first")?.();
    expect(await first).toBe("first");
    expect(workers).toHaveLength(1);
  });

  it("rejects only the call whose handler failed", async () => {
    const { workers, start } = testWorkers();
    const client = new WorkerClient<TestProtocol>(start);
    const failed = client.call("fail", "no memory");
    const doubled = client.call("double", 21);
    await expect(failed).rejects.toThrow("no memory");
    expect(await doubled).toBe(42);
    expect(workers).toHaveLength(1);
  });

  it("rejects all pending calls when its worker crashes, and starts another for the next call", async () => {
    const { workers, start } = testWorkers(() => new Promise(() => undefined));
    const lost = vi.fn();
    const client = new WorkerClient<TestProtocol>(start, lost);
    const pending = [client.call("later", "a"), client.call("later", "b")];
    workers[0]?.crash();
    for (const call of pending) await expect(call).rejects.toThrow("could not be loaded");
    expect(lost).toHaveBeenCalledOnce();
    expect(workers[0]?.isTerminated).toBe(true);
    expect(await client.call("double", 3)).toBe(6);
    expect(workers).toHaveLength(2);
  });

  it("gives up after three workers that have never run, and says what to do; one that has run counts anew", async () => {
    const { workers, start } = testWorkers();
    const client = new WorkerClient<TestProtocol>(start);
    const reports: boolean[] = [];
    const stop = onWorkerLost((_, isReplaced) => reports.push(isReplaced));
    const crashed = async (): Promise<string> => {
      const call = client.call("later", "never");
      workers.at(-1)?.crash();
      return call.catch((error: unknown) => String(error));
    };
    await crashed();
    await crashed();
    expect(await client.call("double", 2)).toBe(4);
    workers.at(-1)?.crash();
    await crashed();
    expect(reports).toEqual([true, true, true, true]);
    await crashed();
    expect(await crashed()).toMatch(/started 3 times.*reload the page/);
    expect(reports).toEqual([true, true, true, true, true, false]);
    expect(workers).toHaveLength(6);
    client.start();
    await expect(client.call("double", 2)).rejects.toThrow("reload the page");
    expect(workers).toHaveLength(6);
    stop();
  });

  it("ends its worker after a single call, whether the call succeeds or fails", async () => {
    const { workers, start } = testWorkers();
    expect(await callOnce<TestProtocol, "double">(start, "double", 4)).toBe(8);
    await expect(callOnce<TestProtocol, "fail">(start, "fail", "no disk")).rejects.toThrow("no disk");
    expect(workers.map(({ isTerminated }) => isTerminated)).toEqual([true, true]);
  });
});

it("typed arrays are copied for transfer, whatever part of a buffer they are, so that the caller keeps its own", async () => {
  const all = Float64Array.from({ length: 100 }, (_, i) => i / 7);
  const holder = { points: all.subarray(10, 40), tetrahedra: Uint32Array.from([3, 1, 4, 1, 5]), name: "π" };
  const { copy, buffers } = await copyForTransfer(holder);
  expect(copy).toEqual(holder);
  expect(buffers.map(({ byteLength }) => byteLength)).toEqual([30 * 8, 5 * 4]);

  const { port1, port2 } = new MessageChannel();
  const received = new Promise((resolve) => port2.once("message", resolve));
  port1.postMessage(copy, buffers);
  expect(await received).toEqual(holder);
  port1.close();
  expect(copy.points).toHaveLength(0);
  expect(holder.points).toHaveLength(30);
  expect(holder.tetrahedra).toHaveLength(5);
});

it("the typed arrays of maps are copied for transfer too", async () => {
  const values = Float64Array.from([1, 2, 3]);
  const nodeData = new Map<string, unknown>([
    ["temperature", { components: 1, values }],
    ["unit", "K"],
  ]);
  const { copy, buffers } = await copyForTransfer({ nodeData });
  expect(copy).toEqual({ nodeData });
  expect(buffers.map(({ byteLength }) => byteLength)).toEqual([24]);
  expect(buffers[0]).not.toBe(values.buffer);
});

it("a large copy for transfer leaves the page time for other tasks", async () => {
  const clock = vi.spyOn(performance, "now");
  let milliseconds = 0;
  clock.mockImplementation(() => (milliseconds += 5));
  const points = Float64Array.from({ length: 500_000 }, (_, i) => i);
  let tasks = 0;
  const timer = setInterval(() => ++tasks, 0);
  const { copy } = await copyForTransfer({ points });
  clearInterval(timer);
  clock.mockRestore();
  expect(tasks).toBeGreaterThan(2);
  expect(copy.points).toEqual(points);
});
