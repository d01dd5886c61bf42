/** Second-order elements of one call: curved edges on the faces of a CAD file, from a surface, a file and a project. */
import { writeFileSync, readFileSync } from "node:fs";
import path from "node:path";
import {
  createMesher,
  meshFile,
  type Mesh,
  type Mesher,
  type MeshResult,
  type MeshReport,
  readSurface,
} from "tetrafront";
import { createBodies, type Project, type ProjectBody, writeProject } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";
import { tetrafront } from "../../support/command-line.js";
import { middlesOnCylinder, parseVtu } from "../../support/mesh-files.js";
import { cubeProject } from "../../support/projects.js";
import { drilledSolid, stepFile } from "../../support/step-files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const RADIUS = 3;
const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], [8, 5], RADIUS)]);
const folder = temporaryFolder("all tests");

let mesher: Mesher;
let surface: Mesh;
let body: ProjectBody;
beforeAll(async () => {
  mesher = await createMesher();
  const read = await readSurface(plate, { fileName: "plate.step" });
  if (!read.success) throw new Error("the plate cannot be read");
  surface = read.value;
  const [made] = createBodies(surface, { id: 1, firstPatchId: 101, name: "plate" });
  if (!made) throw new Error("there is no body");
  body = made;
});
afterAll(() => mesher.dispose());

const projectOf = (bodies: readonly ProjectBody[], drawn: Project): Project => ({ ...drawn, bodies });

const drawnCube = (): Project => ({
  ...cubeProject(),
  background: { nodes: [], tetrahedra: [] },
  meshing: { size: 1.5 },
});

const noDrawing = (): Project => ({
  format: "tetrafront-project",
  version: 2,
  name: "plate",
  points: [],
  lines: [],
  patches: [],
  background: { nodes: [], tetrahedra: [] },
});

type Position = readonly [number, number, number];
const at = (points: Float64Array, node: number): Position => {
  const [x = NaN, y = NaN, z = NaN] = points.subarray(3 * node, 3 * node + 3);
  return [x, y, z];
};
const distance = (a: Position, b: Position) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Edges between two nodes of the hole of a plate: their middles, with the distances from the straight ones, and the lengths. */
function holeEdges({ points, ...mesh }: Mesh, [x, y]: readonly [number, number]) {
  const { edges, middles } = mesh.curvedEdges ?? { edges: new Uint32Array(), middles: new Float64Array() };
  const radiusOf = (position: Position) => Math.hypot(position[0] - x, position[1] - y);
  return Array.from({ length: edges.length / 2 }, (_, e) => {
    const [from, to] = [at(points, edges[2 * e] ?? 0), at(points, edges[2 * e + 1] ?? 0)];
    const middle = at(middles, e);
    const halfway: Position = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2];
    return {
      from,
      to,
      radius: radiusOf(middle),
      offset: distance(middle, halfway),
      length: distance(from, to),
    };
  }).filter(({ from, to }) => [from, to].every((end) => Math.abs(radiusOf(end) - RADIUS) < 1e-6));
}

function expectCurved(
  { mesh, report }: Pick<MeshResult, "mesh" | "report">,
  axes: readonly [number, number][],
) {
  expect(report.status).toBe("done");
  expect(report.secondOrder?.minScaledJacobian).toBeGreaterThan(0);
  expect(report.secondOrder?.minScaledJacobian).toBeLessThan(1);
  expect(report.secondOrder?.straightened).toEqual([]);
  const all = axes.flatMap((axis) => holeEdges(mesh, axis));
  expect(all.length).toBeGreaterThan(50 * axes.length);
  // Every curved edge lies on a hole.
  expect(all).toHaveLength((mesh.curvedEdges?.edges.length ?? 0) / 2);
  for (const { radius, offset, length } of all) {
    expect(Math.abs(radius - RADIUS)).toBeLessThan(1e-9);
    // The sagitta of a chord of a circle.
    expect(offset).toBeLessThan((length * length) / (7.5 * RADIUS) + 1e-9);
  }
}

test("of a surface, a file and a project", async () => {
  const [axis] = [[8, 5] as [number, number]];
  expectCurved(await mesher.meshSurface(surface, { surface: "remesh", elementOrder: 2 }), [axis]);
  const made = await meshFile(plate, { fileName: "plate.step", elementOrder: 2, mesher });
  if (!made.success) throw new Error(made.message);
  expectCurved({ mesh: made.mesh, report: made.report }, [axis]);
  expectCurved(await mesher.meshProject(projectOf([body], noDrawing()), { elementOrder: 2 }), [axis]);
});

test("of bodies beside drawn patches, whose nodes come first", async () => {
  const placed = (id: number, x: number): ProjectBody => ({
    ...body,
    id,
    patches: body.patches.map((patch, p) => ({ ...patch, id: 100 * id + p })),
    placement: { position: [x, 0, 0], rotation: [0, 0, 0, 1], scale: 1 },
  });
  const result = await mesher.meshProject(projectOf([placed(1, 50), placed(2, 100)], drawnCube()), {
    elementOrder: 2,
  });
  expectCurved(result, [
    [58, 5],
    [108, 5],
  ]);
  // Bodies that were prepared before are curved too.
  const project = projectOf([placed(1, 50)], drawnCube());
  const preparedBodies = [await mesher.prepareBody(project, 1)];
  expectCurved(await mesher.meshProject(project, { elementOrder: 2, preparedBodies }), [[58, 5]]);
});

test("only of order 2, and straight without true faces", async () => {
  const linear = await mesher.meshProject(projectOf([body], noDrawing()));
  expect(linear.mesh.curvedEdges).toBeUndefined();
  expect(linear.report.secondOrder).toBeUndefined();
  const straight = await mesher.meshProject(cubeProject(), { elementOrder: 2 });
  expect(straight.report.secondOrder).toMatchObject({ minScaledJacobian: 1, straightened: [] });
  const wrong = await mesher.meshProject(cubeProject(), { elementOrder: 3 as 2 });
  expect(wrong.report.status).toBe("invalid-input");
  expect(wrong.report.diagnostics[0]?.message).toContain("The order of the elements is 3");
});

test("an improved mesh keeps the edges that bend", async () => {
  const { mesh } = await mesher.meshProject(projectOf([body], noDrawing()), { optimization: "none" });
  const improved = await mesher.improveMesh(mesh);
  const curved = await mesher.curveMesh(improved.mesh);
  const edges = holeEdges(curved.mesh, [8, 5]);
  expect(edges.length).toBeGreaterThan(50);
  for (const { radius } of edges) expect(Math.abs(radius - RADIUS)).toBeLessThan(1e-9);
});

test("of a project by the command line: the file has the middles on the hole", async () => {
  const input = path.join(folder.path, "plate.json");
  writeFileSync(input, writeProject(projectOf([body], noDrawing())));
  const [output, report] = [path.join(folder.path, "plate.vtu"), path.join(folder.path, "report.json")];
  const run = await tetrafront(folder.path, [
    ...["mesh", input, "-o", output],
    ...["--element-order", "2", "--report", report],
  ]);
  expect(run.code).toBe(0);
  expect(run.stderr + run.stdout).toContain("curved second-order elements, scaled Jacobian at least 0.");
  const made = JSON.parse(readFileSync(report, "utf8")) as MeshReport;
  expect(made.secondOrder?.minScaledJacobian).toBeGreaterThan(0);
  const gaps = middlesOnCylinder(parseVtu(readFileSync(output)), [8, 5], RADIUS);
  expect(gaps.length).toBeGreaterThan(50);
  expect(Math.max(...gaps)).toBeLessThan(1e-9);
});
