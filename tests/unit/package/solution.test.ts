/** Sizes from the fields of a solver, and their transfer: API, command line, and the files that both use. */
import { readFileSync } from "node:fs";

import { createMesher, type FieldValues, type Mesh, type Mesher, readMesh, writeMesh } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";
import { writeProject } from "tetrafront/project";

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Position = readonly [number, number, number];
type Field = (position: Position) => number;

/** The unit cube, in n × n × n cubes of six tetrahedra: the block with other positions. */
function unitCube(n: number): Mesh {
  const block = blockMesh(n);
  const step = (x: number, axis: number) => {
    if (axis === 0) return Math.round(3 * x);
    return axis === 1 ? Math.round((x - 0.2) / 0.1) : n + Math.round(x / 1e-3);
  };
  return { ...block, points: block.points.map((x, i) => step(x, i % 3) / n) };
}

function atNodes({ points }: Pick<Mesh, "points">, field: Field): Float64Array {
  const position = (i: number): Position => [
    points[3 * i] ?? 0,
    points[3 * i + 1] ?? 0,
    points[3 * i + 2] ?? 0,
  ];
  return Float64Array.from({ length: points.length / 3 }, (_, i) => field(position(i)));
}

const layer: Field = ([x, y, z]) => Math.tanh(15 * (x + 0.2 * y - 0.6)) + z * z;
const scalar = (mesh: Mesh, field: Field, name?: string): FieldValues => ({
  components: 1,
  values: atNodes(mesh, field),
  name,
});

/** Returns the size in a direction at a node. */
function sizeAlong(metrics: Float64Array, node: number, [x, y, z]: Position): number {
  const [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0] = metrics.subarray(6 * node, 6 * node + 6);
  const square = xx * x * x + yy * y * y + zz * z * z + 2 * (xy * x * y + xz * x * z + yz * y * z);
  return 1 / Math.sqrt(square);
}

async function withField(name: string, mesh: Mesh, fields: readonly FieldValues[]): Promise<void> {
  const nodeData = new Map(
    fields.map(({ name: key = "", components, values }) => [key, { components, values }]),
  );
  for (const { fileName, bytes } of await writeMesh({ ...mesh, nodeData }, name)) save(fileName, bytes);
}

async function meshIn(name: string): Promise<Mesh> {
  const read = await readMesh(readFileSync(inFolder(name)), { fileName: name });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

describe("sizeFromSolution", () => {
  test("follows the second derivatives of a quadratic field", async () => {
    const mesh = unitCube(4);
    const field = scalar(mesh, ([x, y, z]) => 8 * x * x + 2 * y * y + 0.5 * z * z + x - 3);
    const { metrics, expectedErrors, diagnostics } = await mesher.sizeFromSolution(mesh, [field], {
      error: 0.001,
      norm: "max",
      growth: Infinity,
      maxSize: 10,
    });
    // The largest error on a regular element with edges 1 is 3/16 of the second derivative.
    const scale = Math.sqrt((16 * 0.001) / 3);
    for (let node = 0; node < metrics.length / 6; node++) {
      expect(sizeAlong(metrics, node, [1, 0, 0])).toBeCloseTo(scale / 4, 6);
      expect(sizeAlong(metrics, node, [0, 1, 0])).toBeCloseTo(scale / 2, 6);
      expect(sizeAlong(metrics, node, [0, 0, 1])).toBeCloseTo(scale, 6);
    }
    expect(expectedErrors[0]).toBeCloseTo(0.001, 9);
    expect(diagnostics).toEqual([]);
  });

  test("asks for the number of elements, and the front makes about as many", async () => {
    const mesh = unitCube(14);
    const sizes = await mesher.sizeFromSolution(mesh, [scalar(mesh, layer)], { elements: 6000 });
    expect(Math.abs(sizes.elements / 6000 - 1)).toBeLessThan(0.05);
    expect([...sizes.mesh.nodeData.keys()]).toEqual([
      "size",
      "stretching",
      "direction",
      "secondStretching",
      "secondDirection",
      "metric",
    ]);
    const background = await mesher.backgroundFromMesh(sizes.mesh);
    const { report } = await mesher.meshProject(cubeProject(), { background, optimization: "none" });
    expect(Math.abs(report.tetrahedra / 6000 - 1)).toBeLessThan(0.4);
  });

  test("warns about fields without variation, and numbers that the limits exclude", async () => {
    const mesh = unitCube(3);
    const constant = await mesher.sizeFromSolution(mesh, [scalar(mesh, () => 7, "p")], { elements: 1000 });
    expect(constant.diagnostics.map(({ code, severity }) => [code, severity])).toEqual([
      ["constant-field", "warning"],
    ]);
    expect(constant.diagnostics[0]?.message).toMatch(/^The field "p" is linear/);
    const sizes = constant.mesh.nodeData.get("size")?.values ?? new Float64Array();
    expect(Math.max(...sizes) - Math.min(...sizes)).toBeLessThan(1e-12);
    const limited = await mesher.sizeFromSolution(mesh, [scalar(mesh, layer)], {
      elements: 1e6,
      minSize: 0.2,
    });
    expect(limited.diagnostics.map(({ code }) => code)).toEqual(["element-count"]);
  });

  test("accepts values of elements", async () => {
    const mesh = unitCube(6);
    const { points, tetrahedra } = mesh;
    const values = Float64Array.from({ length: tetrahedra.length / 4 }, (_, t) => {
      const corners = [...tetrahedra.subarray(4 * t, 4 * t + 4)];
      const x = corners.reduce((sum, node) => sum + (points[3 * node] ?? 0), 0) / 4;
      return x * x;
    });
    const field = { components: 1, values, isPerElement: true };
    const { metrics } = await mesher.sizeFromSolution(mesh, [field], { error: 0.01, norm: "max" });
    for (let node = 0; node < metrics.length / 6; node++) {
      expect(sizeAlong(metrics, node, [1, 0, 0])).toBeCloseTo(Math.sqrt((16 * 0.01) / 3 / 2), 6);
    }
  });

  test.each([
    [
      "too few values",
      { components: 1, values: new Float64Array(5), name: "u" },
      /"u" has 5 values, but 1 for/,
    ],
    [
      "NaN",
      { components: 1, values: new Float64Array(27).fill(NaN, 4, 5), name: "u" },
      /"u" is NaN at node 4/,
    ],
    ["no components", { components: 0, values: new Float64Array() }, /components/],
  ])("rejects %s", async (_, field, message) => {
    const mesh = unitCube(2);
    await expect(mesher.sizeFromSolution(mesh, [field], { elements: 100 })).rejects.toThrow(message);
  });

  test("rejects contradictory options, and elements without volume", async () => {
    const mesh = unitCube(2);
    const fields = [scalar(mesh, layer)];
    await expect(mesher.sizeFromSolution(mesh, fields, {})).rejects.toThrow(/Neither a number of elements/);
    await expect(mesher.sizeFromSolution(mesh, fields, { elements: 10, error: 1 })).rejects.toThrow(/Both/);
    const limits = { elements: 10, minSize: 2, maxSize: 1 };
    await expect(mesher.sizeFromSolution(mesh, fields, limits)).rejects.toThrow(/smallest size is 2/);
    const [a = 0, b = 0, ...rest] = mesh.tetrahedra;
    const inverted = { ...mesh, tetrahedra: Uint32Array.from([b, a, ...rest]) };
    await expect(mesher.sizeFromSolution(inverted, fields, { elements: 10 })).rejects.toThrow(
      /tetrahedron 0 .* no positive volume/i,
    );
  });
});

describe("an indicator of the error", () => {
  const eta = (values: Float64Array, isPerElement = true): FieldValues => ({
    name: "eta",
    components: 1,
    values,
    isPerElement,
  });

  test("gives the optimal sizes for an error h² |f″| on a uniform mesh", async () => {
    const mesh = unitCube(8);
    const second: Field = ([x]) => Math.exp(3 * x);
    const values = atNodes(mesh, second).map((value) => value / 64);
    const options = { indicator: "eta", elements: 20_000, growth: Infinity, maxSize: 10 };
    const sizes = await mesher.sizeFromSolution(mesh, [eta(values, false)], options);
    expect(Math.abs(sizes.elements / 20_000 - 1)).toBeLessThan(0.05);
    const [first = 0] = sizes.metrics;
    for (let node = 0; node < values.length; node++) {
      // Sizes are proportional to 1 / √|f″| everywhere, in all directions.
      const expected = Math.sqrt((values[0] ?? 0) / (values[node] ?? 0) / first);
      for (const axis of [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ] as const)
        expect(sizeAlong(sizes.metrics, node, axis) / expected).toBeCloseTo(1, 9);
    }
    // The sizes of the mesh itself: ten elements per unit cube of the metric.
    const own = await mesher.sizeFromSolution(
      mesh,
      [
        eta(
          values.map(() => 2),
          false,
        ),
      ],
      {
        indicator: "eta",
        error: 2,
      },
    );
    expect(own.elements).toBeCloseTo(mesh.tetrahedra.length / 4, 6);
    expect(own.expectedErrors[0]).toBeCloseTo(2, 9);
  });

  test("leaves the shape to the other fields", async () => {
    const mesh = unitCube(6);
    const thin = scalar(mesh, ([x, y, z]) => x * x + y * y + 25 * z * z, "u");
    const values = new Float64Array(mesh.tetrahedra.length / 4).fill(1);
    const options = { indicator: "eta", elements: 3000 };
    const { metrics } = await mesher.sizeFromSolution(mesh, [thin, eta(values)], options);
    expect(sizeAlong(metrics, 40, [1, 0, 0]) / sizeAlong(metrics, 40, [0, 0, 1])).toBeCloseTo(5, 3);
  });

  test("says what is wrong with it", async () => {
    const mesh = unitCube(2);
    const count = mesh.tetrahedra.length / 4;
    const sizesOf = (field: FieldValues, options = {}) =>
      mesher.sizeFromSolution(mesh, [field], { indicator: "eta", elements: 100, ...options });
    await expect(sizesOf(eta(new Float64Array(count).fill(-1, 3, 4)))).rejects.toThrow(
      /indicator "eta" is -1 at tetrahedron 3 .*magnitude/,
    );
    await expect(sizesOf(eta(new Float64Array(count).fill(NaN, 5, 6)))).rejects.toThrow(
      /"eta" is NaN at tetrahedron 5/,
    );
    await expect(sizesOf({ ...eta(new Float64Array(3 * count)), components: 3 })).rejects.toThrow(
      /"eta" has 3 numbers per tetrahedron/,
    );
    await expect(sizesOf({ ...eta(new Float64Array(count)), name: "u" })).rejects.toThrow(
      /no field is named "eta"/i,
    );
    const alone = { indicator: undefined, indicatorOrder: 3 };
    await expect(sizesOf(eta(new Float64Array(count)), alone)).rejects.toThrow(/no indicator/);
    const zero = await sizesOf(eta(new Float64Array(count)));
    expect(zero.diagnostics.map(({ message }) => message)).toEqual([
      'The indicator "eta" is 0 everywhere, so no sizes follow from it',
    ]);
  });
});

describe("transferSolution", () => {
  test("keeps the integrals if it is conservative", async () => {
    const [from, to] = [unitCube(5), unitCube(4)];
    const vector: FieldValues = {
      components: 2,
      values: Float64Array.from(atNodes(from, layer)).reduce(
        (all, value, i) => {
          all[2 * i] = value;
          all[2 * i + 1] = 1000 + value;
          return all;
        },
        new Float64Array((2 * from.points.length) / 3),
      ),
    };
    const { fields, integrals, outside } = await mesher.transferSolution(from, to, [vector], {
      conservative: true,
    });
    expect(fields[0]?.values.length).toBe((2 * to.points.length) / 3);
    expect(outside).toBe(0);
    for (const { before, after } of integrals[0] ?? []) {
      expect(Math.abs(after / before - 1)).toBeLessThan(1e-12);
    }
  });

  test("interpolates linear fields exactly", async () => {
    const [from, to] = [unitCube(5), unitCube(3)];
    const linear: Field = ([x, y, z]) => 1 + 2 * x - y + 3 * z;
    const { fields } = await mesher.transferSolution(from, to, [scalar(from, linear)]);
    const exact = atNodes(to, linear);
    fields[0]?.values.forEach((value, i) => expect(value).toBeCloseTo(exact[i] ?? NaN, 12));
  });
});

describe("backgroundFromMesh", () => {
  const metric = (values: readonly number[], mesh: Mesh) =>
    new Map([
      [
        "metric",
        {
          components: 6,
          values: Float64Array.from({ length: 2 * mesh.points.length }, (_, i) => values[i % 6] ?? 0),
        },
      ],
    ]);

  test("keeps the three sizes of a metric", async () => {
    const mesh = unitCube(2);
    // Sizes 0.1, 0.4 and 0.8 along z, x and y.
    const nodeData = metric([1 / 0.16, 0, 0, 1 / 0.64, 0, 100], mesh);
    const background = await mesher.backgroundFromMesh({ ...mesh, nodeData });
    const { sizes, stretchings, directions, secondStretchings, secondDirections } = background;
    const perLength = Math.cbrt(Math.sqrt(72) / 10);
    expect(sizes[0]).toBeCloseTo(0.1 * perLength, 12);
    expect(stretchings?.[0]).toBeCloseTo(8, 12);
    expect([...(directions ?? []).slice(0, 3)].map(Math.abs)).toEqual([0, 1, 0]);
    expect(secondStretchings?.[0]).toBeCloseTo(4, 12);
    expect([...(secondDirections ?? []).slice(0, 3)].map(Math.abs)).toEqual([1, 0, 0]);
  });

  test("has no second stretching if all elements are long in one direction", async () => {
    const mesh = unitCube(2);
    const nodeData = metric([100, 0, 0, 1 / 0.64, 0, 100], mesh);
    const background = await mesher.backgroundFromMesh({ ...mesh, nodeData });
    expect(background.stretchings?.[0]).toBeCloseTo(8, 12);
    expect(background.secondStretchings).toBeUndefined();
  });

  test("rejects a metric that is not positive", async () => {
    const mesh = unitCube(2);
    const nodeData = metric([1, 0, 0, 1, 0, -1], mesh);
    await expect(mesher.backgroundFromMesh({ ...mesh, nodeData })).rejects.toThrow(
      /metric at node 0 .* not positive definite/,
    );
  });
});

describe("the command line", () => {
  test("makes a background grid that mesh reads", async () => {
    const mesh = unitCube(8);
    await withField("solution.vtu", mesh, [scalar(mesh, layer, "T")]);
    const made = await run("sizes", "solution.vtu", "--field", "T", "--elements", "4000", "-o", "grid.vtu");
    expect([made.code, made.stderr]).toEqual([
      0,
      expect.stringMatching(/for about 4\d{3} elements|for about 39\d\d elements/),
    ]);
    const grid = await meshIn("grid.vtu");
    expect(grid.nodeData.get("metric")?.components).toBe(6);
    save("cube.json", writeProject(cubeProject()));
    const meshed = await run("mesh", "cube.json", "-o", "next.vtu", "--background", "grid.vtu");
    expect([meshed.code, meshed.stderr]).toEqual([0, expect.not.stringMatching(/not used/)]);
    const next = await meshIn("next.vtu");
    expect(next.tetrahedra.length / 4).toBeGreaterThan(1500);
    const moved = await run("transfer", "solution.vtu", "next.vtu", "-o", "start.vtu", "--conservative");
    expect([moved.code, moved.stderr]).toEqual([
      0,
      expect.stringMatching(/relative change of the integral: "T"/),
    ]);
    const start = await meshIn("start.vtu");
    expect(start.nodeData.get("T")?.values.length).toBe(start.points.length / 3);
  });

  test("makes sizes from an indicator of the elements in a Gmsh file", async () => {
    const mesh = unitCube(6);
    const values = Float64Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => 1 + t);
    const elementData = new Map([["eta", { components: 1, values }]]);
    for (const { fileName, bytes } of await writeMesh({ ...mesh, elementData }, "solution.msh"))
      save(fileName, bytes);
    const args = ["--indicator", "eta", "--indicator-order", "3.5", "-n", "4000", "-o", "grid.vtu"];
    const made = await run("sizes", "solution.msh", ...args);
    expect([made.code, made.stderr]).toEqual([0, expect.stringMatching(/expected largest "eta" \d/)]);
    const grid = await meshIn("grid.vtu");
    expect(grid.elementData).toBeUndefined();
    const { metrics } = await mesher.sizeFromSolution(
      mesh,
      [{ name: "eta", components: 1, values, isPerElement: true }],
      { indicator: "eta", indicatorOrder: 3.5, elements: 4000 },
    );
    expect(grid.nodeData.get("metric")?.values).toEqual(metrics);
    const byField = await run("sizes", "solution.msh", "--field", "eta", "-n", "4000", "-o", "grid.vtu");
    expect([byField.code, byField.stderr]).toEqual([0, expect.stringMatching(/error of "eta"/)]);
  });

  test("names the fields of a file without the one asked for", async () => {
    const mesh = unitCube(2);
    await withField("solution.vtu", mesh, [scalar(mesh, layer, "T")]);
    const { code, stderr } = await run("sizes", "solution.vtu", "-f", "p", "-n", "100", "-o", "grid.vtu");
    expect(code).toBe(2);
    expect(stderr).toMatch(/no field "p"\. The file has "T"/s);
  });

  test("reads sizes and metrics from the .sol file beside a Medit mesh", async () => {
    const mesh = unitCube(2);
    const nodes = mesh.points.length / 3;
    for (const { fileName, bytes } of await writeMesh(mesh, "cube.mesh")) save(fileName, bytes);
    const sol = (count: number) =>
      `MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n${count}\n1 3\n${"1 2 30 4 5 60\n".repeat(count)}End\n`;
    save("cube.sol", sol(nodes));
    const converted = await run("convert", "cube.mesh", "-o", "cube.vtu");
    expect(converted.code).toBe(0);
    const { nodeData } = await meshIn("cube.vtu");
    expect([...(nodeData.get("metric")?.values.slice(0, 6) ?? [])]).toEqual([1, 2, 4, 30, 5, 60]);
    save("cube.sol", sol(nodes - 1));
    const { code, stderr } = await run("convert", "cube.mesh", "-o", "cube.vtu");
    expect([code, stderr]).toEqual([0, expect.stringMatching(/values for 26 nodes, but the mesh has 27/)]);
  });

  test("mesh remeshes a surface after the metric of a .sol file, and its elements follow it too", async () => {
    const cube = unitCube(2);
    const metric = (_: number, i: number) => [100, 0, 0, 100, 0, 9][i % 6] ?? 0;
    const values = Float64Array.from({ length: 2 * cube.points.length }, metric);
    await withField("metric.mesh", cube, [{ name: "metric", components: 6, values }]);
    save("box.off", offFile(boxSurface(1)));
    const args = ["--surface", "remesh", "--background", "metric.mesh"];
    const { code, stderr } = await run("mesh", "box.off", "-o", "made.vtu", ...args);
    expect(code, stderr).toBe(0);
    const { points, triangles, tetrahedra } = await meshIn("made.vtu");
    // Sizes are 0.1 along x and y, and 0.33 along z.
    for (const [corners, width] of [[triangles, 3] as const, [tetrahedra, 4] as const]) {
      const squares = [0, 0, 0];
      corners.forEach((node, i) => {
        const next = corners[i % width === width - 1 ? i - width + 1 : i + 1] ?? 0;
        for (const axis of [0, 1, 2]) {
          const along = (points[3 * next + axis] ?? 0) - (points[3 * node + axis] ?? 0);
          squares[axis] = (squares[axis] ?? 0) + along * along;
        }
      });
      const [x = 0, y = 0, z = 0] = squares.map(Math.sqrt);
      expect(z / x).toBeGreaterThan(1.8);
      expect(z / y).toBeGreaterThan(1.8);
    }
  });
});
