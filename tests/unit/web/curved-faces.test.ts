import { expect, it } from "vitest";
import { CurvedFaces, shareUnit, trianglesPerFace } from "../../../web/viewer/queries/curved-faces";
import { MeshQueries } from "../../../web/viewer/queries/mesh-queries";
import { gridMesh } from "./grid-mesh";

type Vector = readonly [number, number, number];
const at = (values: ArrayLike<number>, i: number): Vector => [
  values[3 * i] ?? 0,
  values[3 * i + 1] ?? 0,
  values[3 * i + 2] ?? 0,
];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Six times the volume within triangles. */
const sixfold = (corners: Float32Array): number => {
  let sum = 0;
  for (let t = 0; t < corners.length / 9; ++t)
    sum += dot(at(corners, 3 * t), cross(at(corners, 3 * t + 1), at(corners, 3 * t + 2)));
  return sum;
};

/** A tetrahedron at the origin with edges 1 along the axes; `middle`: of the edge between its nodes on x and on y. */
const tetrahedron = (middle: Vector) => ({
  points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
  tetrahedra: Uint32Array.of(0, 1, 2, 3),
  tetrahedronRegion: new Uint32Array(1),
  curvedEdges: { edges: Uint32Array.of(2, 1), middles: Float64Array.from(middle) },
});
const whole = {
  origin: [0, 0, 0],
  cut: null,
  hiddenRegions: new Set<number>(),
  shading: "region",
  qualitySpace: "space",
} as const;

it("curved faces are drawn with 16 triangles, the others with one", () => {
  const { faces, corners, shares, values, onBoundary } = new MeshQueries({
    mesh: tetrahedron([0.7, 0.7, 0]),
  }).facesOf(whole);
  // Two faces are at the edge.
  expect(trianglesPerFace).toBe(16);
  expect(faces).toHaveLength(2 * 16 + 2);
  expect([corners.length, shares.length, values.length]).toEqual([9, 9, 3].map((n) => n * faces.length));
  expect([...onBoundary]).toEqual([...faces].map(() => 1));
});

it("the triangles of a closed surface have no gaps, face outward, and pass through the middles", () => {
  const curved = new CurvedFaces(tetrahedron([0.7, 0.7, -0.1]), tetrahedron([0.7, 0.7, -0.1]).curvedEdges);
  const { corners } = curved.trianglesOf(Uint32Array.of(0, 1, 2, 3), [0, 0, 0]);
  const keyOf = (corner: number): string =>
    at(corners, corner)
      .map((x) => x.toFixed(6))
      .join();
  const keys = Array.from({ length: corners.length / 3 }, (_, corner) => keyOf(corner));
  expect(keys).toContain([0.7, 0.7, -0.1].map((x) => Math.fround(x).toFixed(6)).join());
  // Both triangles at an edge pass it in opposite directions; only straight edges may have several pieces on one side.
  const directed = new Map<string, number>();
  keys.forEach((from, corner) => {
    const to = keys[corner % 3 === 2 ? corner - 2 : corner + 1] ?? "";
    directed.set(`${from} ${to}`, (directed.get(`${from} ${to}`) ?? 0) + 1);
  });
  expect(Math.max(...directed.values())).toBe(1);
  const open = [...directed.keys()].filter((key) => !directed.has(key.split(" ").reverse().join(" ")));
  const isStraight = (key: string) => {
    const [x = 0, y = 0] = key.split(",").map(Number);
    return x < 1e-6 || y < 1e-6;
  };
  expect(open.every((key) => key.split(" ").every(isStraight))).toBe(true);
  expect(sixfold(corners)).toBeGreaterThan(1);
});

it("an edge with its middle halfway leaves the shape of the mesh, and every corner where its share says", () => {
  const mesh = tetrahedron([0.5, 0.5, 0]);
  const { corners, shares } = new CurvedFaces(mesh, mesh.curvedEdges).trianglesOf(
    Uint32Array.of(0, 1, 2, 3),
    [1, 2, 3],
  );
  const moved = corners.map((x, i) => x + ([1, 2, 3][i % 3] ?? 0));
  expect(sixfold(moved)).toBeCloseTo(1, 5);
  for (let corner = 0; corner < shares.length / 3; ++corner)
    expect(at(shares, corner).reduce((sum, share) => sum + share * shareUnit, 0)).toBe(1);
});

it("a mesh without curved edges has one triangle per face", () => {
  const { faces, shares } = new MeshQueries({ mesh: gridMesh(2) }).facesOf(whole);
  expect(faces).toHaveLength(6 * 4 * 2);
  expect(shares).toHaveLength(0);
});
