import { describe, expect, it } from "vitest";
import type { VolumeInput } from "tetrafront";
import { histogramOf, qualitiesOf, qualityOf } from "../../../web/document/mesh-quality";
import { faceNodes, findNeighbours } from "../../../web/viewer/queries/topology";
import {
  centroidsAlong,
  collectVisibleFaces,
  hideBeyond,
  writeCorners,
} from "../../../web/viewer/queries/visible-faces";
import { gridMesh } from "./grid-mesh";

const nodesOfFace = ({ tetrahedra }: VolumeInput, face: number): number[] =>
  [0, 1, 2].map((k) => tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + k] ?? 0)] ?? 0);

/** Returns the faces that belong to exactly one of the given tetrahedra, found independently by counting. */
function lonelyFaces(mesh: VolumeInput, kept: readonly number[]): string[] {
  const seen = new Map<string, number>();
  for (const t of kept) {
    for (let face = 4 * t; face < 4 * t + 4; ++face) {
      const key = nodesOfFace(mesh, face)
        .sort((a, b) => a - b)
        .join();
      seen.set(key, (seen.get(key) ?? 0) + 1);
    }
  }
  return [...seen].filter(([, count]) => count === 1).map(([key]) => key);
}

/** Returns the volume enclosed by triangles, by the divergence theorem; positive if they face outward. */
function enclosed(corners: Float32Array): number {
  let sum = 0;
  for (let i = 0; i < corners.length; i += 9) {
    const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = corners.subarray(
      i,
      i + 9,
    );
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum / 6;
}

const mesh = gridMesh(4);
const neighbours = findNeighbours(mesh.tetrahedra);

describe("findNeighbours", () => {
  it("pairs faces with the same nodes, in both directions", () => {
    let boundary = 0;
    neighbours.forEach((other, face) => {
      if (other < 0) return ++boundary;
      const back = [0, 1, 2, 3].map((f) => 4 * other + f).filter((f) => neighbours[f] === face >> 2);
      const nodes = (f: number) => nodesOfFace(mesh, f).sort((a, b) => a - b);
      expect(back.map(nodes)).toContainEqual(nodes(face));
      return undefined;
    });
    // Two triangles per square of the cube's surface.
    expect(boundary).toBe(6 * 4 * 4 * 2);
  });

  it("pairs the faces at two nodes shared by a hundred thousand tetrahedra, whatever their indices", () => {
    // A ring of elements around an axis: each contains both of its ends and two nodes of a ring.
    const ring = 100_000;
    for (const [low, high] of [
      [0, 1],
      [0, ring + 1],
      [ring / 2, ring / 2 + 1],
      [ring, ring + 1],
    ] as const) {
      const rim = Array.from({ length: ring + 2 }, (_, i) => i).filter((i) => i !== low && i !== high);
      const tetrahedra = Uint32Array.from(
        rim.flatMap((node, i) => [low, high, node, rim[(i + 1) % ring] ?? 0]),
      );
      const found = findNeighbours(tetrahedra);
      for (let t = 0; t < ring; ++t) {
        const around = [...found.subarray(4 * t, 4 * t + 4)];
        const expected = [-1, -1, (t + 1) % ring, (t + ring - 1) % ring];
        if (around.some((other, f) => other !== expected[f]))
          expect({ t, around }).toEqual({ t, around: expected });
      }
    }
  });
});

describe("collectVisibleFaces", () => {
  for (const axis of ["x", "y", "z"] as const) {
    for (const above of [false, true]) {
      for (const limit of [-1, 0.3, 1.7, 2, 3.6, 9]) {
        it(`returns the boundary of the visible tetrahedra: ${axis} ${above ? "above" : "below"} ${limit}`, () => {
          const centroids = centroidsAlong(mesh, axis);
          const faces = new Uint32Array(neighbours.length);
          const hidden = new Uint8Array(centroids.length);
          hideBeyond(centroids, limit, above, hidden);
          const count = collectVisibleFaces(neighbours, hidden, faces);
          const kept = [...centroids.keys()].filter((t) =>
            above ? (centroids[t] ?? 0) >= limit : (centroids[t] ?? 0) <= limit,
          );
          const keys = [...faces.subarray(0, count)].map((face) =>
            nodesOfFace(mesh, face)
              .sort((a, b) => a - b)
              .join(),
          );
          expect(keys.sort()).toEqual(lonelyFaces(mesh, kept).sort());
          const corners = new Float32Array(9 * count);
          writeCorners(mesh, faces, count, [2, 2, 2], corners);
          expect(enclosed(corners)).toBeCloseTo(kept.length / 6, 4);
        });
      }
    }
  }
});

describe("qualityOf", () => {
  const single = (points: number[]): VolumeInput => ({
    points: Float64Array.from(points),
    tetrahedra: Uint32Array.from([0, 1, 2, 3]),
  });

  it("is best for the regular tetrahedron, at any position and size", () => {
    const regular = [1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1].map((x) => 7 + 0.01 * x);
    expect(qualityOf(single(regular), "radius-ratio", 0)).toBeCloseTo(1, 6);
    expect(qualityOf(single(regular), "dihedral", 0)).toBeCloseTo(70.528779, 4);
  });

  it("matches the known values for the corner of a cube", () => {
    const corner = single([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
    // Inradius 1 / (3 + √3), circumradius √3 / 2; the slanted face meets the others at 54.7356°.
    expect(qualityOf(corner, "radius-ratio", 0)).toBeCloseTo(6 / ((3 + Math.sqrt(3)) * Math.sqrt(3)), 6);
    expect(qualityOf(corner, "dihedral", 0)).toBeCloseTo(54.73561, 4);
  });

  it("is nearly zero for a sliver; the histogram counts every tetrahedron", () => {
    const sliver = single([0, 0, 0, 1, 1, 0, 1, 0, 1e-4, 0, 1, 1e-4]);
    expect(qualityOf(sliver, "dihedral", 0)).toBeLessThan(0.1);
    const { bars, min, mean } = histogramOf(qualitiesOf(mesh, "radius-ratio"), "radius-ratio", 10);
    expect(bars.reduce((sum, count) => sum + count)).toBe(mesh.tetrahedra.length / 4);
    expect(min).toBeLessThanOrEqual(mean);
  });
});
