/** Curved second-order elements: positions in files, the report, and validity as Python decides it independently. */
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import {
  createMesher,
  type CurvedEdges,
  type Mesh,
  type Mesher,
  type MeshReport,
  writeMesh,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { inOrder } from "../../../wasm/src/api/second-order-mesh.js";
import { tetrafront } from "../../support/command-line.js";
import { blockMesh } from "../../support/block-mesh.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const script = fileURLToPath(new URL("../../oracles/second_order.py", import.meta.url));
const canJudge = spawnSync(python, ["-c", "import meshio"]).status === 0;
const folder = temporaryFolder("all tests");

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Position = readonly [number, number, number];

function pointOf(points: Float64Array, node: number): Position {
  const [x = 0, y = 0, z = 0] = points.subarray(3 * node, 3 * node + 3);
  return [x, y, z];
}

const length = ([x, y, z]: Position) => Math.hypot(x, y, z);

/** The edges of the triangles, with middles moved by `project`. */
function curvedEdgesOf({ points, triangles }: Mesh, project: (halfway: Position) => Position): CurvedEdges {
  const found = new Map<string, readonly [number, number]>();
  triangles.forEach((a, i) => {
    const b = triangles[i % 3 === 2 ? i - 2 : i + 1] ?? 0;
    found.set(`${Math.min(a, b)} ${Math.max(a, b)}`, [a, b]);
  });
  const edges = [...found.values()];
  const middles = edges.flatMap(([a, b]) => {
    const [from, to] = [pointOf(points, a), pointOf(points, b)];
    return project([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2]);
  });
  return { edges: Uint32Array.from(edges.flat()), middles: Float64Array.from(middles) };
}

const onSphere = (halfway: Position): Position => {
  const factor = 1 / length(halfway);
  return [factor * halfway[0], factor * halfway[1], factor * halfway[2]];
};

interface Verdict {
  readonly elements: number;
  readonly valid: number;
  readonly invalid: number;
  readonly undecided: number;
  readonly least: number;
  readonly volume: number;
}

async function judged(mesh: Mesh, fileName: string): Promise<Verdict> {
  const file = path.join(folder.path, fileName);
  const [written] = await writeMesh(mesh, fileName, { elementOrder: 2 });
  writeFileSync(file, written?.bytes ?? new Uint8Array());
  const { stdout, stderr } = spawnSync(python, [script, file], { encoding: "utf8" });
  expect(stderr).toMatch(/^(tetrafront: .* so far.*\n)*$/);
  return JSON.parse(stdout) as Verdict;
}

async function ball(rings: number) {
  const result = await mesher.fillSurface(sphereSurface(rings));
  const mesh = { ...result.mesh, trueEdges: curvedEdgesOf(result.mesh, onSphere) };
  return inOrder(mesher, { ...result, mesh }, { elementOrder: 2 }, {});
}

if (canJudge) {
  describe("an independent program finds all elements valid:", () => {
    test("of a ball, whose volume converges at third order at least", async () => {
      const errors: number[] = [];
      for (const rings of [5, 10]) {
        const { mesh, report } = await ball(rings);
        const verdict = await judged(mesh, `ball ${rings}.vtu`);
        expect(verdict).toMatchObject({
          elements: mesh.tetrahedra.length / 4,
          valid: verdict.elements,
          invalid: 0,
        });
        expect(verdict.least).toBeGreaterThan((report.secondOrder?.minScaledJacobian ?? NaN) - 1e-9);
        errors.push(Math.abs(verdict.volume - (4 / 3) * Math.PI));
      }
      expect(errors[1]).toBeLessThan((errors[0] ?? 0) / 8);
    });

    test("of a cube with waves into it, which need nodes inside to move", async () => {
      const { mesh } = await mesher.fillSurface(boxSurface(4));
      const depthAt = (x: number, y: number) => x * (1 - x) * y * (1 - y) * (1 + Math.sin(9 * x + 7 * y));
      const wavy = curvedEdgesOf(mesh, ([x, y, z]) => [x, y, z === 1 ? z - depthAt(x, y) : z]);
      const curved = await mesher.curveMesh(mesh, wavy);
      // Without untangling, the elements are invalid: the test means something.
      const before = await judged({ ...mesh, curvedEdges: wavy }, "before.vtu");
      expect(before.invalid).toBeGreaterThan(0);
      const after = await judged(curved.mesh, "after.vtu");
      expect(after).toMatchObject({ valid: mesh.tetrahedra.length / 4, invalid: 0, undecided: 0 });
      expect(curved.secondOrder.minScaledJacobian).toBeGreaterThan(0);
      expect(curved.secondOrder.straightened).toEqual([]);
    });
  });
}

test("files of order 2 have the middles of curved edges, and the others halfway", async () => {
  const { mesh } = await ball(6);
  const { edges, middles } = mesh.curvedEdges ?? { edges: [], middles: new Float64Array() };
  const middleOf = new Map<string, Position>();
  for (let e = 0; e < edges.length / 2; e++) {
    middleOf.set(`${edges[2 * e]} ${edges[2 * e + 1]}`, pointOf(middles, e));
  }
  const [file] = await writeMesh(mesh, "a.vtk", { elementOrder: 2 });
  const text = new TextDecoder().decode(file?.bytes);
  const [, list = ""] = /POINTS \d+ double\n([^A-Z]*)/.exec(text) ?? [];
  const points = Float64Array.from(list.trim().split(/\s+/), Number);
  const [, cells = ""] = /CELLS \d+ \d+\n([^A-Z]*)/.exec(text) ?? [];
  const ends = { 10: [0, 1, 1, 2, 2, 0, 0, 3, 1, 3, 2, 3], 6: [0, 1, 1, 2, 2, 0] } as const;
  let curved = 0;
  for (const line of cells.trim().split("\n")) {
    const [count, ...nodes] = line.split(" ").map(Number);
    const pairs = ends[count as 6 | 10];
    const corners = count === 10 ? 4 : 3;
    for (let e = 0; e < pairs.length / 2; e++) {
      const [a = 0, b = 0] = [nodes[pairs[2 * e] ?? 0], nodes[pairs[2 * e + 1] ?? 0]];
      const given = middleOf.get(`${Math.min(a, b)} ${Math.max(a, b)}`);
      const [from, to] = [pointOf(points, a), pointOf(points, b)];
      const halfway = from.map((x, i) => 0.5 * x + 0.5 * (to[i] ?? 0));
      expect(pointOf(points, nodes[corners + e] ?? 0)).toEqual(given ?? halfway);
      if (given !== undefined) curved++;
    }
  }
  expect(curved).toBeGreaterThan(0);
  for (let node = 0; node < mesh.points.length / 3; node++) {
    expect(pointOf(points, node)).toEqual(pointOf(mesh.points, node));
  }
});

test("the report counts every element once, and lists the worst in order", async () => {
  const { mesh, report } = await ball(8);
  const quality = report.secondOrder;
  expect(quality?.histogram).toHaveLength(20);
  expect(quality?.histogram.reduce((sum, count) => sum + count, 0)).toBe(mesh.tetrahedra.length / 4);
  const values = quality?.worst.map(({ scaledJacobian }) => scaledJacobian) ?? [];
  expect(values[0]).toBe(quality?.minScaledJacobian);
  expect(values).toEqual(values.toSorted((a, b) => a - b));
  expect(quality?.straightened).toEqual([]);
});

test("an edge that cannot be curved is straightened, and listed with its position", async () => {
  const { mesh } = await mesher.fillSurface(boxSurface(3));
  const edge = curvedEdgesOf(mesh, (halfway) => halfway);
  const z = (node: number | undefined) => mesh.points[3 * (node ?? 0) + 2];
  const top = Array.from({ length: edge.edges.length / 2 }, (_, e) => e).find(
    (e) => z(edge.edges[2 * e]) === 1 && z(edge.edges[2 * e + 1]) === 1 && edge.middles[3 * e] === 0.5,
  );
  const [a = 0, b = 0] = edge.edges.subarray(2 * (top ?? 0), 2 * (top ?? 0) + 2);
  const middle = edge.middles.slice(3 * (top ?? 0), 3 * (top ?? 0) + 3);
  expect(middle[2]).toBe(1);
  const low = middle.map((value, axis) => (axis === 2 ? value - 0.9 : value));
  const { secondOrder, mesh: curved } = await mesher.curveMesh(mesh, {
    edges: Uint32Array.of(a, b),
    middles: low,
  });
  expect(secondOrder.straightened).toEqual([
    { nodes: [Math.min(a, b), Math.max(a, b)], position: [...middle] },
  ]);
  expect(secondOrder.minScaledJacobian).toBeGreaterThan(0);
  const { edges = new Uint32Array() } = curved.curvedEdges ?? {};
  for (let e = 0; e < edges.length; e += 2) {
    expect([edges[e], edges[e + 1]]).not.toEqual([Math.min(a, b), Math.max(a, b)]);
  }
});

test("elements that are inverted with straight edges are refused", async () => {
  const mesh = blockMesh(2);
  const tetrahedra = mesh.tetrahedra.slice();
  [tetrahedra[4], tetrahedra[5]] = [tetrahedra[5] ?? 0, tetrahedra[4] ?? 0];
  const none = { edges: new Uint32Array(), middles: new Float64Array() };
  await expect(mesher.curveMesh({ ...mesh, tetrahedra }, none)).rejects.toThrow(
    "1 tetrahedron has no positive volume with straight edges; the first one is 1",
  );
});

test("the command line says that edges of triangles stay straight, and reports it", async () => {
  const input = path.join(folder.path, "box.stl");
  writeFileSync(input, stlBinary(boxSurface(2)));
  const report = path.join(folder.path, "report.json");
  const output = path.join(folder.path, "box.vtu");
  const run = await tetrafront(folder.path, [
    ...["mesh", input, "-o", output],
    ...["--element-order", "2", "--report", report],
  ]);
  expect(run.code).toBe(0);
  expect(run.stderr + run.stdout).toContain(
    "second-order elements have straight edges, because the surface consists of triangles",
  );
  const { secondOrder, tetrahedra } = JSON.parse(readFileSync(report, "utf8")) as MeshReport;
  expect(secondOrder).toMatchObject({ minScaledJacobian: 1, meanScaledJacobian: 1, straightened: [] });
  expect(secondOrder?.histogram[19]).toBe(tetrahedra);
});
