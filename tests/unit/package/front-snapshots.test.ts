/** Snapshots of the front during a run. */
import { createMesher, type Mesher, type MeshResult, type RunControl, type Mesh } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { boxSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** About 150 000 elements: advancing the front takes several times the delay of the first snapshot. */
const fill = (control: RunControl = {}): Promise<MeshResult> =>
  mesher.fillSurface(boxSurface(32), { optimization: "none" }, control);

test("onFront receives the advancing front, and the mesh stays the same", async () => {
  const fronts: Float64Array[] = [];
  const observed = await fill({ onFront: (corners) => void fronts.push(corners) });
  const unobserved = await fill();
  expect(observed.report.status).toBe("done");
  expect(observed.report.fingerprint).toBe(unobserved.report.fingerprint);
  expect(fronts.length).toBeGreaterThan(0);
  for (const corners of fronts) {
    expect(corners.length % 9).toBe(0);
    expect(corners.length).toBeGreaterThan(0);
    expect(corners.every((x) => x >= 0 && x <= 1)).toBe(true);
  }
  // At most four snapshots per second, the first after 0.25 s.
  expect(fronts.length).toBeLessThanOrEqual(4 * observed.report.seconds.total);
});

test("a run rejects with the error that onFront throws", async () => {
  const failure = new Error("mine");
  const onFront = (): void => {
    throw failure;
  };
  await expect(fill({ onFront })).rejects.toBe(failure);
});

/**
 * About 150 000 elements without a lattice, optimized by one worker: on every machine that takes several times the
 * delay of the snapshot.
 */
const slowToOptimize = { interior: "front", threads: 1 } as const;
const optimizedEdges = 32;

test("onUnoptimized receives the complete mesh once, and the result stays the same", async () => {
  const surface = boxSurface(optimizedEdges);
  const meshes: Mesh[] = [];
  const phases: string[] = [];
  const observed = await mesher.fillSurface(surface, slowToOptimize, {
    onUnoptimized: (mesh) => {
      meshes.push(mesh);
      phases.push("unoptimized");
    },
    onProgress: ({ phase }) => void phases.push(phase),
  });
  expect(meshes).toHaveLength(1);
  expect(["optimize", "verify"]).toContain(phases[phases.indexOf("unoptimized") - 1]);
  const unobserved = await mesher.fillSurface(surface, slowToOptimize);
  expect(observed.report.fingerprint).toBe(unobserved.report.fingerprint);
  const { volume } = await mesher.inspectMesh(meshes[0] ?? observed.mesh);
  expect(volume).toBeCloseTo(observed.report.volume, 9);
  expect(meshes[0]?.triangles).toEqual(observed.mesh.triangles);
});

test("a run rejects with the error that onUnoptimized throws", async () => {
  const failure = new Error("mine");
  const onUnoptimized = (): void => {
    throw failure;
  };
  await expect(
    mesher.fillSurface(boxSurface(optimizedEdges), slowToOptimize, { onUnoptimized }),
  ).rejects.toBe(failure);
});

test("onFront must be a function", async () => {
  const { report } = await fill({ onFront: 5 as unknown as () => void });
  expect(report.status).toBe("invalid-input");
  expect(report.diagnostics[0]?.remedy).toContain("onFront");
});
