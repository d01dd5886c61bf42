/** Fewer triangles in the place of many, on the same vertices. */
import { expect, it } from "vitest";
import { CoarseTriangles, type PatchTriangles } from "../../../web/viewer/coarse-triangles";

const coarseTriangles = (patches: PatchTriangles, aimed: number): Uint32Array =>
  new CoarseTriangles(aimed).of(patches);

/** Unit squares side by side along x, each of n × n × 2 triangles. */
function squares(count: number, n: number) {
  const positions: number[] = [];
  const index: number[] = [];
  const offsets = [0];
  for (let square = 0; square < count; ++square) {
    const first = positions.length / 3;
    for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) positions.push(2 * square + i / n, j / n, 0);
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < n; ++i) {
        const a = first + j * (n + 1) + i;
        index.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
      }
    offsets.push(index.length / 3);
  }
  return { positions: Float32Array.from(positions), index: Uint32Array.from(index), offsets };
}

const areaOf = (positions: ArrayLike<number>, index: Uint32Array): number => {
  let area = 0;
  for (let corner = 0; corner < index.length; corner += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * (index[corner + k] ?? 0));
    const at = (vertex = 0, k = 0): number => positions[vertex + k] ?? 0;
    area += ((at(b) - at(a)) * (at(c, 1) - at(a, 1)) - (at(c) - at(a)) * (at(b, 1) - at(a, 1))) / 2;
  }
  return area;
};

it("covers nearly the same area by about as many triangles as asked for", () => {
  const patches = squares(5, 40);
  const coarse = coarseTriangles(patches, 2000);
  expect(patches.index.length / 3).toBe(16000);
  expect(coarse.length / 3).toBeGreaterThan(1000);
  expect(coarse.length / 3).toBeLessThan(3000);
  expect(areaOf(patches.positions, patches.index)).toBeCloseTo(5, 5);
  // The edges of the squares stay where they are.
  expect(areaOf(patches.positions, coarse)).toBeCloseTo(5, 1);
});

it("keeps few triangles as they are, uses only given vertices, and lets no patch vanish", () => {
  const few = squares(2, 3);
  expect(coarseTriangles(few, 100)).toBe(few.index);
  const many = squares(30, 20);
  const coarse = coarseTriangles(many, 60);
  const used = new Set(coarse);
  for (let square = 0; square < 30; ++square) {
    const vertices = [...used].filter((vertex) => Math.floor(vertex / 441) === square);
    expect(vertices.length).toBeGreaterThanOrEqual(3);
  }
  for (let corner = 0; corner < coarse.length; corner += 3)
    expect(new Set(coarse.subarray(corner, corner + 3)).size).toBe(3);
});

it("takes patches without triangles or extent", () => {
  const { positions, index } = squares(1, 4);
  expect(coarseTriangles({ positions, index: new Uint32Array(), offsets: [0, 0] }, 10)).toHaveLength(0);
  const flat = new Float32Array(positions.length);
  expect(coarseTriangles({ positions: flat, index, offsets: [0, 32] }, 4)).toHaveLength(0);
});

it("keeps the triangles of the patches whose own are as before, wherever their vertices are", () => {
  const before = squares(5, 40);
  const coarse = new CoarseTriangles(2000);
  const first = coarse.of(before);
  // All vertices have moved, and the first square has fewer triangles: the vertices of the others have lower numbers.
  const [small, large] = [squares(1, 30), squares(1, 40)];
  const removed = (large.positions.length - small.positions.length) / 3;
  const others = before.index.subarray(large.index.length).map((vertex) => vertex - removed);
  const after = {
    positions: Float32Array.from(
      [...small.positions, ...before.positions.subarray(large.positions.length)],
      (x, k) => x + Math.sin(k),
    ),
    index: Uint32Array.from([...small.index, ...others]),
    offsets: before.offsets.map((offset) =>
      offset === 0 ? 0 : offset - (large.index.length - small.index.length) / 3,
    ),
  };
  const second = coarse.of(after);
  const isOther = (vertex: number, own: number): boolean => vertex >= own / 3;
  const kept = first.filter((vertex) => isOther(vertex, large.positions.length));
  expect(kept.length).toBeGreaterThan(1000);
  expect(second.filter((vertex) => isOther(vertex, small.positions.length))).toEqual(
    kept.map((vertex) => vertex - removed),
  );
  expect(second.length).toBeGreaterThan(kept.length);
});

it("makes known patches coarser while others are added, so that all together are about as many as aimed at", () => {
  const coarse = new CoarseTriangles(1000);
  let count = 0;
  for (let patches = 2; patches <= 30; ++patches) count = coarse.of(squares(patches, 20)).length / 3;
  const fresh = coarseTriangles(squares(30, 20), 1000).length / 3;
  expect(count).toBeGreaterThanOrEqual(fresh);
  expect(count).toBeLessThan(1.8 * fresh);
});
