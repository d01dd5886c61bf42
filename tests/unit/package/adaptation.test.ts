/** `adaptMesh` and `tetrafront adapt`: unit edges, what is kept, errors. */
import { readFileSync } from "node:fs";

import { createMesher, type Mesh, type Mesher, readMesh, type VolumeInput, writeMesh } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { defectsOf, meshVolume, NO_DEFECTS } from "../../support/check-mesh.js";
import { pinSolid, stepFile } from "../../support/step-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

let mesher: Mesher;
let box: Mesh;
beforeAll(async () => {
  mesher = await createMesher();
  box = (await mesher.fillSurface(boxSurface(4), { optimization: "fast" })).mesh;
});
afterAll(() => mesher.dispose());

const { save, run, inFolder } = temporaryFolder();

/** The mesh with sizes that are thin along x near the middle. */
function withLayer(mesh: Mesh): Mesh {
  const count = mesh.points.length / 3;
  const xs = Array.from({ length: count }, (_, node) => mesh.points[3 * node] ?? 0);
  const [low, high] = [Math.min(...xs), Math.max(...xs)];
  const extent = high - low;
  const metrics = xs.flatMap((x) => {
    const across = 0.1 * extent + 0.3 * Math.abs(x - (low + high) / 2);
    const along = (0.25 * extent) ** -2;
    return [across ** -2, 0, 0, along, 0, along];
  });
  return { ...mesh, nodeData: new Map([["metric", { components: 6, values: Float64Array.from(metrics) }]]) };
}

const nameOfPatch = ({ patches }: VolumeInput) => patches?.map(({ name }) => name);

test("most edges of an adapted mesh have unit length, and its patches and volume are the given ones", async () => {
  const { mesh, after, before, isPartial } = await mesher.adaptMesh(box, withLayer(box));
  expect(isPartial).toBe(false);
  expect(after.unitEdges).toBeGreaterThan(Math.max(0.97, before.unitEdges));
  expect(after.leastQuality).toBeGreaterThan(0.3);
  expect(nameOfPatch(mesh)).toEqual(nameOfPatch(box));
  const { points, triangles } = mesh;
  expect(defectsOf(mesh, { points, triangles })).toEqual(NO_DEFECTS);
  expect(meshVolume(mesh)).toBeCloseTo(1, 9);
  expect(mesh.nodeData.get("metric")?.values).toHaveLength(2 * mesh.points.length);
});

test("sizes with two stretchings are a metric", async () => {
  const count = box.points.length / 3;
  const sizes = { components: 1, values: new Float64Array(count).fill(0.3) };
  const stretching = { components: 1, values: new Float64Array(count).fill(2) };
  const direction = {
    components: 3,
    values: Float64Array.from({ length: 3 * count }, (_, i) => (i % 3 === 2 ? 5 : 0)),
  };
  const nodeData = new Map([
    ["size", sizes],
    ["stretching", stretching],
    ["direction", direction],
    ["secondStretching", { components: 1, values: new Float64Array(count).fill(3) }],
    [
      "secondDirection",
      { components: 3, values: Float64Array.from({ length: 3 * count }, (_, i) => Number(i % 3 === 0)) },
    ],
  ]);
  const { mesh } = await mesher.adaptMesh(box, { ...box, nodeData });
  const [xx, xy, , yy, , zz] = mesh.nodeData.get("metric")?.values ?? [];
  expect(xx).toBeCloseTo(0.9 ** -2, 9);
  expect(yy).toBeCloseTo(0.3 ** -2, 9);
  expect(zz).toBeCloseTo(0.6 ** -2, 9);
  expect(xy).toBeCloseTo(0, 9);
});

test("a metric that is not positive is refused with its node", async () => {
  const background = withLayer(box);
  background.nodeData.get("metric")?.values.set([-1], 6 * 4);
  await expect(mesher.adaptMesh(box, background)).rejects.toThrow(/metric at node 4/);
});

test("a background without sizes is refused", async () => {
  await expect(mesher.adaptMesh(box, { ...box, nodeData: new Map() })).rejects.toThrow(
    /no metric and no sizes/,
  );
});

test("the command adapts a volume mesh, and meshes a surface first", async () => {
  const [background] = await writeMesh(withLayer(box), "background.vtu");
  save("background.vtu", background?.bytes ?? "");
  const noTetrahedra = { tetrahedra: new Uint32Array(), tetrahedronRegion: new Uint32Array() };
  const [given] = await writeMesh({ ...box, ...noTetrahedra }, "box.off");
  save("box.off", given?.bytes ?? "");
  for (const model of ["background.vtu", "box.off"]) {
    const { code, stderr } = await run("adapt", model, "--background", "background.vtu", "-o", "adapted.vtu");
    expect(stderr).toMatch(/adapted: .*unit edges/);
    expect(code).toBe(0);
    const read = await readMesh(readFileSync(inFolder("adapted.vtu")), { fileName: "adapted.vtu" });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(meshVolume(read.value)).toBeCloseTo(1, 6);
  }
});

test.each([
  ["as it is", [], 1],
  ["in metres", ["--units", "m"], 0.001],
  ["scaled", ["--scale", "3"], 3],
])("nodes on the boundary of a CAD file that is adapted %s are on its faces", async (_, units, scale) => {
  const [radius, height, size] = [5 * scale, 4 * scale, 1.2 * scale];
  save("pin.step", stepFile([pinSolid("pin", [0, 0, 0], 5, 4)]));
  const values = new Float64Array(box.points.length / 3).fill(size);
  const background: Mesh = {
    ...box,
    points: box.points.map((x) => 14 * scale * (x - 0.5)),
    nodeData: new Map([["size", { components: 1, values }]]),
  };
  const [file] = await writeMesh(background, "sizes.vtu");
  save("sizes.vtu", file?.bytes ?? "");
  const pin = await run("adapt", "pin.step", "--background", "sizes.vtu", "-o", "pin.vtu", ...units);
  expect(`${pin.code} ${pin.stderr}`).toMatch(/^0 .*adapted: /s);
  const read = await readMesh(readFileSync(inFolder("pin.vtu")), { fileName: "pin.vtu" });
  if (!read.success) throw new Error(read.errors[0].message);
  const { points, triangles, nodeData } = read.value;
  const off = [...new Set(triangles)].map((node) => {
    const [x = 0, y = 0, z = 0] = points.subarray(3 * node, 3 * node + 3);
    return Math.min(Math.abs(z), Math.abs(z - height), Math.abs(Math.hypot(x, y) - radius));
  });
  expect(off.length).toBeGreaterThan(50);
  expect(Math.max(...off)).toBeLessThan(1e-9 * radius);
  // Chords of length s cut off about (s / r)^2 / 6 of a disc.
  const share = meshVolume(read.value) / (Math.PI * radius ** 2 * height);
  expect(share).toBeLessThan(1);
  expect(share).toBeGreaterThan(1 - (size / radius) ** 2 / 4);
  const metrics = nodeData.get("metric")?.values ?? [];
  expect(metrics).toHaveLength(2 * points.length);
  expect((metrics[0] ?? 0) * size ** 2).toBeCloseTo(1, 6);
});
