import { writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { parseMsh, parseVtu } from "../../support/mesh-files.js";
import { namedMesh } from "../../../wasm/src/api/generated-mesh.js";
import type { EngineMesh } from "../../../wasm/src/engine/engine-mesh.js";

/**
 * Two tetrahedra of two regions that share a face; two of their outer faces are patches. The coordinates are
 * chosen so that any conversion to decimal or float32 shows.
 */
const points = Float64Array.of(
  0,
  -0,
  1e-300,
  1 / 3,
  0.1 + 0.2,
  0,
  0,
  1 + 2 ** -52,
  0,
  2 ** -1074,
  0,
  1,
  5e300,
  1,
  1,
);
const flat: EngineMesh = {
  surface: {
    points: points.slice(0, 12),
    triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2),
    trianglePatch: Uint32Array.of(2, 0, 2),
    sides: new Uint32Array(),
    triangleRegions: new Uint32Array(),
    sideLine: new Uint32Array(),
  },
  volume: {
    points,
    tetrahedra: Uint32Array.of(0, 1, 2, 3, 1, 4, 2, 3),
    regions: Uint32Array.of(0, 1),
    front: new Uint32Array(),
  },
};
const { mesh } = namedMesh(flat, {});
const { mesh: empty } = namedMesh(
  {
    surface: { ...flat.surface, triangles: new Uint32Array(), trianglePatch: new Uint32Array() },
    volume: { ...flat.volume, tetrahedra: new Uint32Array(), regions: new Uint32Array() },
  },
  {},
);

/** Writes a mesh and returns its only file. */
async function written(extension: string, mesh: Mesh): Promise<Uint8Array<ArrayBuffer>> {
  const [file, ...others] = await writeMesh(mesh, `part${extension}`);
  if (file === undefined || others.length > 0) throw new Error("not one file");
  expect(file.fileName).toBe(`part${extension}`);
  return file.bytes;
}

const named = (patches: readonly string[], regions: readonly string[] = ["region 1", "region 2"]): Mesh => ({
  ...mesh,
  patches: patches.map((name, p) => ({ name, tag: p + 1 })),
  regions: regions.map((name, r) => ({ name, tag: r + 1 })),
});

test("a partial mesh with elements of the last region only lists all regions", () => {
  const volume = { ...flat.volume, regions: flat.volume.regions.map(() => 2) };
  expect(namedMesh({ ...flat, volume }, {}).mesh.regions).toHaveLength(3);
});

describe("VTU", () => {
  test("holds the tetrahedra with exact coordinates", async () => {
    const read = parseVtu(await written(".vtu", mesh));
    expect([...read.points]).toEqual([...points]);
    expect(read.tetrahedra).toEqual([
      [0, 1, 2, 3],
      [1, 4, 2, 3],
    ]);
    expect(read.regions).toEqual([1, 2]);
    expect(read.triangles).toEqual([
      [0, 2, 1],
      [0, 1, 3],
      [0, 3, 2],
    ]);
    expect(read.patches).toEqual([3, 1, 3]);
  });

  test("is complete for a mesh without tetrahedra", async () => {
    const read = parseVtu(await written(".vtu", empty));
    expect([read.points.length, read.tetrahedra, read.regions]).toEqual([15, [], []]);
  });
});

describe("MSH", () => {
  test("holds patches and regions as named groups with exact coordinates", async () => {
    const read = parseMsh(await written(".msh", named(["inlet", "unused", 'the "wall"'])));
    expect([...read.points]).toEqual([...points]);
    expect(read.triangles).toEqual([
      { name: "inlet", elements: [[0, 1, 3]] },
      {
        name: "the 'wall'",
        elements: [
          [0, 2, 1],
          [0, 3, 2],
        ],
      },
    ]);
    expect(read.tetrahedra).toEqual([
      { name: "region 1", elements: [[0, 1, 2, 3]] },
      { name: "region 2", elements: [[1, 4, 2, 3]] },
    ]);
  });

  test("makes equal group names unique", async () => {
    const read = parseMsh(await written(".msh", named(["wall", "", "wall"], ["", " "])));
    expect(read.triangles.map(({ name }) => name)).toEqual(["wall", "wall (patch 3)"]);
    expect(read.tetrahedra.map(({ name }) => name)).toEqual(["region 1", "region 2"]);
  });

  test.each([".msh", ".msh2"])(
    "%s truncates long names at the limit of Gmsh and keeps them unique",
    async (extension) => {
      const long = "ä".repeat(150);
      const text = new TextDecoder("latin1").decode(
        await written(extension, named([long, "", long], [long, long])),
      );
      const names = Array.from(text.matchAll(/^\d \d "(.*)"$/gm), ([, name]) => name ?? "");
      expect(names).toHaveLength(4);
      for (const name of names) {
        expect(name.length).toBeLessThanOrEqual(127); // One latin1 character per byte.
        expect(() =>
          new TextDecoder("utf-8", { fatal: true }).decode(Uint8Array.from(name, (c) => c.charCodeAt(0))),
        ).not.toThrow();
      }
      expect(new Set(names.slice(0, 2)).size).toBe(2);
      expect(new Set(names.slice(2)).size).toBe(2);
    },
  );

  test("is complete for a mesh without elements", async () => {
    expect(parseMsh(await written(".msh", empty))).toMatchObject({
      triangles: [],
      tetrahedra: [],
    });
  });
});

describe("legacy VTK", () => {
  /** Returns the first `count` numbers after a line that matches. */
  const after = (file: Uint8Array, line: RegExp, count: number) => {
    const text = new TextDecoder().decode(file);
    const found = line.exec(text);
    if (found === null) throw new Error(`no ${line.source}`);
    const words = text.slice(found.index + found[0].length).split(/\s+/);
    return words.slice(0, count).map(Number);
  };

  test("holds the tetrahedra with exact coordinates", async () => {
    const file = await written(".vtk", mesh);
    expect(after(file, /^ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n/m, 15)).toEqual([...points]);
    const cells = [4, 0, 1, 2, 3, 4, 1, 4, 2, 3, 3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2];
    expect(after(file, /^CELLS 5 22\n/m, 22)).toEqual(cells);
    expect(after(file, /^CELL_TYPES 5\n/m, 5)).toEqual([10, 10, 5, 5, 5]);
    expect(after(file, /^SCALARS region int 1\nLOOKUP_TABLE default\n/m, 5)).toEqual([1, 2, 0, 0, 0]);
    expect(after(file, /^SCALARS patch int 1\nLOOKUP_TABLE default\n/m, 5)).toEqual([0, 0, 3, 1, 3]);
  });

  test("is complete for a mesh without tetrahedra", async () => {
    expect(new TextDecoder("latin1").decode(await written(".vtk", empty))).toMatch(
      /CELLS 0 0\nCELL_TYPES 0\nCELL_DATA 0\n/,
    );
  });
});

describe("Medit", () => {
  const rowsOf = (file: string, section: string): number[][] => {
    const lines = file.split("\n");
    const begin = lines.indexOf(section);
    return lines
      .slice(begin + 2, begin + 2 + Number(lines[begin + 1]))
      .map((line) => line.split(" ").map(Number));
  };

  test("holds boundary and tetrahedra with their references and exact coordinates", async () => {
    const file = new TextDecoder().decode(await written(".mesh", mesh));
    expect(file).toMatch(/^MeshVersionFormatted 2\n\nDimension 3\n/);
    expect(rowsOf(file, "Vertices").flatMap((row) => row.slice(0, 3))).toEqual([...points]);
    expect(rowsOf(file, "Triangles")).toEqual([
      [1, 3, 2, 3],
      [1, 2, 4, 1],
      [1, 4, 3, 3],
    ]);
    expect(rowsOf(file, "Tetrahedra")).toEqual([
      [1, 2, 3, 4, 1],
      [2, 5, 3, 4, 2],
    ]);
    expect(file).toMatch(/\nEnd\n$/);
  });

  test("is complete for a mesh without elements", async () => {
    expect(new TextDecoder().decode(await written(".mesh", empty))).toMatch(/Tetrahedra\n0\n\nEnd\n$/);
  });
});

test("SU2: holds the tetrahedra, exact coordinates, and a marker per patch", async () => {
  const lines = new TextDecoder().decode(await written(".su2", named(["the inlet", "", "wall"]))).split("\n");
  expect(lines.slice(0, 4)).toEqual(["NDIME= 3", "NELEM= 2", "10 0 1 2 3 0", "10 1 4 2 3 1"]);
  expect(lines[4]).toBe("NPOIN= 5");
  const rows = lines.slice(5, 10).map((line) => line.split(" ").map(Number));
  expect(rows.flatMap((row) => row.slice(0, 3))).toEqual([...points]);
  expect(rows.map((row) => row[3])).toEqual([0, 1, 2, 3, 4]);
  expect(lines.slice(10)).toEqual(
    ["NMARK= 3", "MARKER_TAG= the_inlet", "MARKER_ELEMS= 1", "5 0 1 3"].concat([
      "MARKER_TAG= wall",
      "MARKER_ELEMS= 2",
      "5 0 2 1",
      "5 0 3 2",
      // Three outer faces of this mesh have no triangle.
      "MARKER_TAG= unnamed_faces",
      "MARKER_ELEMS= 3",
      "5 4 2 3",
      "5 1 4 3",
      "5 1 2 4",
      "",
    ]),
  );
});

/** Two equal names longer than any format permits, and names that differ only in case. */
const hardNames = named(["the wall ".repeat(40), "Wall", "the wall ".repeat(40)], ["wall", "WALL"]);

test("SU2: marker names are unique and have at most 199 bytes", async () => {
  const text = new TextDecoder().decode(await written(".su2", hardNames));
  const all = Array.from(text.matchAll(/^MARKER_TAG= (.*)$/gm), ([, name]) => name ?? "");
  const names = all.filter((name) => name !== "unnamed_faces");
  expect(names).toHaveLength(2);
  expect(new Set(names).size).toBe(2);
  for (const name of names) expect(name).toMatch(/^\S{100,199}$/);
});

test("Abaqus: names differ in more than case and have at most 80 characters", async () => {
  const text = new TextDecoder().decode(await written(".inp", hardNames));
  for (const word of ["NSET, NSET", "ELSET", "SURFACE, NAME", "MATERIAL, NAME"]) {
    const names = Array.from(
      text.matchAll(new RegExp(`^\\*.*${word}=(\\w+)`, "gm")),
      ([, name]) => name ?? "",
    );
    const distinct = new Set(names.map((name) => name.toUpperCase()));
    expect([word, distinct.size]).toEqual([word, 2]);
    for (const name of names) expect(name).toMatch(/^[A-Z]\w{0,79}$/i);
  }
});
