/** Polygons cut into triangles: area, turn, every corner and every edge stay, and no two triangles overlap. */
import { describe, expect, test } from "vitest";

import { addPolygon, ClippingBudget } from "../../../wasm/src/formats/polygons.js";
import { randomSource } from "../../support/random.js";

type Place = readonly [number, number];

/** Twice the signed area. */
const areaOf = (places: readonly Place[]) =>
  places.reduce((sum, [x, y], i) => {
    const [u, v] = places[(i + 1) % places.length] ?? [0, 0];
    return sum + x * v - y * u;
  }, 0);

/** A plane in space that no axis knows; its axes are orthogonal and of one length. */
const inSpace = ([x, y]: Place) => [x + 2 * y, 2 * x + y, -2 * x + 2 * y].map((value) => value / 3);

function trianglesOf(places: readonly Place[]): number[] | undefined {
  const triangles: number[] = [];
  const points = places.flatMap(inSpace);
  const corners = places.map((_, i) => i);
  return addPolygon(corners, points, triangles) ? triangles : undefined;
}

function expectCut(places: readonly Place[]): void {
  const triangles = trianglesOf(places);
  if (triangles === undefined) throw new Error("not cut");
  expect(triangles.length).toBe(3 * (places.length - 2));
  const all = Array.from({ length: triangles.length / 3 }, (_, t) => triangles.slice(3 * t, 3 * t + 3));
  const areas = all.map((corners) => areaOf(corners.map((corner) => places[corner] ?? [0, 0])));
  const whole = areaOf(places);
  // Triangles that all turn as the polygon does and have its area together do not overlap.
  for (const area of areas) expect(area * Math.sign(whole)).toBeGreaterThan(0);
  expect(areas.reduce((a, b) => a + b)).toBeCloseTo(whole, 9);
  const edges = new Set(all.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
  places.forEach((_, i) => expect(edges).toContain(`${i} ${(i + 1) % places.length}`));
}

const comb = (teeth: number): Place[] => [
  ...Array.from({ length: teeth }, (_, i): Place[] => [
    [2 * i, 0],
    [2 * i + 1, 5],
  ]).flat(),
  [2 * teeth, 0],
  [2 * teeth, -1],
  [0, -1],
];
const spiral = (turns: number): Place[] => {
  const arm = (radius: number) =>
    Array.from({ length: 12 * turns }, (_, i): Place => {
      const angle = (i * Math.PI) / 6;
      return [(radius + i) * Math.cos(angle), (radius + i) * Math.sin(angle)];
    });
  return [...arm(10), ...arm(14).reverse()];
};

const around = (count: number, radius: (i: number) => number): Place[] =>
  Array.from({ length: count }, (_, i) => [
    radius(i) * Math.cos((2 * Math.PI * i) / count),
    radius(i) * Math.sin((2 * Math.PI * i) / count),
  ]);

const onCircle = (degrees: number): Place => [
  Math.cos((degrees * Math.PI) / 180),
  Math.sin((degrees * Math.PI) / 180),
];

describe("a polygon is cut into triangles", () => {
  test.each<[string, readonly Place[]]>([
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
      "a square with corners on its edges",
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
      "a triangle with a corner on its first edge",
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
      Array.from({ length: 40 }, (_, i): Place => {
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
  ])("%s", (_, places) => {
    expectCut(places);
    expectCut([...places].reverse());
  });

  test("around a point, whatever its radii", () => {
    const random = randomSource(3);
    for (let n = 4; n < 60; n++) {
      expectCut(
        Array.from({ length: n }, (_, i): Place => {
          const radius = 0.2 + random() / 2 ** 32;
          return [radius * Math.cos((2 * Math.PI * i) / n), radius * Math.sin((2 * Math.PI * i) / n)];
        }),
      );
    }
  });

  test.each<[string, readonly Place[]]>([
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
      "corners on one line",
      [
        [0, 0],
        [1, 0],
        [2, 0],
        [3, 0],
      ],
    ],
    [
      "corners in one place",
      [
        [1, 1],
        [1, 1],
        [1, 1],
        [1, 1],
      ],
    ],
    [
      "one that goes around its first corner more than once, always turning the same way",
      [[0, 0], ...[0, 100, 200, 300, 40, 140].map(onCircle)],
    ],
  ])("but not %s", (_, places) => {
    expect(trianglesOf(places)).toBeUndefined();
  });

  test.each<[string, (count: number) => Place[]]>([
    ["a gear", (count) => around(count, (i) => (i % 2 === 0 ? 1 : 1 - 10 / count))],
    ["a comb", (count) => comb(count / 2)],
    ["a circle", (count) => around(count, () => 1)],
  ])("%s of very many corners, in a time that grows about as they do", (_, shape) => {
    const steps = (count: number) => {
      const places = shape(count);
      const budget = new ClippingBudget();
      let used = 0;
      const spend = budget.spend.bind(budget);
      budget.spend = (corners, use) =>
        spend(corners, (work) => {
          const { left } = work;
          const result = use(work);
          used = left - work.left;
          return result;
        });
      const triangles: number[] = [];
      const corners = places.map((_, i) => i);
      expect(addPolygon(corners, places.flatMap(inSpace), triangles, budget)).toBe(true);
      expect(triangles).toHaveLength(3 * (places.length - 2));
      return used;
    };
    // Quadratic, it would be a hundred times as long.
    expect(steps(20_000)).toBeLessThan(20 * Math.max(steps(2_000), 1));
  });
});

test("what a file asks of clipping is bounded; polygons of usual sizes are not, and others may run meanwhile", () => {
  let rests = 0;
  const budget = new ClippingBudget(() => rests++);
  const cut = (places: readonly Place[]) =>
    addPolygon(
      places.map((_, i) => i),
      places.flatMap(inSpace),
      [],
      budget,
    );
  const star = around(60, (i) => (i % 2 === 0 ? 1 : 0.5));
  for (let i = 0; i < 500; i++) expect(cut(star)).toBe(true);
  expect(rests).toBeGreaterThan(2);
  // Teeth across the axes: the box of each meets those of thousands of others.
  const slanted = comb(20_000).map(([x, y]): Place => [x / 4e4 - y, x / 4e4 + y]);
  const began = performance.now();
  for (let i = 0; i < 5; i++) expect(cut(slanted)).toBe(false);
  expect(performance.now() - began).toBeLessThan(60_000);
  expect(cut(star)).toBe(true);
});
