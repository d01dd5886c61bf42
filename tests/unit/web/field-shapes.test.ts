import { describe, expect, it } from "vitest";
import { arrowsOf, isosurface } from "../../../web/viewer/queries/field-shapes";
import { MeshQueries } from "../../../web/viewer/queries/mesh-queries";
import { cutSmoothly } from "../../../web/viewer/queries/smooth-cut";
import { gridMesh } from "./grid-mesh";

const mesh = gridMesh(4);
const nodeValues = (f: (x: number, y: number, z: number) => number): Float32Array<ArrayBuffer> =>
  Float32Array.from({ length: mesh.points.length / 3 }, (_, n) =>
    f(mesh.points[3 * n] ?? 0, mesh.points[3 * n + 1] ?? 0, mesh.points[3 * n + 2] ?? 0),
  );

/** Returns the sum of the areas. */
function areaOf(corners: Float32Array): number {
  let area = 0;
  for (let i = 0; i < corners.length; i += 9) {
    const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = corners.subarray(
      i,
      i + 9,
    );
    const [ux, uy, uz, vx, vy, vz] = [bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az];
    area += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }
  return area;
}

describe("an isosurface", () => {
  it("of a linear field is a plane through the whole mesh", () => {
    const corners = isosurface(
      mesh,
      nodeValues((x, y) => x + 0.25 * y),
      2.3,
      [1, 0, 0],
    );
    expect(corners.length).toBeGreaterThan(0);
    for (let i = 0; i < corners.length; i += 3)
      expect((corners[i] ?? 0) + 1 + 0.25 * (corners[i + 1] ?? 0)).toBeCloseTo(2.3, 5);
    // The plane crosses a cube of 4 from y = 0 to 4: an edge of 4 √(1 + 1/16), times the height of 4.
    expect(areaOf(corners)).toBeCloseTo(16 * Math.sqrt(1 + 1 / 16), 4);
  });

  it("is empty beyond the values of the field", () => {
    expect(
      isosurface(
        mesh,
        nodeValues((x) => x),
        4.5,
        [0, 0, 0],
      ),
    ).toHaveLength(0);
  });

  it("of a distance is near its sphere", () => {
    const fine = gridMesh(12);
    const radii = Float32Array.from({ length: fine.points.length / 3 }, (_, n) =>
      Math.hypot(...[0, 1, 2].map((k) => (fine.points[3 * n + k] ?? 0) - 6)),
    );
    const area = areaOf(isosurface(fine, radii, 4, [0, 0, 0]));
    expect(area / (4 * Math.PI * 16)).toBeGreaterThan(0.96);
    expect(area / (4 * Math.PI * 16)).toBeLessThan(1.01);
  });
});

describe("arrows", () => {
  it("begin at nodes, and the longest one has the given length", () => {
    const vectors = new Float64Array(mesh.points.length);
    vectors.set([0, 3, 4], 0);
    vectors.set([1, 0, 0], 3);
    const ends = arrowsOf(mesh.points, vectors, 2);
    expect([...ends.subarray(0, 6)]).toEqual([0, 0, 0, 0, 1.2, 1.6]);
    // The barbs are behind the tip, on both sides.
    const tips = [ends.subarray(6, 12), ends.subarray(12, 18)].map((barb) => [...barb]);
    for (const [tx, ty, tz, x = 0, y = 0, z = 0] of tips) {
      expect([tx, ty, tz]).toEqual([0, 1.2, 1.6]);
      expect(Math.hypot(x, y, z)).toBeLessThan(2);
    }
    const [one, other] = tips;
    expect(one?.slice(3)).not.toEqual(other?.slice(3));
  });

  it("are none if all vectors are zero", () => {
    expect(arrowsOf(mesh.points, new Float64Array(mesh.points.length), 1)).toHaveLength(0);
  });
});

describe("the faces of a mesh with a field", () => {
  const options = {
    origin: [0, 0, 0],
    cut: null,
    hiddenRegions: new Set<number>(),
    shading: "radius-ratio",
    qualitySpace: "space",
    byField: true,
  } as const;

  it("have the position of each corner's own value on the scale", () => {
    const queries = new MeshQueries({ mesh });
    queries.setField({
      values: nodeValues((x) => 10 + x),
      range: [10, 14],
      isPerElement: false,
      offsets: null,
    });
    const { corners, values } = queries.facesOf(options);
    expect(values).toHaveLength(corners.length / 3);
    values.forEach((value, i) => expect(value).toBeCloseTo((corners[3 * i] ?? 0) / 4, 6));
  });

  it("have the colour in the middle if all values are equal", () => {
    const queries = new MeshQueries({ mesh });
    queries.setField({ values: nodeValues(() => 7), range: [7, 7], isPerElement: false, offsets: null });
    expect(new Set(queries.facesOf(options).values)).toEqual(new Set([0.5]));
  });

  it("have one colour per element if the values are those of elements", () => {
    const queries = new MeshQueries({ mesh });
    const count = mesh.tetrahedra.length / 4;
    const values = Float32Array.from({ length: count }, (_, t) => 2 * t);
    queries.setField({ values, range: [0, 2 * count], isPerElement: true, offsets: null });
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const drawn = queries.facesOf({ ...options, cut }, cutSmoothly);
    expect(drawn.faces.length).toBeGreaterThan(0);
    drawn.faces.forEach((face, i) => {
      for (let k = 0; k < 3; ++k) expect(drawn.values[3 * i + k]).toBeCloseTo((face >> 2) / count, 6);
    });
  });

  it.each([
    ["x", 0.4, false],
    ["y", 0.3, true],
    // Through nodes.
    ["z", 0.5, false],
    ["z", 0.75, true],
  ] as const)("are cut smoothly along %s at %f (flipped: %s)", (axis, position, flipped) => {
    const queries = new MeshQueries({ mesh });
    const linear = (x: number, y: number, z: number) => x + 2 * y + 4 * z;
    queries.setField({ values: nodeValues(linear), range: [0, 28], isPerElement: false, offsets: null });
    const cut = { axis, position, flipped };
    const drawn = queries.facesOf({ ...options, origin: [1, 2, 3], cut }, cutSmoothly);
    const k = { x: 0, y: 1, z: 2 }[axis];
    const plane = 4 * position;
    let volume = 0;
    let section = 0;
    drawn.faces.forEach((face, triangle) => {
      const [a = [], b = [], c = []] = [0, 3, 6].map((corner) =>
        [1, 2, 3].map((x, i) => x + (drawn.corners[9 * triangle + corner + i] ?? 0)),
      );
      const minor = (i: number, j: number) => (b[i] ?? 0) * (c[j] ?? 0) - (b[j] ?? 0) * (c[i] ?? 0);
      volume += ((a[0] ?? 0) * minor(1, 2) + (a[1] ?? 0) * minor(2, 0) + (a[2] ?? 0) * minor(0, 1)) / 6;
      [a, b, c].forEach(([x = 0, y = 0, z = 0], corner) =>
        expect(drawn.values[3 * triangle + corner]).toBeCloseTo(linear(x, y, z) / 28, 5),
      );
      expect(face >> 2).toBeLessThan(mesh.tetrahedra.length / 4);
      if (drawn.onBoundary[triangle] === 1) return;
      for (const corner of [a, b, c]) expect(corner[k]).toBeCloseTo(plane, 5);
      section += areaOf(drawn.corners.subarray(9 * triangle, 9 * triangle + 9));
    });
    // What is drawn encloses the part that is left, with all triangles facing outward.
    expect(volume).toBeCloseTo(64 * (flipped ? 1 - position : position), 4);
    expect(section).toBeCloseTo(16, 4);
  });

  it("are cut beside hidden regions as elsewhere", () => {
    const tetrahedronRegion = Uint32Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) =>
      Number(t % 2),
    );
    const queries = new MeshQueries({ mesh: { ...mesh, tetrahedronRegion } });
    queries.setField({ values: nodeValues((x) => x), range: [0, 4], isPerElement: false, offsets: null });
    const cut = { axis: "y", position: 0.4, flipped: false } as const;
    const drawn = queries.facesOf({ ...options, cut, hiddenRegions: new Set([1]) }, cutSmoothly);
    expect([...drawn.faces].every((face) => (face >> 2) % 2 === 0)).toBe(true);
    for (let i = 1; i < drawn.corners.length; i += 3) expect(drawn.corners[i]).toBeLessThan(1.6 + 1e-5);
  });

  it("are moved by offsets of the nodes; the cut is that of the mesh at rest", () => {
    const queries = new MeshQueries({ mesh });
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const values = nodeValues((x) => x);
    queries.setField({ values, range: [0, 4], isPerElement: false, offsets: null });
    const atRest = queries.facesOf({ ...options, cut }, cutSmoothly);
    const offsets = Float32Array.from(mesh.points, (_, i) => (i % 3 === 2 ? 5 : 0));
    queries.setField({ values, range: [0, 4], isPerElement: false, offsets });
    const moved = queries.facesOf({ ...options, cut }, cutSmoothly);
    expect(moved.faces).toEqual(atRest.faces);
    expect([...moved.corners]).toEqual(Array.from(atRest.corners, (x, i) => x + (i % 3 === 2 ? 5 : 0)));
  });
});
