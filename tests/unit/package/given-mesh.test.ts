/** Meshes from files and improved meshes in the form of results: boundary, interfaces, patches, statistics. */
import { createMesher, NO_REGION, type Mesh, type Mesher } from "tetrafront";
import { improvedResult, inspectedResult, isInterface, meshWithBoundary } from "tetrafront/internal";
import { afterAll, beforeAll, expect, test } from "vitest";

import { sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const group = (name: string, tag: number) => ({ name, tag });

/** Two tetrahedra on the triangle 0 1 2, in one region each; the file lists one outer face and one free triangle. */
const pair: Mesh = {
  points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 9, 9, 9),
  triangles: Uint32Array.of(0, 1, 3, 0, 1, 5),
  trianglePatch: Uint32Array.of(1, 0),
  patches: [group("unused", 4), group("side", 5)],
  tetrahedra: Uint32Array.of(0, 1, 2, 3, 0, 2, 1, 4),
  tetrahedronRegion: Uint32Array.of(0, 1),
  regions: [group("upper", 1), group("lower", 2)],
  nodeData: new Map(),
};

test("the boundary has every outer face and interface once, outward, in the patches of the file", async () => {
  const { mesh, patchShapes, outer } = await meshWithBoundary(pair);
  expect(mesh.patches.map(({ name }) => name)).toEqual(["side", "boundary", "interface"]);
  expect(mesh.triangles).toHaveLength(3 * 7);
  const names = [...mesh.trianglePatch].map((patch) => mesh.patches[patch]?.name);
  expect(names.toSorted()).toEqual([...Array<string>(5).fill("boundary"), "interface", "side"]);
  names.forEach((name, t) => {
    expect(isInterface(mesh, t)).toBe(name === "interface");
    const sides = [...(mesh.triangleRegions ?? []).slice(2 * t, 2 * t + 2)];
    if (name === "interface") expect(sides.toSorted()).toEqual([0, 1]);
    else expect(sides[1]).toBe(NO_REGION);
  });
  expect(mesh.tetrahedra).toBe(pair.tetrahedra);
  const [side] = patchShapes;
  expect(side).toMatchObject({ patch: 0, triangles: 1, minAngle: expect.closeTo(45, 9) as number });
  expect(side?.meanRadiusRatio).toBeCloseTo(2 * (Math.SQRT2 - 1), 9);
  expect(side?.meanEdge).toBeCloseTo((2 + Math.SQRT2) / 3, 9);
  // The node that no element uses is left out.
  expect(outer.points).toHaveLength(3 * 5);
  const inspection = await mesher.inspectSurface(outer, { innerShells: "regions" });
  expect(inspection).toMatchObject({ isFillable: true, regions: 2 });
  expect(inspection.volume).toBeCloseTo(1 / 3, 12);
});

test("a file triangle inside a region stays a triangle of the mesh, but bounds no body", async () => {
  const inner = {
    ...pair,
    tetrahedronRegion: Uint32Array.of(0, 0),
    triangles: Uint32Array.of(0, 1, 2),
    trianglePatch: Uint32Array.of(0),
  };
  const { mesh, outer } = await meshWithBoundary(inner);
  expect(mesh.patches.map(({ name }) => name)).toEqual(["unused", "boundary"]);
  expect(mesh.triangles).toHaveLength(3 * 7);
  expect(outer.triangles).toHaveLength(3 * 6);
});

test("a file without tetrahedra is refused", async () => {
  const none = { ...pair, tetrahedra: new Uint32Array(), tetrahedronRegion: new Uint32Array() };
  await expect(meshWithBoundary(none)).rejects.toMatchObject({ code: "invalid-input" });
});

test("an improved result has the triangles and patches of the given one, and better elements", async () => {
  const made = await mesher.fillSurface(sphereSurface(8), { optimization: "none" });
  const opened = await meshWithBoundary(made.mesh);
  const given = inspectedResult(opened, await mesher.inspectMesh(opened.mesh));
  expect(given.report).toMatchObject({ status: "done", tetrahedra: made.report.tetrahedra });
  expect(given.report.dihedral.min).toBeCloseTo(made.report.dihedral.min, 6);

  const improvement = await mesher.improveMesh(given.mesh);
  const better = improvedResult(given, improvement, await mesher.inspectMesh(improvement.mesh));
  expect(better.report.dihedral.min).toBeGreaterThan(given.report.dihedral.min);
  expect(better.report.fingerprint).toBe("");
  const corners = ({ points, triangles }: Mesh): string[] =>
    Array.from(triangles, (node) => points.subarray(3 * node, 3 * node + 3).join(" "));
  expect(corners(better.mesh)).toEqual(corners(given.mesh));
  expect(better.mesh.trianglePatch).toEqual(given.mesh.trianglePatch);
  const { volume } = await mesher.inspectMesh(better.mesh);
  expect(volume).toBeCloseTo(given.report.volume, 9);
});
