/** `addLayers` and `tetrafront adapt --layers`: heights, what is kept, errors. */
import { existsSync, readFileSync } from "node:fs";

import { createMesher, type Mesh, type Mesher, type PatchLayers, readMesh, writeMesh } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { defectsOf, meshVolume, NO_DEFECTS } from "../../support/check-mesh.js";
import { pinSolid, stepFile } from "../../support/step-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const WALL = "wall: cold";
const REST = "rest";

let mesher: Mesher;
let box: Mesh;
beforeAll(async () => {
  mesher = await createMesher();
  const { mesh } = await mesher.fillSurface(boxSurface(3), { optimization: "fast" });
  const { points, triangles } = mesh;
  const isOnFloor = (t: number) => [0, 1, 2].every((k) => points[3 * (triangles[3 * t + k] ?? 0) + 2] === 0);
  const trianglePatch = Uint32Array.from({ length: triangles.length / 3 }, (_, t) => (isOnFloor(t) ? 0 : 1));
  box = {
    ...mesh,
    trianglePatch,
    patches: [
      { name: WALL, tag: 1 },
      { name: REST, tag: 2 },
    ],
  };
});
afterAll(() => mesher.dispose());

const { save, run, inFolder } = temporaryFolder();

const LAYERS: PatchLayers = { patch: WALL, firstHeight: 0.01, growth: 1.5, count: 4 };

/** Heights of the lowest nodes above the floor, ascending. */
function lowestHeights({ points }: Mesh): number[] {
  const heights = points.filter((_, i) => i % 3 === 2).filter((z) => z > 0);
  return [...heights].sort((a, b) => a - b);
}

test("layers are as high as asked for, and the body is the given one", async () => {
  const made = await mesher.addLayers(box, [LAYERS]);
  const { mesh, after, layers, cycles, isPartial } = made;
  expect(isPartial).toBe(false);
  expect(after.unitEdges).toBeGreaterThan(0.97);
  expect(after.leastQuality).toBeGreaterThan(0.3);
  expect(made.largestAspect).toBeGreaterThan(10);
  expect(cycles).toBeGreaterThan(1);
  expect(layers).toHaveLength(1);
  const [own] = layers;
  expect(own?.patch).toBe(WALL);
  expect(own?.triangles).toBe(mesh.trianglePatch.filter((patch) => patch === 0).length);
  expect(own?.meanFirstHeight).toBeGreaterThan(0.0075);
  expect(own?.meanFirstHeight).toBeLessThan(0.0125);
  expect(own?.thickness).toBeCloseTo(0.01 * (1 + 1.5 + 1.5 ** 2 + 1.5 ** 3), 9);
  const [lowest = 0] = lowestHeights(mesh);
  expect(lowest).toBeGreaterThan(0.004);
  expect(lowest).toBeLessThan(0.013);
  const { points, triangles } = mesh;
  expect(defectsOf(mesh, { points, triangles })).toEqual(NO_DEFECTS);
  expect(meshVolume(mesh)).toBeCloseTo(1, 9);
  expect(mesh.patches.map(({ name }) => name)).toEqual([WALL, REST]);
});

test("sizes along the patch are those of a background", async () => {
  const size = { components: 1, values: new Float64Array(box.points.length / 3).fill(0.15) };
  const background = { ...box, nodeData: new Map([["size", size]]) };
  const { mesh } = await mesher.addLayers(box, [LAYERS], { background, cycles: 3 });
  // A regular triangle with edges of 0.15 has an area of 0.01.
  const triangles = mesh.trianglePatch.filter((patch) => patch === 0).length;
  expect(triangles).toBeGreaterThan(70);
  expect(triangles).toBeLessThan(200);
});

test("cycles with a solver keep the layers of every mesh, and follow the solution beyond them", async () => {
  // Bends across x = 0.5, away from the wall.
  const solve = ({ points }: Mesh) => {
    const values = points.filter((_, i) => i % 3 === 0).map((x) => Math.tanh(12 * (x - 0.5)));
    return [{ name: "u", components: 1, values }];
  };
  const nearBends: number[] = [];
  const counts: number[] = [];
  const options = { layers: [LAYERS], cycles: 3, elements: 1500, sweeps: 4 };
  for await (const { next } of mesher.adapt(box, solve, options)) {
    const { mesh, after } = next;
    if (!("layers" in next)) throw new Error("no layers");
    expect(next.layers[0]?.meanFirstHeight).toBeGreaterThan(0.0075);
    expect(next.layers[0]?.meanFirstHeight).toBeLessThan(0.0125);
    expect(after.unitEdges).toBeGreaterThan(0.95);
    const { points, triangles } = mesh;
    expect(defectsOf(mesh, { points, triangles })).toEqual(NO_DEFECTS);
    expect(meshVolume(mesh)).toBeCloseTo(1, 9);
    expect(mesh.nodeData.get("u")?.values).toHaveLength(points.length / 3);
    const above = [...points.keys()].filter((i) => i % 3 === 0 && (points[i + 2] ?? 0) > 0.3);
    const near = above.filter((i) => Math.abs((points[i] ?? 0) - 0.5) < 0.2);
    nearBends.push(near.length / above.length);
    counts.push(after.tetrahedra);
  }
  // Of evenly distributed nodes, it would be 0.4. The layers count as elements of the whole.
  expect(nearBends.at(-1)).toBeGreaterThan(0.5);
  expect(Math.abs((counts.at(-1) ?? 0) / 1500 - 1), counts.join()).toBeLessThan(0.2);
});

test.each([
  [{ patch: "roof" }, /no patch roof/],
  [{ firstHeight: 0 }, /first height of the layers of wall: cold is 0/],
  [{ growth: 0.5 }, /growth of the layers of wall: cold is 0\.5/],
  [{ count: 0 }, /number of the layers of wall: cold is 0/],
])("layers with %o are refused", async (change, message) => {
  await expect(mesher.addLayers(box, [{ ...LAYERS, ...change }])).rejects.toThrow(message);
});

test.each([
  [[{ ...LAYERS, firstHeight: 0 }], /first height of the layers of wall: cold is 0/],
  [[{ ...LAYERS, patch: "roof" }], /no patch roof/],
  [[LAYERS, LAYERS], /twice/],
])("layers of cycles are checked before the solver runs (%#)", async (layers, message) => {
  const solve = () => Promise.reject(new Error("it ran"));
  const cycles = mesher.adapt(box, solve, { layers, elements: 100 });
  await expect(cycles.next()).rejects.toThrow(message);
});

test.each([
  [[], 1],
  [["--units", "m"], 0.001],
  [["--scale", "3"], 3],
])("layers have the lengths of a CAD file that is read with %j", async (units, scale) => {
  save("pin.step", stepFile([pinSolid("pin", [0, 0, 0], 5, 4)]));
  const layers = ["--layers", `*:${0.1 * scale}:1.5:3`];
  const made = await run(
    "adapt",
    "pin.step",
    ...layers,
    ...units,
    "--cycles",
    "3",
    "-o",
    "pin.vtu",
    "--json",
  );
  expect(`${made.code} ${made.stderr}`).toMatch(/^0/);
  const report = JSON.parse(made.stdout) as { layers: { meanFirstHeight: number; thickness: number }[] };
  for (const { meanFirstHeight, thickness } of report.layers) {
    expect(meanFirstHeight / scale).toBeGreaterThan(0.06);
    expect(meanFirstHeight / scale).toBeLessThan(0.14);
    expect(thickness / scale).toBeCloseTo(0.1 + 0.15 + 0.225, 9);
  }
});

test("layers that come twice for a patch are refused", async () => {
  await expect(mesher.addLayers(box, [LAYERS, LAYERS])).rejects.toThrow(/twice/);
});

test("the command makes layers along the patches that it names, or all", async () => {
  const [file] = await writeMesh(box, "box.vtu");
  save("box.vtu", file?.bytes ?? "");
  const layers = ["--layers", `${WALL}:0.02:1.5:3`, "--layers", "*:0.05:1.5:2"];
  const { code, stdout, stderr } = await run("adapt", "box.vtu", ...layers, "-o", "made.vtu", "--json");
  expect(stderr).toBe("");
  expect(code).toBe(0);
  const report = JSON.parse(stdout) as { layers: { patch: string; thickness: number }[] };
  expect(report.layers.map(({ patch }) => patch)).toEqual([WALL, REST]);
  expect(report.layers[1]?.thickness).toBeCloseTo(0.125, 9);
  const read = await readMesh(readFileSync(inFolder("made.vtu")), { fileName: "made.vtu" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(meshVolume(read.value)).toBeCloseTo(1, 6);
  expect(lowestHeights(read.value)[0]).toBeLessThan(0.026);
});

test("the command names what is wrong with layers", async () => {
  const [file] = await writeMesh(box, "box.vtu");
  save("box.vtu", file?.bytes ?? "");
  const wrong = [
    ["roof:0.1:1.2:3", /no patch roof.*rest, wall: cold, or \*/s],
    ["wall", /PATCH:FIRST:GROWTH:COUNT/],
    ["rest:0.1:x:3", /growth of the layers of rest is "x", not a number/],
    ["rest:-0.1:1.2:3", /first height of the layers of rest is -0\.1/],
  ] as const;
  for (const [text, message] of wrong) {
    const { code, stderr } = await run("adapt", "box.vtu", "--layers", text, "-o", "made.vtu");
    expect(stderr).toMatch(message);
    expect(code).toBe(2);
  }
  const withSolver = ["--solver", "x", "--elements", "100"];
  const both = await run("adapt", "box.vtu", "--layers", "roof:0.1:1.2:3", ...withSolver, "-o", "made.vtu");
  expect(both.stderr).toMatch(/no patch roof/);
  expect(both.code).toBe(2);
  // No folder is left that would refuse the corrected command.
  expect(existsSync(inFolder("made-cycles"))).toBe(false);
});
