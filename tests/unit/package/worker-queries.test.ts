/** The worker between a mock port and a mock engine: which queries reach the engine. */
import { expect, test, vi } from "vitest";

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
vi.mock("../../../wasm/dist/engine/loader.js", () => ({
  loadEngine: () =>
    Promise.resolve({
      module: undefined,
      engine: {
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
    }),
}));

function proposal(id: number): Request {
  return { kind: "propose", id, model: `model ${id}` } as unknown as Request;
}

test("queries cancelled in the queue are not started, and the others are answered in order", async () => {
  await import("../../../wasm/dist/engine/worker.js");
  port.handle({ kind: "load", module: undefined });
  for (const id of [1, 2, 3, 4]) port.handle(proposal(id));
  for (const id of [2, 3]) port.handle({ kind: "cancel", id });
  const answered = () => port.replies.flatMap((reply) => (reply.kind === "answer" ? [reply.id] : []));
  await vi.waitFor(() => expect(answered()).toEqual([1, 4]));
  expect(port.started).toEqual(["model 1", "model 4"]);
  // The id of a cancelled query can be used again.
  port.handle(proposal(2));
  await vi.waitFor(() => expect(port.started).toHaveLength(3));
});
