/** Tests of the test support: cases with known results. */
import { describe, expect, test } from "vitest";

import { enclosedVolume, defectsOf, meshVolume, NO_DEFECTS } from "../../support/check-mesh.js";
import { orientation } from "../../support/exact.js";
import { boxSurface, cavitySurface, sphereSurface, torusSurface, turned } from "../../support/surfaces.js";

describe("surfaces are closed, oriented outward and enclose the right volume:", () => {
  test.each([
    ["box", boxSurface(3, [0, 0, 0], [1, 2, 3]), 6, 1e-12],
    ["sphere", sphereSurface(30), (4 / 3) * Math.PI, 1e-2],
    ["torus", torusSurface(90, 40), 2 * Math.PI ** 2 * 0.16, 1e-2],
    ["cube with a cavity", cavitySurface(40), 8 - (4 / 3) * Math.PI * 0.125, 1e-2],
    ["box inside out", turned(boxSurface(2)), -1, 1e-12],
  ])("%s", (_, surface, volume, tolerance) => {
    const edges = new Map<string, number>();
    for (let t = 0; t < surface.triangles.length; t += 3) {
      for (const [i, j] of [
        [0, 1],
        [1, 2],
        [2, 0],
      ] as const) {
        const [a, b] = [surface.triangles[t + i] ?? NaN, surface.triangles[t + j] ?? NaN];
        const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
        edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
      }
    }
    expect([...edges.values()].filter((sum) => sum !== 0)).toEqual([]);
    expect(Math.abs(enclosedVolume(surface) / volume - 1)).toBeLessThan(tolerance);
  });
});

describe("orientation", () => {
  const nodes = [0, 1, 2, 3] as const;

  test("is exact where doubles round to zero", () => {
    // The fourth point is one unit in the last place off the plane through the others.
    for (const [step, sign] of [
      [1, 1],
      [0, 0],
      [-1, -1],
    ] as const) {
      const points = Float64Array.of(
        0.1,
        0.1,
        0.1,
        0.3,
        0.1,
        0.1,
        0.1,
        0.3,
        0.1,
        0.2,
        0.2,
        0.1 + step * 2 ** -56,
      );
      expect(orientation(points, [...nodes])).toBe(sign);
    }
  });

  test("is exact for huge and tiny numbers together", () => {
    expect(orientation(Float64Array.of(0, 0, 0, 1e200, 0, 0, 0, 1e-200, 0, 1, 1, 1e-300), [...nodes])).toBe(
      1,
    );
    expect(orientation(Float64Array.of(0, 0, 0, 1e200, 0, 0, 0, 1e-200, 0, 1, 1, 0), [...nodes])).toBe(0);
  });
});

describe("defectsOf", () => {
  const points = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1);
  const both = { points, tetrahedra: Uint32Array.of(0, 1, 2, 3, 4, 2, 1, 3) };
  const surface = { points, triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 4, 1, 2, 4, 3, 1, 4, 2, 3) };

  test("finds no defects in two adjacent tetrahedra", () => {
    expect(defectsOf(both, surface)).toEqual(NO_DEFECTS);
    expect(meshVolume(both)).toBeCloseTo(enclosedVolume(surface), 14);
  });

  test.each<[string, number[], object]>([
    [
      "an inverted tetrahedron",
      [1, 0, 2, 3, 4, 2, 1, 3],
      { notPositive: 1, missingTriangles: 3, extraFaces: 4, sameSideFaces: 1 },
    ],
    ["a duplicate tetrahedron", [0, 1, 2, 3, 4, 2, 1, 3, 0, 1, 2, 3], { crowdedFaces: 1, sameSideFaces: 4 }],
    ["a hole", [0, 1, 2, 3], { missingTriangles: 3, extraFaces: 1, unusedNodes: 1 }],
  ])("finds %s", (_, tetrahedra, defects) => {
    const mesh = { points, tetrahedra: Uint32Array.from(tetrahedra) };
    expect(defectsOf(mesh, surface)).toEqual({ ...NO_DEFECTS, ...defects });
  });
});
