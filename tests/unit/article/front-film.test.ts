/** The film of lesson 1: the record of the engine's front in the plane, state by state. */
import { readFileSync } from "node:fs";
import { beforeAll, describe, expect, test } from "vitest";
import { loadPlaneFront, type PlaneFront } from "tetrafront/trace";
import {
  filmOf,
  smallestAngle,
  type FilmCandidate,
  type FrontFilm,
} from "../../../web/teach/article/figures/front/front-film";
import { Polygon } from "../../../web/teach/article/figures/front/polygon";
import { shapes } from "../../../web/teach/article/figures/front/shapes";
import { storedPlanes, successOf } from "../../support/planes";

let engine: PlaneFront;
beforeAll(async () => {
  engine = await loadPlaneFront();
});

type Point = readonly [number, number];

function film(shape: string, size: number): FrontFilm {
  const filled = engine.fill([shapes[shape] ?? []], size, { improve: false });
  if (!filled.success) throw new Error(filled.message);
  return filmOf(filled);
}

/** The native engine makes the same triangles of the stored planes (tests/cpp/surface_plane_fill_test.cpp). */
const stored = storedPlanes().filter(({ name }) => /^lesson-(?!wing)/.test(name));

test("each shape is stored, at the smallest, the first and the largest size", () => {
  expect(stored.map(({ name }) => name)).toEqual(
    Object.keys(shapes).flatMap((shape) => [0.06, 0.12, 0.26].map((size) => `lesson-${shape}-${size}`)),
  );
});

test.each(stored)("the figure has the triangles of $name", ({ name, fingerprint }) => {
  const [, shape = "", size = ""] = name.split("-");
  const filled = successOf(engine.fill([shapes[shape] ?? []], Number(size), { improve: false }));
  expect(filled.fingerprint).toBe(fingerprint);
});

const areaOf = (points: readonly Point[]): number =>
  points.reduce((sum, [x, y], i) => {
    const [u, v] = points[(i + 1) % points.length] ?? [0, 0];
    return sum + (x * v - u * y) / 2;
  }, 0);

describe.each(Object.keys(shapes))("the film of the %s", (shape) => {
  test.each([0.06, 0.12, 0.26])("at size %d", (size) => {
    const {
      nodes,
      sides,
      triangles,
      sizes,
      stepCount,
      boundaryNodes,
      refusals,
      refusedCount,
      stepAt,
      worst,
    } = film(shape, size);
    // The front of each state is as large as the record says, and closes in the end.
    sizes.forEach((count, state) => {
      expect(sides.filter(({ born, died }) => born <= state && state < died)).toHaveLength(count);
    });
    expect([sizes[0], sizes.at(-1)]).toEqual([boundaryNodes, 0]);
    // One triangle per step at most; together they fill the polygon, none upside down.
    const areas = triangles.map(({ corners }) => areaOf(corners.map((node) => nodes[node] ?? [0, 0])));
    expect(Math.min(...areas)).toBeGreaterThan(0);
    expect(areas.reduce((sum, area) => sum + area, 0)).toBeCloseTo(areaOf(shapes[shape] ?? []), 9);
    expect(triangles.every(({ born }, i) => born > (triangles[i - 1]?.born ?? 0))).toBe(true);
    // What is refused is shown.
    let refused = 0;
    for (let k = 0; k < stepCount; k++) {
      const step = stepAt(k);
      const count = step?.candidates.filter(({ refusal }) => refusal !== null).length ?? 0;
      expect(count > 0).toBe(refusals.includes(k));
      const base = sides[step?.base ?? -1];
      expect(base && base.born <= k && k < base.died).toBe(true);
      refused += count;
    }
    expect(refused).toBe(refusedCount);
    expect(stepAt(stepCount)).toBeUndefined();
    const angles = triangles.map(({ corners }) =>
      smallestAngle(corners.map((node) => nodes[node] ?? [0, 0])),
    );
    expect(worst.angle).toBe(Math.min(...angles));
  });
});

test("the order of candidates has the numbers of lesson 1", () => {
  const rules = readFileSync("cpp/src/surface/rules.h", "utf8");
  const text = readFileSync("web/lessons/1.md", "utf8");
  const constant = (name: string): string => new RegExp(`${name} = ([\\d.]+);`).exec(rules)?.[1] ?? "";
  expect(text).toContain(`within ${constant("kCaptureRadius")} of the length, come first`);
  expect(text).toContain(`at ${constant("kLowerHeight")} of its height`);
});

test("candidates of both shapes are tried in the order of lesson 1", () => {
  let [nearCount, otherCount] = [0, 0];
  const films = Object.keys(shapes).flatMap((shape) =>
    [0.05, 0.06, 0.08, 0.12].map((size) => film(shape, size)),
  );
  const stepsOf = ({ stepCount, stepAt }: FrontFilm) =>
    Array.from({ length: stepCount }, (_none, k) => stepAt(k)).filter((step) => step !== undefined);
  for (const { ideal, candidates } of films.flatMap(stepsOf)) {
    const distanceOf = ({ at: [x, y] }: FilmCandidate): number => Math.hypot(x - ideal[0], y - ideal[1]);
    const firstNew = candidates.findIndex(({ isNew }) => isNew);
    if (firstNew < 0) continue;
    // Before the new node, the nearest leads; all others are farther away.
    const near = candidates.slice(0, firstNew).map(distanceOf);
    const others = candidates.slice(firstNew).filter(({ isNew }) => !isNew);
    expect(near).toEqual(near.toSorted((a, b) => a - b));
    for (const other of others) expect(distanceOf(other)).toBeGreaterThan(Math.max(0, ...near));
    nearCount += near.length;
    otherCount += others.length;
  }
  expect(Math.min(nearCount, otherCount)).toBeGreaterThan(0);
});

test("a size of half is about four times as many triangles, as lesson 1 says", () => {
  const ratio = film("boot", 0.06).triangles.length / film("boot", 0.12).triangles.length;
  expect(ratio).toBeGreaterThan(3.5);
  expect(ratio).toBeLessThan(4.5);
});

test("the angles of a right triangle", () => {
  expect(
    smallestAngle([
      [0, 0],
      [1, 0],
      [0, Math.sqrt(3)],
    ]),
  ).toBeCloseTo(30, 10);
});

describe("a polygon", () => {
  const square: readonly Point[] = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];

  test("gets a corner between two others", () => {
    const polygon = new Polygon(square);
    expect(polygon.split(3)).toBe(4);
    expect(polygon.corners.at(-1)).toEqual([0, 0.5]);
  });

  test("keeps three corners", () => {
    const polygon = new Polygon(square);
    expect([polygon.remove(0), polygon.remove(0)]).toEqual([true, false]);
    expect(polygon.corners).toEqual(square.slice(1));
  });

  test("goes back to the shape that it was told to keep", () => {
    const polygon = new Polygon(square);
    polygon.move(0, [2, 2]);
    expect(polygon.sound).toEqual(square);
    polygon.keep();
    polygon.move(0, [3, 3]);
    expect(polygon.sound[0]).toEqual([2, 2]);
  });
});
