/** Lesson 9: its tensors are the engine's, its measures are what it says, and its front is the engine's. */
import { loadPlaneFront } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { extent, fields, outline } from "../../../web/teach/article/figures/stretching/fields";
import type { PlanePoint } from "../../../web/teach/article/kit/plane-view";
import {
  aspectOf,
  ellipseOf,
  fillField,
  intoSpaceOf,
  outOfSpaceOf,
  shapeOf,
  TensorField,
  tensorOf,
  type Tensor,
  type Triangle,
} from "../../../web/teach/article/figures/stretching/tensor-rules";

const front = await loadPlaneFront();
/** Of cpp/src/surface/rules.h. */
const [minLengthRatio, maxLengthRatio, centreHeight] = [0.55, 2, 0.35] as const;
const equilateral: Triangle = [
  [0, 0],
  [1, 0],
  [0.5, Math.sqrt(3) / 2],
];
const ellipse = { size: 0.07, stretching: 3, angle: 25 };

describe("the tensor", () => {
  test("makes the ellipse out of a circle", () => {
    const tensor = tensorOf(ellipse);
    const turn = (25 * Math.PI) / 180;
    const [x, y] = outOfSpaceOf(tensor, [Math.cos(turn), Math.sin(turn)]);
    expect(Math.hypot(x, y)).toBeCloseTo(0.21, 12);
    expect((Math.atan2(y, x) * 180) / Math.PI).toBeCloseTo(25, 9);
    const across = outOfSpaceOf(tensor, [-Math.sin(turn), Math.cos(turn)]);
    expect(Math.hypot(...across)).toBeCloseTo(0.07, 12);
    const [u, v] = intoSpaceOf(tensor, outOfSpaceOf(tensor, [0.3, -0.8]));
    expect([u, v]).toEqual([expect.closeTo(0.3, 12), expect.closeTo(-0.8, 12)]);
  });

  test("gives back its size, stretching and direction, the same ones for the opposite direction", () => {
    for (const angle of [25, 25 - 180, 25 + 180]) {
      const found = ellipseOf(tensorOf({ ...ellipse, angle }));
      expect(found.size).toBeCloseTo(0.07, 12);
      expect(found.stretching).toBeCloseTo(3, 12);
      expect(found.angle).toBeCloseTo(25, 9);
    }
    expect(ellipseOf([0.1, 0, 0.1])).toEqual({ size: 0.1, stretching: 1, angle: 0 });
  });

  test("stretches an equilateral triangle by the stretching, in any direction", () => {
    expect(shapeOf(equilateral)).toBeCloseTo(1, 12);
    expect(aspectOf(equilateral)).toBeCloseTo(1, 6);
    for (const angle of [0, 17, 90, -60]) {
      const tensor = tensorOf({ ...ellipse, angle });
      const stretched = equilateral.map((point) => outOfSpaceOf(tensor, point)) as unknown as Triangle;
      expect(aspectOf(stretched)).toBeCloseTo(3, 9);
      expect(
        shapeOf(stretched.map((point) => intoSpaceOf(tensor, point)) as unknown as Triangle),
      ).toBeCloseTo(1, 9);
    }
  });
});

describe("the field", () => {
  const field = new TensorField(fields.hill, extent);

  test("has the ellipses of its nodes, and the mean of two halfway", () => {
    for (const each of fields.hill) {
      const found = field.tensorAt(each.at);
      tensorOf(each).forEach((entry, i) => expect(found[i]).toBeCloseTo(entry, 12));
    }
    const [a, b] = [tensorOf(fields.hill[0] ?? { ...ellipse }), tensorOf(fields.hill[4] ?? { ...ellipse })];
    const half = field.tensorAt([extent[0] / 4, extent[1] / 4]);
    half.forEach((entry, i) => expect(entry).toBeCloseTo(((a[i] ?? 0) + (b[i] ?? 0)) / 2, 12));
  });

  test("is that of the engine, near the centre of the ideal triangle of every base edge", () => {
    const filled = fillField(front, outline, field);
    if (!filled.success) throw new Error(filled.message);
    expect(filled.status).toBe("done");
    const { trace, front: recorded } = filled;
    const at = (node: number): PlanePoint => [
      recorded.plane[2 * node] ?? 0,
      recorded.plane[2 * node + 1] ?? 0,
    ];
    let compared = 0;
    for (let step = recorded.firstStep + 1; step <= trace.stepCount; step++) {
      const edge = trace.stepAt(step);
      if (edge?.kind !== "edge") continue;
      const [a, b] = [at(recorded.edges[2 * edge.edge] ?? 0), at(recorded.edges[2 * edge.edge + 1] ?? 0)];
      const found = metricOf(field.tensorAt(sampledAt(field, a, b)));
      const norm = Math.hypot(...edge.metric);
      // Positions and metrics are recorded with seven digits.
      edge.metric.forEach((entry, i) => expect((found[i] ?? 0) / norm).toBeCloseTo(entry / norm, 4));
      compared++;
    }
    expect(compared).toBeGreaterThan(100);
  });
});

/** The square of the length of a step, in target lengths: the inverse square of the tensor. */
function metricOf([xx, xy, yy]: Tensor): Tensor {
  const squared = (xx * yy - xy * xy) ** 2;
  return [(yy * yy + xy * xy) / squared, (-xy * (xx + yy)) / squared, (xx * xx + xy * xy) / squared];
}

/** Where the engine takes the metric of a base edge (cpp/src/surface/planar_front.cpp, makeBase). */
function sampledAt(field: TensorField, a: PlanePoint, b: PlanePoint): PlanePoint {
  const middle: PlanePoint = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const along: PlanePoint = [b[0] - a[0], b[1] - a[1]];
  const [xx, xy, yy] = metricOf(field.tensorAt(middle));
  const image: PlanePoint = [xx * along[0] + xy * along[1], xy * along[0] + yy * along[1]];
  const length = Math.sqrt(along[0] * image[0] + along[1] * image[1]);
  const normal: PlanePoint = [-image[1], image[0]];
  const norm = Math.sqrt(xx * normal[0] ** 2 + 2 * xy * normal[0] * normal[1] + yy * normal[1] ** 2);
  const height =
    (centreHeight * Math.min(Math.max(1, minLengthRatio * length), maxLengthRatio * length)) / norm;
  return [middle[0] + height * normal[0], middle[1] + height * normal[1]];
}
