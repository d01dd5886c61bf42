/** Constrained Delaunay triangulations, on random star-shaped polygons whose edges are the constraints. */
import { describe, expect, test } from "vitest";

import {
  type Constraint,
  constrainedTriangles,
  CrossingConstraints,
} from "../../../wasm/src/formats/constrained-triangulation.js";
import { trianglesWithin } from "../../../wasm/src/formats/unrolled-group.js";
import { randomSource } from "../../support/random.js";

type Position = readonly [number, number];

const cross = ([ax, ay]: Position, [bx, by]: Position, [cx, cy]: Position): number =>
  (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

/** Returns a polygon around the origin, counter-clockwise, with spikes. */
function star(count: number, random: () => number): Position[] {
  return Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    const radius = 0.2 + 2 * random();
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

const areaOf = (polygon: readonly Position[]): number =>
  polygon.reduce((sum, p, i) => sum + cross([0, 0], p, polygon[(i + 1) % polygon.length] ?? p) / 2, 0);

describe.each([3, 12, 60, 400])("a polygon of %d corners and random points", (count) => {
  const integer = randomSource(count);
  const random = () => integer() / 2 ** 32;
  const polygon = star(count, random);
  const others = Array.from({ length: count }, (): Position => [3 * random() - 1.5, 3 * random() - 1.5]);
  const positions = [...polygon, ...others];
  const border = polygon.map((_, i): Constraint => [i, (i + 1) % count]);
  const triangles = constrainedTriangles(Float64Array.from(positions.flat()), border);
  const corners = (t: number) =>
    [0, 1, 2].map((k) => positions[triangles[3 * t + k] ?? 0] ?? [0, 0]) as [Position, Position, Position];

  test("has only triangles of positive area", () => {
    for (let t = 0; t < triangles.length / 3; t++) expect(cross(...corners(t))).toBeGreaterThan(0);
  });

  test("is filled by the triangles inside its edges", () => {
    const area = trianglesWithin(triangles, border).reduce((sum, t) => sum + cross(...corners(t)) / 2, 0);
    expect(area).toBeCloseTo(areaOf(polygon), 9);
  });
});

test("a point on a constraint divides it", () => {
  const triangles = constrainedTriangles(Float64Array.from([0, 0, 4, 0, 4, 4, 0, 4, 2, 2]), [
    [0, 2],
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
  ]);
  expect(triangles.length / 3).toBe(4);
});

test("constraints that cross are refused", () => {
  const crossing: Constraint[] = [
    [0, 2],
    [1, 3],
  ];
  expect(() => constrainedTriangles(Float64Array.from([0, 0, 4, 0, 4, 4, 0, 5]), crossing)).toThrow(
    CrossingConstraints,
  );
});
