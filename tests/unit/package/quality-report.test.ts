/** Quality statistics of the report, compared with the mesh. */
import { createMesher, type Mesher, type MeshResult, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { cavitySurface, joined, sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const sum = (counts: readonly number[]) => counts.reduce((a, b) => a + b, 0);

type Position = readonly [number, number, number];

function cornersOf({ mesh }: MeshResult, tetrahedron: number): Position[] {
  return Array.from(mesh.tetrahedra.subarray(4 * tetrahedron, 4 * tetrahedron + 4), (node): Position => {
    const [x = 0, y = 0, z = 0] = mesh.points.subarray(3 * node, 3 * node + 3);
    return [x, y, z];
  });
}

function centroidOf(corners: readonly Position[]): Position {
  const mean = (k: 0 | 1 | 2) => sum(corners.map((corner) => corner[k])) / corners.length;
  return [mean(0), mean(1), mean(2)];
}

function edgeCount({ mesh }: MeshResult): number {
  const edges = new Set<string>();
  for (let t = 0; t < mesh.tetrahedra.length; t += 4) {
    const nodes = [...mesh.tetrahedra.subarray(t, t + 4)].sort((a, b) => a - b);
    nodes.forEach((a, i) => nodes.slice(i + 1).forEach((b) => edges.add(`${a} ${b}`)));
  }
  return edges.size;
}

describe("the quality report", () => {
  test("counts every tetrahedron, dihedral angle and edge of every region once", async () => {
    const result = await mesher.fillSurface(joined(cavitySurface(8), sphereSurface(4, 0.3)));
    const { quality, tetrahedra, dihedral, radiusRatio, volume } = result.report;
    expect(quality.regions.map(({ region }) => region)).toEqual([0, 1]);
    expect(sum(quality.regions.map((region) => region.tetrahedra))).toBe(tetrahedra);
    expect(sum(quality.regions.map((region) => region.volume))).toBeCloseTo(volume, 9);
    expect(sum(quality.regions.map(({ edge }) => sum(edge)))).toBe(edgeCount(result));
    for (const region of quality.regions) {
      expect(sum(region.dihedral)).toBe(6 * region.tetrahedra);
      expect(sum(region.smallestDihedral)).toBe(region.tetrahedra);
      expect(sum(region.radiusRatio)).toBe(region.tetrahedra);
      const first = region.dihedral.findIndex((count) => count > 0);
      expect((first + 1) * quality.binWidths.dihedral).toBeGreaterThan(dihedral.min);
    }
    const mean = quality.regions.flatMap(({ radiusRatio: bins }) =>
      bins.map((count, i) => count * (i + 0.5) * quality.binWidths.radiusRatio),
    );
    expect(sum(mean) / tetrahedra).toBeCloseTo(radiusRatio.mean, 1);
  });

  test("lists the worst elements with their centroids", async () => {
    const result = await mesher.fillSurface(sphereSurface(12));
    const { quality, dihedral } = result.report;
    expect(quality.worst).toHaveLength(10);
    const worst = Math.min(...quality.worst.map((element) => element.dihedral.min));
    expect(worst).toBeCloseTo(dihedral.min, 9);
    for (const { tetrahedron, centroid } of quality.worst) {
      centroidOf(cornersOf(result, tetrahedron)).forEach((x, k) => expect(centroid[k]).toBeCloseTo(x, 12));
    }
    expect(quality.smallest?.volume).toBeGreaterThan(0);
    expect(quality.volumeRatio).toBeGreaterThanOrEqual(1);
    expect(quality.outOfRange + quality.limitedByBoundary.count).toBe(0);
  });

  test("counts elements limited by the boundary separately", async () => {
    const sharp: SurfaceInput = {
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 0.98, 0.2),
      triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2),
    };
    const { report } = await mesher.fillSurface(sharp, { optimization: "none" });
    const { worst, ...counts } = report.quality.limitedByBoundary;
    expect(report.tetrahedra).toBe(1);
    expect(counts).toEqual({ count: 1, edges: 1, needles: 0, narrowGaps: 0 });
    expect(report.quality.outOfRange).toBe(0);
    expect(worst[0]?.dihedral.min).toBeCloseTo((Math.atan2(0.2, 0.98) * 180) / Math.PI, 9);
  });
});
