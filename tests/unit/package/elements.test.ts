/** Meshes with a wanted number of elements: `elements` of the calls, and `--elements` of the command line. */
import { readFileSync } from "node:fs";

import {
  createMesher,
  meshFile,
  type MeshReport,
  type MeshResult,
  type PreparedBody,
  readSurface,
} from "tetrafront";
import { createBody, type Project, writeProject } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";

import { expectValid } from "../../support/expect-valid.js";
import { cubeProject } from "../../support/projects.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { offFile, stlText } from "../../support/surface-files.js";
import { boxSurface, sphereSurface, torusSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();
let mesher: Awaited<ReturnType<typeof createMesher>>;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const codes = (report: MeshReport) => report.diagnostics.map(({ code }) => code);

/** Expects a mesh with the wanted number of elements within 5 %, as its report says. */
function expectReached({ status, tetrahedra, elements }: MeshReport, wanted: number): void {
  expect(status).toBe("done");
  expect(Math.abs(tetrahedra / wanted - 1), `${tetrahedra} of ${wanted}`).toBeLessThanOrEqual(0.05);
  expect(elements).toMatchObject({ asked: wanted, reached: tetrahedra });
}

async function meshed(input: string, ...more: readonly string[]): Promise<MeshReport> {
  const result = await run("mesh", input, "-o", "part.vtu", "--report", "part.json", ...more);
  expect(result.code, result.stderr).toBe(0);
  return JSON.parse(readFileSync(inFolder("part.json"), "utf8")) as MeshReport;
}

const SHAPES = {
  sphere: () => sphereSurface(24),
  box: () => boxSurface(1, [0, 0, 0], [3, 2, 1]),
  // All its edges get a further side at the same size.
  cube: () => boxSurface(1),
  plate: () => boxSurface(2, [0, 0, 0], [10, 8, 0.5]),
  torus: () => torusSurface(48, 24, 5, 2),
};

test.each([
  ["sphere", 300],
  ["sphere", 3000],
  ["box", 200],
  ["box", 2000],
  ["box", 8000],
  ["cube", 500],
  ["cube", 1000],
  ["plate", 2000],
  ["torus", 1000],
] as const)("--elements reaches the number within the tolerance: %s, %i", async (shape, wanted) => {
  save("part.stl", stlText(SHAPES[shape]()));
  const report = await meshed("part.stl", "--elements", String(wanted));
  expectReached(report, wanted);
  expect(report.dihedral.min).toBeGreaterThan(10);
  expect(codes(report)).not.toContain("element-count");
});

test("a STEP file of several solids is meshed with the number", async () => {
  const solids = [boxSolid("a", [0, 0, 0], [10, 10, 10]), boxSolid("b", [20, 0, 0], [24, 30, 5])];
  save("part.step", stepFile(solids));
  expectReached(await meshed("part.step", "--elements", "4000"), 4000);
});

test("the number decides the sizes of a drawn model with a background grid and sources", async () => {
  const project = cubeProject(0.25);
  const source = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.05, distance: 0.1 } as const;
  const withSource: Project = { ...project, background: { ...project.background, sources: [source] } };
  for (const wanted of [400, 4000]) {
    const result = await mesher.meshProject(withSource, { elements: wanted });
    expectReached(result.report, wanted);
    expectValid(result);
    // Elements at the source stay the smallest ones.
    expect(edgeNear(result, [0, 0, 0])).toBeLessThan(0.7 * edgeNear(result, [1, 1, 1]));
  }
});

/** Returns the length of the shortest edge at the node nearest to a position. */
function edgeNear({ mesh: { points, tetrahedra } }: MeshResult, position: readonly number[]): number {
  const distance = (a: number, to: readonly number[]) =>
    Math.hypot(...to.map((value, k) => value - (points[3 * a + k] ?? 0)));
  let nearest = 0;
  for (let n = 1; n < points.length / 3; n++) {
    if (distance(n, position) < distance(nearest, position)) nearest = n;
  }
  const at = [...points.subarray(3 * nearest, 3 * nearest + 3)];
  const others = [...tetrahedra].flatMap((_, i) => {
    const corners = tetrahedra.subarray(i - (i % 4), i - (i % 4) + 4);
    return tetrahedra[i] === nearest ? [...corners].filter((node) => node !== nearest) : [];
  });
  return Math.min(...others.map((node) => distance(node, at)));
}

test("a project keeps the number among its settings; a size of the caller replaces it", async () => {
  const project: Project = { ...cubeProject(0.3), meshing: { size: 0.3, elements: 1500 } };
  expectReached((await mesher.meshProject(project)).report, 1500);
  const sized = await mesher.meshProject(project, { size: 0.3 });
  expect(sized.report.elements).toBeUndefined();
  save("cube.json", new TextEncoder().encode(writeProject(project)));
  expectReached(await meshed("cube.json"), 1500);
  expectReached(await meshed("cube.json", "--elements", "600"), 600);
});

test("the same number gives the same mesh", async () => {
  const surface = sphereSurface(8);
  const meshes = [1, 2].map(() => mesher.fillSurface(surface, { elements: 4000 }));
  const [a, b] = await Promise.all(meshes);
  expect(a?.report.fingerprint).toBe(b?.report.fingerprint);
  if (a) expectReached(a.report, 4000);
});

test("a kept surface limits the number, and the warning states the limit", async () => {
  const { report } = await mesher.fillSurface(sphereSurface(16), { elements: 10 });
  expect(report.status).toBe("done");
  expect(codes(report)).toContain("element-count");
  const told = report.diagnostics.find(({ code }) => code === "element-count");
  expect(told).toMatchObject({ severity: "warning" });
  expect(told?.message).toContain(`10 elements asked for, ${report.tetrahedra} reached`);
  expect(told?.message).toContain("the triangles of the surface are kept");
});

test("a body that would be refined is remeshed for a number, and a kept one limits it", async () => {
  const bodyWith = (surface: "refine" | "keep"): Project => ({
    ...cubeProject(1),
    points: [],
    lines: [],
    patches: [],
    bodies: [{ ...createBody(sphereSurface(6), { id: 1, firstPatchId: 1 }), surface }],
  });
  expectReached((await mesher.meshProject(bodyWith("refine"), { elements: 3000 })).report, 3000);
  const kept = await mesher.meshProject(bodyWith("keep"), { elements: 60 });
  expect(codes(kept.report)).toContain("element-count");
});

test("a number below what the shape permits ends with the fewest and exit code 0", async () => {
  save("part.off", offFile(torusSurface(40, 20, 5, 1)));
  const result = await run("mesh", "part.off", "-o", "part.vtu", "--elements", "5", "--report", "part.json");
  expect(result.code).toBe(0);
  expect(result.stderr).toMatch(/warning: part\.off: 5 elements asked for, \d+ reached/);
});

test.each([
  [["--size", "0.1"], "--elements and --size exclude each other"],
  [["--max-size", "0.1"], "--elements and --max-size exclude each other"],
  [["--min-size", "0.1"], "--elements and --min-size exclude each other"],
])("sizes and a number exclude each other: %j", async (more, message) => {
  save("part.off", offFile(boxSurface(1)));
  const { code, stderr } = await run("mesh", "part.off", "-o", "part.vtu", "--elements", "100", ...more);
  expect(code).toBe(2);
  expect(stderr).toContain(message);
});

test.each(["0", "-5", "2.5", "many", "1e9"])("%s is no number of elements", async (count) => {
  save("part.off", offFile(boxSurface(1)));
  const { code, stderr } = await run("mesh", "part.off", "-o", "part.vtu", "--elements", count);
  expect(code).toBe(2);
  expect(stderr).toMatch(/number of elements/);
});

test("a size and a number in one call are refused", async () => {
  const { report } = await mesher.fillSurface(boxSurface(1), { size: 0.2, elements: 100 });
  expect(report.status).toBe("invalid-input");
  expect(codes(report)).toEqual(["invalid-option"]);
});

test("progress never decreases and ends at 1; cancelling ends all runs", async () => {
  const fractions: number[] = [];
  await mesher.fillSurface(
    sphereSurface(16),
    { elements: 2000 },
    { onProgress: ({ fraction }) => fractions.push(fraction) },
  );
  expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
  expect(fractions.at(-1)).toBe(1);
  const stop = new AbortController();
  const { report } = await mesher.fillSurface(
    sphereSurface(16),
    { elements: 200_000 },
    { signal: stop.signal, onProgress: ({ tetrahedra }) => tetrahedra > 1000 && stop.abort() },
  );
  expect(report.status).toBe("cancelled");
});

test.each([
  ["sphere", 1000],
  ["box", 200],
  ["box", 1500],
  ["plate", 2000],
] as const)(
  "a project with the body of a file has the mesh of the file, and its bodies are those of the mesh: %s, %i",
  async (shape, elements) => {
    const surface = SHAPES[shape]();
    const file = await meshFile(stlText(surface), { fileName: "a.stl", elements, mesher });
    const read = await readSurface(stlText(surface), { fileName: "a.stl" });
    if (!read.success) throw new Error(read.errors[0].message);
    const project: Project = {
      ...cubeProject(),
      points: [],
      lines: [],
      patches: [],
      background: { nodes: [], tetrahedra: [] },
      bodies: [createBody(read.value, { id: 1, firstPatchId: 1 })],
      meshing: { elements },
    };
    const bodies: PreparedBody[] = [];
    const onBody = (body: PreparedBody) => void bodies.push(body);
    const { report } = await mesher.meshProject(project, {}, { onBody });
    expect(report.elements).toEqual(file.report.elements);
    expect(report.fingerprint).toBe(file.report.fingerprint);
    const [body] = bodies;
    expect(bodies).toHaveLength(1);
    expect((body?.triangles.length ?? 0) / 3).toBe(report.triangles);
    expect(body?.sizeFactor).toBe(report.elements?.sizeFactor);
    // It is of no use for another number.
    const known = { elements: elements / 2, preparedBodies: bodies };
    const other = await mesher.meshProject({ ...project, meshing: {} }, known);
    const plain = await mesher.meshProject({ ...project, meshing: {} }, { elements: elements / 2 });
    expect(other.report.fingerprint).toBe(plain.report.fingerprint);
  },
);

test("too few elements for good ones in a thin wall are said, with the number that suffices", async () => {
  const plate = stlText(boxSurface(1, [0, 0, 0], [25, 15, 0.8]));
  const few = await meshFile(plate, { fileName: "a.stl", elements: 200, mesher });
  const told = few.report.diagnostics.find(({ code }) => code === "element-count");
  expect(told?.message).toMatch(
    /elements are too few for good shapes, as in thin walls: the smallest dihedral/,
  );
  const number = Number(/about (\d+) elements/.exec(told?.remedy ?? "")?.[1]);
  const enough = await meshFile(plate, { fileName: "a.stl", elements: number, mesher });
  expect(codes(enough.report)).not.toContain("element-count");
  expect(enough.report.dihedral.min).toBeGreaterThan(20);
});
