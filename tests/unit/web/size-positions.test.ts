import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { sizeSurface } from "../../../web/document/size-positions";
import { factsOf } from "../../../web/document/triangle-facts";
import { sizeColors } from "../../../web/viewer/layers/sizes-layer";
import { boxSurface } from "../../support/surfaces";
import { preview } from "./scene";

/** A line of length 4 and a triangle of area 8, in the plane z = 0. */
const samples = preview([[0, 0, 0, 4, 0, 0]], [[0, 0, 0, 4, 0, 0, 0, 4, 0]]);

function areaOf({ points }: { readonly points: Float64Array }, triangles: Uint32Array): number {
  let area = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a = 0, b = 0, c = 0] = [...triangles.subarray(t, t + 3)].map((node) => 3 * node);
    const at = (node: number, k: number): number => points[node + k] ?? NaN;
    const u = [0, 1, 2].map((k) => at(b, k) - at(a, k));
    const v = [0, 1, 2].map((k) => at(c, k) - at(a, k));
    const across = [0, 1, 2].map((k) => {
      const [i, j] = [(k + 1) % 3, (k + 2) % 3];
      return (u[i] ?? 0) * (v[j] ?? 0) - (u[j] ?? 0) * (v[i] ?? 0);
    });
    area += Math.hypot(...across) / 2;
  }
  return area;
}

it("divides lines and patches into pieces that cover them", async () => {
  const surface = await sizeSurface(emptyProject(), samples, [], null);
  expect(areaOf(surface, surface.triangles)).toBeCloseTo(8, 9);
  expect(surface.plane).toHaveLength(0);
  let length = 0;
  for (let s = 0; s < surface.segments.length; s += 2) {
    const [a = 0, b = 0] = surface.segments.subarray(s, s + 2);
    const piece = Math.abs((surface.points[3 * a] ?? NaN) - (surface.points[3 * b] ?? NaN));
    expect(piece).toBeLessThanOrEqual(Math.hypot(4, 4) / 40 + 1e-9);
    length += piece;
  }
  expect(length).toBeCloseTo(4, 9);
});

it("lays a plane across the model, a little larger than it", async () => {
  const { low, high } = { low: [0, 0, 0], high: [4, 4, 0] };
  const surface = await sizeSurface(emptyProject(), samples, [], { axis: "z", position: 0.5 });
  expect(areaOf(surface, surface.plane)).toBeCloseTo(16 * 1.16 ** 2, 6);
  const corners = [...surface.plane].map((node) => [...surface.points.subarray(3 * node, 3 * node + 3)]);
  for (const axis of [0, 1]) {
    const values = corners.map((corner) => corner[axis] ?? NaN);
    expect(Math.min(...values)).toBeLessThan(low[axis] ?? 0);
    expect(Math.max(...values)).toBeGreaterThan(high[axis] ?? 0);
  }
});

it("covers prepared bodies, and lays the plane across them", async () => {
  const { points, triangles } = boxSurface(1, [10, 10, 10], [12, 12, 12]);
  const body = { body: 7, points, triangles };
  const surface = await sizeSurface(emptyProject(), preview([]), [body], { axis: "z", position: 0.5 });
  expect(surface.bodies).toEqual([7]);
  expect(areaOf(surface, surface.triangles)).toBeCloseTo(24, 9);
  expect(areaOf(surface, surface.plane)).toBeCloseTo(4 * 1.16 ** 2, 6);
  const [, , z] = surface.points.subarray(3 * (surface.plane[0] ?? 0));
  expect(z).toBe(11);
});

it("covers a model with too many patches and lines, with longer pieces", async () => {
  const patches = Array.from({ length: 8000 }, (_, k) => [0, 0, k, 1000, 0, k, 0, 1000, k]);
  const surface = await sizeSurface(emptyProject(), preview([[0, 0, 0, 4000, 0, 0]], patches), [], null);
  expect(areaOf(surface, surface.triangles) / (8000 * 5e5)).toBeCloseTo(1, 9);
  expect(surface.points.length / 3).toBeLessThanOrEqual(60_000);
  // Not all the way down to one piece, if that is not needed.
  expect(surface.triangles.length / 3).toBeGreaterThan(8000);
});

it("covers a body with more nodes than positions", async () => {
  const { points, triangles } = boxSurface(110);
  expect(points.length / 3).toBeGreaterThan(60_000);
  const surface = await sizeSurface(emptyProject(), preview([]), [{ body: 1, points, triangles }], null);
  expect(areaOf(surface, surface.triangles)).toBeCloseTo(6, 9);
  expect(surface.points).toHaveLength(points.length);
});

it("colours the smallest size by the first colour, the largest by the last, and their geometric mean between them", () => {
  const ramp = ["#000000", "#ffffff"];
  const sizes = Float64Array.of(0.01, 0.1, 1);
  const rgb = sizeColors({ sizes, range: [0.01, 1] }, ramp);
  expect([...rgb].map((value) => Math.round(100 * value))).toEqual([0, 0, 0, 50, 50, 50, 100, 100, 100]);
  // One size everywhere has one colour.
  expect(new Set(sizeColors({ sizes: Float64Array.of(2, 2), range: [2, 2] }, ramp)).size).toBe(1);
});

it("keeps the facts of a body while the plane moves, and lets the page act in between", async () => {
  const { points, triangles } = boxSurface(40);
  const reads = { points: 0 };
  const counted = new Proxy(points, {
    get: (target, key) => {
      if (typeof key === "string" && /^\d+$/.test(key)) ++reads.points;
      return Reflect.get(target, key, target) as unknown;
    },
  });
  const body = { body: 1, points: counted, triangles };
  const surface = (position: number) =>
    sizeSurface(emptyProject(), preview([]), [body], { axis: "z", position });
  let turns = 0;
  const timer = setInterval(() => ++turns, 0);
  await surface(0.2);
  expect(turns).toBeGreaterThan(0);
  const first = reads.points;
  const moved = await surface(0.8);
  clearInterval(timer);
  // Each node is read once more, for the positions; its triangles are not measured again.
  expect(reads.points - first).toBe(points.length);
  expect(first).toBeGreaterThan(3 * triangles.length);
  expect(moved.points).toHaveLength(points.length + 3 * 49 ** 2);
});

it("rejects soon after it is aborted, and the next question goes on with the measurement", async () => {
  const { points, triangles } = boxSurface(60);
  const body = { body: 1, points, triangles };
  const abort = new AbortController();
  const plane = { axis: "z", position: 0.2 } as const;
  const first = sizeSurface(emptyProject(), preview([]), [body], plane, abort.signal);
  const facts = factsOf(body);
  abort.abort(new Error("replaced"));
  await expect(first).rejects.toThrow("replaced");
  const second = await sizeSurface(emptyProject(), preview([]), [body], plane);
  expect(areaOf(second, second.triangles)).toBeCloseTo(6, 9);
  expect(await factsOf(body)).toBe(await facts);
});
