/** The ideal point of lesson 4, against the rules of the engine. */
import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  circleCentre,
  idealRules,
  isWithin,
  placeIdealPoint,
  poses,
  type Corners,
} from "../../../web/teach/article/figures/ideal/ideal-rules";

const even: Corners = [
  [0, 0, 0],
  [1, 0, 0],
  [0.5, Math.sqrt(3) / 2, 0],
];
const blunt: Corners = [
  [-1, 0, 0],
  [1, 0, 0],
  [0, 0.2, 0],
];

describe("the ideal point", () => {
  test("has the constants of the engine", () => {
    const header = readFileSync("cpp/src/volume/rules.h", "utf8");
    for (const [name, value] of Object.entries(idealRules)) {
      const [, text] = new RegExp(`${name} = ([\\d.]+);`).exec(header) ?? [];
      expect([name, Number(text)]).toEqual([name, value]);
    }
  });

  // Numbers in sentences that lead to a state, and stay the same in every other one.
  test("has the lengths of lesson 4", () => {
    const text = readFileSync("web/lessons/4.md", "utf8");
    const edges = (pose: keyof typeof poses, isOverCentre: boolean): string[] =>
      placeIdealPoint(poses[pose], 1.35, isOverCentre).edges.map((edge) => edge.toFixed(2));
    const listed = ([a, b, c]: string[]): string => `${a}, ${b} and ${c}`;
    expect(text).toContain(`the three edges come apart: ${listed(edges("long", false))}.`);
    expect(new Set(edges("long", true))).toHaveLength(1);
    expect(text).toContain(`all three are ${edges("long", true)[0]} long.`);
    const [first, second, third] = edges("blunt", false);
    expect(text).toContain(`the edges are ${first}, ${second} and ${third} long`);
    const { radius, height, h } = placeIdealPoint(poses.even, 0.4, false);
    expect(text).toContain(`$0.97\\cdot0.4=${(0.97 * 0.4).toFixed(2)}$ would not even reach`);
    expect(text).toContain(`which is $R=${radius.toFixed(2)}$ away`);
    expect(text).toContain(`The height is then $${(height / h).toFixed(2)}\\,h$`);
  });

  test("is kept near a small face by the limit of h; that of R lowers it by at most 4 %", () => {
    // On every face, R is at least the size of the face over the root of 3.
    const least = 1 / (Math.sqrt(3) * idealRules.kMaxSizePerBase);
    const [high, held] = [least, idealRules.kMinCircumradius].map((r) => Math.sqrt(1 - r * r)) as [
      number,
      number,
    ];
    expect(1 - held / high).toBeGreaterThan(0.035);
    expect(1 - held / high).toBeLessThan(0.045);
    expect(readFileSync("web/lessons/4.md", "utf8")).toContain("by at most 4 %");
  });

  test("over an equilateral face of the right size gives the regular tetrahedron", () => {
    const { height, edges, sizeLimit, radiusLimit } = placeIdealPoint(even, 1 / 0.97, false);
    expect(height).toBeCloseTo(Math.sqrt(2 / 3), 12);
    for (const edge of edges) expect(edge).toBeCloseTo(1, 12);
    expect([sizeLimit, radiusLimit]).toEqual(["none", "none"]);
  });

  test("satisfies Pythagoras when no limit is met", () => {
    const { height, h, radius } = placeIdealPoint(
      [
        [0, 0, 0],
        [1.1, 0.1, 0],
        [0.3, 0.8, 0],
      ],
      1.1,
      false,
    );
    expect(height ** 2 + radius ** 2).toBeCloseTo(h ** 2, 12);
  });

  test.each([
    ["small sizes", 0.1, ["small", "low"], 0.55],
    ["large sizes", 9, ["large", "high"], 2],
    ["circles that are small for the size", 1.6, ["none", "high"], 1.552],
    ["circles that are large for the size", 0.6, ["none", "low"], 0.582],
  ] as const)("holds %s", (_name, size, limits, h) => {
    const point = placeIdealPoint(even, size, false);
    expect([point.sizeLimit, point.radiusLimit]).toEqual(limits);
    // What the lesson puts into its root is what gives the height.
    expect(point.height).toBeCloseTo(Math.sqrt(point.h ** 2 - point.used ** 2), 12);
    expect(point.h).toBeCloseTo(h, 12);
  });

  test("is never lower than the root of 1 - 0.95² of h", () => {
    const { height, h, square, radiusLimit } = placeIdealPoint(blunt, 1, false);
    expect(square).toBeLessThan(0);
    expect(radiusLimit).toBe("low");
    expect(height / h).toBeCloseTo(Math.sqrt(1 - 0.95 ** 2), 12);
  });

  test("over the centre has edges alike, and leaves a blunt face", () => {
    const { edges, foot } = placeIdealPoint(blunt, 2, true);
    expect(Math.max(...edges) - Math.min(...edges)).toBeLessThan(1e-12);
    expect(isWithin(foot, blunt)).toBe(false);
    expect(isWithin(placeIdealPoint(blunt, 2, false).foot, blunt)).toBe(true);
    expect(circleCentre(even)[1]).toBeCloseTo(Math.sqrt(3) / 6, 12);
  });
});
