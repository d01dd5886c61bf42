/** Polygons that are filled in the plane: those of tests/support/planes.h, and what their triangles must fulfil. */
import { readFileSync } from "node:fs";
import type { FillPlaneOptions, FilledPlane, FillPlaneResult, PlaneSizes } from "tetrafront/trace";

export interface StoredPlane {
  readonly name: string;
  readonly loops: readonly Float64Array[];
  readonly sizes: PlaneSizes;
  readonly options: FillPlaneOptions;
  readonly fingerprint: string;
}

/** Returns the polygons of tests/fingerprints/planes.txt; planes.h describes the words of its lines. */
export function storedPlanes(): readonly StoredPlane[] {
  const text = readFileSync(new URL("../fingerprints/planes.txt", import.meta.url), "utf8");
  return text.trim().split("\n").map(planeIn);
}

function planeIn(line: string): StoredPlane {
  const words = line.split(" ");
  const next = (): string => words.shift() ?? "";
  const number = (): number => Number(next());
  const list = <Item>(count: number, read: () => Item): Item[] => Array.from({ length: count }, read);
  const [name, order, seed, boundary, improve] = [next(), next(), number(), next(), next()];
  const size = number();
  const loops = list(number(), () => Float64Array.from(list(2 * number(), number)));
  const sources = list(number(), () => ({
    position: [number(), number()] as const,
    size: number(),
    distance: number(),
    growth: number(),
  }));
  const options = { order, seed, boundary, improve: improve === "improved" } as FillPlaneOptions;
  return { name, loops, sizes: { size, sources }, options, fingerprint: next() };
}

/** Returns a result that must be a success. */
export function successOf(result: FillPlaneResult): FilledPlane {
  if (!result.success) throw new Error(result.message);
  return result;
}

/** Area of a polygon by the shoelace formula: that of the first loop minus those of the others. */
export function polygonArea(loops: readonly Float64Array[]): number {
  const areas = loops.map((loop) => {
    let twice = 0;
    for (let i = 0; i < loop.length; i += 2) {
      const [x = 0, y = 0] = loop.subarray(i, i + 2);
      const j = (i + 2) % loop.length;
      twice += x * (loop[j + 1] ?? 0) - y * (loop[j] ?? 0);
    }
    return Math.abs(twice) / 2;
  });
  return areas.reduce((sum, area, i) => (i === 0 ? area : sum - area), 0);
}

/** Signed areas of triangles in the plane. */
export function triangleAreas(points: Float64Array, triangles: Uint32Array): readonly number[] {
  return Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [ax, ay, bx, by, cx, cy] = [...triangles.subarray(3 * t, 3 * t + 3)].flatMap((node) => [
      points[2 * node] ?? 0,
      points[2 * node + 1] ?? 0,
    ]) as [number, number, number, number, number, number];
    return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2;
  });
}
