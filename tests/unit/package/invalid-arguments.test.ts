/**
 * Calls every function of the package with invalid values in place of each argument and each nested value:
 * the call succeeds, or reports a code of the closed union and the name of the argument.
 */
import * as root from "tetrafront";
import type { BackgroundArrays, Diagnostic, Mesher, MeshReport } from "tetrafront";
import * as internal from "tetrafront/internal";
import * as projects from "tetrafront/project";
import type { ProjectBody } from "tetrafront/project";
import * as traces from "tetrafront/trace";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

type AnyFunction = (...given: never[]) => unknown;
/** Arguments by name, in the order of the parameters. */
type Arguments = Readonly<Record<string, unknown>>;

/** Everything that the package exports. */
const api = { ...root, ...projects, ...traces, ...internal };

let mesher: Mesher;
beforeAll(async () => {
  mesher = await api.createMesher();
});
afterAll(() => mesher.dispose());

const box = boxSurface(1);
/** The block is made as high as it is wide: calls that fill or improve a flat one need many elements. */
const flatBlock = blockMesh(1);
const block = {
  ...flatBlock,
  points: flatBlock.points.map((value, i) => (i % 3 === 2 ? 100 * value : value)),
};
const project = cubeProject();
/** A grid that contains everything. */
const background: BackgroundArrays = {
  points: Float64Array.from(block.points, (_, i) => ((Math.floor(i / 3) >> (i % 3)) & 1 ? 3 : -2)),
  sizes: new Float64Array(8).fill(1),
  stretchings: new Float64Array(8).fill(1),
  directions: new Float64Array(24).fill(1),
  secondStretchings: new Float64Array(8).fill(1),
  secondDirections: new Float64Array(24).fill(1),
  tetrahedra: block.tetrahedra,
  coverageMargin: 0.1,
  sources: [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 1 }],
};
const sourcesOnly = {
  ...background,
  points: new Float64Array(),
  sizes: new Float64Array(),
  stretchings: undefined,
  directions: undefined,
  secondStretchings: undefined,
  secondDirections: undefined,
  tetrahedra: new Uint32Array(),
};
const body: ProjectBody = {
  ...api.createBody(box, { id: 1, firstPatchId: 10, name: "a" }),
  placement: { position: [1.5, 0, 0], rotation: [0, 0, 0, 1], scale: 1 },
  remeshing: { layers: 1 },
  surface: "keep",
};
const prepared = {
  body: 1,
  ...api.bodySurface(body),
  origin: Uint32Array.from({ length: 12 }, (_, t) => t),
  trueEdges: { edges: Uint32Array.of(0, 1), middles: Float64Array.of(0.5, 0, 0) },
  diagnostics: [],
};
const control = { signal: new AbortController().signal, onProgress: () => undefined };
const surfaceFile = { ...box, trianglePatch: new Uint32Array(12), patches: [{ name: "skin", tag: 1 }] };
const surfaceRegions = {
  regions: [{ name: "body", tag: 1 }],
  triangleRegions: new Uint32Array(24).map((_, side) => (side % 2 === 0 ? 0 : api.NO_REGION)),
  areMeshed: true,
  maxVolumes: Float64Array.of(1),
};
const regionPoints = {
  holes: [],
  regions: [{ number: 1, position: [0.5, 0.5, 0.5], tag: 1, name: "body", maxVolume: 1 }],
};
const triangleRegions = new Uint32Array(24);
const text = new TextEncoder().encode("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
const nodes = new TextEncoder().encode("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
const elements = new TextEncoder().encode("1 4 0\n1 1 2 3 4\n");
const readOptions = { fileName: "a.off", openOther: () => Promise.resolve(undefined), ...control };

const element = { tetrahedron: 0, centroid: [0, 0, 0], dihedral: { min: 5, max: 170 } };
const inspection = {
  nodes: 8,
  tetrahedra: 6,
  dihedral: { min: 5, max: 170 },
  radiusRatio: { min: 0.1, mean: 0.5 },
  volume: 1,
  edgeLengths: { mean: 1 },
  quality: {
    binWidths: { dihedral: 5 },
    regions: [{ tetrahedra: 6, smallestDihedral: [6] }],
    shapes: { dihedral: { max: 170 } },
    worst: [element],
    limitedByBoundary: { edges: 0, needles: 0, narrowGaps: 0, worst: [element] },
    poor: {
      worst: element,
      reason: "wedge",
      value: 5,
      edge: { from: [0, 0, 0], to: [0, 0, 1] },
      goodSize: 0,
      goodTetrahedra: 0,
    },
  },
};

const functions: Readonly<Record<string, Arguments>> = {
  extensionsFor: { action: "read", contents: "surface" },
  formatOf: { fileName: "a.off" },
  setCadLibrary: { addresses: { script: "occt-import-js.js", wasm: "occt-import-js.wasm" } },
  patchNames: { project },
  readMesh: { source: text, options: readOptions },
  readSurface: { source: text, options: readOptions },
  readVolume: {
    source: elements,
    options: {
      fileName: "a.ele",
      openOther: (name: string) => Promise.resolve(name.endsWith(".node") ? nodes : undefined),
    },
  },
  writeMesh: { mesh: block, fileName: "a.vtu" },
  streamMesh: { mesh: block, fileName: "a.vtu" },
  meshFile: {
    file: offFile(box),
    options: {
      fileName: "a.off",
      size: 1,
      surface: "auto",
      repair: true,
      weld: 0,
      fillHoles: 3,
      splitPatches: 40,
      get mesher() {
        return mesher;
      },
    },
    control,
  },
  unusedData: { mesh: { nodeData: new Map([["size", { components: 1, values: new Float64Array(8) }]]) } },
  backgroundArrays: {
    background: { ...project.background, sources: background.sources, coverageMargin: 0.1 },
  },
  projectBackground: { background },
  parseProject: { value: project },
  readProject: { text: api.writeProject(project) },
  writeProject: { project: { ...project, name: "a", meshing: { size: 1 } } },
  createBody: {
    surface: { ...box, trianglePatch: new Uint32Array(12), patches: [{ name: "a" }] },
    body: { id: 1, firstPatchId: 2, name: "a" },
  },
  createBodies: {
    surface: {
      ...box,
      trianglePatch: new Uint32Array(12),
      patches: [{ name: "a" }],
      surfaceRegions: { regions: [{ name: "r", tag: 1 }], triangleRegions: new Uint32Array(24) },
    },
    body: { id: 1, firstPatchId: 2, name: "a" },
  },
  bodySurface: { body },
  bodyPatchGroups: { body },
  bodyWithPatches: {
    body,
    surface: { trianglePatch: new Uint32Array(12), patches: [{ name: "a" }] },
    nextPatchId: 11,
  },
  mergePatches: { body, ids: [10] },
  meshWithBoundary: { mesh: block },
  inspectedResult: { opened: { mesh: block, patchShapes: [{ meanEdge: 1 }] }, inspection },
  improvedResult: {
    result: { mesh: block, sides: new Uint32Array(), report: { diagnostics: [] } },
    improvement: {
      mesh: block,
      nodeOrigin: Uint32Array.from({ length: block.points.length / 3 }, (_, node) => node),
    },
    inspection,
  },
  measureTriangles: { surface: box },
  isInterface: { mesh: { triangleRegions }, triangle: 0 },
};

const field = { components: 1, values: new Float64Array(block.points.length / 3).fill(1) };
const methods: Readonly<Record<Exclude<keyof Mesher, "dispose">, Arguments>> = {
  meshProject: {
    project: { ...project, bodies: [body] },
    options: { growth: 0.3, background, preparedBodies: [prepared], elementOrder: 2 },
    control,
  },
  checkProject: {
    project: { ...project, bodies: [body] },
    options: { growth: 0.3, background, preparedBodies: [prepared], elementOrder: 2 },
    control,
  },
  fillSurface: { surface: { ...box, surfaceRegions }, options: { growth: 0.3, background }, control },
  locateRegions: { surface: { ...surfaceFile, regionPoints }, control },
  proposeSurfaceSizes: { surface: box, options: { size: 1 }, control },
  prepareBody: {
    project: { ...project, bodies: [body] },
    body: body.id,
    options: { size: 1, background: sourcesOnly },
    control,
  },
  previewProject: { project, options: { size: 1, innerShells: "cavities" }, control },
  coverProject: { project, options: { size: 1, shape: "box" }, control },
  proposeSizes: { project, options: { minSize: 0.5 }, control },
  sampleCurvature: { project, options: { cells: 3 }, control },
  sampleSizes: {
    project: { ...project, bodies: [body] },
    positions: new Float64Array(6),
    options: { growth: 0.3, background, preparedBodies: [prepared], elementOrder: 2 },
    control,
  },
  backgroundFromMesh: { mesh: block, options: { sizes: new Float64Array(8).fill(1) }, control },
  inspectSurface: { surface: box, options: { innerShells: "regions" }, control },
  repairSurface: { surface: box, options: { weld: 0, fillHoles: 3 }, control },
  refineSurface: { surface: box, options: { background }, control },
  splitPatches: {
    surface: { ...box, trianglePatch: new Uint32Array(12), patches: [{ name: "a", tag: 1 }] },
    options: { angle: 30, patches: [0] },
    control,
  },
  meshSurface: {
    surface: { ...surfaceFile, surfaceRegions },
    options: { size: 1, surface: "auto", splitPatches: 40, background: sourcesOnly, elementOrder: 2 },
    control,
  },
  remeshSurface: {
    surface: { ...box, trianglePatch: new Uint32Array(12) },
    options: { featureAngle: 30, layers: 1, background },
    control,
  },
  inspectMesh: { mesh: block, control },
  improveMesh: {
    mesh: block,
    options: { optimization: "fast" },
    control: { ...control, partial: true },
  },
  sizeFromSolution: { mesh: block, fields: [field], options: { elements: 100, norm: "l4" }, control },
  adapt: {
    model: block,
    solve: () => [field],
    options: { cycles: 1, elements: 50, norm: "l2", fields: ["field 1"], sweeps: 1, conservative: false },
    control,
  },
  adaptMesh: {
    mesh: block,
    background: { ...block, nodeData: new Map([["size", field]]) },
    options: { sweeps: 1 },
    control: { ...control, partial: true },
  },
  addLayers: {
    mesh: block,
    layers: [{ patch: "floor, cold", firstHeight: 0.1, growth: 1.2, count: 2 }],
    options: { cycles: 1, sweeps: 1 },
    control: { ...control, partial: true },
  },
  transferSolution: {
    from: block,
    to: block,
    fields: [field],
    options: { conservative: true },
    control,
  },
  curveMesh: {
    mesh: block,
    curvedEdges: { edges: Uint32Array.of(0, 1), middles: Float64Array.of(0.5, 0, 0) },
    control,
  },
};

function detached<T extends Float64Array | Uint32Array>(array: T): T {
  structuredClone(array, { transfer: [array.buffer as ArrayBuffer] });
  return array;
}

/** Invalid values by description, created for each call. */
const INVALID_VALUES: Readonly<Record<string, () => unknown>> = {
  nothing: () => undefined,
  null: () => null,
  "a number": () => 5,
  "a number below 0": () => -1,
  "not a number": () => NaN,
  "a word": () => "word",
  true: () => true,
  "an empty list": () => [],
  "a list": () => [1, 2],
  "a list of nothing": () => [null, undefined],
  "an empty object": () => ({}),
  "an object with other properties": () => ({ lines: 5 }),
  "a function": () => () => 5,
  "a symbol": () => Symbol("any"),
  "a large integer": () => 5n,
  "an array of another type": () => new Float32Array(24),
  "an odd number of doubles": () => new Float64Array(7),
  "doubles that are not numbers": () => new Float64Array(24).fill(NaN),
  "an odd number of integers": () => new Uint32Array(7),
  "integers out of range": () => new Uint32Array(24).fill(0xfffffff0),
  "detached doubles": () => detached(new Float64Array(24)),
  "detached integers": () => detached(new Uint32Array(24)),
  "doubles in shared memory": () => new Float64Array(new SharedArrayBuffer(8 * 24)),
  "integers in shared memory": () => new Uint32Array(new SharedArrayBuffer(4 * 24)),
  "shared memory": () => new SharedArrayBuffer(64),
};

/**
 * Returns the paths of all replaceable values: the value itself, properties of objects, and first entries of
 * lists.
 */
function pathsIn(value: unknown, depth = 0): (readonly string[])[] {
  const isOpen = typeof value === "object" && value !== null && !ArrayBuffer.isView(value) && depth < 4;
  if (!isOpen || value instanceof Map || value instanceof AbortSignal) return [[]];
  const entries = Array.isArray(value) ? Object.entries(value).slice(0, 1) : Object.entries(value);
  return [[], ...entries.flatMap(([key, own]) => pathsIn(own, depth + 1).map((rest) => [key, ...rest]))];
}

function withReplaced(value: unknown, [key, ...rest]: readonly string[], other: unknown): unknown {
  if (key === undefined) return other;
  const own = value as Record<string, unknown>;
  const changed = withReplaced(own[key], rest, other);
  return Array.isArray(value)
    ? value.map((kept: unknown, i) => (String(i) === key ? changed : kept))
    : { ...own, [key]: changed };
}

const ENGINE: readonly string[] = Object.values(api.ENGINE_CODES);
const OTHERS: readonly string[] = [
  ...["invalid-argument", "invalid-arrays", "invalid-option", "invalid-project", "not-a-project"],
  ...["unknown-format", "empty-file", "malformed-file", "missing-file", "no-triangles", "no-tetrahedra"],
  ...["later-version", "invalid-mesh"],
];

interface ReportedError {
  readonly code: string;
  readonly message: string;
}

/** The properties in which results report errors. */
interface Answer {
  readonly errors?: readonly ReportedError[];
  readonly diagnostics?: readonly Diagnostic[];
  readonly report?: MeshReport;
  readonly result?: { readonly report: MeshReport };
}

const isIterable = (value: unknown): value is AsyncIterable<unknown> =>
  typeof value === "object" && value !== null && Symbol.asyncIterator in value;

async function lastOf(values: AsyncIterable<unknown>): Promise<unknown> {
  let last: unknown;
  for await (const value of values) last = value;
  return last;
}

/** Returns the errors of a call; undefined if it succeeded. */
async function errorsOf(call: () => unknown): Promise<readonly ReportedError[] | undefined> {
  try {
    const answer = await call();
    const made = (isIterable(answer) ? await lastOf(answer) : answer) as Answer | undefined;
    const diagnostics = (made?.report ?? made?.result?.report)?.diagnostics ?? made?.diagnostics;
    const found = made?.errors ?? diagnostics?.filter(({ severity }) => severity === "error");
    return found?.length === 0 ? undefined : found;
  } catch (failure) {
    if (!(failure instanceof api.MesherError) || failure.code !== "invalid-input") throw failure;
    expect(failure.data.diagnostics.length).toBeGreaterThan(0);
    return failure.data.diagnostics;
  }
}

/**
 * Functions tested elsewhere: `readTrace` and `loadTrace` with damaged files (trace.test.ts); `recordTrace` passes its
 * arguments on to methods of the mesher; `liveNotes` takes a project that was checked; `hasWelded`
 * and `remeshedBest` take results of the mesher (best-repair.test.ts), `withSolidsOfPatches` one of a reader; units of solids are tested in solid-units.test.ts,
 * the front in the plane, for which one number is a size, in fill-plane.test.ts.
 */
const TESTED_ELSEWHERE = [
  // Their callers have checked what they pass.
  "correctedNumber",
  "base64Of",
  "deviationOf",
  "rowsOf",
  "bodyBox",
  "estimatedErrors",
  "featureSolid",
  "partOfFile",
  "drawnSolid",
  "importKernel",
  "TimeLeft",
  "roundTime",
  "inOrder",
  "MesherError",
  "createMesher",
  "fillPlane",
  "loadPlaneFront",
  "loadTrace",
  "readTrace",
  "recordTrace",
  "liveNotes",
  "hasWelded",
  "remeshedBest",
  "withSolidsOfPatches",
  "connectedGroups",
  "createUnitBodies",
  "dataOf",
  "differentNames",
  "fieldsOf",
  "isWithin",
  "nearPairs",
  "sharedPairs",
  "solidUnits",
  "live",
  "watchLife",
  "receiveWatched",
];

test("every exported function and every method is tested", () => {
  const exported = Object.entries(api).filter(([, value]) => typeof value === "function");
  const names = exported.map(([name]) => name).filter((name) => !TESTED_ELSEWHERE.includes(name));
  expect(Object.keys(functions).sort()).toEqual(names.sort());
  const own = Object.getOwnPropertyNames(Object.getPrototypeOf(mesher) as object);
  expect(own.filter((name) => !["constructor", "dispose"].includes(name)).sort()).toEqual(
    Object.keys(methods).sort(),
  );
});

/** Text that every message about an argument contains if it does not contain the argument's name. */
const MESSAGE_PATTERNS: Readonly<Record<string, RegExp>> = {
  file: /file|source/i,
  fileName: /name|extension/i,
  value: /project/,
  text: /project/,
  volume: /mesh|volume/,
};

describe.each([
  ...Object.entries(functions).map(([name, given]) => [name, given, false] as const),
  ...Object.entries(methods).map(([name, given]) => [name, given, true] as const),
])("%s", (name, given, isMethod) => {
  const callWith = (values: readonly unknown[]) => {
    const owner = (isMethod ? mesher : api) as unknown as Readonly<Record<string, AnyFunction>>;
    return owner[name]?.call(owner, ...(values as never[]));
  };
  const valid = Object.values(given);

  test("accepts valid arguments", async () => {
    expect(await errorsOf(() => callWith(valid))).toBeUndefined();
  });

  test.each(Object.keys(given))("reports invalid values for its %s", async (argument) => {
    const index = Object.keys(given).indexOf(argument);
    for (const [description, make] of Object.entries(INVALID_VALUES)) {
      for (const path of pathsIn(given[argument])) {
        const label = `${name}: ${description} as ${[argument, ...path].join(".")}`;
        const values = valid.map((value, i) => (i === index ? withReplaced(value, path, make()) : value));
        let errors: readonly ReportedError[] | undefined;
        try {
          errors = await errorsOf(() => callWith(values));
        } catch (failure) {
          throw new Error(`${label}: ${String(failure)}`, { cause: failure });
        }
        for (const { code, message } of errors ?? []) {
          expect([...OTHERS, ...ENGINE], label).toContain(code);
          expect(message, label).not.toBe("");
        }
        const namesArgument = path.length === 0 && ["a number", "a symbol"].includes(description);
        if (namesArgument && !["index", "triangle", "nextPatchId"].includes(argument)) {
          expect(errors?.[0]?.message, label).toMatch(
            MESSAGE_PATTERNS[argument] ?? new RegExp(argument, "i"),
          );
        }
      }
    }
  });
});
