import { describe, expect, it } from "vitest";
import { scalePosition, qualityOf } from "../../../web/document/mesh-quality";
import { MeshQueries, type ViewOptions } from "../../../web/viewer/queries/mesh-queries";
import { faceNodes } from "../../../web/viewer/queries/topology";
import { gridMesh } from "./grid-mesh";

const size = 3;
const mesh = gridMesh(size);
const queries = new MeshQueries({ mesh });
const whole: ViewOptions = {
  origin: [0, 0, 0],
  cut: null,
  hiddenRegions: new Set(),
  shading: "plain",
  qualitySpace: "space",
};

const cornersOf = (face: number): number[] =>
  [0, 1, 2].flatMap((k) => {
    const node = mesh.tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + k] ?? 0)] ?? 0;
    return [...mesh.points.subarray(3 * node, 3 * node + 3)];
  });

describe("MeshQueries", () => {
  it("returns the corners of each face relative to the origin, and distinguishes boundary and cut", () => {
    const origin = [1, -2, 0.5] as const;
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const { faces, corners, onBoundary } = queries.facesOf({ ...whole, origin, cut });
    expect(faces.length).toBeGreaterThan(0);
    faces.forEach((face, i) => {
      const expected = cornersOf(face);
      const given = [...corners.subarray(9 * i, 9 * i + 9)].map((x, k) => x + (origin[k % 3] ?? 0));
      expect(given).toEqual(expected);
      const isOutside = [0, 1, 2].some((axis) =>
        [0, size].some((wall) => [0, 1, 2].every((k) => expected[3 * k + axis] === wall)),
      );
      expect(onBoundary[i]).toBe(isOutside ? 1 : 0);
    });
  });

  it("returns the whole boundary again after any cut", () => {
    for (const axis of ["x", "y", "z"] as const) {
      queries.facesOf({ ...whole, cut: { axis, position: 0.2, flipped: true } });
    }
    const { faces } = queries.facesOf(whole);
    expect(faces).toEqual(new MeshQueries({ mesh }).facesOf(whole).faces);
    expect(faces).toHaveLength(6 * size * size * 2);
  });

  it("gives the three corners of a face the quality of their element", () => {
    for (const shading of ["radius-ratio", "dihedral"] as const) {
      const { faces, values } = queries.facesOf({ ...whole, shading });
      expect(values).toHaveLength(3 * faces.length);
      faces.forEach((face, i) => {
        const value = scalePosition(qualityOf(mesh, shading, face >> 2), shading);
        for (const corner of values.subarray(3 * i, 3 * i + 3)) expect(corner).toBeCloseTo(value, 5);
      });
    }
    expect(queries.facesOf(whole).values).toHaveLength(0);
    // The cached qualities of all elements must give the same values.
    const before = queries.facesOf({ ...whole, shading: "dihedral" });
    expect(queries.histogram("dihedral", "space", 20).bars.reduce((sum, n) => sum + n)).toBe(
      mesh.tetrahedra.length / 4,
    );
    const after = queries.facesOf({ ...whole, shading: "dihedral" });
    after.values.forEach((value, i) => expect(value).toBeCloseTo(before.values[i] ?? NaN, 5));
  });
});

describe("MeshQueries of a stretched mesh", () => {
  const count = mesh.tetrahedra.length / 4;
  const radiusRatio = Float32Array.from({ length: count }, (_, t) => 0.3 + (0.5 * t) / count);
  const smallestDihedral = Float32Array.from({ length: count }, (_, t) => 20 + (30 * t) / count);
  const stretched = new MeshQueries({ mesh, metricShapes: { radiusRatio, smallestDihedral } });

  it.each([
    ["radius-ratio", radiusRatio],
    ["dihedral", smallestDihedral],
  ] as const)("measures the %s in the metric or in space", (shading, values) => {
    for (const qualitySpace of ["metric", "space", "metric"] as const) {
      const drawn = stretched.facesOf({ ...whole, shading, qualitySpace });
      const { min, mean } = stretched.histogram(shading, qualitySpace, 20);
      const expected = Array.from(values, (value, t) =>
        qualitySpace === "metric" ? value : qualityOf(mesh, shading, t),
      );
      expect(min).toBeCloseTo(Math.min(...expected), 4);
      expect(mean).toBeCloseTo(expected.reduce((sum, value) => sum + value) / count, 4);
      drawn.faces.forEach((face, i) => {
        expect(drawn.values[3 * i]).toBeCloseTo(scalePosition(expected[face >> 2] ?? NaN, shading), 5);
      });
    }
  });

  it("measures a mesh without a stretched metric in space", () => {
    expect(queries.histogram("dihedral", "metric", 20)).toEqual(queries.histogram("dihedral", "space", 20));
  });
});

describe("MeshQueries with regions", () => {
  // Two slabs, one above the other: the lower third and the rest.
  const perLayer = 6 * size * size;
  const regions = Uint32Array.from({ length: size * perLayer }, (_, t) => (t < perLayer ? 0 : 1));
  const slabs = new MeshQueries({ mesh: { ...mesh, tetrahedronRegion: regions } });
  const facesWithout = (...hidden: number[]) => slabs.facesOf({ ...whole, hiddenRegions: new Set(hidden) });

  it("gives the corners of each face the region of their element", () => {
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const { faces, values } = slabs.facesOf({ ...whole, cut, shading: "region" });
    expect(values).toHaveLength(3 * faces.length);
    faces.forEach((face, i) => {
      const region = face >> 2 < perLayer ? 0 : 1;
      expect([...values.subarray(3 * i, 3 * i + 3)]).toEqual([region, region, region]);
    });
    expect(new Set(values)).toEqual(new Set([0, 1]));
  });

  it("hides regions and draws the faces behind them, the interface as boundary", () => {
    const [lower, upper] = [facesWithout(1), facesWithout(0)];
    expect(lower.faces.every((face) => face >> 2 < perLayer)).toBe(true);
    expect(upper.faces.every((face) => face >> 2 >= perLayer)).toBe(true);
    // Each slab has two large faces and four narrow ones, with two triangles per square.
    expect(lower.faces).toHaveLength(2 * (2 * size * size + 4 * size));
    expect(upper.faces).toHaveLength(2 * (2 * size * size + 4 * size * (size - 1)));
    for (const { onBoundary } of [lower, upper]) expect(onBoundary.every((flag) => flag === 1)).toBe(true);
    expect(facesWithout(0, 1).faces).toHaveLength(0);
    expect(facesWithout().faces).toEqual(queries.facesOf(whole).faces);
  });
});
