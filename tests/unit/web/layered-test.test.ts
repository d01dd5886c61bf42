/**
 * The paper's crossing test in three layers, against exact arithmetic: corners are small integers, so that the determinants
 * and projections of the independent tests have no rounding.
 */
import { describe, expect, it } from "vitest";
import { alphasOf, excessOf, type Segment, type Triangle } from "../../../web/teach/player/crossing";
import type { FrontFace, NewElement } from "../../../web/teach/player/judge";
import { testByLayers, tolerance } from "../../../web/teach/player/layered-test";
import { randomSource } from "../../support/random";

type Vector = readonly [number, number, number];

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** The sign of the volume of four positions. */
const orient = (a: Vector, b: Vector, c: Vector, d: Vector): number =>
  Math.sign(dot(cross(minus(b, a), minus(c, a)), minus(d, a)));

const random = randomSource(1988);
/** Few different coordinates make many touching and flat cases. */
const vector = (range: number): Vector => [random() % range, random() % range, random() % range];
const triangle = (range: number): Triangle => {
  for (;;) {
    const [a, b, c] = [vector(range), vector(range), vector(range)];
    if (cross(minus(b, a), minus(c, a)).some((term) => term !== 0)) return [a, b, c];
  }
};

/** Whether a side that is not parallel to a face has a point in common with it: five exact signs. */
function intersects([p, q]: Segment, [a, b, c]: Triangle): boolean {
  if (orient(a, b, c, p) * orient(a, b, c, q) > 0) return false;
  const around = [orient(p, q, a, b), orient(p, q, b, c), orient(p, q, c, a)];
  return !(around.includes(1) && around.includes(-1));
}

/** Whether a plane separates a tetrahedron strictly from a triangle: the theorem of separating axes, exact. */
function areApart(corners: NewElement["corners"], face: Triangle): boolean {
  const [a, b, c, d] = corners;
  const sides = [minus(b, a), minus(c, a), minus(d, a), minus(c, b), minus(d, b), minus(d, c)];
  const ofFace = [minus(face[1], face[0]), minus(face[2], face[0]), minus(face[2], face[1])];
  const axes = [
    ...sides.flatMap((side, i) => [...ofFace, ...sides.slice(i + 1)].map((other) => cross(side, other))),
  ];
  axes.push(cross(minus(face[1], face[0]), minus(face[2], face[0])));
  return axes.some((axis) => {
    const element = corners.map((corner) => dot(axis, corner));
    const other = face.map((corner) => dot(axis, corner));
    return Math.min(...element) > Math.max(...other) || Math.max(...element) < Math.min(...other);
  });
}

/** Whether a position is in a tetrahedron of positive volume or touches it, by exact signs. */
const isInside = ([a, b, c, d]: NewElement["corners"], p: Vector): boolean =>
  [orient(p, b, c, d), orient(a, p, c, d), orient(a, b, p, d), orient(a, b, c, p)].every((sign) => sign >= 0);

function element(range: number): NewElement {
  for (;;) {
    const corners = [vector(range), vector(range), vector(range), vector(range)] as const;
    if (orient(...corners) > 0) return { corners, nodes: [0, 1, 2, 3] };
  }
}

describe("a side and a face", () => {
  it.each([3, 5, 12])(
    "cross by the paper's inequality exactly where signs say so, coordinates below %i",
    (range) => {
      const found = { crossing: 0, apart: 0, touching: 0 };
      while (Math.min(...Object.values(found)) < 50) {
        const face = triangle(range);
        const side: Segment = [vector(range), vector(range)];
        const alphas = alphasOf(side, face);
        const isParallel =
          dot(cross(minus(face[1], face[0]), minus(face[2], face[0])), minus(side[1], side[0])) === 0;
        expect(alphas === null).toBe(isParallel);
        if (!alphas) continue;
        const excess = excessOf(alphas);
        expect(excess <= tolerance).toBe(intersects(side, face));
        found[excess > tolerance ? "apart" : excess < -tolerance ? "crossing" : "touching"]++;
      }
    },
  );

  it("meet where equation 1 says, on both sides of it", () => {
    for (let i = 0; i < 500; i++) {
      const [face, side]: [Triangle, Segment] = [triangle(12), [vector(12), vector(12)]];
      const alphas = alphasOf(side, face);
      if (!alphas) continue;
      const [first, second, along, rest] = alphas;
      for (const axis of [0, 1, 2] as const) {
        const [a, b, c] = face.map((corner) => corner[axis]) as [number, number, number];
        const onSide = side[0][axis] + along * (side[1][axis] - side[0][axis]);
        expect(a + first * (b - a) + second * (c - a)).toBeCloseTo(onSide, 8);
      }
      expect(first + second + rest).toBeCloseTo(1, 12);
    }
  });
});

describe("the layers", () => {
  /** A face of some size at a random position; none of its nodes is one of the element's. */
  function freeFace(size: number, range: number): FrontFace {
    const origin = vector(range - size + 1);
    const [a, b, c] = triangle(size).map((corner): Vector => {
      return [origin[0] + corner[0], origin[1] + corner[1], origin[2] + corner[2]];
    }) as [Vector, Vector, Vector];
    return { corners: [a, b, c], nodes: [4, 5, 6] };
  }

  it("rule out only faces that a plane separates from the element, and (c) finds only faces that none does", () => {
    const ruledOut = { boxes: 0, shapes: 0 };
    const decided = { found: 0, apart: 0, exact: 0 };
    for (let i = 0; i < 6000; i++) {
      const [tetrahedron, face] = [element(9), freeFace(i % 2 === 0 ? 9 : 2, 9)];
      const { boxGap, minGap, shapeExcess, finds } = testByLayers(tetrahedron, face);
      const apart = areApart(tetrahedron.corners, face.corners);
      if (boxGap > minGap) ruledOut.boxes++;
      if (shapeExcess > tolerance) ruledOut.shapes++;
      if (boxGap > minGap || shapeExcess > tolerance) expect(apart).toBe(true);
      expect(finds && apart).toBe(false);
      decided[finds ? "found" : apart ? "apart" : "exact"]++;
      // Without common nodes, (c) misses only faces that are wholly in the element.
      if (!finds && !apart)
        expect(face.corners.every((corner) => isInside(tetrahedron.corners, corner))).toBe(true);
    }
    expect(Math.min(...Object.values(ruledOut), decided.found, decided.apart)).toBeGreaterThan(500);
    expect(decided.exact).toBeGreaterThan(0);
  });

  it("leave a face in the element that has a common edge with it to the exact sign", () => {
    const corners: NewElement["corners"] = [
      [0, 0, 0],
      [4, 0, 0],
      [0, 4, 0],
      [0, 0, 4],
    ];
    const face: FrontFace = { corners: [corners[0], corners[1], [1, 1, 1]], nodes: [0, 1, 7] };
    const test = testByLayers({ corners, nodes: [0, 1, 2, null] }, face);
    expect(test).toMatchObject({ finds: false });
    expect(test.boxGap).toBeLessThanOrEqual(test.minGap);
    expect(test.shapeExcess).toBeLessThanOrEqual(tolerance);
  });

  it("name the nodes of the side that crosses", () => {
    const corners: NewElement["corners"] = [
      [0, 0, 0],
      [4, 0, 0],
      [0, 4, 0],
      [1, 1, 8],
    ];
    const face: FrontFace = {
      corners: [
        [0.8, 0.8, 4],
        [9, 0, 4],
        [0, 9, 4],
      ],
      nodes: [20, 21, 22],
    };
    const { pair, finds } = testByLayers({ corners, nodes: [10, 11, 12, null] }, face);
    expect(finds).toBe(true);
    expect(pair?.ends).toEqual(
      pair?.isNewSide ? expect.arrayContaining([null]) : expect.arrayContaining([20]),
    );
  });
});
