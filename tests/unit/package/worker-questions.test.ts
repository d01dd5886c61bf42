/** The worker between an engine and a maker that a test plays: which questions reach the engine. */
import { expect, test, vi } from "vitest";

import type { Reply, Request } from "../../../wasm/src/engine/protocol.js";

const port = vi.hoisted(() => ({
  handle: (_: Request): void => undefined,
  replies: [] as Reply[],
  asked: [] as unknown[],
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
          port.asked.push(model);
          return {
            advance: () => true,
            fraction: () => 1,
            result: () => ({}),
            failure: () => "",
            delete: () => undefined,
          };
        },
      },
    }),
}));

function proposal(id: number): Request {
  return { kind: "propose", id, model: `model ${id}` } as unknown as Request;
}

test("questions given up while they waited are not begun, others are answered in order", async () => {
  await import("../../../wasm/dist/engine/worker.js");
  port.handle({ kind: "load", module: undefined });
  for (const id of [1, 2, 3, 4]) port.handle(proposal(id));
  for (const id of [2, 3]) port.handle({ kind: "cancel", id });
  const answered = () => port.replies.flatMap((reply) => (reply.kind === "answer" ? [reply.id] : []));
  await vi.waitFor(() => expect(answered()).toEqual([1, 4]));
  expect(port.asked).toEqual(["model 1", "model 4"]);
  // The number of a question that was given up is nothing that would keep the next from its answer.
  port.handle(proposal(2));
  await vi.waitFor(() => expect(port.asked).toHaveLength(3));
});
