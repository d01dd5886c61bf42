/**
 * Triangulation of polygons: keeps area, orientation, all corners and edges, without overlapping triangles.
 */
import { describe, expect, test } from "vitest";

import { addPolygon, ClippingBudget } from "../../../wasm/src/formats/polygons.js";
import { randomSource } from "../../support/random.js";

type Position = readonly [number, number];

/** Twice the signed area. */
const areaOf = (positions: readonly Position[]) =>
  positions.reduce((sum, [x, y], i) => {
    const [u, v] = positions[(i + 1) % positions.length] ?? [0, 0];
    return sum + x * v - y * u;
  }, 0);

/** Maps the polygon to an inclined plane; the images of the axes are orthogonal and of equal length. */
const inSpace = ([x, y]: Position) => [x + 2 * y, 2 * x + y, -2 * x + 2 * y].map((value) => value / 3);

function trianglesOf(positions: readonly Position[]): number[] | undefined {
  const triangles: number[] = [];
  const points = positions.flatMap(inSpace);
  const corners = positions.map((_, i) => i);
  return addPolygon(corners, points, triangles) ? triangles : undefined;
}

function expectCut(positions: readonly Position[]): void {
  const triangles = trianglesOf(positions);
  if (triangles === undefined) throw new Error("not cut");
  expect(triangles.length).toBe(3 * (positions.length - 2));
  const all = Array.from({ length: triangles.length / 3 }, (_, t) => triangles.slice(3 * t, 3 * t + 3));
  const areas = all.map((corners) => areaOf(corners.map((corner) => positions[corner] ?? [0, 0])));
  const whole = areaOf(positions);
  // If all triangles have the orientation of the polygon and their areas add up to its area, none overlap.
  for (const area of areas) expect(area * Math.sign(whole)).toBeGreaterThan(0);
  expect(areas.reduce((a, b) => a + b)).toBeCloseTo(whole, 9);
  const edges = new Set(all.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
  positions.forEach((_, i) => expect(edges).toContain(`${i} ${(i + 1) % positions.length}`));
}

const comb = (teeth: number): Position[] => [
  ...Array.from({ length: teeth }, (_, i): Position[] => [
    [2 * i, 0],
    [2 * i + 1, 5],
  ]).flat(),
  [2 * teeth, 0],
  [2 * teeth, -1],
  [0, -1],
];
const spiral = (turns: number): Position[] => {
  const arm = (radius: number) =>
    Array.from({ length: 12 * turns }, (_, i): Position => {
      const angle = (i * Math.PI) / 6;
      return [(radius + i) * Math.cos(angle), (radius + i) * Math.sin(angle)];
    });
  return [...arm(10), ...arm(14).reverse()];
};

const around = (count: number, radius: (i: number) => number): Position[] =>
  Array.from({ length: count }, (_, i) => [
    radius(i) * Math.cos((2 * Math.PI * i) / count),
    radius(i) * Math.sin((2 * Math.PI * i) / count),
  ]);

const onCircle = (degrees: number): Position => [
  Math.cos((degrees * Math.PI) / 180),
  Math.sin((degrees * Math.PI) / 180),
];

describe("triangulates a polygon:", () => {
  test.each<[string, readonly Position[]]>([
    [
      "a dart",
      [
        [0, 0],
        [2, 2],
        [0, 1],
        [-2, 2],
      ],
    ],
    [
      "an L",
      [
        [0, 0],
        [2, 0],
        [2, 1],
        [1, 1],
        [1, 2],
        [0, 2],
      ],
    ],
    [
      "a square with extra corners on its edges",
      [
        [0, 0],
        [1, 0],
        [2, 0],
        [2, 1],
        [2, 2],
        [1, 2],
        [0, 2],
        [0, 1],
      ],
    ],
    [
      "a triangle with an extra corner on its first edge",
      [
        [0, 0],
        [1, 0],
        [2, 0],
        [0, 2],
      ],
    ],
    ["a comb", comb(20)],
    ["a spiral", spiral(3)],
    [
      "a star",
      Array.from({ length: 40 }, (_, i): Position => {
        const radius = i % 2 === 0 ? 1 : 0.3;
        return [radius * Math.cos((i * Math.PI) / 20), radius * Math.sin((i * Math.PI) / 20)];
      }),
    ],
    [
      "a frame, opened along a cut",
      [
        [0, 0],
        [4, 0],
        [4, 4],
        [0, 4],
        [0, 0],
        [1, 1],
        [1, 3],
        [3, 3],
        [3, 1],
        [1, 1],
      ],
    ],
  ])("%s", (_, positions) => {
    expectCut(positions);
    expectCut([...positions].reverse());
  });

  test("around a point with random radii", () => {
    const random = randomSource(3);
    for (let n = 4; n < 60; n++) {
      expectCut(
        Array.from({ length: n }, (_, i): Position => {
          const radius = 0.2 + random() / 2 ** 32;
          return [radius * Math.cos((2 * Math.PI * i) / n), radius * Math.sin((2 * Math.PI * i) / n)];
        }),
      );
    }
  });

  test.each<[string, readonly Position[]]>([
    [
      "a bow tie",
      [
        [0, 0],
        [1, 1],
        [1, 0],
        [0, 1],
      ],
    ],
    [
      "a band that overlaps itself",
      [
        [0, 0],
        [4, 0],
        [4, 3],
        [1, 3],
        [1, -1],
        [2, -1],
        [2, 2],
        [3, 2],
        [3, 1],
        [0, 1],
      ],
    ],
    [
      "collinear corners",
      [
        [0, 0],
        [1, 0],
        [2, 0],
        [3, 0],
      ],
    ],
    [
      "coincident corners",
      [
        [1, 1],
        [1, 1],
        [1, 1],
        [1, 1],
      ],
    ],
    [
      "one that winds around its first corner more than once",
      [[0, 0], ...[0, 100, 200, 300, 40, 140].map(onCircle)],
    ],
  ])("but not %s", (_, positions) => {
    expect(trianglesOf(positions)).toBeUndefined();
  });

  test.each<[string, (count: number) => Position[]]>([
    ["a gear", (count) => around(count, (i) => (i % 2 === 0 ? 1 : 1 - 10 / count))],
    ["a comb", (count) => comb(count / 2)],
    ["a circle", (count) => around(count, () => 1)],
  ])("%s with very many corners, in a time that grows about linearly", (_, shape) => {
    const steps = (count: number) => {
      const positions = shape(count);
      const budget = new ClippingBudget();
      const used = countSteps(budget);
      const triangles: number[] = [];
      const corners = positions.map((_, i) => i);
      expect(addPolygon(corners, positions.flatMap(inSpace), triangles, budget)).toBe(true);
      expect(triangles).toHaveLength(3 * (positions.length - 2));
      return used();
    };
    // Quadratic growth would take a hundred times as many steps.
    expect(steps(20_000)).toBeLessThan(20 * Math.max(steps(2_000), 1));
  });
});

/** Counts the steps taken from a budget from now on. Returns their number so far. */
function countSteps(budget: ClippingBudget): () => number {
  let used = 0;
  const spend = budget.spend.bind(budget);
  budget.spend = (corners, use) =>
    spend(corners, (work) => {
      const { left } = work;
      const result = use(work);
      used += left - work.left;
      return result;
    });
  return () => used;
}

test("clipping stops at its budget per file, handles polygons of usual size, and yields in between", () => {
  let pauses = 0;
  const budget = new ClippingBudget(() => pauses++);
  const cut = (positions: readonly Position[]) =>
    addPolygon(
      positions.map((_, i) => i),
      positions.flatMap(inSpace),
      [],
      budget,
    );
  const star = around(60, (i) => (i % 2 === 0 ? 1 : 0.5));
  for (let i = 0; i < 500; i++) expect(cut(star)).toBe(true);
  expect(pauses).toBeGreaterThan(2);
  // The teeth are inclined: the box of each one overlaps the boxes of thousands of others.
  const slanted = comb(20_000).map(([x, y]): Position => [x / 4e4 - y, x / 4e4 + y]);
  const steps = countSteps(budget);
  for (let i = 0; i < 5; i++) expect(cut(slanted)).toBe(false);
  // 40 000 corners: a step per pair of them would be 800 million, five times.
  expect(steps()).toBeLessThan(1.3e8);
  expect(cut(star)).toBe(true);
});
