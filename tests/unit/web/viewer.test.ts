// @vitest-environment happy-dom
/** The view without WebGL: what it is fitted to when its size changes, and how states are drawn out of sight. */
import { Scene } from "three";
import type { Project } from "tetrafront/project";
import { beforeEach, expect, it, vi } from "vitest";
import { viewerColors } from "../../../web/ui/theme/theme";
import type { CameraPose } from "../../../web/viewer/camera";
import type { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client";
import { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { emptyProject } from "../../../web/document/create";
import { preview, sceneState } from "./scene";

/** What is drawn, in this order. */
let drawn: string[] = [];
let preparing = Promise.resolve();
let finishDrawing: () => void = () => undefined;
vi.mock("../../../web/viewer/scene-renderer", () => ({
  SceneRenderer: class {
    readonly scene = new Scene();
    readonly webgl = {};
    readonly isSharp = true;
    readonly sharpScale = 1;
    readonly prepare = (): Promise<void> => preparing;
    readonly finish = (): Promise<void> => new Promise((resolve) => (finishDrawing = resolve));
    readonly resize = (width: number, height: number) => ({ width, height, pixelRatio: 1, isHurried: false });
    readonly setScale = (): number => 1;
    readonly render = (): void => void drawn.push("frame");
    readonly warmUp = (): void => void drawn.push("hidden");
  },
}));
let notice: () => void = () => undefined;
let frames: (() => void)[] = [];

/** Draws the frames that have been requested, and lets what waits for them go on. */
async function nextFrame(): Promise<void> {
  const due = frames;
  frames = [];
  for (const frame of due) frame();
  await new Promise((resolve) => setTimeout(resolve));
}

beforeEach(() => {
  drawn = [];
  preparing = Promise.resolve();
  frames = [];
  vi.stubGlobal("requestAnimationFrame", (frame: () => void) => frames.push(frame));
  vi.stubGlobal("cancelAnimationFrame", vi.fn());
  vi.stubGlobal(
    "ResizeObserver",
    class {
      constructor(callback: () => void) {
        notice = callback;
      }
      readonly observe = vi.fn();
    },
  );
});

interface Shown {
  readonly viewer: Viewer;
  readonly resize: (width: number, height: number) => void;
}

/** Shows a project as a whole, with motion, in a view of 390 × 640 pixels. */
async function shownProject(project: Project = cubeProject()): Promise<Shown> {
  const container = document.createElement("div");
  const canvas = document.createElement("canvas");
  let size = { width: 390, height: 640 };
  Object.defineProperty(container, "clientWidth", { get: () => size.width });
  Object.defineProperty(container, "clientHeight", { get: () => size.height });
  container.append(canvas);
  const viewer = new Viewer(container, canvas, {
    state: sceneState({ project }),
    colors: viewerColors.dark,
    motion: true,
    smoothEdges: false,
    adaptiveResolution: false,
    coveredLeft: 0,
    meshQueries: { release: vi.fn() } as unknown as MeshQueryClient,
    events: {
      onFrame: vi.fn(),
      onFaces: vi.fn(),
      onFailure: vi.fn(),
      onContextLost: vi.fn(),
      onContextRestored: vi.fn(),
    },
  });
  await vi.dynamicImportSettled();
  do await nextFrame();
  while (frames.length > 0);
  const resize = (width: number, height: number): void => {
    size = { width, height };
    notice();
  };
  return { viewer, resize };
}

const close = ({ eye, target }: CameraPose) => ({
  eye: eye.map((x) => expect.closeTo(x, 9) as number),
  target: target.map((x) => expect.closeTo(x, 9) as number),
});

it("keeps the fit of an entity if its size changes while the camera still moves there", async () => {
  const point = { kind: "point", id: 1 } as const;
  const { viewer, resize } = await shownProject();
  resize(390, 160);
  viewer.framing.fit([point]);
  resize(390, 640);
  const { pose } = viewer;
  const other = await shownProject();
  other.viewer.framing.fit([point], false);
  expect(pose).toEqual(close(other.viewer.pose));
  other.viewer.framing.fit(null, false);
  expect(pose).not.toEqual(close(other.viewer.pose));
});

it("fits the whole model again if its size changes, also one that has grown a little since", async () => {
  const { viewer, resize } = await shownProject();
  resize(390, 160);
  const project = cubeProject();
  const grown: Project = {
    ...project,
    points: [...project.points, { id: 1000, position: [1.4, 0.5, 0.5] }],
  };
  viewer.show({ project: grown });
  const before = viewer.pose;
  resize(390, 640);
  const other = await shownProject(grown);
  expect(viewer.pose).toEqual(close(other.viewer.pose));
  expect(viewer.pose.target).not.toEqual(close(before).target);
});

it("fits a circle of a new model whose points are in view, as soon as it is sampled", async () => {
  const { viewer, resize } = await shownProject(emptyProject("Test"));
  resize(900, 600);
  const far = [0, -4, 0] as const;
  const isInView = async (): Promise<boolean> => {
    viewer.requestFrame();
    await nextFrame();
    const { x, y } = viewer.toScreen(far) ?? { x: NaN, y: NaN };
    return x >= 0 && y >= 0 && x <= 900 && y <= 600;
  };
  const project: Project = {
    ...emptyProject("Test"),
    points: [
      { id: 1, position: [0.5, 0.5, 0] },
      { id: 2, position: [0, 0.6, 0] },
      { id: 3, position: [-0.5, 0.5, 0] },
    ],
    lines: [{ id: 1, type: "circle", points: [1, 2, 3, 1] }],
  };
  const before = viewer.pose;
  viewer.show({ project });
  expect(viewer.pose).toEqual(close(before));
  expect(await isInView()).toBe(false);
  const samples = preview([[...[0.5, 0.5, 0], ...far, ...[-0.5, 0.5, 0]]]);
  viewer.show({ preview: { project, samples } });
  do await nextFrame();
  while (frames.length > 0);
  expect(await isInView()).toBe(true);
  // Once fitted, the view stays while the model is edited within it.
  const fitted = viewer.pose;
  viewer.show({ preview: { project, samples: preview([[...[0.5, 0.5, 0], ...[0, -5, 0]]]) } });
  expect(viewer.pose).toEqual(close(fitted));
});

it("follows a model that outgrows the view by a drag only after the release, and not one that only moves", async () => {
  const { viewer, resize } = await shownProject(emptyProject("Test"));
  resize(900, 600);
  const cube = cubeProject();
  const changed = (change: (position: readonly [number, number, number]) => [number, number, number]) => ({
    ...cube,
    points: cube.points.map((point) => ({ ...point, position: change(point.position) })),
  });
  viewer.show({ project: cube });
  viewer.framing.fit(null, false);
  const fitted = viewer.pose;
  viewer.show({ project: changed(([x, y, z]) => [x + 3, y, z]) });
  expect(viewer.pose).toEqual(close(fitted));
  viewer.framing.hold(true);
  viewer.show({ project: changed(([x, y, z]) => [4 * x, 4 * y, 4 * z]) });
  expect(viewer.pose).toEqual(close(fitted));
  viewer.framing.hold(false);
  expect(viewer.pose).not.toEqual(close(fitted));
});

it("fits a model that shrinks to a dot, as by a change of units, unless it was zoomed to before", async () => {
  const cube = cubeProject();
  const points = cube.points.map((point) => ({
    ...point,
    position: point.position.map((x) => 0.001 * x) as [number, number, number],
  }));
  const small = { ...cube, points };
  const { viewer, resize } = await shownProject(cube);
  resize(900, 600);
  viewer.framing.fit(null, false);
  viewer.requestFrame();
  await nextFrame();
  viewer.show({ project: small });
  const other = await shownProject(small);
  other.resize(900, 600);
  other.viewer.framing.fit(null, false);
  expect(viewer.pose).toEqual(close(other.viewer.pose));
  // The parts that are shown remain where they are if only larger ones are deleted.
  const zoomed = await shownProject({ ...small, points: [...points, ...cube.points.slice(7)] });
  const { pose } = other.viewer;
  zoomed.viewer.setPose(pose);
  zoomed.viewer.requestFrame();
  await nextFrame();
  zoomed.viewer.show({ project: small });
  expect(zoomed.viewer.pose).toEqual(close(pose));
});

it("draws states out of sight while the view is at rest, each followed by the present one, until it is ended", async () => {
  const { viewer } = await shownProject();
  let finishShaders: () => void = () => undefined;
  preparing = new Promise((resolve) => (finishShaders = resolve));
  const end = new AbortController();
  const states = ["first", "second", "third"].map((name) => () => void drawn.push(name));
  vi.useFakeTimers({ toFake: ["setTimeout", "performance"] });
  drawn = [];
  const warm = viewer.warmUp(states, () => void drawn.push("present"), end.signal);
  viewer.requestFrame();
  for (const frame of frames.splice(0)) frame();
  // A frame would wait for the shaders, and so does it.
  expect(drawn).toEqual([]);
  finishShaders();
  await vi.advanceTimersByTimeAsync(1000);
  // A frame is due: a state would delay it.
  expect(drawn).toEqual([]);
  for (const frame of frames.splice(0)) frame();
  expect(drawn).toEqual(["frame"]);
  await vi.advanceTimersByTimeAsync(100);
  expect(drawn).toEqual(["frame"]);
  await vi.advanceTimersByTimeAsync(1000);
  expect(drawn).toEqual(["frame", "first", "hidden", "present"]);
  finishDrawing();
  await vi.advanceTimersByTimeAsync(1000);
  expect(drawn.slice(4)).toEqual(["second", "hidden", "present"]);
  end.abort();
  finishDrawing();
  await vi.advanceTimersByTimeAsync(1000);
  await warm;
  expect(drawn).toHaveLength(7);
  vi.useRealTimers();
});

it("fits the whole model beside what covers the left of the view, and again when it is free", async () => {
  const { viewer, resize } = await shownProject();
  resize(900, 600);
  const corners = [0, 1].flatMap((x) => [0, 1].flatMap((y) => [0, 1].map((z) => [x, y, z] as const)));
  const left = async (): Promise<number> => {
    viewer.requestFrame();
    await nextFrame();
    return Math.min(...corners.map((corner) => viewer.toScreen(corner)?.x ?? NaN));
  };
  const before = await left();
  viewer.setCoveredLeft(358);
  expect(await left()).toBeGreaterThan(358);
  viewer.setCoveredLeft(0);
  expect(await left()).toBeCloseTo(before, 6);
});

it("keeps a view that was zoomed if a part of it is covered, unless the model would no longer be in view", async () => {
  const distance = ({ eye, target }: CameraPose): number =>
    Math.hypot(...eye.map((x, k) => x - (target[k] ?? 0)));
  const { viewer, resize } = await shownProject();
  resize(900, 600);
  viewer.framing.fit(null, false);
  const fitted = distance(viewer.pose);
  viewer.zoom(0.5);
  const far = distance(viewer.pose);
  viewer.setCoveredLeft(358);
  expect(distance(viewer.pose)).toBeCloseTo(far, 9);
  expect(far).toBeGreaterThan(1.5 * fitted);
  viewer.setCoveredLeft(0);
  // Still zoomed out, but so far at the left that it would be covered.
  const { eye, target } = viewer.pose;
  const aside = ([x, y, z]: readonly [number, number, number]) => [x + 1.2, y + 0.9, z] as const;
  viewer.setPose({ eye: aside(eye), target: aside(target) });
  viewer.requestFrame();
  await nextFrame();
  viewer.setCoveredLeft(358);
  expect(distance(viewer.pose)).toBeLessThan(0.9 * far);
});

it("draws nodes of the background grid that are far from the model, from afar and when one of them is in the middle", async () => {
  const cube = cubeProject();
  const far: readonly [number, number, number][] = [
    [60, 0, 0],
    [0, -60, 0],
    [0, 0, 60],
    [-60, -60, -60],
  ];
  const nodes = far.map((position, i) => ({ id: i + 1, position, size: 1 }));
  const background = { ...cube.background, nodes, tetrahedra: [] };
  const { viewer } = await shownProject({ ...cube, background });
  const areShown = (): boolean[] => far.map((position) => viewer.toScreen(position) !== null);
  viewer.show({ layers: { ...sceneState().layers, background: true } });
  viewer.framing.fit(null, false);
  viewer.requestFrame();
  await nextFrame();
  expect(areShown()).toEqual([true, true, true, true]);
  // In front of the camera, a node and the model far behind it.
  viewer.setPose({ eye: [0, -61, 0], target: [0, -60, 0] });
  viewer.requestFrame();
  await nextFrame();
  expect(viewer.toScreen([0.5, 0.5, 0.5])).not.toBeNull();
  expect(viewer.toScreen([0, -60, 0])).not.toBeNull();
});
