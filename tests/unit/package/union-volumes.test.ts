/**
 * Volumes of the unions that a repair makes of bodies which intersect: against analytic values, and against Monte Carlo
 * integration with tests of points that share no code with the engine.
 */
import { createMesher, type Mesher, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { randomSource } from "../../support/random.js";

type Triple = readonly [number, number, number];

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** A body with its surface and an independent test of points. */
interface Body {
  readonly surface: SurfaceInput;
  readonly contains: (position: Triple) => boolean;
}

/** Returns a prism over an outline that goes counter-clockwise around the z axis and is visible from it. */
function prism(
  outline: readonly (readonly [number, number])[],
  [low, high]: readonly [number, number],
): Body {
  const n = outline.length;
  const points = [low, high].flatMap((z) => [...outline.flatMap(([x, y]) => [x, y, z]), 0, 0, z]);
  const triangles = outline.flatMap((_, i) => {
    const [a, b] = [i, (i + 1) % n];
    const [c, d] = [a + n + 1, b + n + 1];
    return [a, b, d, a, d, c, n, b, a, 2 * n + 1, c, d];
  });
  const contains = ([x, y, z]: Triple) =>
    z > low &&
    z < high &&
    outline.some(([ax, ay], i) => {
      const [bx, by] = outline[(i + 1) % n] ?? [0, 0];
      const isAhead = ax * y - ay * x >= 0 && x * by - y * bx > 0;
      return isAhead && (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
    });
  return { surface: surfaceOf(points, triangles), contains };
}

const box = (size: number): Body =>
  prism(
    [
      [-size, -size],
      [size, -size],
      [size, size],
      [-size, size],
    ],
    [-size, size],
  );

function gear(teeth: number): Body {
  const outline = Array.from({ length: 4 * teeth }, (_, i) => {
    const radius = i % 4 < 2 ? 1 : 0.8;
    const angle = (2 * Math.PI * i) / (4 * teeth);
    return [radius * Math.cos(angle), radius * Math.sin(angle)] as const;
  });
  return prism(outline, [-0.3, 0.3]);
}

/** Returns the convex polyhedron of points on circles of latitude. */
function sphere(rings: number): Body {
  const sides = 2 * rings;
  const points = [0, 0, -1];
  for (let r = 1; r < rings; r++) {
    const [z, radius] = [-Math.cos((Math.PI * r) / rings), Math.sin((Math.PI * r) / rings)];
    for (let s = 0; s < sides; s++) {
      const angle = (2 * Math.PI * s) / sides;
      points.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
    }
  }
  points.push(0, 0, 1);
  const last = points.length / 3 - 1;
  const node = (r: number, s: number) =>
    r === 0 ? 0 : r === rings ? last : 1 + (r - 1) * sides + (s % sides);
  const triangles: number[] = [];
  for (let r = 0; r < rings; r++) {
    for (let s = 0; s < sides; s++) {
      const [a, b, c, d] = [node(r, s), node(r, s + 1), node(r + 1, s + 1), node(r + 1, s)];
      if (a !== b) triangles.push(a, b, c);
      if (c !== d) triangles.push(a, c, d);
    }
  }
  const surface = surfaceOf(points, triangles);
  const planes = planesOf(surface);
  return { surface, contains: (at) => planes.every(([n, d]) => dot(n, at) < d) };
}

const surfaceOf = (points: readonly number[], triangles: readonly number[]): SurfaceInput => ({
  points: Float64Array.from(points),
  triangles: Uint32Array.from(triangles),
});

const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Returns normal and distance of the plane of each triangle. */
function planesOf({ points, triangles }: SurfaceInput): (readonly [Triple, number])[] {
  const at = (node = 0): Triple => [
    points[3 * node] ?? 0,
    points[3 * node + 1] ?? 0,
    points[3 * node + 2] ?? 0,
  ];
  return Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [a, b, c] = [at(triangles[3 * t]), at(triangles[3 * t + 1]), at(triangles[3 * t + 2])];
    const u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    const v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]] as const;
    const normal: Triple = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    return [normal, dot(normal, a)] as const;
  });
}

function moved({ surface, contains }: Body, by: Triple): Body {
  return {
    surface: { ...surface, points: surface.points.map((x, i) => x + (by[i % 3] ?? 0)) },
    contains: ([x, y, z]) => contains([x - by[0], y - by[1], z - by[2]]),
  };
}

/** Returns the volume of the repaired surface of both bodies; the second one may be inside out. */
async function volumeOf(one: Body, other: Body, isInsideOut = false): Promise<number> {
  const nodes = one.surface.points.length / 3;
  const second = [...other.surface.triangles].map((node) => node + nodes);
  const both = {
    points: Float64Array.of(...one.surface.points, ...other.surface.points),
    triangles: Uint32Array.of(...one.surface.triangles, ...(isInsideOut ? second.reverse() : second)),
  };
  const repair = await mesher.repairSurface(both);
  const found = await mesher.inspectSurface(repair.mesh);
  expect(found.isFillable).toBe(true);
  return found.volume;
}

const SAMPLES = 400_000;
const REACH = 2.5;

/** Returns the volume of the union by random points, and its largest expected error: five standard deviations. */
function sampled(one: Body, other: Body, seed: number) {
  const random = randomSource(seed);
  const coordinate = () => REACH * ((2 * random()) / 2 ** 32 - 1);
  let inside = 0;
  for (let i = 0; i < SAMPLES; i++) {
    const at: Triple = [coordinate(), coordinate(), coordinate()];
    if (one.contains(at) || other.contains(at)) inside++;
  }
  const perSample = (2 * REACH) ** 3 / SAMPLES;
  return { volume: perSample * inside, error: 5 * perSample * Math.sqrt(inside) };
}

test("boxes have the analytic volume", async () => {
  const [one, other] = [box(1), moved(box(0.5), [1, 0.25, 0.125])];
  const common = 0.5 * 1 * 1;
  expect(await volumeOf(one, other)).toBeCloseTo(8 + 1 - common, 9);
  // A shell that was given inside out is turned.
  expect(await volumeOf(one, other, true)).toBeCloseTo(8 + 1 - common, 9);
});

describe.each([
  ["two spheres", sphere(12), moved(sphere(9), [0.7, 0.31, 0.23]), 1],
  ["a gear and a sphere", gear(9), moved(sphere(8), [0.6, 0.4, 0.5]), 2],
  ["two gears", gear(11), moved(gear(7), [0.9, 0.35, 0.17]), 3],
  ["a box and a gear", box(0.7), moved(gear(12), [0.2, 0.1, 0.55]), 4],
] as const)("%s", (_, one, other, seed) => {
  test("have the volume of random points", async () => {
    const { volume, error } = sampled(one, other, seed);
    expect(Math.abs((await volumeOf(one, other)) - volume)).toBeLessThan(error);
  });
});
