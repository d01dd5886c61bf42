/** Lesson 3: its maps lead there and back, its triangle is even in space, and its metric makes the front's triangles even. */
import { loadPlaneFront } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { distance } from "../../../web/document/vectors";
import type { PlanePoint } from "../../../web/teach/article/kit/plane-view";
import { evenEllipse, fillPatch, rulers } from "../../../web/teach/article/figures/surface/surface-fill";
import {
  anglesOf,
  lossOf,
  startCorners,
  SurfaceMaps,
} from "../../../web/teach/article/figures/surface/surface-maps";

const front = await loadPlaneFront();
const maps = new SurfaceMaps(startCorners, 1);
const places: readonly PlanePoint[] = [0.1, 0.5, 0.9].flatMap((xi) =>
  [0.1, 0.4, 0.9].map((eta): PlanePoint => [xi, eta]),
);

describe("the maps of a patch", () => {
  test("have the corners, the lines and the derivatives of the surface", () => {
    const [a, b, c, d] = startCorners;
    for (const [unit, corner] of [
      [[0, 0], a],
      [[1, 0], b],
      [[1, 1], c],
      [[0, 1], d],
    ] as const)
      expect(distance(maps.pointAt(unit).position, corner)).toBeLessThan(1e-12);
    const step = 1e-6;
    for (const [xi, eta] of places) {
      const at = maps.pointAt([xi, eta]);
      [0, 1, 2].forEach((axis) => {
        const slope = (to: PlanePoint, from: PlanePoint): number =>
          ((maps.pointAt(to).position[axis] ?? 0) - (maps.pointAt(from).position[axis] ?? 0)) / (2 * step);
        expect(at.alongXi[axis]).toBeCloseTo(slope([xi + step, eta], [xi - step, eta]), 6);
        expect(at.alongEta[axis]).toBeCloseTo(slope([xi, eta + step], [xi, eta - step]), 6);
      });
    }
  });

  test("lead to the stretched square and back, and measure there what space measures", () => {
    for (const unit of places) {
      const back = maps.toUnit(maps.toPlane(unit));
      expect(back).toEqual([expect.closeTo(unit[0], 12), expect.closeTo(unit[1], 12)]);
      const [xx, xy, yy] = maps.planeMetricAt(unit);
      const [p, q, r] = maps.metricAt(unit);
      for (const step of [
        [1, 0],
        [0, 1],
        [0.3, -0.7],
      ] as const) {
        const [dx, dy] = maps.stepToPlane(unit, step);
        const inSpace = p * step[0] ** 2 + 2 * q * step[0] * step[1] + r * step[1] ** 2;
        expect(xx * dx * dx + 2 * xy * dx * dy + yy * dy * dy).toBeCloseTo(inSpace, 9);
      }
    }
    expect(maps.plane).toEqual([
      [0, 0],
      [maps.xB, 0],
      [maps.xC, maps.yD],
      [maps.xD, maps.yD],
    ]);
  });

  test("make a triangle that is even in space", () => {
    for (const unit of places) {
      const corners = maps.evenTriangle(unit, 1e-4).map((corner) => maps.pointAt(corner).position);
      for (const angle of anglesOf(corners)) expect(angle).toBeCloseTo(60, 1);
    }
    expect(lossOf([35, 60, 85])).toBe(25);
  });

  test("lose nothing on a flat square", () => {
    const flat = new SurfaceMaps(
      [
        [0, 0, 0],
        [1, 0, 0],
        [1, 1, 0],
        [0, 1, 0],
      ],
      0,
    );
    for (const unit of places) {
      const triangle = flat.evenTriangle(unit, 0.1);
      expect(lossOf(anglesOf(triangle))).toBeLessThan(1e-6);
      expect(lossOf(anglesOf(triangle.map((corner) => flat.toPlane(corner))))).toBeLessThan(1e-6);
    }
    expect(flat.isSound).toBe(true);
    expect(
      new SurfaceMaps(
        [
          [0, 0, 0],
          [1, 0, 0],
          [0.05, 0.05, 0],
          [0, 1, 0],
        ],
        0,
      ).isSound,
    ).toBe(false);
  });
});

describe("the front of the patch", () => {
  test("the ellipse of a metric is a circle by it", () => {
    const metric = [4, 1, 2] as const;
    const { size, stretching = 1, direction = [1, 0] } = evenEllipse(metric, 0.5);
    const lengthOf = (x: number, y: number): number =>
      Math.sqrt(metric[0] * x * x + 2 * metric[1] * x * y + metric[2] * y * y);
    const [c, s] = direction;
    expect(lengthOf(-s * size, c * size)).toBeCloseTo(0.5, 9);
    expect(lengthOf(c * size * stretching, s * size * stretching)).toBeCloseTo(0.5, 9);
  });

  test("is more even in space with each better ruler", () => {
    const filled = rulers.map((ruler) => fillPatch(front, maps, ruler));
    const means = filled.map((each) => each?.means.space ?? 0);
    // Each is even where it is measured.
    rulers.forEach((ruler, i) => expect(filled[i]?.means[ruler]).toBeGreaterThan(50));
    expect(means[1]).toBeGreaterThan(means[0] ?? 0);
    expect(means[2]).toBeGreaterThan(means[1] ?? 0);
    expect(means[2]).toBeGreaterThan(48);
    for (const each of filled) expect(each?.film.sizes.at(-1)).toBe(0);
  });

  test("the tasks of the lesson can be done", () => {
    const losses = (of: SurfaceMaps): readonly number[] =>
      [0.06, 0.3, 0.5, 0.7, 0.94].flatMap((xi) =>
        [0.06, 0.3, 0.5, 0.7, 0.94].map((eta) =>
          lossOf(anglesOf(of.evenTriangle([xi, eta], 1e-3).map((corner) => of.toPlane(corner)))),
        ),
      );
    expect(Math.max(...losses(maps))).toBeLessThan(25);
    expect(Math.max(...losses(new SurfaceMaps(startCorners, 1.6)))).toBeGreaterThan(25);
    expect(Math.min(...losses(new SurfaceMaps(startCorners, 0)))).toBeLessThan(3);
    const [a, b, c, d] = startCorners;
    const long = new SurfaceMaps([a, [1.45, b[1], b[2]], [1.3, c[1], c[2]], d], 1);
    expect(fillPatch(front, long, "square")?.means.space).toBeLessThan(35);
    expect(fillPatch(front, long, "space")?.means.space).toBeGreaterThan(50);
  });
});
