import {
  type BufferAttribute,
  type BufferGeometry,
  Mesh,
  type Points,
  Ray,
  type ShaderMaterial,
  Vector3,
} from "three";
import { describe, expect, it, vi } from "vitest";
import type { MeshResult } from "tetrafront";
import type { Project, ProjectSource } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { stateCodes } from "../../../web/viewer/draw-state";
import { DotsLayer } from "../../../web/viewer/layers/dots-layer";
import { FrontLayer } from "../../../web/viewer/layers/front-layer";
import type { Layer } from "../../../web/viewer/layers/layer";
import { LinesLayer } from "../../../web/viewer/layers/lines-layer";
import { MeshLayer } from "../../../web/viewer/layers/mesh-layer";
import { PatchesLayer } from "../../../web/viewer/layers/patches-layer";
import { SourcesLayer } from "../../../web/viewer/layers/sources-layer";
import { createDotMaterial } from "../../../web/viewer/materials/dot-material";
import { dotReach } from "../../../web/viewer/nearest";
import type { SceneState } from "../../../web/viewer/scene-state";
import { Screen } from "../../../web/viewer/screen";
import type { QueriedMesh } from "../../../web/viewer/queries/mesh-queries";
import type { DrawnFaces } from "../../../web/viewer/queries/visible-faces";
import type { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client";
import { gridMesh } from "./grid-mesh";
import { change, frontCamera, noTree, preview, sceneState, show, viewport } from "./scene";

const { normal, hover, selected, hidden } = stateCodes;

const project: Project = {
  ...emptyProject("Test"),
  points: [
    { id: 1, position: [0, 0, 0] },
    { id: 2, position: [1, 2, 3] },
  ],
  lines: [
    { id: 5, type: "straight", points: [1, 2] },
    { id: 6, type: "straight", points: [2, 1] },
  ],
  patches: [
    { id: 8, type: "planar", loops: [] },
    { id: 9, type: "planar", loops: [] },
  ],
};
const samples = preview(
  [
    [0, 0, 0, 1, 0, 0, 2, 0, 0],
    [0, 0, 0, 0, 1, 0],
  ],
  [
    [0, 0, 0, 1, 0, 0, 0, 1, 0],
    [0, 0, 1, 1, 0, 1, 0, 1, 1],
  ],
);
const start = sceneState({ project, preview: { samples, project } });

const pointsLayer = () =>
  new DotsLayer({
    kind: "point",
    name: "points",
    shape: "round",
    color: (colors) => colors.point,
    records: (state) => state.project.points,
    positions: (point) => [point.position],
  });

/** Returns the attributes of the first object that a layer draws. */
function attributes(layer: Layer): Record<string, BufferAttribute> {
  const drawn = (layer.root.children[0] ?? layer.root) as Mesh | Points;
  return drawn.geometry.attributes as Record<string, BufferAttribute>;
}

const stateBytes = (layer: Layer): number[] => [...(attributes(layer)["state"]?.array ?? [])];

describe.each([
  ["points", pointsLayer, { kind: "point", id: 2 }, [normal, hover]],
  [
    "lines",
    () => new LinesLayer(),
    { kind: "line", id: 6 },
    [normal, normal, hover].flatMap((code) => [code, code, code, code]),
  ],
  [
    "patches",
    () => new PatchesLayer(noTree),
    { kind: "patch", id: 9 },
    [normal, normal, normal, hover, hover, hover],
  ],
] as const)("the layer of %s", (_, create, entity, hovered) => {
  it("shows hover by writing bytes into the same buffers", () => {
    const layer = create();
    show(layer, start);
    const before = { ...attributes(layer) };
    const versions = Object.entries(before).map(([name, { version }]) => [name, version]);
    change(layer, start, { ...start, hover: entity });
    expect(stateBytes(layer)).toEqual(hovered);
    Object.entries(attributes(layer)).forEach(([name, attribute]) => expect(attribute).toBe(before[name]));
    const touched = Object.entries(before).filter(
      ([name, { version }]) => versions.find(([known]) => known === name)?.[1] !== version,
    );
    expect(touched.map(([name]) => name)).toEqual(["state"]);
  });

  it("shows selection and visibility in the same bytes", () => {
    const layer = create();
    show(layer, start, { ...start, selection: [entity] });
    expect(stateBytes(layer)).toEqual(hovered.map((code) => (code === hover ? selected : code)));
    const state = { ...start, hidden: new Set([`${entity.kind}-${entity.id}`]) };
    show(layer, start, state);
    expect(stateBytes(layer)).toEqual(hovered.map((code) => (code === hover ? hidden : code)));
  });

  it("shows changes made while it was switched off", () => {
    const layer = create();
    const off = { ...start, layers: { ...start.layers, points: false, lines: false, patches: false } };
    show(layer, start, off, { ...off, hover: entity }, { ...start, hover: entity });
    expect(stateBytes(layer)).toEqual(hovered);
  });
});

describe("the layer of points", () => {
  it("draws small dots, and larger ones under the pointer and selected, which show through surfaces", () => {
    const { uniforms, vertexShader } = createDotMaterial("round");
    const sizes = uniforms.stateScales.value;
    const [small, large] = [sizes[normal] ?? 0, Math.min(sizes[hover] ?? 0, sizes[selected] ?? 0)];
    expect(small).toBeGreaterThanOrEqual(6);
    expect(small).toBeLessThanOrEqual(7);
    expect(large).toBeGreaterThanOrEqual(1.5 * small);
    const threshold = Number(/stateScale\(\) > ([\d.]+)/.exec(vertexShader)?.[1]);
    expect(threshold).toBeGreaterThan(small);
    expect(threshold).toBeLessThan(large);
    // The pointer need not be on the dot.
    expect(dotReach).toBeGreaterThan(small / 2 + 4);
  });

  it("writes only the position of a point that moves", () => {
    const layer = pointsLayer();
    show(layer, start);
    const { position } = attributes(layer);
    position?.clearUpdateRanges();
    const [first] = project.points;
    const points = first ? [first, { id: 2, position: [4, 5, 6] as const }] : [];
    change(layer, start, { ...start, project: { ...project, points } });
    expect(attributes(layer)["position"]).toBe(position);
    expect(position?.updateRanges).toEqual([{ start: 3, count: 3 }]);
    expect([...(position?.array ?? [])]).toEqual([0, 0, 0, 4, 5, 6]);
  });

  it("makes room for a new point", () => {
    const layer = pointsLayer();
    const points = [...project.points, { id: 7, position: [9, 9, 9] as const }];
    show(layer, start, { ...start, project: { ...project, points }, hover: { kind: "point", id: 7 } });
    expect(stateBytes(layer)).toEqual([normal, normal, hover]);
    expect([...(attributes(layer)["position"]?.array ?? [])].slice(6)).toEqual([9, 9, 9]);
  });

  it("writes all positions if records exchange their numbers of dots", () => {
    const layer = new SourcesLayer();
    const at = (x: number) => [x, 0, 0] as const;
    const withSources = (...positions: (readonly (readonly [number, number, number])[])[]): SceneState => {
      const sources = positions.map((list, i) => ({ id: i + 1, type: list.length === 1 ? ("point" as const) : ("segment" as const), size: 1, positions: list })); // prettier-ignore
      const kept = [sources[0], unchanged, sources[1]] as ProjectSource[];
      const background = { ...project.background, sources: kept };
      return { ...start, project: { ...project, background }, layers: { ...start.layers, sources: true } };
    };
    const unchanged: ProjectSource = { id: 9, type: "point", size: 1, positions: [at(5)] };
    const before = withSources([at(1), at(2)], [at(3)]);
    show(layer, before);
    change(layer, before, withSources([at(1)], [at(3), at(4)]));
    const dots = layer.root.children.at(-1) as Points;
    const { array } = dots.geometry.getAttribute("position");
    expect([...array].filter((_, i) => i % 3 === 0)).toEqual([1, 5, 3, 4]);
  });

  it("draws relative to the origin", () => {
    const layer = pointsLayer();
    show(layer, start, { ...start, origin: [1, 1, 1] });
    expect([...(attributes(layer)["position"]?.array ?? [])]).toEqual([-1, -1, -1, 0, 1, 2]);
  });
});

describe("the layer of lines", () => {
  it("draws the others if some lines have no samples", () => {
    const layer = new LinesLayer();
    const ids = [5, 6, 7, 8];
    const lines = ids.map((id) => ({ id, type: "straight" as const, points: [1, 2] }));
    const withEmpty = preview([[], [], [0, 0, 0, 1, 0, 0, 2, 0, 0], []], []);
    show(layer, {
      ...start,
      project: { ...project, lines },
      preview: { samples: withEmpty, project: { ...project, lines } },
      hover: { kind: "line", id: 7 },
    });
    expect(stateBytes(layer)).toEqual(Array<number>(8).fill(hover));
    const ends = attributes(layer)["end"];
    expect([0, 4].map((vertex) => ends?.getX(vertex))).toEqual([1, 2]);
  });
});

describe("the layer of lines while a motion must hurry", () => {
  /** Which passes are drawn: normal, thin, emphasized, thin and emphasized, open, defective. */
  const passes = (layer: Layer): boolean[] => layer.root.children.map((pass) => pass.visible);
  const hurry = (state: SceneState): SceneState => ({ ...state, viewport: { ...viewport, isHurried: true } });
  const drawn = (pass: Mesh | undefined): number[] => {
    const { geometry } = pass ?? {};
    return [...(geometry?.getIndex()?.array ?? [])].slice(0, geometry?.drawRange.count);
  };

  it("draws lines thin, but few emphasized ones as wide as before, and alone in their pass", () => {
    const layer = new LinesLayer();
    const chosen = { ...start, selection: [{ kind: "line", id: 6 } as const] };
    show(layer, chosen);
    expect(passes(layer)).toEqual([true, false, true, false, false, false]);
    const emphasized = layer.root.children[2] as Mesh;
    // Line 6 has one segment, the third, with the vertices from 8 to 11.
    expect([...new Set(drawn(emphasized))].sort((a, b) => a - b)).toEqual([8, 9, 10, 11]);
    change(layer, chosen, hurry(chosen));
    expect(passes(layer)).toEqual([false, true, true, false, false, false]);
    change(layer, hurry(chosen), chosen);
    expect(passes(layer)).toEqual([true, false, true, false, false, false]);
  });

  it("draws many emphasized lines thin, too", () => {
    const layer = new LinesLayer();
    const zigzag = Array.from({ length: 800 }, (_, i) => [i, i % 2, 0]).flat();
    const one = { ...project, lines: project.lines.slice(0, 1) };
    const state = {
      ...start,
      project: one,
      preview: { samples: preview([zigzag], []), project: one },
      selection: [{ kind: "line", id: 5 } as const],
    };
    show(layer, hurry(state));
    expect(passes(layer)).toEqual([false, true, false, true, false, false]);
  });

  it("joins segments in one direction, and follows a line that is bent", () => {
    const layer = new LinesLayer();
    show(layer, hurry(start));
    // Two segments of line 5 in one direction, from the first vertex to the last; one segment of line 6.
    expect(drawn(layer.root.children[1] as Mesh)).toEqual([0, 7, 8, 11]);
    // Bent, line 5 has two directions: lines and segments are as many as before.
    const counts = { lines: samples.lineOffsets.length, points: samples.linePoints.length };
    const linePoints = samples.linePoints.slice();
    linePoints[4] = (linePoints[4] ?? 0) + 1;
    const bent = { ...samples, linePoints };
    expect({ lines: bent.lineOffsets.length, points: bent.linePoints.length }).toEqual(counts);
    change(layer, hurry(start), hurry({ ...start, preview: { samples: bent, project } }));
    expect(drawn(layer.root.children[1] as Mesh)).toEqual([0, 3, 4, 7, 8, 11]);
  });

  it("leaves thick lines out where target sizes colour them", () => {
    const layer = new LinesLayer();
    const shownSizes = {} as NonNullable<SceneState["shownSizes"]>;
    show(layer, hurry({ ...start, shownSizes }));
    expect(passes(layer)).toEqual([false, false, false, false, false, false]);
  });
});

describe("the layer of patches", () => {
  it("draws a patch under the pointer in a separate pass, and a selected one also behind others", () => {
    const layer = new PatchesLayer(noTree);
    const visible = (): boolean[] => layer.root.children.map((pass) => pass.visible);
    show(layer, start);
    expect(visible()).toEqual([true, false, false]);
    const hovered = { ...start, hover: { kind: "patch", id: 8 } as const };
    change(layer, start, hovered);
    expect(visible()).toEqual([true, true, false]);
    change(layer, hovered, {
      ...start,
      defects: {
        triangles: [],
        patches: new Set([9]),
        openLines: new Set<number>(),
        areOpenLinesExpected: false,
        bodies: new Map(),
      },
    });
    expect(visible()).toEqual([true, true, true]);
    show(layer, { ...start, hidden: new Set(["patch-8", "patch-9"]) });
    expect(visible()).toEqual([false, false, false]);
  });

  it("draws all in one pass while a motion must hurry, on vertices that follow the samples", () => {
    const layer = new PatchesLayer(noTree);
    const selected = { ...start, selection: [{ kind: "patch", id: 8 } as const] };
    show(layer, selected);
    const hurried = { ...selected, viewport: { ...selected.viewport, isHurried: true } };
    change(layer, selected, hurried);
    const visible = (): boolean[] => layer.root.children.map((pass) => pass.visible);
    expect(visible()).toEqual([false, false, false, true]);
    const [full, , , coarse] = layer.root.children as Mesh[];
    expect(coarse?.geometry.getAttribute("position")).toBe(full?.geometry.getAttribute("position"));
    expect(coarse?.geometry.getIndex()?.count).toBeGreaterThan(0);
    change(layer, hurried, selected);
    expect(visible()).toEqual([true, true, true, false]);
  });

  it("lets a worker build the tree of a large surface at once, but while samples follow each other only at the end", async () => {
    vi.useFakeTimers();
    try {
      const build = vi.fn(() => new Promise<never>(() => undefined));
      const layer = new PatchesLayer(build);
      const square = preview([], [[0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0]]);
      const patchTriangles = Uint32Array.from({ length: 60_000 }, (_, corner) => corner % 3);
      let state = {
        ...start,
        layers: { ...start.layers, patches: true },
        preview: {
          samples: { ...square, patchTriangles },
          project: { ...project, patches: project.patches.slice(0, 1) },
        },
      };
      show(layer, state);
      await vi.advanceTimersByTimeAsync(1000);
      expect(build).toHaveBeenCalledTimes(1);
      for (let step = 1; step <= 20; ++step) {
        const moved = { ...state, origin: [step, 0, 0] as const };
        change(layer, state, moved);
        state = moved;
        await vi.advanceTimersByTimeAsync(50);
      }
      const whileMoving = build.mock.calls.length;
      expect(whileMoving).toBeLessThanOrEqual(2);
      await vi.advanceTimersByTimeAsync(1000);
      expect(build).toHaveBeenCalledTimes(whileMoving + 1);
      layer.dispose();
    } finally {
      vi.useRealTimers();
    }
  });

  it("keeps the vertices on the graphics card if other triangles are drawn while a motion must hurry", () => {
    const layer = new PatchesLayer(noTree);
    const square = preview([], [[0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0]]);
    const one = { ...project, patches: project.patches.slice(0, 1) };
    const hurriedWith = (...triangles: readonly number[]): SceneState => ({
      ...start,
      preview: { samples: { ...square, patchTriangles: Uint32Array.from(triangles) }, project: one },
      viewport: { ...start.viewport, isHurried: true },
    });
    const hurried = hurriedWith(0, 1, 2, 2, 1, 3);
    show(layer, hurried);
    const [full, , , coarse] = layer.root.children as Mesh[];
    const disposed = vi.fn();
    for (const mesh of [full, coarse]) mesh?.geometry.addEventListener("dispose", disposed);
    const drawn = (mesh: Mesh | undefined): number[] => {
      const { count = 0 } = mesh?.geometry.drawRange ?? {};
      return [...(mesh?.geometry.getIndex()?.array ?? [])].slice(0, count);
    };
    const before = coarse?.geometry.getIndex()?.version ?? 0;
    // The other diagonal: as many triangles of as many vertices.
    change(layer, hurried, hurriedWith(0, 1, 3, 0, 3, 2));
    expect(disposed).not.toHaveBeenCalled();
    expect(drawn(coarse)).toEqual(drawn(full));
    expect(coarse?.geometry.getIndex()?.version).toBeGreaterThan(before);
  });
});

it("patches are as opaque over a mesh that is not drawn as without one", () => {
  const layer = new PatchesLayer(noTree);
  const [plain] = layer.root.children as [Mesh];
  const { uniforms } = plain.material as ShaderMaterial;
  const opacity = (): unknown => (uniforms["stateScales"]?.value as number[] | undefined)?.[normal];
  const mesh = { tetrahedra: Uint32Array.from([0, 1, 2, 3]) };
  const meshed = { ...start, mesh: { mesh } as MeshResult };
  show(layer, start);
  const alone = opacity();
  change(layer, start, meshed);
  expect(opacity()).toBeLessThan(Number(alone));
  const ofOthers = { ...meshed, isMeshStale: true, isMeshOfOthers: true };
  change(layer, meshed, ofOthers);
  expect(opacity()).toBe(alone);
  change(layer, ofOthers, { ...ofOthers, unoptimized: { mesh } as SceneState["unoptimized"] });
  expect(opacity()).toBeLessThan(Number(alone));
});

describe("the layer of the front", () => {
  const points = Float64Array.from([1, 0, 0, 2, 0, 0, 1, 1, 0, 1, 0, 1]);
  const front = (...nodes: number[]) =>
    Float64Array.from(nodes.flatMap((node) => [...points.subarray(3 * node, 3 * node + 3)]));
  /** Number of corners that are drawn in front. */
  const drawn = ({ root }: FrontLayer) =>
    root.children.flatMap((child) => (child.visible && child instanceof Mesh ? [child as Mesh] : []));
  const countOf = (layer: FrontLayer) =>
    drawn(layer).reduce((sum, { geometry }) => sum + geometry.drawRange.count / 3, 0);
  const positionOf = (layer: FrontLayer) => drawn(layer)[0]?.geometry.getAttribute("position");

  it("reuses its buffer for a front that is no larger", () => {
    const layer = new FrontLayer();
    const first = { ...start, front: front(0, 1, 2, 0, 3, 1) };
    show(layer, start, first);
    const position = positionOf(layer);
    change(layer, first, { ...start, front: front(1, 2, 3), origin: [1, 0, 0] });
    expect(positionOf(layer)).toBe(position);
    expect(countOf(layer)).toBe(1);
    expect([...(position?.array ?? [])].slice(0, 9)).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  });

  it("copies a large front in pieces, and draws the one before until all are uploaded", () => {
    const layer = new FrontLayer();
    const [small, large, larger] = [1, 70_000, 90_000].map((count) => ({
      ...start,
      front: Float64Array.from({ length: 9 * count }, (_, i) => i),
    }));
    if (!small || !large || !larger) throw new Error("three fronts");
    show(layer, start, small);
    expect(layer.prepareMore(() => undefined)).toBe("nothing");
    change(layer, small, large);
    const uploaded: number[] = [];
    const upload = (geometry: BufferGeometry) => uploaded.push(geometry.getAttribute("position").count);
    expect(layer.prepareMore(upload)).toBe("piece");
    expect(countOf(layer)).toBe(1);
    // What comes meanwhile waits.
    change(layer, large, larger);
    while (layer.prepareMore(upload) === "piece");
    expect(Math.max(...uploaded)).toBeLessThanOrEqual(75_000);
    expect(countOf(layer)).toBe(70_000);
    const last = drawn(layer).at(-1)?.geometry;
    const at = 3 * ((last?.drawRange.count ?? 0) - 1);
    expect([...(last?.getAttribute("position").array ?? [])].slice(at, at + 3)).toEqual([
      629_997, 629_998, 629_999,
    ]);
    while (layer.prepareMore(upload) === "piece");
    expect(countOf(layer)).toBe(90_000);
    expect(layer.prepareMore(upload)).toBe("nothing");
    change(layer, larger, start);
    expect(countOf(layer)).toBe(0);
    expect(layer.root.visible).toBe(false);
  });

  it("draws the front of an incomplete mesh only if no run advances", () => {
    const layer = new FrontLayer();
    const mesh = {
      report: { status: "cancelled" },
      mesh: { points, tetrahedra: Uint32Array.from([0, 1, 2, 3]) },
      front: Uint32Array.from([0, 1, 2]),
    } as unknown as MeshResult;
    const left = { ...start, mesh };
    show(layer, start, left);
    expect(countOf(layer)).toBe(1);
    // The elements enclose it: it shows through them.
    const [behind] = layer.root.children;
    expect(behind).toMatchObject({ visible: true, children: [{ material: { depthTest: false } }] });
    change(layer, left, { ...left, front: front(0, 1, 2) });
    expect(behind?.visible).toBe(false);
    const ofOthers = { ...left, isMeshStale: true, isMeshOfOthers: true };
    change(layer, left, ofOthers);
    expect(layer.root.visible).toBe(false);
    const running = { ...left, front: front() };
    change(layer, ofOthers, running);
    expect(layer.root.visible).toBe(false);
    const done = { ...start, mesh: { ...mesh, report: { ...mesh.report, status: "done" } } as MeshResult };
    change(layer, running, done);
    expect(layer.root.visible).toBe(false);
  });
});

describe("the layer of the mesh", () => {
  function setUp() {
    const queried: QueriedMesh[] = [];
    const answers: { resolve: (faces: DrawnFaces) => void; reject: (failure: Error) => void }[] = [];
    const queries = {
      facesOf: (mesh: QueriedMesh) => {
        queried.push(mesh);
        return new Promise<DrawnFaces>((resolve, reject) => answers.push({ resolve, reject }));
      },
      release: () => undefined,
      treeOf: noTree,
    };
    const reasons: string[] = [];
    const layer = new MeshLayer(queries as unknown as MeshQueryClient, {
      onChange: () => undefined,
      onFailure: (reason) => void reasons.push(reason),
    });
    return { queried, answers, reasons, layer };
  }
  const [one, two] = [gridMesh(1), gridMesh(2)].map(
    (mesh) => ({ mesh, report: {} }) as unknown as MeshResult,
  );
  const withMesh = (mesh = one) => ({ ...start, mesh: mesh ?? null });
  const faces: DrawnFaces = {
    faces: Uint32Array.from([0]),
    onBoundary: Uint8Array.from([1]),
    corners: new Float32Array(9),
    shares: new Uint8Array(),
    shareUnit: 1,
    values: new Float32Array(3),
  };

  /** Hits the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0). */
  const ray = new Ray(new Vector3(0.2, 0.3, 5), new Vector3(0, 0, -1));
  const screen = new Screen(frontCamera(), viewport, { x: 100, y: 50 });
  const triangle = [0, 0, 0, 1, 0, 0, 0, 1, 0];

  it("queries a new mesh at once, and a cut once per frame", async () => {
    const { queried, answers, layer } = setUp();
    show(layer, withMesh());
    expect(queried).toEqual([one]);
    expect(layer.isCurrent).toBe(false);
    answers[0]?.resolve(faces);
    await vi.waitFor(() => expect(layer.isCurrent).toBe(true));
    const cuts = [0.2, 0.3, 0.4].map((position) => ({
      ...withMesh(),
      cut: { ...start.cut, enabled: true, position },
    }));
    show(layer, withMesh(), ...cuts);
    expect(queried).toHaveLength(1);
    layer.queryFaces();
    layer.queryFaces();
    expect(queried).toHaveLength(2);
  });

  it("shows the mesh that a run is optimizing until the result replaces it, without elements to click", async () => {
    const { queried, answers, layer } = setUp();
    const running = { ...withMesh(one), isMeshStale: true };
    show(layer, running);
    answers[0]?.resolve(faces);
    await vi.waitFor(() => expect(layer.isCurrent).toBe(true));
    const advancing = { ...running, front: new Float64Array(9) };
    change(layer, running, advancing);
    expect(layer.root.visible).toBe(false);
    const optimizing = { ...running, unoptimized: two ?? null };
    change(layer, advancing, optimizing);
    expect(queried.at(-1)).toBe(two);
    const cutFaces = { ...faces, onBoundary: Uint8Array.from([0]), corners: Float32Array.from(triangle) };
    answers[1]?.resolve(cutFaces);
    await vi.waitFor(() => expect(layer.isCurrent).toBe(true));
    expect(layer.root.visible).toBe(true);
    expect(layer.hit(ray, screen)).toBeNull();
    const done = withMesh(two);
    change(layer, optimizing, done);
    expect(layer.root.visible).toBe(true);
    expect(layer.hit(ray, screen)?.target).toEqual({ kind: "element", index: 0 });
  });

  it("gives way to other bodies than those it was made of, and is then not hit", async () => {
    const { answers, layer } = setUp();
    const cutFaces = { ...faces, onBoundary: Uint8Array.from([0]), corners: Float32Array.from(triangle) };
    show(layer, withMesh(one));
    answers[0]?.resolve(cutFaces);
    await vi.waitFor(() => expect(layer.isCurrent).toBe(true));
    expect(layer.hit(ray, screen)).not.toBeNull();
    const others = { ...withMesh(one), isMeshStale: true, isMeshOfOthers: true };
    change(layer, withMesh(one), others);
    expect(layer.root.visible).toBe(false);
    expect(layer.hit(ray, screen)).toBeNull();
    change(layer, others, { ...others, unoptimized: two ?? null });
    expect(layer.root.visible).toBe(true);
  });

  it("queries the next mesh after a query has failed, and no mesh twice", async () => {
    const { queried, answers, reasons, layer } = setUp();
    show(layer, withMesh(one), withMesh(two));
    answers[0]?.reject(new Error("no memory"));
    await vi.waitFor(() => expect(reasons).toEqual(["no memory"]));
    layer.queryFaces();
    expect(queried).toEqual([one, two]);
    answers[1]?.reject(new Error("no memory"));
    await vi.waitFor(() => expect(reasons).toHaveLength(2));
    layer.queryFaces();
    expect(queried).toHaveLength(2);
    expect(layer.isCurrent).toBe(true);
  });

  it("hides the old mesh while a front advances", async () => {
    const { answers, layer } = setUp();
    const shown = withMesh();
    show(layer, shown);
    answers[0]?.resolve(faces);
    await vi.waitFor(() => expect(layer.root.visible).toBe(true));
    const front = new Float64Array();
    change(layer, shown, { ...shown, front });
    expect(layer.root.visible).toBe(false);
    change(layer, { ...shown, front }, shown);
    expect(layer.root.visible).toBe(true);
  });
});
