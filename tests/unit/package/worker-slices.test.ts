/** The worker with its engine in this thread, by a clock that ends a slice with every call of the engine. */
import { afterEach, describe, expect, test, vi } from "vitest";

import { emptyGrid } from "../../../wasm/dist/project/grid-arrays.js";
import { engineOptions, engineProposalOptions, engineRepairOptions } from "../../../wasm/dist/api/options.js";
import { projectArrays } from "../../../wasm/dist/project/arrays.js";
import type { Question, Reply, Request } from "../../../wasm/src/engine/protocol.js";
import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface } from "../../support/surfaces.js";

const port = vi.hoisted(() => ({
  handle: (_: Request): void => undefined,
  onReply: (_: Reply): void => undefined,
}));

vi.mock("../../../wasm/dist/engine/worker-port-node.js", async () => {
  const { readFile } = await import("node:fs/promises");
  return {
    workerPort: {
      post: (reply: Reply) => port.onReply(reply),
      onRequest: (handle: (request: Request) => void) => (port.handle = handle),
      letRequestsIn: () => new Promise((resolve) => setImmediate(resolve)),
      compile: async (address: URL) => WebAssembly.compile(await readFile(address)),
    },
  };
});

afterEach(() => vi.restoreAllMocks());

const started = new Promise<void>((resolve) => {
  port.onReply = ({ kind }) => kind === "ready" && resolve();
  void import("../../../wasm/dist/engine/worker.js").then(() =>
    port.handle({ kind: "load", module: undefined }),
  );
});

/** By this clock every look at it is later than any slice may last. */
function slowClock(): void {
  let now = 0;
  vi.spyOn(performance, "now").mockImplementation(() => (now += 1000));
}

let lastId = 0;

/** What the worker replies until it has been silent for a while, or has answered. */
async function repliesTo(question: Question, onReply: (reply: Reply) => void = () => undefined) {
  await started;
  const replies: Reply[] = [];
  port.onReply = (reply) => {
    replies.push(reply);
    onReply(reply);
  };
  port.handle(question);
  let silent = 0;
  for (let heard = 0; silent < 20 && replies.at(-1)?.kind !== "answer";) {
    await new Promise((resolve) => setImmediate(resolve));
    silent = heard === replies.length ? silent + 1 : 0;
    heard = replies.length;
  }
  return replies;
}

const model = projectArrays(cubeProject());
const { points, tetrahedra } = blockMesh(8);
const surface = boxSurface(12);
const options = engineOptions({ size: 0.05 });
const repair = engineRepairOptions({ weld: 1e-9, fillHoles: 5 });

/** Those that are made anew for each question: the arrays of a question are its own. */
const questions: Readonly<Record<Question["kind"], (id: number) => Question>> = {
  preview: (id) => ({ kind: "preview", id, model, options }),
  cover: (id) => ({ kind: "cover", id, model, size: 0, shape: 0 }),
  propose: (id) => ({ kind: "propose", id, model, options: engineProposalOptions({ uniform: 0.9 }) }),
  "background-from-mesh": (id) => ({
    kind: "background-from-mesh",
    id,
    points,
    tetrahedra,
    sizes: new Float64Array(),
  }),
  "inspect-surface": (id) => ({ kind: "inspect-surface", id, ...surface, innerShells: 0, maxDiagnostics: 9 }),
  "repair-surface": (id) => ({ kind: "repair-surface", id, ...surface, options: repair }),
  "refine-surface": (id) => ({
    kind: "refine-surface",
    id,
    ...surface,
    grid: emptyGrid(),
    options,
    volume: 0,
  }),
  "inspect-mesh": (id) => ({ kind: "inspect-mesh", id, points, tetrahedra, regions: new Uint32Array() }),
};

describe.each(Object.entries(questions))("%s", (_, ask) => {
  test("tells fractions from the beginning to the end, and answers the same in slices of any length", async () => {
    const whole = (await repliesTo(ask(++lastId))).at(-1);
    slowClock();
    const replies = await repliesTo(ask(lastId));
    expect(replies.at(-1)).toEqual(whole);
    const fractions = replies.flatMap((reply) =>
      reply.kind === "progress" ? [reply.progress.fraction] : [],
    );
    expect(fractions).toHaveLength(replies.length - 1);
    expect(fractions.length).toBeGreaterThan(4);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions[0]).toBeLessThan(0.5);
    expect(fractions.at(-1)).toBe(1);
  });

  test("is given up between two slices, and leaves the engine as it was", async () => {
    slowClock();
    const id = ++lastId;
    const replies = await repliesTo(ask(id), () => port.handle({ kind: "cancel", id }));
    expect(replies.map(({ kind }) => kind)).toEqual(["progress"]);
    vi.restoreAllMocks();
    const [last] = (await repliesTo(ask(++lastId))).slice(-1);
    expect(last?.kind).toBe("answer");
  });
});
