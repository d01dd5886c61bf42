import { BufferAttribute, BufferGeometry, DoubleSide, FrontSide, Ray, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { placeOnScale, qualityOf } from "../../../web/document/mesh-quality";
import { patchOfFace } from "../../../web/viewer/patch-finder";
import { nearestHit } from "../../../web/viewer/ray-hit";
import { Survey, type Look } from "../../../web/viewer/mesh-queries";
import { faceNodes } from "../../../web/viewer/topology";
import { gridMesh } from "./grid-mesh";

const size = 3;
const mesh = gridMesh(size);
const survey = new Survey(mesh);
const whole: Look = { origin: [0, 0, 0], cut: null, hiddenRegions: new Set(), shading: "plain" };

const cornersOf = (face: number): number[] =>
  [0, 1, 2].flatMap((k) => {
    const node = mesh.tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + k] ?? 0)] ?? 0;
    return [...mesh.points.subarray(3 * node, 3 * node + 3)];
  });

describe("a survey", () => {
  it("gives the corners of every face it names, relative to the origin, and tells the boundary from the cut", () => {
    const origin = [1, -2, 0.5] as const;
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const { faces, corners, onBoundary } = survey.facesOf({ ...whole, origin, cut });
    expect(faces.length).toBeGreaterThan(0);
    faces.forEach((face, i) => {
      const wanted = cornersOf(face);
      const given = [...corners.subarray(9 * i, 9 * i + 9)].map((x, k) => x + (origin[k % 3] ?? 0));
      expect(given).toEqual(wanted);
      const isOutside = [0, 1, 2].some((axis) =>
        [0, size].some((wall) => [0, 1, 2].every((k) => wanted[3 * k + axis] === wall)),
      );
      expect(onBoundary[i]).toBe(isOutside ? 1 : 0);
    });
  });

  it("shows the boundary again after any cut, and the same as a survey that never cut", () => {
    for (const axis of ["x", "y", "z"] as const) {
      survey.facesOf({ ...whole, cut: { axis, position: 0.2, flipped: true } });
    }
    const { faces } = survey.facesOf(whole);
    expect(faces).toEqual(new Survey(mesh).facesOf(whole).faces);
    expect(faces).toHaveLength(6 * size * size * 2);
  });

  it("colours the three corners of a face by the quality of its element", () => {
    for (const shading of ["radius-ratio", "dihedral"] as const) {
      const { faces, values } = survey.facesOf({ ...whole, shading });
      expect(values).toHaveLength(3 * faces.length);
      faces.forEach((face, i) => {
        const value = placeOnScale(qualityOf(mesh, shading, face >> 2), shading);
        for (const corner of values.subarray(3 * i, 3 * i + 3)) expect(corner).toBeCloseTo(value, 5);
      });
    }
    expect(survey.facesOf(whole).values).toHaveLength(0);
    // As before, when the qualities of all elements are known.
    const before = survey.facesOf({ ...whole, shading: "dihedral" });
    expect(survey.histogram("dihedral", 20).bars.reduce((sum, n) => sum + n)).toBe(
      mesh.tetrahedra.length / 4,
    );
    const after = survey.facesOf({ ...whole, shading: "dihedral" });
    after.values.forEach((value, i) => expect(value).toBeCloseTo(before.values[i] ?? NaN, 5));
  });
});

describe("a survey of regions", () => {
  // Two slabs, one upon the other: the lower third and the rest.
  const perLayer = 6 * size * size;
  const regions = Uint32Array.from({ length: size * perLayer }, (_, t) => (t < perLayer ? 0 : 1));
  const slabs = new Survey({ ...mesh, regions });
  const facesWithout = (...hidden: number[]) => slabs.facesOf({ ...whole, hiddenRegions: new Set(hidden) });

  it("colours each face by the region of its element", () => {
    const cut = { axis: "x", position: 0.5, flipped: false } as const;
    const { faces, values } = slabs.facesOf({ ...whole, cut, shading: "region" });
    expect(values).toHaveLength(3 * faces.length);
    faces.forEach((face, i) => {
      const region = face >> 2 < perLayer ? 0 : 1;
      expect([...values.subarray(3 * i, 3 * i + 3)]).toEqual([region, region, region]);
    });
    expect(new Set(values)).toEqual(new Set([0, 1]));
  });

  it("hides regions, and shows of the others what was behind them, the wall as a boundary", () => {
    const [lower, upper] = [facesWithout(1), facesWithout(0)];
    expect(lower.faces.every((face) => face >> 2 < perLayer)).toBe(true);
    expect(upper.faces.every((face) => face >> 2 >= perLayer)).toBe(true);
    // Of each slab the two large sides and the four narrow ones, two triangles per square.
    expect(lower.faces).toHaveLength(2 * (2 * size * size + 4 * size));
    expect(upper.faces).toHaveLength(2 * (2 * size * size + 4 * size * (size - 1)));
    for (const { onBoundary } of [lower, upper]) expect(onBoundary.every((flag) => flag === 1)).toBe(true);
    expect(facesWithout(0, 1).faces).toHaveLength(0);
    expect(facesWithout().faces).toEqual(survey.facesOf(whole).faces);
  });
});

describe("nearestHit", () => {
  const { faces, corners } = survey.facesOf(whole);
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
  const ray = new Ray(new Vector3(-2, 1.3, 1.6), new Vector3(1, 0, 0));

  it("finds the face turned to the eye, and from inside only a surface with two sides", () => {
    const hit = nearestHit(ray, geometry, FrontSide);
    expect(hit?.distance).toBeCloseTo(2);
    expect(cornersOf(faces[hit?.triangle ?? -1] ?? 0).filter((_, i) => i % 3 === 0)).toEqual([0, 0, 0]);
    const inside = new Ray(new Vector3(1.1, 1.3, 1.6), ray.direction);
    expect(nearestHit(inside, geometry, FrontSide)).toBeNull();
    expect(nearestHit(inside, geometry, DoubleSide)?.distance).toBeCloseTo(size - 1.1);
    expect(nearestHit(new Ray(ray.origin, new Vector3(0, 1, 0)), geometry, DoubleSide)).toBeNull();
  });

  it("goes by the index where there is one", () => {
    const last = faces.length - 1;
    const indexed = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
    const order = Array.from(
      { length: 3 * faces.length },
      (_, i) => 3 * (last - Math.floor(i / 3)) + (i % 3),
    );
    indexed.setIndex(order);
    const direct = nearestHit(ray, geometry, FrontSide);
    expect(nearestHit(ray, indexed, FrontSide)?.triangle).toBe(last - (direct?.triangle ?? 0));
  });
});

describe("patchOfFace", () => {
  it("knows a triangle by its nodes in any order, and no other", () => {
    const triangles = Uint32Array.from([0, 1, 2, 2, 1, 3, 3, 1, 4]);
    const surface = {
      points: new Float64Array(15),
      triangles,
      trianglePatch: Uint32Array.from([5, 6, 7]),
      triangleRegions: new Uint32Array(6),
      sides: new Uint32Array(),
      sideLine: new Uint32Array(),
    };
    expect(patchOfFace(surface, [3, 2, 1])).toBe(6);
    expect(patchOfFace(surface, [1, 4, 3])).toBe(7);
    expect(patchOfFace(surface, [0, 1, 3])).toBeNull();
  });
});
