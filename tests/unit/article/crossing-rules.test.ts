/** The crossing test of lesson 6, in the plane and in space, against independent checks. */
import { describe, expect, test } from "vitest";
import {
  testCrossing,
  type Crossed,
  type Point,
} from "../../../web/teach/article/figures/crossing/crossing-rules";
import { isStoppedByFourth, pairsOf } from "../../../web/teach/article/figures/crossing-space/pairs";
import { decidingLayer } from "../../../web/teach/article/figures/crossing-space/space-layers";
import { paintedPieces } from "../../../web/teach/article/figures/crossing-space/painted-pieces";
import type { Position } from "../../../web/document/position";
import type { Triangle } from "../../../web/teach/player/crossing";

/** Numbers from 0 to 1, the same in every run. */
function* randomNumbers(seed: number): Generator<number, never> {
  for (let state = seed; ;) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state / 2 ** 32;
  }
}

const triangle = { a: [0, 0], b: [1, 0], p: [0.5, 1] } as const;

describe("the crossing test in the plane", () => {
  test.each([
    ["boxes apart", [1.2, 0], [1.5, 1], 1, false],
    ["beyond a line", [0.9, 0.9], [1.1, 0.2], 2, false],
    ["a crossing", [-0.5, 0.5], [1.5, 0.5], 3, true],
    ["a side inside", [0.45, 0.3], [0.55, 0.4], 3, false],
  ] as const)("%s", (_name, q, r, layer, isCrossing) => {
    const found = testCrossing({ ...triangle, q, r }, 0);
    expect([found.layer, found.isCrossing]).toEqual([layer, isCrossing]);
  });

  test("a side inside is known to be inside", () => {
    expect(testCrossing({ ...triangle, q: [0.45, 0.3], r: [0.55, 0.4] }, 0).isInside).toBe(true);
  });

  test("a near miss is refused with a tolerance alone", () => {
    const near: Crossed = { ...triangle, q: [0.2, 1.02], r: [0.8, 1.02] };
    expect(testCrossing(near, 0).isCrossing).toBe(false);
    const found = testCrossing(near, 0.05);
    expect([found.isCrossing, found.meets]).toEqual([true, false]);
  });

  test("a common node is no crossing", () => {
    const found = testCrossing({ ...triangle, q: [0.5, 1], r: [1.2, 0.4] }, 0.05);
    expect(found.pairs.every(({ isShared }) => isShared)).toBe(true);
    expect(found.isCrossing).toBe(false);
  });

  test.each([
    ["starts into the triangle and ends inside", [0.5, 1], [0.5, 0.4], true],
    ["starts into the triangle and leaves it through the active side", [0.4, -0.6], [0.5, 1], true],
    ["starts into the triangle from an end of the active side", [0, 0], [0.9, 0.9], true],
    ["lies along a new side", [0.5, 1], [0.75, 0.5], true],
    ["leaves the corner outwards", [0.5, 1], [0.6, 1.6], false],
    ["leaves the corner beside the triangle", [0.5, 1], [1.2, 0.1], false],
    ["is a new side itself", [0.5, 1], [1, 0], false],
  ] as const)("a side with a common node that %s", (_name, q, r, isCrossing) => {
    expect(testCrossing({ ...triangle, q, r }, 0).isCrossing).toBe(isCrossing);
  });

  test("a near miss of two sides beside each other is allowed, as the lesson says", () => {
    const beside: Crossed = { ...triangle, q: [0.88, 0.27], r: [0.64, 0.75] };
    const found = testCrossing(beside, 0.05);
    expect([found.layer, found.isCrossing]).toEqual([3, false]);
    expect(found.pairs[1].excess).toBeGreaterThan(100);
  });

  test("random sides cross if their ends lie on different sides of a new side, and its ends on different sides of them", () => {
    const numbers = randomNumbers(46);
    const point = (): Point => [numbers.next().value * 2 - 0.5, numbers.next().value * 2 - 0.5];
    const sign = (a: Point, b: Point, c: Point) =>
      Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    let crossings = 0;
    for (let i = 0; i < 2000; i++) {
      const [q, r] = [point(), point()];
      const meets = [triangle.a, triangle.b].some(
        (from) =>
          sign(from, triangle.p, q) !== sign(from, triangle.p, r) &&
          sign(q, r, from) !== sign(q, r, triangle.p),
      );
      const found = testCrossing({ ...triangle, q, r }, 0);
      expect(found.isCrossing, JSON.stringify([q, r])).toBe(meets);
      if (meets) crossings++;
    }
    expect(crossings).toBeGreaterThan(200);
  });

  test("equation 1 holds at the point where both lines meet", () => {
    const [q, r] = [
      [-0.5, 0.2],
      [1.5, 0.9],
    ] as const;
    for (const { from, alphas, at } of testCrossing({ ...triangle, q, r }, 0).pairs) {
      const other = [q[0] + alphas[1] * (r[0] - q[0]), q[1] + alphas[1] * (r[1] - q[1])];
      expect(at?.[0]).toBeCloseTo(other[0] ?? NaN, 12);
      expect(at?.[1]).toBeCloseTo(from[1] + alphas[0] * (triangle.p[1] - from[1]), 12);
      expect(alphas[2]).toBeCloseTo(1 - alphas[0], 12);
    }
  });
});

const front: Triangle = [
  [0, 0, 0],
  [2, 0, 0],
  [0, 2, 0],
];

describe("the crossing test in space", () => {
  test("two sides of a face that stands in another cross it", () => {
    const pairs = pairsOf(
      [
        [0.5, 0.5, -1],
        [0.5, 0.5, 1],
        [1.4, 0.4, 1],
      ],
      front,
    );
    expect(pairs.map(({ excess }) => excess <= 0)).toEqual([true, false, true, false, false, false]);
  });

  test("the fourth value alone stops a side beyond the long side of the face", () => {
    const [pair] = pairsOf(
      [
        [1.5, 1.5, -1],
        [1.5, 1.5, 1],
        [1.6, 1.5, 1],
      ],
      front,
    );
    expect(pair && isStoppedByFourth(pair, 0)).toBe(true);
    expect(pair?.alphas[3]).toBeCloseTo(-0.5, 12);
  });

  test("a face is painted in two pieces, on either side of the other", () => {
    const pieces = paintedPieces(
      front,
      [
        [0.5, 0.5, -1],
        [0.5, 0.5, 1],
        [1, 0.4, 1],
      ],
      [0, 0, 9],
    );
    expect(pieces.map(({ isFirst }) => isFirst)).toEqual([false, true, false]);
    expect(pieces[0]?.corners.every(([, , z]) => z <= 0)).toBe(true);
    expect(pieces[2]?.corners.every(([, , z]) => z >= 0)).toBe(true);
  });
});

describe("the layers before equation (1) in space", () => {
  const floor: Triangle = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
  ];
  const moved = (by: Position, heights: readonly [number, number, number]): Triangle =>
    [
      [0.2, 0.2, heights[0]],
      [0.6, 0.2, heights[1]],
      [0.3, 0.5, heights[2]],
    ].map(([x = 0, y = 0, z = 0]) => [x + by[0], y + by[1], z + by[2]]) as unknown as Triangle;

  test("boxes that are apart decide first", () => {
    expect(decidingLayer(moved([2, 0, 0], [-1, 1, 1]), floor, 0)).toBe(1);
    expect(decidingLayer(moved([0, 0, 0], [0.1, 0.1, 0.2]), floor, 0)).toBe(1);
  });

  test("a tolerance keeps what is near for the next layer", () => {
    expect(decidingLayer(moved([0, 0, 0], [0.1, 0.1, 0.2]), floor, 0.05)).toBe(2);
    expect(decidingLayer(moved([0, 0, 0], [0.01, 0.01, 0.2]), floor, 0.05)).toBe(3);
  });

  test("corners beyond a plane decide next, and what is left is calculated", () => {
    const tilted: Triangle = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 1],
    ];
    expect(decidingLayer(moved([0, 0, 0], [0.5, 0.5, 0.9]), tilted, 0)).toBe(2);
    expect(decidingLayer(moved([0, 0, 0], [-0.5, 0.5, 0.5]), tilted, 0)).toBe(3);
  });

  test("never decide against a pair that crosses", () => {
    let crossings = 0;
    for (let i = 0; i < 400; i++) {
      const at = (k: number): number => 1.4 * Math.abs(Math.sin(12.9 * i + 78.2 * k)) - 0.35;
      const added: Triangle = [
        [at(0), at(1), at(2)],
        [at(3), at(4), at(5)],
        [at(6), at(7), at(8)],
      ];
      const tolerance = (i % 4) * 0.05;
      if (!pairsOf(added, floor).some(({ excess }) => excess <= tolerance)) continue;
      crossings++;
      expect(decidingLayer(added, floor, tolerance)).toBe(3);
    }
    expect(crossings).toBeGreaterThan(50);
  });
});
