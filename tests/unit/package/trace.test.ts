/** Traces of the front: states, steps, summary, final mesh, and damaged files. */
import { MesherError } from "tetrafront";
import { loadTrace, readTrace, type Trace, type TraceStep } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { mutated, randomSource } from "../../support/random.js";
import { boxSurface } from "../../support/surfaces.js";
import {
  keyOf,
  type StarOptions,
  starSurface,
  starTrace,
  TraceBytes,
  traceBytes,
  writeFirstFaces,
} from "../../support/traces.js";

const box = starSurface(boxSurface(2, [-1, -1, -1], [1, 1, 1]));
const full: StarOptions = { ...box, postponeEvery: 5, reopenAfter: 12, withFronts: true };

function read(bytes: Uint8Array): Trace {
  const result = readTrace(bytes);
  if (!result.success) throw new Error(result.errors[0].message);
  return result.value;
}

const frontKeys = (trace: Trace, state: number): string[] =>
  Array.from(trace.frontAt(state), (face) => {
    const [a = 0, b = 0, c = 0] = trace.faces.nodes.subarray(3 * face, 3 * face + 3);
    return keyOf([a, b, c]);
  }).sort();

/** FNV-1a as in the engine, with 64-bit integers. */
function fingerprintOf(points: readonly number[], tetrahedra: readonly number[]): string {
  let hash = 0xcbf29ce484222325n;
  const add = (word: bigint) => {
    for (let byte = 0n; byte < 8n; byte++)
      hash = ((hash ^ ((word >> (8n * byte)) & 0xffn)) * 0x100000001b3n) & 0xffffffffffffffffn;
  };
  for (const bits of new BigUint64Array(Float64Array.from(points, (value) => value + 0).buffer)) add(bits);
  for (const node of tetrahedra) add(BigInt(node));
  return hash.toString(16).padStart(16, "0");
}

describe("states", () => {
  test("every state equals that of a replay from the start, in any order", () => {
    const { bytes, fronts } = starTrace(full);
    const trace = read(bytes);
    expect(fronts).toHaveLength(trace.stepCount + 1);
    const random = randomSource(200);
    for (let scrub = 0; scrub < 200; scrub++) {
      const state = random() % fronts.length;
      expect(frontKeys(trace, state)).toEqual(fronts[state]);
      expect(trace.steps.frontSizes[state]).toBe(fronts[state]?.length);
    }
  });

  test("the changes of the steps lead from state to state", () => {
    const trace = read(starTrace(full).bytes);
    let front = new Set(trace.frontAt(0));
    let elements = new Set(trace.elementsAt(0));
    for (let step = 1; step <= trace.stepCount; step++) {
      const changes = trace.changesAt(step);
      front = new Set([...front].filter((face) => !changes.removedFaces.includes(face)));
      elements = new Set([...elements].filter((element) => !changes.removedElements.includes(element)));
      for (const face of changes.addedFaces) front.add(face);
      for (const element of changes.addedElements) elements.add(element);
      expect([...front].sort((a, b) => a - b)).toEqual([...trace.frontAt(step)]);
      expect([...elements].sort((a, b) => a - b)).toEqual([...trace.elementsAt(step)]);
    }
    expect(front.size).toBe(0);
  });

  test("an element that is removed and restored comes back as another one", () => {
    const trace = read(starTrace(full).bytes);
    const reopened = Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).filter(
      (step) => step?.kind === "recovery",
    );
    expect(reopened.map((step) => step.change)).toEqual(["reopened", "undone"]);
    const [removed] = reopened[0]?.removedElements ?? [];
    const [restored] = reopened[1]?.addedElements ?? [];
    expect(restored).toBeGreaterThan(removed ?? NaN);
  });

  test("a second front begins in the state in which the first has ended", () => {
    const tetrahedron = {
      points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
      triangles: [0, 1, 2, 1, 0, 3, 2, 1, 3, 0, 2, 3],
    };
    const events = new TraceBytes();
    for (let pass = 0; pass < 2; pass++) {
      writeFirstFaces(events, tetrahedron.triangles);
      events.event(1).zigzag(0).byte(16).varint(0).float(1);
      events.float(0).float(0).float(1).varint(4).varint(1);
      events.event(3, 7).score(1).zigzag(3).zigzag(2).zigzag(3).zigzag(1);
    }
    const trace = read(traceBytes({ points: tetrahedron.points, steps: 2, events: events.event(6) }));
    expect([0, 1, 2].map((state) => trace.frontAt(state).length)).toEqual([4, 4, 0]);
    expect(trace.changesAt(1)).toMatchObject({ removedFaces: [0, 1, 2, 3], addedFaces: [] });
    expect(trace.fronts.map(({ state, firstFace }) => [state, firstFace])).toEqual([
      [0, 0],
      [1, 4],
    ]);
    expect([...trace.finalMesh().tetrahedra]).toEqual([0, 1, 2, 3, 0, 1, 2, 3]);
  });
});

describe("steps", () => {
  test("have the numbers that were recorded", () => {
    const trace = read(starTrace(full).bytes);
    const advances: Extract<TraceStep, { kind: "advance" }>[] = [];
    for (let i = 1; i <= trace.stepCount; i++) {
      const step = trace.stepAt(i);
      if (step?.kind === "advance") advances.push(step);
    }
    for (const step of advances) {
      expect(step).toMatchObject({ ruleClass: 0, bucket: 16, layers: 0, targetEdge: 0.5, tensor: null });
      const first = trace.faces.nodes[3 * step.face] ?? 0;
      const origin = trace.nodes.positions.subarray(3 * first, 3 * first + 3);
      expect(step.idealPoint).toEqual(Array.from(origin, (coordinate) => 0.5 * coordinate));
      expect(trace.faces.born[step.face]).toBeLessThan(step.step);
      expect(step.candidates.at(-1)?.verdict === "accepted").toBe(step.outcome === "accepted");
      for (const { verdict, culprit } of step.candidates)
        expect(culprit === null).toBe(verdict === "behind" || verdict === "accepted");
    }
    const refused = advances
      .flatMap((step) => step.candidates)
      .filter(({ verdict }) => verdict === "too-close");
    expect(refused.length).toBeGreaterThan(0);
    expect(refused.every(({ node, isNew }) => node === null && isNew)).toBe(true);
    expect(advances[0]?.candidates.at(-1)).toMatchObject({ isNew: true, position: [0, 0, 0] });
    expect(trace.stepAt(0)).toBeUndefined();
    expect(trace.stepAt(trace.stepCount + 1)).toBeUndefined();
  });

  test("are counted", () => {
    const trace = read(starTrace(full).bytes);
    const summary = trace.summary();
    expect(summary.accepted).toBe(48);
    expect(summary.changes).toEqual({ star: 0, reopened: 1, closed: 0, undone: 1, "exact-fill": 0 });
    expect(summary.accepted + summary.postponed + 2).toBe(summary.steps);
    const { behind, crosses, "too-close": tooClose } = summary.refused;
    expect(behind + crosses + tooClose + summary.accepted).toBe(trace.steps.candidateVerdicts.length);
  });
});

test("the final mesh has the engine's order and fingerprint", () => {
  const { bytes, points, tetrahedra } = starTrace(full);
  const mesh = read(bytes).finalMesh();
  expect([...mesh.tetrahedra].length).toBe(tetrahedra.length);
  expect([...mesh.points]).toEqual(points.map((value) => value + 0));
  expect([...mesh.tetrahedra]).toEqual(tetrahedra);
  expect(mesh.fingerprint).toBe(fingerprintOf(points, tetrahedra));
});

describe("reading in slices", () => {
  const large = starTrace(starSurface(boxSurface(40, [-1, -1, -1], [1, 1, 1]))).bytes;

  test("returns the trace that is read at once, and lets other work run meanwhile", async () => {
    const expected = read(large);
    const fractions: number[] = [];
    let ticks = 0;
    const ticking = setInterval(() => ++ticks);
    const loaded = await loadTrace(large, { onProgress: (fraction) => fractions.push(fraction) });
    clearInterval(ticking);
    if (!loaded.success) throw new Error(loaded.errors[0].message);
    const trace = loaded.value;
    expect(trace.steps).toEqual(expected.steps);
    expect(trace.faces).toEqual(expected.faces);
    expect(trace.finalMesh()).toEqual(expected.finalMesh());
    expect(ticks).toBeGreaterThan(0);
    expect(fractions.length).toBeGreaterThan(2);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions.at(-1)).toBe(1);
  });

  test("is cancelled before and while it runs", async () => {
    const code = (error: unknown) => (error instanceof MesherError ? error.code : error);
    await expect(loadTrace(large, { signal: AbortSignal.abort() }).catch(code)).resolves.toBe("cancelled");
    const abort = new AbortController();
    let calls = 0;
    const onProgress = () => {
      ++calls;
      abort.abort();
    };
    await expect(loadTrace(large, { signal: abort.signal, onProgress }).catch(code)).resolves.toBe(
      "cancelled",
    );
    expect(calls).toBe(1);
  });

  test("returns the errors of a damaged file, and rejects invalid options", async () => {
    const damaged = large.slice(0, -1);
    expect(await loadTrace(damaged)).toEqual(readTrace(damaged));
    const options = { onProgress: 3 } as unknown as { onProgress: () => void };
    await expect(loadTrace(large, options)).rejects.toThrow(/options.onProgress/);
  });
});

describe("damaged files", () => {
  test("are never read with an exception, and their errors name byte and remedy", () => {
    const seeds = Number(process.env["TETRAFRONT_FUZZ"] ?? 2000);
    const { bytes } = starTrace({ ...full, withFronts: false });
    let refused = 0;
    for (let seed = 1; seed <= seeds; seed++) {
      const damaged = mutated(bytes, randomSource(seed));
      const result = readTrace(damaged);
      if (result.success) {
        const trace = result.value;
        for (let step = 1; step <= trace.stepCount; step++) trace.stepAt(step);
        trace.finalMesh();
        continue;
      }
      ++refused;
      const [error] = result.errors;
      expect(error.offset, error.message).toBeTypeOf("number");
      expect(error.remedy).toMatch(/\.$/);
    }
    expect(refused).toBeGreaterThan(seeds / 2);
  });

  test.each([
    ["no bytes", () => new Uint8Array(), /the file is empty/],
    ["another file", () => new TextEncoder().encode("solid cube"), /byte 0: this is no trace/],
    ["a truncated file", (bytes: Uint8Array) => bytes.slice(0, -1), /the file ends before the trace does/],
    ["a later version", (bytes: Uint8Array) => bytes.with(7, 9), /byte 7: version 9/],
    ["more bytes", (bytes: Uint8Array) => Uint8Array.of(...bytes, 1), /bytes after the end/],
  ])("%s", (_, damage, message) => {
    const result = readTrace(damage(starTrace(box).bytes));
    expect(result.success ? "" : result.errors[0].message).toMatch(message);
  });
});
