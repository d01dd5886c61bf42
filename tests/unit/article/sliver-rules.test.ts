/** Four points of lesson 11: angles and ratios against values that are known otherwise. */
import { describe, expect, test } from "vitest";
import type { Position } from "../../../web/document/position";
import { anglesOf } from "../../../web/teach/article/figures/surface/surface-maps";
import { kindOf, measureFour, type Four } from "../../../web/teach/article/figures/sliver/sliver-rules";

/** The corners of a square of half a diagonal 1, two opposite ones lifted. */
const lifted = (lift: number): Four => [
  [1, 0, lift / 2],
  [-1, 0, lift / 2],
  [0, 1, -lift / 2],
  [0, -1, -lift / 2],
];
const regular = lifted(Math.SQRT2);

describe("four points", () => {
  test("the regular tetrahedron has angles of arccos 1/3, and a ratio of 1", () => {
    const { angles, edges, radiusRatio, volume } = measureFour(regular);
    for (const angle of angles) expect(angle).toBeCloseTo((Math.acos(1 / 3) * 180) / Math.PI, 10);
    for (const edge of edges) expect(edge).toBeCloseTo(2, 12);
    expect(radiusRatio).toBeCloseTo(1, 10);
    expect(volume).toBeCloseTo(8 / (6 * Math.SQRT2), 12);
    expect(kindOf(measureFour(regular))).toBe("good");
  });

  test("the corner of a cube has three right angles", () => {
    const corner: Four = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
    const { angles } = measureFour(corner);
    expect(angles.slice(0, 3).map((angle) => Math.round(angle))).toEqual([90, 90, 90]);
    for (const angle of angles.slice(3))
      expect(angle).toBeCloseTo((Math.acos(1 / Math.sqrt(3)) * 180) / Math.PI, 10);
  });

  test("a lifted square becomes a sliver whose edges differ by less than 1.42, as lesson 11 says", () => {
    for (let lift = Math.SQRT2; lift > 0.01; lift -= 0.01) {
      const { edges } = measureFour(lifted(lift));
      expect(Math.max(...edges) / Math.min(...edges)).toBeLessThan(1.42);
    }
    const flat = measureFour(lifted(0.05));
    expect(kindOf(flat)).toBe("sliver");
    expect(flat.angles.filter((angle) => angle > 170)).toHaveLength(2);
    expect(flat.angles.filter((angle) => angle < 5)).toHaveLength(4);
  });

  test("the faces of a sliver are halves of a square, as lesson 11 says", () => {
    const four = lifted(0.05);
    for (const left of four) {
      const face = four.filter((point) => point !== left);
      const angles = anglesOf(face).toSorted((a, b) => a - b);
      expect(angles.map((angle) => Math.round(angle))).toEqual([45, 45, 90]);
    }
  });

  test.each<readonly [string, Position]>([
    ["cap", [0.01, 0.02, 0.05]],
    ["good", [0, 0, 1.3]],
    ["needle", [0, 0, 6]],
  ])("a point over a face makes a %s", (kind, apex) => {
    const four: Four = [[1, 0, 0], [-0.5, Math.sqrt(0.75), 0], [-0.5, -Math.sqrt(0.75), 0], apex];
    expect(kindOf(measureFour(four))).toBe(kind);
  });

  test("four points in one plane have no volume, and a ratio of 0", () => {
    const { volume, radiusRatio } = measureFour(lifted(0));
    expect([volume, radiusRatio]).toEqual([0, 0]);
  });
});
