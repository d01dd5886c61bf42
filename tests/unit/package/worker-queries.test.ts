/** The worker between a mock port and mock modules: which queries reach the tools, and when these are loaded. */
import { afterEach, beforeAll, expect, test, vi } from "vitest";

import type { Reply, Request } from "../../../wasm/src/engine/protocol.js";

const port = vi.hoisted(() => ({
  handle: (_: Request): void => undefined,
  replies: [] as Reply[],
  started: [] as unknown[],
}));

vi.mock("../../../wasm/dist/engine/worker-port-node.js", () => ({
  workerPort: {
    post: (reply: Reply) => port.replies.push(reply),
    onRequest: (handle: (request: Request) => void) => (port.handle = handle),
    letRequestsIn: () => new Promise((resolve) => setImmediate(resolve)),
  },
}));
const modules = vi.hoisted(() => ({ failure: undefined as Error | undefined, loads: 0 }));

vi.mock("../../../wasm/dist/engine/loader.js", () => ({
  loadEngine: () => new Promise(() => undefined),
  loadTraceEngine: () => new Promise(() => undefined),
  loadTools: () => {
    modules.loads += 1;
    if (modules.failure !== undefined) return Promise.reject(modules.failure);
    return Promise.resolve({
      module: undefined,
      instance: {
        propose: (model: unknown) => {
          port.started.push(model);
          return {
            advance: () => true,
            fraction: () => 1,
            result: () => ({}),
            failure: () => 0,
            delete: () => undefined,
          };
        },
      },
    });
  },
}));

function proposal(id: number): Request {
  return { kind: "question", id, call: "propose", given: [`model ${id}`] };
}

/** Sends the code that the worker has asked for last. */
function sendTools(): void {
  expect(port.replies.at(-1)).toEqual({ kind: "wanted", name: "tools" });
  port.handle({ kind: "load", name: "tools", module: undefined });
}

beforeAll(() => import("../../../wasm/dist/engine/worker.js"));
afterEach(() => {
  port.replies.splice(0);
  port.started.splice(0);
});

test("queries that wait for tools that cannot be loaded get the reason; later ones ask again", async () => {
  modules.failure = new Error("tools.wasm is answered with HTTP status 404");
  for (const id of [5, 6]) port.handle(proposal(id));
  sendTools();
  const { message } = modules.failure;
  await vi.waitFor(() => expect(port.replies).toHaveLength(4));
  expect(port.replies.slice(1)).toEqual([
    { kind: "unusable", name: "tools", message },
    { kind: "unanswerable", id: 5, message },
    { kind: "unanswerable", id: 6, message },
  ]);
  expect(port.started).toEqual([]);
  modules.failure = undefined;
});

test("queries cancelled in the queue are not started; the others load the tools once and are answered in order", async () => {
  modules.loads = 0;
  for (const id of [1, 2, 3, 4]) port.handle(proposal(id));
  for (const id of [2, 3]) port.handle({ kind: "cancel", id });
  sendTools();
  const answered = () => port.replies.flatMap((reply) => (reply.kind === "answer" ? [reply.id] : []));
  await vi.waitFor(() => expect(answered()).toEqual([1, 4]));
  expect(port.started).toEqual(["model 1", "model 4"]);
  // The id of a cancelled query can be used again.
  port.handle(proposal(2));
  await vi.waitFor(() => expect(port.started).toHaveLength(3));
  expect(modules.loads).toBe(1);
});
