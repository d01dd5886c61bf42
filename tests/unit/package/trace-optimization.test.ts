/** The sweeps of the optimizer in a trace: they lead from the mesh of the front to the result. */
import { createMesher, type Mesher } from "tetrafront";
import { readTrace, recordTrace, type SweptMesh } from "tetrafront/trace";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Elements } from "../../support/check-mesh.js";
import { randomSource } from "../../support/random.js";
import { galleryProject, tracedIn } from "../../support/recorded-models.js";
import { boxSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** As recorded runs: by the front alone. */
const unoptimized = { optimization: "none", interior: "front" } as const;

/** Corners of each element, as positions in an order that does not depend on numbers. */
function elementsOf({ points, tetrahedra }: Elements): readonly string[] {
  return Array.from({ length: tetrahedra.length / 4 }, (_, element) =>
    Array.from(tetrahedra.subarray(4 * element, 4 * element + 4), (node) =>
      points.subarray(3 * node, 3 * node + 3).join(" "),
    )
      .sort()
      .join(", "),
  ).sort();
}

/**
 * Returns a mesh of sweeps in the order of a result: elements and inner nodes region by region, without the nodes that no element
 * uses.
 */
function asResult({ points, tetrahedra, tetrahedronRegion }: SweptMesh, boundaryNodes: number): Elements {
  const elements = Array.from(tetrahedronRegion, (region, element) => ({ region, element })).sort(
    (a, b) => a.region - b.region || a.element - b.element,
  );
  const ordered = elements.flatMap(({ element }) => [...tetrahedra.subarray(4 * element, 4 * element + 4)]);
  const regionOf = new Map(ordered.map((node, i) => [node, elements[Math.floor(i / 4)]?.region ?? 0]));
  const inside = [...regionOf]
    .filter(([node]) => node >= boundaryNodes)
    .sort(([a, regionOfA], [b, regionOfB]) => regionOfA - regionOfB || a - b)
    .map(([node]) => node);
  const kept = [...Array(boundaryNodes).keys(), ...inside];
  const indexOf = new Map(kept.map((node, index) => [node, index]));
  return {
    points: Float64Array.from(kept.flatMap((node) => [...points.subarray(3 * node, 3 * node + 3)])),
    tetrahedra: Uint32Array.from(ordered, (node) => indexOf.get(node) ?? 0),
  };
}

function volumeOf({ points, tetrahedra }: Elements): number {
  let volume = 0;
  for (let i = 0; i < tetrahedra.length; i += 4) {
    const at = (corner: number, axis: number): number =>
      points[3 * (tetrahedra[i + corner] ?? 0) + axis] ?? 0;
    const edge = (corner: number, axis: number): number => at(corner, axis) - at(0, axis);
    for (const [x, y, z, sign] of [
      [0, 1, 2, 1],
      [1, 2, 0, 1],
      [2, 0, 1, 1],
      [0, 2, 1, -1],
      [1, 0, 2, -1],
      [2, 1, 0, -1],
    ] as const)
      volume += (sign * edge(1, x) * edge(2, y) * edge(3, z)) / 6;
  }
  return volume;
}

function meshAfter(trace: ReturnType<typeof tracedIn>, sweep: number): SweptMesh {
  const mesh = trace.optimization?.meshAfter(sweep);
  if (!mesh) throw new Error(`there is no mesh after sweep ${sweep}`);
  return mesh;
}

test.each([
  ["fast", "unit-cube"],
  ["default", "unit-cube"],
  ["thorough", "unit-cube"],
  ["default", "wing-in-a-tunnel"],
  ["thorough", "pipe-and-flow"],
] as const)("%s, %s: the sweeps lead from the mesh of the front to the result", async (optimization, id) => {
  const project = galleryProject(id);
  const front = await recordTrace(mesher, project, unoptimized);
  const { result, trace: bytes } = await recordTrace(mesher, project, { optimization });
  const { report, metricShapes } = await mesher.meshProject(project, { optimization, interior: "front" });
  expect(result.report.fingerprint).toBe(report.fingerprint);
  expect(result.recording?.fingerprint).toBe(front.result.report.fingerprint);
  // The events of the front are the same.
  const begin = front.trace ?? new Uint8Array();
  expect(bytes?.subarray(0, begin.length)).toEqual(begin);

  const trace = tracedIn(bytes);
  expect(trace.finalMesh().fingerprint).toBe(front.result.report.fingerprint);
  const { before, sweeps, result: chosen } = trace.optimization?.summary ?? {};
  if (!before || !sweeps || chosen === undefined) throw new Error("no sweep was recorded");
  expect(sweeps.length).toBeGreaterThan(3);
  expect(before.tetrahedra).toBe(front.result.report.tetrahedra);
  expect(elementsOf(meshAfter(trace, 0))).toEqual(elementsOf(front.result.mesh));

  const last = asResult(meshAfter(trace, chosen), result.surfaceNodes);
  expect(last.tetrahedra).toEqual(result.mesh.tetrahedra);
  expect(last.points).toHaveLength(result.mesh.points.length);
  const farthest = last.points.reduce(
    (most, x, i) => Math.max(most, Math.abs(x - (result.mesh.points[i] ?? 0))),
    0,
  );
  expect(farthest).toBeLessThan(1e-4);
  const measured = chosen === 0 ? before : sweeps[chosen - 1];
  expect(measured).toMatchObject({ tetrahedra: report.tetrahedra, nodes: report.nodes });
  // Without stretching, the metric is that of space.
  if (metricShapes) return;
  expect(measured?.dihedral.min).toBeCloseTo(report.dihedral.min, 3);
  expect(measured?.dihedral.max).toBeCloseTo(report.dihedral.max, 3);
  expect(measured?.meanRadiusRatio).toBeCloseTo(report.radiusRatio.mean, 6);
});

test("each sweep changes what it says, and meshes are found forwards and backwards", async () => {
  const { trace: bytes } = await recordTrace(mesher, galleryProject("unit-cube"));
  const trace = tracedIn(bytes);
  const { before, sweeps = [] } = trace.optimization?.summary ?? {};
  const meshes = [before, ...sweeps].map((measures, sweep) => {
    const mesh = meshAfter(trace, sweep);
    expect(mesh.tetrahedronRegion).toHaveLength(measures?.tetrahedra ?? 0);
    expect(volumeOf(mesh)).toBeCloseTo(1, 5);
    return mesh;
  });
  sweeps.forEach(({ kind, movedNodes, changedElements }, i) => {
    if (kind === "move" || kind === "newton") expect(changedElements).toBe(0);
    if (kind === "swap") expect(movedNodes).toBe(0);
    const [from, to] = [meshes[i], meshes[i + 1]].map((mesh) => mesh && elementsOf(mesh).join("; "));
    expect(from === to).toBe(movedNodes + changedElements === 0);
  });
  for (const sweep of [7, 2, 2, 5, 0]) expect(meshAfter(trace, sweep)).toEqual(meshes[sweep]);
  expect(trace.optimization?.meshAfter(-1)).toBeUndefined();
  expect(trace.optimization?.meshAfter(meshes.length)).toBeUndefined();
  expect(trace.summary().optimization).toEqual({ before, sweeps, result: sweeps.length });
});

test("a run without optimization has no sweeps", async () => {
  const { trace } = await recordTrace(mesher, boxSurface(3), unoptimized);
  expect(tracedIn(trace).optimization).toBeNull();
  expect(tracedIn(trace).summary().optimization).toBeNull();
});

test("a damaged sweep is refused with its byte, or harmless", async () => {
  const { trace: whole = new Uint8Array() } = await recordTrace(mesher, boxSurface(3));
  const { trace: front = new Uint8Array() } = await recordTrace(mesher, boxSurface(3), unoptimized);
  expect(whole.length).toBeGreaterThan(front.length);
  const random = randomSource(5);
  let refused = 0;
  for (let i = 0; i < 300; i++) {
    const at = front.length + (random() % (whole.length - front.length));
    const damaged = i % 2 === 0 ? whole.slice(0, at) : whole.slice();
    if (i % 2 === 1) damaged[at] = random() % 256;
    const result = readTrace(damaged);
    if (!result.success) {
      refused++;
      expect(result.errors[0].message).toMatch(/^byte \d+: /);
    } else {
      const { optimization } = result.value;
      optimization?.meshAfter(optimization.summary.sweeps.length);
    }
  }
  expect(refused).toBeGreaterThan(100);
});
