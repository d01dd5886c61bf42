import { writeMsh, writeVtu, type MeshResult } from "tetrafront";
import { describe, expect, test } from "vitest";

import { parseMsh, parseVtu } from "../../support/mesh-files.js";

/**
 * Two tetrahedra of two regions on either side of one face, and two of their outer faces as patches.
 * The coordinates are such that any detour through decimal or float32 numbers shows.
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
const mesh: Pick<MeshResult, "surface" | "volume"> = {
  surface: {
    points: points.slice(0, 12),
    triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2),
    trianglePatch: Uint32Array.of(2, 0, 2),
    sides: new Uint32Array(),
    sideLine: new Uint32Array(),
  },
  volume: {
    points,
    tetrahedra: Uint32Array.of(0, 1, 2, 3, 1, 4, 2, 3),
    regions: Uint32Array.of(0, 1),
    front: new Uint32Array(),
  },
};
const empty: typeof mesh = {
  surface: { ...mesh.surface, triangles: new Uint32Array(), trianglePatch: new Uint32Array() },
  volume: { ...mesh.volume, tetrahedra: new Uint32Array(), regions: new Uint32Array() },
};

describe("VTU", () => {
  test("holds the tetrahedra with coordinates bit for bit", () => {
    const read = parseVtu(writeVtu(mesh));
    expect([...read.points]).toEqual([...points]);
    expect(read.tetrahedra).toEqual([
      [0, 1, 2, 3],
      [1, 4, 2, 3],
    ]);
    expect(read.regions).toEqual([0, 1]);
  });

  test("of a mesh without tetrahedra is whole", () => {
    const read = parseVtu(writeVtu(empty));
    expect([read.points.length, read.tetrahedra, read.regions]).toEqual([15, [], []]);
  });
});

describe("MSH", () => {
  test("holds patches and regions as named groups with coordinates bit for bit", () => {
    const read = parseMsh(writeMsh(mesh, { patches: ["inlet", "unused", 'the "wall"'] }));
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

  test("tells groups of one name apart", () => {
    const read = parseMsh(writeMsh(mesh, { patches: ["wall", "", "wall"], regions: ["", " "] }));
    expect(read.triangles.map(({ name }) => name)).toEqual(["wall", "wall (patch 3)"]);
    expect(read.tetrahedra.map(({ name }) => name)).toEqual(["region 1", "region 2"]);
  });

  test("of a mesh without elements is whole", () => {
    expect(parseMsh(writeMsh(empty))).toMatchObject({ triangles: [], tetrahedra: [] });
  });
});
