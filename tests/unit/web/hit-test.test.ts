import { BackSide, DoubleSide, FrontSide, Ray, Vector3 } from "three";
import { describe, expect, it, vi } from "vitest";
import type { Project } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { entitiesUnder, hitTest } from "../../../web/viewer/hit-test";
import { DotsLayer } from "../../../web/viewer/layers/dots-layer";
import type { Hit, HittableLayer } from "../../../web/viewer/layers/layer";
import { LinesLayer } from "../../../web/viewer/layers/lines-layer";
import { PatchesLayer } from "../../../web/viewer/layers/patches-layer";
import { SourcesLayer } from "../../../web/viewer/layers/sources-layer";
import { PatchFinder } from "../../../web/viewer/patch-finder";
import { Screen } from "../../../web/viewer/screen";
import type { SceneState } from "../../../web/viewer/scene-state";
import { buildTree } from "../../../web/viewer/triangle-boxes";
import { TriangleTree } from "../../../web/viewer/triangle-tree";
import { frontCamera, noTree, preview, sceneState, show, viewport } from "./scene";

const camera = frontCamera();
const centre = { x: 100, y: 50 };
const front = [3, 0, 0] as const;

const project: Project = {
  ...emptyProject("Test"),
  points: [
    { id: 4, position: [1, 0, 0] },
    { id: 9, position: front },
    { id: 5, position: [3, 20, 0] },
  ],
  lines: [
    { id: 2, type: "straight", points: [4, 9] },
    { id: 6, type: "straight", points: [9, 5] },
  ],
  patches: [
    { id: 8, type: "planar", loops: [] },
    { id: 3, type: "planar", loops: [] },
  ],
  background: {
    ...emptyProject("Test").background,
    sources: [{ id: 11, type: "segment", size: 1, positions: [[-5, 0, 2], [-3, 0, 2]] }], // prettier-ignore
  },
};

/** Line 2 lies in the plane y = 0, line 6 is far behind it; patch 8 is behind patch 3. */
const samples = preview(
  [
    [1, 0, -2, 3, 0, -2],
    [-4, 20, -12, 4, 20, -12, 8, 20, -12],
  ],
  [
    [-9, 9, -4, 9, 9, -4, 0, 9, 9],
    [-4, 2, -4, -2, 2, -4, -3, 2, 4],
  ],
);

const base = sceneState({ project, preview: { samples, project } });
const all: Partial<SceneState> = { layers: { ...base.layers, sources: true } };

/** A layer that hides everything beyond a depth. */
const wall = (depth: number): HittableLayer => ({
  ...({} as HittableLayer),
  hit: (): Hit => ({ target: { kind: "element", index: 5 }, position: [0, 0, 0], depth }),
});
const nothing: HittableLayer = { ...({} as HittableLayer), hit: () => null };

function pick(at: { x: number; y: number }, change: Partial<SceneState> = {}, solid = nothing): Hit | null {
  const points = new DotsLayer({
    kind: "point",
    name: "points",
    shape: "round",
    color: (colors) => colors.point,
    records: (state) => state.project.points,
    positions: (point) => [point.position],
  });
  const [lines, patches, sources] = [new LinesLayer(), new PatchesLayer(noTree), new SourcesLayer()];
  const state = { ...base, ...change };
  for (const layer of [points, lines, patches, sources]) show(layer, state);
  return hitTest(
    { solid: [solid], onSurfaces: [points, sources, lines], translucent: patches },
    camera,
    viewport,
    at,
  );
}

/** Returns where the position (x, d, z) appears in the view. */
const at = (x: number, z: number, d = 0): { x: number; y: number } => ({
  x: 100 + (100 * x) / (10 + d),
  y: 50 - (100 * z) / (10 + d),
});

describe("hit test", () => {
  it("finds the nearest point within reach, and its position", () => {
    const hit = pick({ x: 134, y: 52 });
    expect(hit).toMatchObject({ target: { kind: "point", id: 9 }, position: front });
    expect(hit?.depth).toBeCloseTo(Math.hypot(3, 10));
    expect(pick({ x: 113, y: 53 })?.target).toEqual({ kind: "point", id: 4 });
  });

  it("finds a line within its smaller reach, and the nearest position on it", () => {
    const hit = pick({ x: at(2, -2).x, y: at(2, -2).y + 5 });
    expect(hit?.target).toEqual({ kind: "line", id: 2 });
    hit?.position.forEach((x, k) => expect(x).toBeCloseTo([2, 0, -2][k] ?? 0));
    expect(
      pick({ x: at(2, -2).x, y: at(2, -2).y + 7 }, { layers: { ...base.layers, patches: false } }),
    ).toBeNull();
  });

  it("returns the line to which a segment belongs", () => {
    expect(pick(at(6, -12, 20))?.target).toEqual({ kind: "line", id: 6 });
  });

  it("finds the front patch of two, and the position on it", () => {
    const hit = pick(at(-3, 0.5, 2));
    expect(hit?.target).toEqual({ kind: "patch", id: 3 });
    hit?.position.forEach((x, k) => expect(x).toBeCloseTo([-3, 2, 0.5][k] ?? 0));
    expect(pick(centre)?.target).toEqual({ kind: "patch", id: 8 });
  });

  it("finds all entities under the pointer, each once", () => {
    const patches = new PatchesLayer(noTree);
    show(patches, base);
    const order = { solid: [nothing], onSurfaces: [], translucent: patches };
    const found = entitiesUnder(order, camera, viewport, at(-3, 0.5, 2));
    expect(found).toEqual([
      { kind: "patch", id: 3 },
      { kind: "patch", id: 8 },
    ]);
    expect(entitiesUnder(order, camera, viewport, { x: 0, y: 0 })).toEqual([]);
  });

  it("gives model coordinates although the layers work in local ones", () => {
    const origin = [0, 5, 0] as const;
    const local = frontCamera();
    local.position.y -= 5;
    local.updateMatrixWorld();
    const patches = new PatchesLayer(noTree);
    show(patches, { ...base, origin });
    const order = { solid: [nothing], onSurfaces: [], translucent: patches };
    const hit = hitTest(order, local, viewport, at(-3, 0.5, 2));
    hit?.position.forEach((x, k) => expect(x).toBeCloseTo([-3, 2, 0.5][k] ?? 0));
    expect(hit?.target).toEqual({ kind: "patch", id: 3 });
  });

  it("skips hidden entities and hidden layers", () => {
    expect(pick(at(3, 0), { hidden: new Set(["point-9"]) })?.target).not.toEqual({ kind: "point", id: 9 });
    expect(pick(at(-3, 0.5, 2), { hidden: new Set(["patch-3"]) })?.target).toEqual({ kind: "patch", id: 8 });
    const layers = { ...base.layers, points: false, patches: false, lines: false };
    for (const position of [at(3, 0), at(-3, 0.5, 2), at(2, -2)])
      expect(pick(position, { layers })).toBeNull();
  });

  it("finds nothing behind a solid surface, except sources, which show through", () => {
    const far = wall(1000);
    expect(pick(at(3, 0), {}, far)?.target).toEqual({ kind: "point", id: 9 });
    for (const position of [at(3, 0), at(2, -2), at(-3, 0.5, 2)]) {
      expect(pick(position, {}, wall(5))?.target).toEqual({ kind: "element", index: 5 });
    }
    expect(pick(at(-4, 2), all, wall(5))?.target).toEqual({ kind: "source", id: 11 });
    expect(pick(at(-4, 2))?.target).not.toEqual({ kind: "source", id: 11 });
  });

  it("finds entities on the surface despite rounding", () => {
    const depth = Math.hypot(3, 10);
    expect(pick(at(3, 0), {}, wall(depth * 0.999))?.target).toEqual({ kind: "point", id: 9 });
    expect(pick(at(3, 0), {}, wall(depth * 0.99))?.target).toEqual({ kind: "element", index: 5 });
  });
});

describe("Screen", () => {
  it("projects positions to CSS pixels, and gives their distance from the eye", () => {
    const screen = new Screen(camera, viewport, centre);
    const point = { x: 0, y: 0, depth: 0 };
    expect(screen.project(3, 0, 1, point)).toBe(true);
    expect(point.x).toBeCloseTo(130);
    expect(point.y).toBeCloseTo(40);
    expect(point.depth).toBeCloseTo(Math.hypot(3, 10, 1));
  });

  it("rejects positions behind the eye and beyond the far plane", () => {
    const screen = new Screen(camera, viewport, centre);
    const point = { x: 0, y: 0, depth: 0 };
    expect(screen.project(0, -11, 0, point)).toBe(false);
    expect(screen.project(0, 200, 0, point)).toBe(false);
  });
});

describe("TriangleTree", () => {
  // Two parallel triangles; the second one faces the other way.
  const corners = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1]);
  const tree = new TriangleTree(corners);
  const ray = new Ray(new Vector3(0.2, 0.3, 5), new Vector3(0, 0, -1));

  it("finds the first accepted triangle on the ray that faces the given side", () => {
    expect(tree.firstHit(ray, DoubleSide)).toMatchObject({ triangle: 1, distance: 4 });
    expect(tree.firstHit(ray, FrontSide)).toMatchObject({ triangle: 0, distance: 5 });
    expect(tree.firstHit(ray, DoubleSide, (triangle) => triangle !== 1)?.triangle).toBe(0);
    expect(tree.firstHit(new Ray(ray.origin, new Vector3(1, 0, 0)), DoubleSide)).toBeNull();
  });

  it("finds nothing without triangles", () => {
    expect(new TriangleTree(new Float32Array()).firstHit(ray, DoubleSide)).toBeNull();
  });

  it("finds the same by all triangles and by the tree that a worker builds of a large surface", async () => {
    const soup = randomTriangles(25_000);
    const [prepared, failed] = [new TriangleTree(soup), new TriangleTree(soup)];
    const build = vi.fn((copy: Float32Array) => Promise.resolve(structuredClone(buildTree(copy))));
    await prepared.prepare(build);
    await failed.prepare(() => Promise.reject(new Error("no memory")));
    expect(build).toHaveBeenCalledOnce();
    for (let k = 0; k < 50; ++k) {
      const down = new Ray(new Vector3(0.02 * k, 0.5, 3), new Vector3(0, 0.05, -1).normalize());
      for (const side of [FrontSide, BackSide, DoubleSide]) {
        const [hit, other] = [prepared, failed].map((one) => one.firstHit(down, side, (t) => t % 3 !== 0));
        expect(other?.triangle).toBe(hit?.triangle);
        expect(other?.distance ?? -1).toBeCloseTo(hit?.distance ?? -1, 5);
        expect(hit && hit.triangle % 3).not.toBe(0);
      }
    }
  });

  it("needs no tree for a small surface", async () => {
    const searched = new TriangleTree(randomTriangles(500));
    const build = vi.fn(() => Promise.reject(new Error("not asked")));
    await searched.prepare(build);
    expect(build).not.toHaveBeenCalled();
  });
});

/** Small pseudo-random triangles, the same in every run. */
function randomTriangles(count: number): Float32Array<ArrayBuffer> {
  let seed = 1;
  const random = (): number => (seed = (seed * 16807) % 2147483647) / 2147483647;
  const soup = new Float32Array(9 * count);
  for (let t = 0; t < count; ++t) {
    const middle = [random(), random(), random()];
    for (let i = 0; i < 9; ++i) soup[9 * t + i] = (middle[i % 3] ?? 0) + 0.2 * random();
  }
  return soup;
}

describe("PatchFinder", () => {
  const surface = {
    points: new Float64Array(15),
    triangles: Uint32Array.from([0, 1, 2, 2, 1, 3, 3, 1, 4]),
    trianglePatch: Uint32Array.from([5, 6, 7]),
    triangleRegions: new Uint32Array(6),
    sides: new Uint32Array(),
    sideLine: new Uint32Array(),
  };
  const finder = new PatchFinder(surface);

  it("finds a triangle by its nodes in any order", () => {
    expect(finder.patchOf([0, 1, 2])).toBe(5);
    expect(finder.patchOf([3, 2, 1])).toBe(6);
    expect(finder.patchOf([4, 1, 3])).toBe(7);
    expect(finder.patchOf([1, 4, 3])).toBe(7);
  });

  it("finds nothing for nodes without a common triangle, or not on the boundary", () => {
    expect(finder.patchOf([0, 1, 3])).toBeNull();
    expect(finder.patchOf([17, 1, 3])).toBeNull();
  });
});
