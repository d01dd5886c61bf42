/** One rule for cancelling: every call with a signal rejects with a `MesherError` of code `cancelled`. */
import {
  createMesher,
  MesherError,
  readMesh,
  readSurface,
  readVolume,
  writeMesh,
  type Mesher,
  type MesherErrorCode,
  type SurfaceInput,
} from "tetrafront";
import { createBody } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, expectTypeOf, test, vi } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

const surface = sphereSurface(40);
const block = blockMesh(4);
const { points, tetrahedra } = block;
const sizes = { components: 1, values: new Float64Array(points.length / 3).fill(0.2) };
const sized = { ...block, nodeData: new Map([["size", sizes]]) };
const field = {
  components: 1,
  values: Float64Array.from(
    points.filter((_, i) => i % 3 === 0),
    (x) => x * x,
  ),
};
const noEdges = { edges: new Uint32Array(), middles: new Float64Array() };
const project = cubeProject();
const withBody = { ...project, bodies: [createBody(surface, { id: 1, firstPatchId: 100 })] };

const marked: SurfaceInput = {
  ...surface,
  trianglePatch: new Uint32Array(surface.triangles.length / 3),
  patches: [{ name: "sphere", tag: 1 }],
  regionPoints: { holes: [], regions: [{ number: 1, position: [0, 0, 0], tag: 7 }] },
};

let mesher: Mesher;
let vtu: Uint8Array;
beforeAll(async () => {
  mesher = await createMesher();
  vtu = (await writeMesh(block, "a.vtu"))[0]?.bytes ?? new Uint8Array();
});
afterAll(() => mesher.dispose());

type Call = (signal: AbortSignal) => Promise<unknown>;

/** The methods by name, without runs. */
const methods: Readonly<Record<string, Call>> = {
  previewProject: (signal) => mesher.previewProject(project, {}, { signal }),
  checkProject: (signal) => mesher.checkProject(project, {}, { signal }),
  coverProject: (signal) => mesher.coverProject(project, {}, { signal }),
  proposeSizes: (signal) => mesher.proposeSizes(project, {}, { signal }),
  sampleCurvature: (signal) => mesher.sampleCurvature(project, {}, { signal }),
  sampleSizes: (signal) => mesher.sampleSizes(project, new Float64Array(3), {}, { signal }),
  backgroundFromMesh: (signal) => mesher.backgroundFromMesh(block, {}, { signal }),
  inspectSurface: (signal) => mesher.inspectSurface(surface, {}, { signal }),
  repairSurface: (signal) => mesher.repairSurface(surface, {}, { signal }),
  refineSurface: (signal) => mesher.refineSurface(surface, { size: 0.01 }, { signal }),
  locateRegions: (signal) => mesher.locateRegions(marked, { signal }),
  proposeSurfaceSizes: (signal) => mesher.proposeSurfaceSizes(surface, { size: 0.02 }, { signal }),
  remeshSurface: (signal) => mesher.remeshSurface(surface, { size: 0.02 }, { signal }),
  splitPatches: (signal) => mesher.splitPatches(surface, {}, { signal }),
  prepareBody: (signal) => mesher.prepareBody(withBody, 1, {}, { signal }),
  inspectMesh: (signal) => mesher.inspectMesh({ points, tetrahedra }, { signal }),
  improveMesh: (signal) => mesher.improveMesh({ points, tetrahedra }, {}, { signal }),
  curveMesh: (signal) => mesher.curveMesh(block, noEdges, { signal }),
  adaptMesh: (signal) => mesher.adaptMesh(block, sized, {}, { signal }),
  addLayers: (signal) =>
    mesher.addLayers(block, [{ patch: "floor, cold", firstHeight: 0.1 }], {}, { signal }),
  sizeFromSolution: (signal) => mesher.sizeFromSolution(block, [field], { elements: 100 }, { signal }),
  transferSolution: (signal) => mesher.transferSolution(block, block, [field], {}, { signal }),
};
const functions: Readonly<Record<string, Call>> = {
  createMesher: (signal) => createMesher({ signal }),
  readSurface: (signal) => readSurface(stlBinary(surface), { fileName: "a.stl", signal }),
  readVolume: (signal) => readVolume(vtu, { fileName: "a.vtu", signal }),
  readMesh: (signal) => readMesh(vtu, { fileName: "a.vtu", signal }),
  writeMesh: (signal) => writeMesh(block, "a.foam.zip", { signal }),
};

const RUNS = ["meshProject", "fillSurface", "meshSurface"];
/** Methods whose cancelling adaptation-cycles.test.ts tests. */
const CYCLES = ["adapt"];

test("every method of a mesher is tested", () => {
  const own = Object.getOwnPropertyNames(Object.getPrototypeOf(mesher) as object);
  const known = [...Object.keys(methods), ...RUNS, ...CYCLES, "constructor", "dispose"];
  expect(own.sort()).toEqual(known.sort());
});

describe.each(Object.entries({ ...methods, ...functions }))("%s", (_, call) => {
  const reason = { word: "enough" };
  const expected = { name: "MesherError", code: "cancelled", data: { reason }, cause: reason };
  const failureOf = (answer: Promise<unknown>) => answer.catch((failure: unknown) => failure);

  test("rejects if the signal was aborted before the call", async () => {
    const failure = await failureOf(call(AbortSignal.abort(reason)));
    expect(failure).toBeInstanceOf(MesherError);
    expect(failure).toMatchObject(expected);
    expect((failure as Error).cause).toBe(reason);
  });

  test("rejects if the signal is aborted during the call, and removes its listeners", async () => {
    const stop = new AbortController();
    const listeners = listenerCount(stop.signal);
    const answer = failureOf(call(stop.signal));
    stop.abort(reason);
    expect(await answer).toMatchObject(expected);
    expect(listeners()).toBe(0);
  });
});

test("no argument is accessed if the signal was aborted before the call", async () => {
  const untouched = new Proxy({}, { get: () => expect.unreachable("it was accessed") }) as never;
  const aborted = { signal: AbortSignal.abort() };
  const calls: Readonly<Record<string, Promise<unknown>>> = {
    previewProject: mesher.previewProject(untouched, untouched, aborted),
    checkProject: mesher.checkProject(untouched, untouched, aborted),
    coverProject: mesher.coverProject(untouched, untouched, aborted),
    proposeSizes: mesher.proposeSizes(untouched, untouched, aborted),
    sampleCurvature: mesher.sampleCurvature(untouched, untouched, aborted),
    sampleSizes: mesher.sampleSizes(untouched, untouched, untouched, aborted),
    backgroundFromMesh: mesher.backgroundFromMesh(untouched, untouched, aborted),
    inspectSurface: mesher.inspectSurface(untouched, untouched, aborted),
    repairSurface: mesher.repairSurface(untouched, untouched, aborted),
    refineSurface: mesher.refineSurface(untouched, untouched, aborted),
    locateRegions: mesher.locateRegions(untouched, aborted),
    proposeSurfaceSizes: mesher.proposeSurfaceSizes(untouched, untouched, aborted),
    remeshSurface: mesher.remeshSurface(untouched, untouched, aborted),
    splitPatches: mesher.splitPatches(untouched, untouched, aborted),
    prepareBody: mesher.prepareBody(untouched, 1, untouched, aborted),
    inspectMesh: mesher.inspectMesh(untouched, aborted),
    improveMesh: mesher.improveMesh(untouched, untouched, aborted),
    curveMesh: mesher.curveMesh(untouched, untouched, aborted),
    adaptMesh: mesher.adaptMesh(untouched, untouched, untouched, aborted),
    addLayers: mesher.addLayers(untouched, untouched, untouched, aborted),
    sizeFromSolution: mesher.sizeFromSolution(untouched, untouched, untouched, aborted),
    transferSolution: mesher.transferSolution(untouched, untouched, untouched, untouched, aborted),
  };
  expect(Object.keys(calls)).toEqual(Object.keys(methods));
  for (const call of Object.values(calls)) await expect(call).rejects.toMatchObject({ code: "cancelled" });
  for (const run of [
    mesher.meshProject(untouched, untouched, aborted),
    mesher.fillSurface(untouched, untouched, aborted),
  ]) {
    expect((await run).report.status).toBe("cancelled");
  }
});

/** Returns a function that counts the listeners that were added to a signal and not removed. */
function listenerCount(signal: AbortSignal): () => number {
  const added = vi.spyOn(signal, "addEventListener");
  const removed = vi.spyOn(signal, "removeEventListener");
  return () => {
    const gone = new Set(removed.mock.calls.map(([, listener]) => listener));
    return added.mock.calls.filter(([, listener]) => !gone.has(listener)).length;
  };
}

test("only cancelled runs resolve with a result", async () => {
  const signal = AbortSignal.abort();
  const box = boxSurface(1);
  for (const { report } of [
    await mesher.fillSurface(box, {}, { signal }),
    await mesher.meshProject(project, {}, { signal }),
  ]) {
    expect(report.status).toBe("cancelled");
  }
});

test("createMesher rejects an invalid control", async () => {
  const failure: unknown = await createMesher({ signal: 5 as never }).catch((reason: unknown) => reason);
  expect(failure).toMatchObject({ data: { diagnostics: [{ code: "invalid-option" }] } });
});

test("disposing rejects calls and reports whether they were active", async () => {
  const short = await createMesher();
  const underWay = short.inspectSurface(surface).catch((failure: unknown) => failure);
  short.dispose();
  expect(await underWay).toMatchObject({ code: "disposed", data: { wasUnderWay: true } });
  const after = short.inspectSurface(surface).catch((failure: unknown) => failure);
  expect(await after).toMatchObject({ code: "disposed", data: { wasUnderWay: false } });
});

/** Compiles only if every code has its own data and the cases are complete. */
function dataOf(error: MesherError): readonly unknown[] {
  switch (error.code) {
    case "invalid-input":
      return error.data.diagnostics;
    case "cancelled":
      return [error.data.reason];
    case "disposed":
      return [error.data.wasUnderWay];
    case "out-of-memory":
      return [error.data.bytes, error.data.phase, error.data.sizeFactor];
    case "engine-not-loaded":
      return [error.data.what, error.data.reason, error.data.remedy];
    case "engine-failed":
      return [error.data.reason];
    default:
      return error satisfies never;
  }
}

test("errors are a closed union discriminated by their code", () => {
  expectTypeOf<MesherError["code"]>().toEqualTypeOf<MesherErrorCode>();
  const error: MesherError = new MesherError("cancelled", "enough", { reason: 5 });
  expect(dataOf(error)).toEqual([5]);
  expect(error).toBeInstanceOf(Error);
});
