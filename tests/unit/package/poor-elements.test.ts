/** The warning about poor elements: when it is given, and what it says about the worst one. */
import { afterAll, expect, test } from "vitest";

import { createMesher, type Diagnostic, type SurfaceInput } from "tetrafront";

import { poorElementWarnings } from "../../../wasm/src/mesh/quality-warnings.js";

const mesher = await createMesher();
afterAll(() => {
  mesher.dispose();
});

/** Prism over a triangle of two long sides that meet at an angle, at the edge from (0, 0, 0) to (0, 0, height). */
function wedge(degrees: number, length: number, height: number): SurfaceInput {
  const half = (degrees * Math.PI) / 360;
  const [x, y] = [length * Math.cos(half), length * Math.sin(half)];
  const base = [
    [0, 0],
    [x, -y],
    [x, y],
  ];
  const points = [0, height].flatMap((z) => base.flatMap((point) => [...point, z]));
  const triangles = [0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5];
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

function box(a: number, b: number, c: number): SurfaceInput {
  const points = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [i & 1 ? a : 0, i & 2 ? b : 0, i & 4 ? c : 0]);
  const triangles = [
    0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7,
    5,
  ];
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

async function warningOf(surface: SurfaceInput, size?: number): Promise<Diagnostic | undefined> {
  const options = size === undefined ? {} : { size };
  const remeshed = await mesher.remeshSurface(surface, options);
  const { report } = await mesher.fillSurface(remeshed.mesh, options);
  return report.diagnostics.find(({ code }) => code === "poor-elements");
}

test.each([2, 4])(
  "a wedge of %d° is named with its edge and its angle, and smaller elements are not advised",
  async (degrees) => {
    const warning = await warningOf(wedge(degrees, 10, 6), 1);
    expect(warning?.message).toMatch(
      new RegExp(
        `two faces meet at an angle of ${degrees}° at the edge from \\(0, 0, [06]\\) to \\(0, 0, [06]\\)`,
      ),
    );
    expect(warning?.data).toMatchObject({ reason: "wedge" });
    expect(warning?.remedy).not.toMatch(/smaller elements there|thorough|Remesh/);
  },
);

test("a plate far thinner than its elements is named with its thickness, and the size that it needs", async () => {
  const warning = await warningOf(box(10, 10, 0.02), 1);
  expect(warning?.message).toContain("the region is only 0.02 thick there");
  expect(warning?.remedy).toMatch(/needs a size of 0\.085 there, with about [\d.]+( million)? tetrahedra/);
});

test("one needle among good triangles is named with its angle", async () => {
  const { mesh: surface } = await mesher.remeshSurface(box(1, 1, 1), { size: 0.1 });
  // A node on the first triangle, near the middle of one of its edges, makes a cap.
  const [a = 0, b = 0, c = 0] = surface.triangles;
  const at = (node: number, axis: number) => surface.points[3 * node + axis] ?? 0;
  const node = surface.points.length / 3;
  const middle = [0, 1, 2].map((k) => 0.4999 * (at(a, k) + at(b, k)) + 0.0002 * at(c, k));
  const needles: SurfaceInput = {
    points: Float64Array.from([...surface.points, ...middle]),
    triangles: Uint32Array.from([...surface.triangles.subarray(3), a, b, node, b, c, node, c, a, node]),
  };
  const { report } = await mesher.fillSurface(needles);
  const warning = report.diagnostics.find(({ code }) => code === "poor-elements");
  expect(warning?.data).toMatchObject({ reason: "triangle" });
  expect(warning?.message).toContain("(less than 1 %)");
  expect(warning?.message).toMatch(/a triangle of the surface has an angle of 0\.0\d+° there/);
});

test("an element with an angle near 180° is named, also if its smallest angle is above 5°", async () => {
  const { mesh: surface } = await mesher.remeshSurface(box(1, 1, 1));
  const { quality } = (await mesher.fillSurface(surface)).report;
  const warningsWith = (max: number): Diagnostic[] => {
    const dihedral = { min: 6, max };
    const [first] = quality.worst;
    if (first === undefined) throw new Error("no elements");
    const worst = { ...first, tetrahedron: 7, dihedral };
    const shapes = { ...quality.shapes, dihedral };
    return poorElementWarnings({ ...quality, shapes, worst: [worst], poor: { ...quality.poor, worst } });
  };
  expect(warningsWith(160)).toEqual([]);
  const [warning] = warningsWith(172);
  expect(warning?.message).toMatch(/the worst is tetrahedron 7 .*\. The largest angle is 172°$/);
});

test.each([
  ["a box", box(3, 2, 1)],
  ["a plate", box(10, 10, 0.2)],
  ["a wedge of 40°", wedge(40, 2, 2)],
])("a good mesh of %s has no warning", async (_, surface) => {
  expect(await warningOf(surface)).toBeUndefined();
});
