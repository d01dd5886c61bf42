// @vitest-environment happy-dom
/** The view without WebGL: what it is fitted to when its size changes, and how states are drawn out of sight. */
import { Scene } from "three";
import type { Project } from "tetrafront";
import { beforeEach, expect, it, vi } from "vitest";
import { viewerColors } from "../../../web/ui/theme/theme";
import type { CameraPose } from "../../../web/viewer/camera";
import type { MeshQueryClient } from "../../../web/viewer/queries/mesh-query-client";
import { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { sceneState } from "./scene";

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
vi.mock("../../../web/viewer/view-cube", () => ({
  ViewCube: class {
    readonly animating = false;
    readonly prepare = (): Promise<void> => Promise.resolve();
    readonly setColors = vi.fn();
    readonly resize = vi.fn();
    readonly render = vi.fn();
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
    coveredLeft: () => 0,
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
  viewer.fit([point]);
  resize(390, 640);
  const { pose } = viewer;
  const other = await shownProject();
  other.viewer.fit([point], false);
  expect(pose).toEqual(close(other.viewer.pose));
  other.viewer.fit(null, false);
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
