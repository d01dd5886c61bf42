/** The worker with its engine in this thread, and a clock on which every call of the engine ends a slice. */
import { afterEach, describe, expect, test, vi } from "vitest";

import { emptyGrid } from "../../../wasm/dist/project/grid-arrays.js";
import { engineProposalOptions } from "../../../wasm/dist/api/grid-options.js";
import { engineSolutionOptions } from "../../../wasm/dist/api/solution-options.js";
import { engineOptions, engineImproveOptions } from "../../../wasm/dist/api/mesh-options.js";
import {
  engineInspectionOptions,
  engineRemeshOptions,
  engineRepairOptions,
} from "../../../wasm/dist/api/surface-options.js";
import { projectArrays } from "../../../wasm/dist/project/arrays.js";
import type { ArgumentsOf, CallName } from "../../../wasm/src/engine/calls.js";
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
      post: (reply: Reply) => {
        if (reply.kind === "wanted") port.handle({ kind: "load", name: reply.name, module: undefined });
        else port.onReply(reply);
      },
      onRequest: (handle: (request: Request) => void) => (port.handle = handle),
      letRequestsIn: () => new Promise((resolve) => setImmediate(resolve)),
      compile: async (address: URL) => WebAssembly.compile(await readFile(address)),
    },
  };
});

afterEach(() => vi.restoreAllMocks());

/** Resolves when the worker has loaded the engine and answered a query, for which it loads its tools. */
const started = new Promise<void>((resolve, reject) => {
  port.onReply = (reply) => {
    if (reply.kind === "ready" && reply.name === "engine") {
      port.handle({
        kind: "question",
        id: 0,
        call: "cover",
        given: [projectArrays(cubeProject()).model, 0, 0],
      });
    }
    if (reply.kind === "answer") resolve();
    if (reply.kind === "unusable") reject(new Error(reply.message));
  };
  void import("../../../wasm/dist/engine/worker.js").then(() =>
    port.handle({ kind: "load", name: "engine", module: undefined }),
  );
});

/** Replaces the clock by one on which every reading is later than the end of a slice. */
function slowClock(): void {
  let now = 0;
  vi.spyOn(performance, "now").mockImplementation(() => (now += 1000));
}

let lastId = 0;

/** Returns the replies of the worker until it answers or is silent for a while. */
async function repliesTo(query: Question, onReply: (reply: Reply) => void = () => undefined) {
  await started;
  const replies: Reply[] = [];
  port.onReply = (reply) => {
    replies.push(reply);
    onReply(reply);
  };
  port.handle(query);
  let silent = 0;
  for (let received = 0; silent < 20 && replies.at(-1)?.kind !== "answer";) {
    await new Promise((resolve) => setImmediate(resolve));
    silent = received === replies.length ? silent + 1 : 0;
    received = replies.length;
  }
  return replies;
}

const { model, grid } = projectArrays(cubeProject());
const { points, tetrahedra } = blockMesh(8);
const surface = boxSurface(12);
const options = engineOptions({ size: 0.05 });
const inspectionOptions = engineInspectionOptions({ maxDiagnostics: 9 });
const repairOptions = engineRepairOptions({ weld: 1e-9, fillHoles: 5 });

const noRegions = { triangleRegions: new Uint32Array(), maxVolumes: new Float64Array() };

const none = new Uint32Array();
const noBodies = { points: new Float64Array(), triangles: none, trianglePatch: none, patches: 0 };
const mesh = { points, tetrahedra, regions: none, front: none };
const surfaceArrays = [surface.points, surface.triangles] as const;
const noTriangles = {
  points: new Float64Array(),
  parameters: new Float64Array(),
  triangles: none,
  faces: none,
};
const bareMesh = {
  points,
  tetrahedra,
  regions: none,
  triangles: none,
  trianglePatch: none,
  model: new Float64Array(),
  modelTriangles: noTriangles,
};
const remeshing = engineRemeshOptions({ size: 0.2 });

const atNodes = {
  values: Float64Array.from(points, (x) => x * x).filter((_, i) => i % 3 === 0),
  components: Uint32Array.of(1),
  isPerElement: Uint8Array.of(0),
};

const unitMetrics = (nodes: number) =>
  Float64Array.from({ length: 6 * nodes }, (_, i) => ([0, 3, 5].includes(i % 6) ? 1 : 0));

/** What each call is given; the arrays belong to it. */
const queries: { readonly [Name in CallName]: () => ArgumentsOf<Name> } = {
  previewModel: () => [model, grid, options, false],
  cover: () => [model, 0, 0],
  propose: () => [model, engineProposalOptions({ maxSize: 0.9 })],
  sampleCurvature: () => [model, 24],
  sampleSizes: () => [model, noBodies, grid, options, points.slice()],
  backgroundFromMesh: () => [mesh, new Float64Array()],
  inspectSurface: () => [...surfaceArrays, inspectionOptions, none],
  locateRegions: () => [...surfaceArrays, Float64Array.of(0.1, 0.1, 0.1)],
  proposeSurfaceSizes: () => [...surfaceArrays, none, remeshing, none],
  repairSurface: () => [...surfaceArrays, repairOptions, none],
  refineSurface: () => [...surfaceArrays, emptyGrid(), options, 0, noRegions],
  splitPatches: () => [...surfaceArrays, none, 40],
  remeshSurface: () => [...surfaceArrays, none, emptyGrid(), remeshing, noRegions, new Float64Array()],
  placeNodes: () => [...surfaceArrays, none, new Float64Array(5), noTriangles, 0.1],
  inspectMesh: () => [points, tetrahedra, none],
  improveMesh: () => [points, tetrahedra, none, none, engineImproveOptions({})],
  curveEdges: () => [points, tetrahedra, none, none, new Float64Array()],
  adaptMesh: () => [
    bareMesh,
    { points, tetrahedra, metrics: unitMetrics(points.length / 3) },
    { leastQuality: 0.5, sweeps: 1 },
  ],
  addLayers: () => [
    bareMesh,
    { points: new Float64Array(), tetrahedra: none, metrics: new Float64Array() },
    { leastQuality: 0.5, sweeps: 1 },
    {
      patch: Uint32Array.of(0),
      firstHeight: Float64Array.of(0.1),
      growth: Float64Array.of(1.2),
      count: Uint32Array.of(3),
    },
    { maxAspect: 10, growth: 0.5, cycles: 1 },
  ],
  checkRun: () => [model, noBodies, grid, options],
  sizeFromSolution: () => [mesh, atNodes, engineSolutionOptions({ elements: 1000 })],
  transferSolution: () => [mesh, mesh, atNodes, true],
  frontSizesOf: () => [unitMetrics(40_000)],
};

describe.each(Object.entries(queries))("%s", (call, given) => {
  const makeQuery = (id: number): Question => {
    return { kind: "question", id, call: call as CallName, given: given() };
  };

  test("reports increasing fractions up to 1 and answers the same in slices of any length", async () => {
    const whole = (await repliesTo(makeQuery(++lastId))).at(-1);
    slowClock();
    const replies = await repliesTo(makeQuery(lastId));
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

  test("can be cancelled between two slices and leaves the engine usable", async () => {
    slowClock();
    const id = ++lastId;
    const replies = await repliesTo(makeQuery(id), () => port.handle({ kind: "cancel", id }));
    expect(replies.map(({ kind }) => kind)).toEqual(["progress"]);
    vi.restoreAllMocks();
    const [last] = (await repliesTo(makeQuery(++lastId))).slice(-1);
    expect(last?.kind).toBe("answer");
  });
});
