/** Inspection of surfaces and meshes, and repair on request: every diagnostic and every change is listed. */
import {
  createMesher,
  LIMITS,
  MesherError,
  NO_ORIGIN,
  readMesh,
  type Diagnostic,
  type Mesher,
  type SurfaceInput,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";
import { randomSource } from "../../support/random.js";
import {
  boxSurface,
  cavitySurface,
  crossingNeedles,
  joined,
  sphereSurface,
  turned,
} from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const box = boxSurface(3, [0, 0, 0], [1, 2, 3]);
const without = ({ points, triangles }: SurfaceInput, triangle: number): SurfaceInput => ({
  points,
  triangles: triangles.filter((_, i) => Math.floor(i / 3) !== triangle),
});

describe("the inspection of a surface", () => {
  test("measures a box", async () => {
    const found = await mesher.inspectSurface(box);
    expect(found).toMatchObject({
      isFillable: true,
      isClosed: true,
      isManifold: true,
      isEmbedded: true,
      regions: 1,
      cavities: 0,
      box: { low: [0, 0, 0], high: [1, 2, 3] },
      diagnostics: [],
    });
    expect(found.area).toBeCloseTo(22, 12);
    expect(found.volume).toBeCloseTo(6, 12);
    expect(found.triangles).toBe(box.triangles.length / 3);
    // Euler's formula for a solid without handles.
    expect(found.nodes - found.edges + found.triangles).toBe(2);
    expect(found.worst).toHaveLength(10);
  });

  test("lists at most maxDiagnostics diagnostics per code and counts all", async () => {
    const pairs = 1500;
    const soup = crossingNeedles(pairs);
    for (const [maxDiagnostics, listed] of [
      [undefined, 1000],
      [1, 1],
      [pairs - 1, pairs - 1],
      [LIMITS.maxDiagnostics, pairs],
    ]) {
      const { diagnostics, isEmbedded } = await mesher.inspectSurface(soup, { maxDiagnostics });
      const crossings = diagnostics.filter(({ code }) => code === "self-intersection");
      expect(isEmbedded).toBe(false);
      expect(crossings.map(({ entities }) => entities.map(({ index }) => index))).toEqual(
        Array.from({ length: listed ?? 0 }, (_, i) => [2 * i, 2 * i + 1]),
      );
      expect(new Set(crossings.map(({ data }) => JSON.stringify(data)))).toEqual(
        new Set([JSON.stringify({ count: pairs })]),
      );
      for (const [i, { position }] of crossings.entries()) expect(position?.[0]).toBeCloseTo(10 * i, 2);
      const edges = diagnostics.filter(({ code }) => code === "open-edge").length;
      expect(edges).toBe(Math.min(maxDiagnostics ?? 1000, 6 * pairs));
    }
  });

  test("rejects an invalid maxDiagnostics", async () => {
    for (const maxDiagnostics of [0, -1, 1.5, NaN, LIMITS.maxDiagnostics + 1, "all" as unknown as number]) {
      await expect(mesher.inspectSurface(box, { maxDiagnostics })).rejects.toMatchObject({
        data: { diagnostics: [{ code: "invalid-option", data: { option: "maxDiagnostics" } }] },
      });
    }
  });

  test("can be cancelled while diagnostics are formatted", async () => {
    const stop = new AbortController();
    const onProgress = ({ fraction }: { fraction: number }) => fraction === 1 && stop.abort();
    const inspection = mesher.inspectSurface(
      crossingNeedles(20_000),
      { maxDiagnostics: LIMITS.maxDiagnostics },
      {
        signal: stop.signal,
        onProgress,
      },
    );
    await expect(inspection).rejects.toMatchObject({ code: "cancelled" });
  });

  test("distinguishes regions from cavities", async () => {
    const surface = joined(cavitySurface(10), boxSurface(2, [5, 0, 0], [6, 1, 1]));
    const found = await mesher.inspectSurface(surface);
    expect([found.regions, found.cavities]).toEqual([2, 1]);
    expect(found.volume).toBeCloseTo(enclosedVolume(surface), 10);
    expect(found.shells.map(({ isCavity }) => isCavity)).toEqual([false, true, false]);
  });

  test("counts inner shells as regions on request, whatever their orientation", async () => {
    const inside = boxSurface(2, [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]);
    const outside = boxSurface(4, [-1, -1, -1], [1, 1, 1]);
    for (const core of [inside, turned(inside)]) {
      const surface = joined(outside, core);
      const found = await mesher.inspectSurface(surface, { innerShells: "regions" });
      expect(found).toMatchObject({ isFillable: true, regions: 2, cavities: 0 });
      expect(found.volume).toBeCloseTo(8, 12);
      const { report } = await mesher.fillSurface(surface, { innerShells: "regions" });
      expect(report.diagnostics).toEqual(found.diagnostics);
    }
    const asCavity = await mesher.inspectSurface(joined(outside, turned(inside)), {
      innerShells: "cavities",
    });
    expect(asCavity).toMatchObject({ isFillable: true, regions: 1, cavities: 1 });
    expect(asCavity.volume).toBeCloseTo(7, 12);
  });

  test("reports every open edge with its position, as fillSurface does", async () => {
    const open = without(box, 7);
    const found = await mesher.inspectSurface(open);
    expect(found).toMatchObject({ isFillable: false, isClosed: false, openEdges: 3 });
    expect(found.diagnostics.map(({ code }) => code)).toEqual(["open-edge", "open-edge", "open-edge"]);
    expect(found.diagnostics.every(({ position }) => position?.length === 3)).toBe(true);
    const { report } = await mesher.fillSurface(open);
    expect(report.diagnostics).toEqual(found.diagnostics);
  });

  test("identifies refined or repaired triangles by their original indices", async () => {
    const open = without(boxSurface(1), 7);
    const refinement = await mesher.refineSurface(open, { size: 0.2 });
    const count = refinement.origin.length;
    expect(count).toBeGreaterThan(100);
    const { diagnostics } = await mesher.inspectSurface(refinement.mesh);
    const named = diagnostics.flatMap(({ entities }) => entities.filter(({ kind }) => kind === "triangle"));
    expect(named.length).toBeGreaterThan(3);
    const around = (await mesher.inspectSurface(open)).diagnostics.flatMap(({ entities }) =>
      entities.filter(({ kind }) => kind === "triangle").map(({ index }) => index),
    );
    expect(new Set(named.map(({ index }) => index))).toEqual(new Set(around));
    for (const { index, label } of named) expect(label).toBe(`triangle ${index}`);
    const { report } = await mesher.fillSurface(refinement.mesh);
    expect(report.diagnostics).toEqual(diagnostics);
    // After a repair before the refinement, and with a triangle that no given surface contains.
    const file = { ...open, trianglePatch: new Uint32Array(11), patches: [{ name: "skin", tag: 1 }] };
    const repaired = (await mesher.repairSurface(file, { fillHoles: 3 })).mesh;
    const again = (await mesher.refineSurface(repaired, { size: 0.5 })).mesh;
    expect(new Set(again.origin)).toEqual(new Set([...file.trianglePatch.keys(), NO_ORIGIN]));
  });

  test("reports coordinates that are not finite", async () => {
    const points = box.points.slice();
    points[4] = NaN;
    const found = await mesher.inspectSurface({ ...box, points });
    expect(found).toMatchObject({ isFillable: false, box: null });
    expect(found.diagnostics[0]?.code).toBe("not-finite");
  });

  test("runs in parallel with a run and reports progress", async () => {
    const run = mesher.fillSurface(sphereSurface(20));
    const fractions: number[] = [];
    const inspecting = mesher.inspectSurface(
      sphereSurface(60),
      {},
      {
        onProgress: ({ fraction }) => fractions.push(fraction),
      },
    );
    const [found, { report }] = await Promise.all([inspecting, run]);
    expect(found.isFillable).toBe(true);
    expect(report.status).toBe("done");
    expect(fractions.at(-1)).toBe(1);
  });
});

test("a surface is closed if it has edges and no diagnostic reports an open edge", async () => {
  const random = randomSource(5);
  const below = (limit: number) => random() % limit;
  const found = { closed: 0, open: 0 };
  for (let i = 0; i < 300; i++) {
    const triangles = Array.from({ length: 12 }, (_, t) => [
      ...boxSurface(1).triangles.slice(3 * t, 3 * t + 3),
    ]);
    for (let k = below(3); k >= 0; k--) {
      const t = below(triangles.length);
      const [a = 0, b = 0, c = 0] = triangles[t] ?? [];
      if (k === 0 && i % 3 === 0) triangles.splice(t, 1);
      else if (i % 3 === 1) triangles.push(below(2) === 0 ? [a, b, c] : [c, b, a]);
      else triangles[t] = below(2) === 0 ? [b, a, c] : [a, a, below(8)];
    }
    const given = i === 0 ? triangles.map(([a = 0]) => [a, a, a]) : triangles;
    const surface = { points: boxSurface(1).points, triangles: Uint32Array.from(given.flat()) };
    const { isClosed, edges, diagnostics } = await mesher.inspectSurface(surface);
    expect(isClosed).toBe(edges > 0 && diagnostics.every(({ code }) => code !== "open-edge"));
    if (isClosed) expect(diagnostics.map(({ message }) => message).join("\n")).not.toMatch(/not closed/i);
    found[isClosed ? "closed" : "open"]++;
  }
  expect(found.closed).toBeGreaterThan(20);
  expect(found.open).toBeGreaterThan(20);
});

test("the remedy for flipped triangles between two regions is to mesh inner shells as regions", async () => {
  const inside = boxSurface(1, [0.25, 0.25, 0.25], [0.5, 0.5, 0.5]);
  const triangles = inside.triangles.slice();
  triangles.set([inside.triangles[1] ?? 0, inside.triangles[0] ?? 0], 0);
  const nested = joined(box, { points: inside.points, triangles });
  const { diagnostics } = await mesher.inspectSurface(nested, { innerShells: "cavities" });
  expect(new Set(diagnostics.map(({ code }) => code))).toEqual(new Set(["flipped-triangle"]));
  for (const { remedy } of diagnostics) expect(remedy).toMatch(/innerShells: "regions"/);
  expect((await mesher.inspectSurface(nested, { innerShells: "regions" })).isFillable).toBe(true);
});

describe("a repair", () => {
  test("changes neither a valid surface nor the caller's arrays", async () => {
    const given = turned(box);
    const copy = { points: given.points.slice(), triangles: given.triangles.slice() };
    const { changes, mesh: surface } = await mesher.repairSurface(given, { orient: false });
    expect(changes).toEqual([]);
    expect(surface).toMatchObject(copy);
    expect(given).toEqual(copy);
  });

  test("flips triangles and lists each one, while other calls only report them", async () => {
    const wrong = [3, 7, 8];
    const triangles = box.triangles.slice();
    for (const t of wrong) triangles.set([box.triangles[3 * t + 1] ?? 0, box.triangles[3 * t] ?? 0], 3 * t);
    const given = { points: box.points, triangles };
    const codes = (found: readonly Diagnostic[]) =>
      found.map(({ code, entities }) => [code, entities[0]?.index]);
    const errors = wrong.map((t) => ["flipped-triangle", t]);
    const { report } = await mesher.fillSurface(given);
    expect([report.status, codes(report.diagnostics)]).toEqual(["invalid-input", errors]);
    expect(report.diagnostics[0]?.remedy).toMatch(/`repairSurface\(\)`/);
    const found = await mesher.inspectSurface(given);
    expect(found).toMatchObject({ isFillable: false, isClosed: true, isManifold: true, flippedTriangles: 3 });
    expect(codes(found.diagnostics)).toEqual(errors);
    const { mesh: surface, changes } = await mesher.repairSurface(given);
    expect(changes.map((change) => (change.kind === "flipped-triangle" ? change.triangle : -1))).toEqual(
      wrong,
    );
    expect((await mesher.fillSurface(surface)).report).toMatchObject({ status: "done", diagnostics: [] });
  });

  test("orients inner shells for the given interpretation", async () => {
    const inside = sphereSurface(2, 0.2, [0.5, 0.5, 0.5]);
    const given = joined(boxSurface(2), inside);
    expect((await mesher.repairSurface(given, { innerShells: "regions" })).changes).toEqual([]);
    // By its orientation, the inner shell is a body.
    expect((await mesher.repairSurface(given)).changes).toEqual([]);
    const { changes } = await mesher.repairSurface(given, { innerShells: "cavities" });
    expect(changes.map(({ kind }) => kind)).toEqual(
      Array.from({ length: inside.triangles.length / 3 }, () => "flipped-triangle"),
    );
  });

  test("lists welded nodes, removed triangles and filled holes", async () => {
    const corners = [...box.triangles].map((node) => [...box.points.subarray(3 * node, 3 * node + 3)]);
    const soup = { points: Float64Array.from(corners.flat()), triangles: box.triangles.map((_, h) => h) };
    const broken = without(soup, 3);
    const last = broken.triangles.slice(-3);
    const given = { points: broken.points, triangles: Uint32Array.of(...broken.triangles, ...last, 0, 0, 1) };
    const { mesh: surface, changes, origin } = await mesher.repairSurface(given, { fillHoles: 3 });
    expect(new Set(changes.map(({ kind }) => kind))).toEqual(
      new Set(["welded-node", "removed-triangle", "removed-duplicate", "filled-hole"]),
    );
    expect(changes.every(({ position }) => position.every(Number.isFinite))).toBe(true);
    expect(origin.filter((triangle) => triangle === NO_ORIGIN)).toHaveLength(1);
    const found = await mesher.inspectSurface(surface);
    expect(found.isFillable).toBe(true);
    expect(found.volume).toBeCloseTo(6, 12);
    expect(found.nodes).toBe(box.points.length / 3);
  });

  test("keeps the original node indices", async () => {
    // Two unused nodes come first, and the first corner of one triangle is a node of its own.
    const count = box.points.length / 3 + 2;
    const first = [...box.points.subarray(3 * (box.triangles[0] ?? 0)).slice(0, 3)];
    const points = Float64Array.of(9, 9, 9, 8, 8, 8, ...box.points, ...first);
    const triangles = box.triangles.map((node, h) => (h === 0 ? count : node + 2));
    const given = { points, triangles, trianglePatch: new Uint32Array(triangles.length / 3), patches: [] };
    const exactly = { weld: false, resolveIntersections: false } as const;
    const { mesh: repaired } = await mesher.repairSurface(given, exactly);
    const positionOf = (all: Float64Array, node: number) => [...all.subarray(3 * node, 3 * node + 3)];
    const { nodeOrigin = new Uint32Array() } = repaired;
    expect(nodeOrigin).toHaveLength(repaired.points.length / 3);
    nodeOrigin.forEach((from, node) =>
      expect(positionOf(repaired.points, node)).toEqual(positionOf(points, from)),
    );
    const { diagnostics } = await mesher.inspectSurface(repaired);
    const nodes = diagnostics
      .filter(({ code }) => code === "coincident-nodes")
      .flatMap(({ entities }) => entities.map(({ label }) => label));
    expect(nodes.sort()).toEqual(
      [`surface node ${count}`, `surface node ${(box.triangles[0] ?? 0) + 2}`].sort(),
    );

    const welded = (await mesher.repairSurface(repaired)).mesh;
    const { nodeOrigin: chained = new Uint32Array() } = welded;
    expect(chained).toHaveLength(box.points.length / 3);
    chained.forEach((from, node) =>
      expect(positionOf(welded.points, node)).toEqual(positionOf(points, from)),
    );
  });

  test.each([
    { weld: -1 },
    { enclosed: "holes" as "cavities" },
    { weld: NaN },
    { fillHoles: 1.5 },
    { fillHoles: 201 },
    { orient: "yes" as unknown as boolean },
  ])("rejects %j", async (options) => {
    await expect(mesher.repairSurface(box, options)).rejects.toMatchObject({
      code: "invalid-input",
      data: { diagnostics: [{ code: "invalid-option" }] },
    });
  });
});

describe("the refinement of a surface", () => {
  const plain = boxSurface(1, [0, 0, 0], [1, 1, 1]);

  test("prepares a box of twelve triangles for a small size, and the warning disappears", async () => {
    const options = { size: 0.15 };
    const before = await mesher.fillSurface(plain, options);
    expect(before.report.tetrahedra).toBeLessThan(50);
    expect(before.report.diagnostics).toMatchObject([
      { code: "coarse-surface", severity: "warning", entities: [{ kind: "triangle" }] },
    ]);
    expect(before.report.quality.edges.mean).toBeGreaterThan(5);
    const { mesh: surface, origin, splitEdges } = await mesher.refineSurface(plain, options);
    expect(surface.points).toHaveLength(plain.points.length + 3 * splitEdges);
    expect(origin).toHaveLength(surface.triangles.length / 3);
    const { nodeOrigin = new Uint32Array() } = surface;
    expect([...nodeOrigin.filter((from) => from !== NO_ORIGIN)]).toEqual([
      ...plain.points.filter((_, i) => i % 3 === 0).keys(),
    ]);
    expect(nodeOrigin.filter((from) => from === NO_ORIGIN)).toHaveLength(splitEdges);
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, volume: 1, regions: 1 });
    expect(found.area).toBeCloseTo(6, 12);
    const { report } = await mesher.fillSurface(surface, options);
    expect(report.diagnostics).toEqual([]);
    expect(report.dihedral.min).toBeGreaterThan(30);
    expect(report.dihedral.max).toBeLessThan(135);
    expect(Math.abs(report.quality.edges.mean - 1)).toBeLessThan(0.12);
  });

  test("without sizes keeps triangles of one size; too small sizes are rejected", async () => {
    expect((await mesher.refineSurface(plain)).splitEdges).toBe(0);
    for (const [options, code] of [
      [{ size: -1 }, "invalid-option"],
      [{ size: 1e-6 }, "too-many-elements"],
    ] as const) {
      await expect(mesher.refineSurface(plain, options)).rejects.toMatchObject({
        code: "invalid-input",
        data: { diagnostics: [{ code }] },
      });
    }
  });

  test("can be cancelled", async () => {
    const control = new AbortController();
    const refining = mesher.refineSurface(plain, { size: 0.002 }, { signal: control.signal });
    setTimeout(() => control.abort(), 50);
    await expect(refining).rejects.toMatchObject({ code: "cancelled" });
  });
});

describe("the inspection of a mesh", () => {
  test("agrees with the report of the run", async () => {
    const { mesh, report } = await mesher.fillSurface(box, { size: 0.5 });
    const found = await mesher.inspectMesh(mesh);
    expect(found.isValid).toBe(true);
    expect(found.dihedral).toEqual(report.dihedral);
    expect(found.tetrahedra).toBe(report.tetrahedra);
    expect(found.boundary.triangles).toHaveLength(mesh.triangles.length);
    expect(found.quality.worst[0]?.tetrahedron).toBe(report.quality.worst[0]?.tetrahedron);
  });

  test("rejects invalid arrays", async () => {
    const { mesh } = await mesher.fillSurface(box);
    const tetrahedronRegion = mesh.tetrahedronRegion.slice(1);
    await expect(mesher.inspectMesh({ ...mesh, tetrahedronRegion })).rejects.toMatchObject({
      code: "invalid-input",
    });
  });
});

describe("aborting", () => {
  test.each<[string, (signal: AbortSignal) => Promise<unknown>]>([
    ["an inspection", (signal) => mesher.inspectSurface(sphereSurface(80), {}, { signal })],
    ["a repair", (signal) => mesher.repairSurface(sphereSurface(40), {}, { signal })],
  ])("%s rejects the call and leaves the mesher usable", async (_, call) => {
    const stop = new AbortController();
    const answer = call(stop.signal);
    stop.abort();
    await expect(answer).rejects.toBeInstanceOf(MesherError);
    await expect(answer).rejects.toMatchObject({ code: "cancelled" });
    await expect(call(AbortSignal.abort())).rejects.toMatchObject({ code: "cancelled" });
    const { report } = await mesher.fillSurface(box);
    expect(report.status).toBe("done");
  });
});

describe("a size that requires too many elements", () => {
  test("is rejected before the start with a size that fits, and the mesher stays usable", async () => {
    const fine = boxSurface(12, [0, 0, 0], [1, 1, 1]);
    const { report } = await mesher.fillSurface(fine, { size: 1e-4 });
    expect(report.status).toBe("invalid-input");
    const found = report.diagnostics.at(-1);
    if (found?.code !== "too-many-elements") throw new Error(`unexpected code ${found?.code}`);
    const factor = Number(/at least ([\d.]+) times as large/.exec(found.remedy)?.[1]);
    const { expected, limit } = found.data;
    expect(expected / factor ** 3).toBeLessThanOrEqual(limit);
    expect(expected / (factor - 0.2) ** 3).toBeGreaterThan(limit);
    expect((await mesher.fillSurface(box)).report.status).toBe("done");
  });
});

/** Returns tetrahedra that do not touch, 100 in a row. */
function rowsOfTetrahedra(count: number) {
  const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const points = Array.from({ length: count }, (_, t) => {
    const origin = [2 * (t % 100), 2 * Math.floor(t / 100), 0];
    return corners.map((value, i) => value + (origin[i % 3] ?? 0));
  });
  return {
    points: Float64Array.from(points.flat()),
    tetrahedra: Uint32Array.from({ length: 4 * count }, (_, i) => i),
  };
}

test("repairSurface and inspectMesh report progress while a run beside them continues", async () => {
  const stop = new AbortController();
  let reports = 0;
  const run = mesher.fillSurface(
    sphereSurface(30),
    { size: 0.03, interior: "front" },
    { signal: stop.signal, onProgress: () => reports++ },
  );
  try {
    const fractions: number[] = [];
    const onProgress = ({ fraction }: { readonly fraction: number }) => fractions.push(fraction);
    const given = sphereSurface(40);
    const { mesh: surface } = await mesher.repairSurface(given, { weld: 1e-9 }, { onProgress });
    expect(surface.triangles.length).toBe(given.triangles.length);
    expect(fractions.at(-1)).toBe(1);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    const reportsOfRepair = fractions.length;
    const found = await mesher.inspectMesh(rowsOfTetrahedra(50_000), { onProgress });
    expect(found.tetrahedra).toBe(50_000);
    expect(fractions.length).toBeGreaterThan(reportsOfRepair);
    expect(reports).toBeGreaterThan(0);
  } finally {
    // A run that goes on would hold up the tests after this one.
    stop.abort();
  }
  expect((await run).report.status).toBe("cancelled");
});

test("inverted elements are flipped when a file is read, and the inspection reports them", async () => {
  const { points, tetrahedra } = (await mesher.fillSurface(boxSurface(2), { size: 0.4 })).mesh;
  const count = tetrahedra.length / 4;
  const inverted = [3, 7, count - 1];
  const file = (isInverted: (t: number) => boolean) => {
    const rows = Array.from({ length: count }, (_, t) => {
      const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
      return `${(isInverted(t) ? [b, a, c, d] : [a, b, c, d]).map((node) => node + 1).join(" ")} 1`;
    });
    const positions = Array.from(
      { length: points.length / 3 },
      (_, n) => `${points.subarray(3 * n, 3 * n + 3).join(" ")} 0`,
    );
    const sections = [`Vertices ${positions.length}`, ...positions, `Tetrahedra ${count}`, ...rows, "End"];
    return new TextEncoder().encode(`MeshVersionFormatted 2\nDimension 3\n${sections.join("\n")}\n`);
  };
  // With a minority and with a majority of inverted elements.
  for (const isMajority of [false, true]) {
    const read = await readMesh(
      file((t) => inverted.includes(t) !== isMajority),
      { fileName: "a.mesh" },
    );
    if (!read.success) throw new Error(read.errors[0].message);
    expect([...(read.value.invertedTetrahedra ?? [])]).toEqual(inverted);
    expect([...read.value.tetrahedra.subarray(12, 16)].sort()).toEqual(
      [...tetrahedra.subarray(12, 16)].sort(),
    );
    const found = await mesher.inspectMesh({ ...read.value, regions: undefined });
    expect(found).toMatchObject({
      isValid: false,
      invertedTetrahedra: 3,
      degenerateTetrahedra: 0,
      overlappingFaces: 0,
    });
  }
  const all = await readMesh(
    file(() => true),
    { fileName: "a.mesh" },
  );
  if (!all.success) throw new Error(all.errors[0].message);
  expect(await mesher.inspectMesh({ ...all.value, regions: undefined })).toMatchObject({
    isValid: true,
    invertedTetrahedra: 0,
  });
});
