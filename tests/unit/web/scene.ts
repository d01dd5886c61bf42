import { PerspectiveCamera, Vector3 } from "three";
import type { ProjectPreview } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { ViewStore } from "../../../web/document/selection";
import { viewerColors } from "../../../web/ui/theme/theme";
import type { Layer } from "../../../web/viewer/layers/layer";
import { SceneChanges, type SceneState } from "../../../web/viewer/scene-state";

export const viewport = { width: 200, height: 100, pixelRatio: 1, isHurried: false };

/** Returns the state of a scene with an empty project. */
export function sceneState(change: Partial<SceneState> = {}): SceneState {
  return {
    ...new ViewStore().state.getState(),
    project: emptyProject("Test"),
    preview: null,
    bodies: [],
    mesh: null,
    isMeshStale: false,
    front: null,
    unoptimized: null,
    checkedSurface: null,
    defects: {
      triangles: [],
      patches: new Set(),
      openLines: new Set<number>(),
      areOpenLinesExpected: false,
      bodies: new Map(),
    },
    shownSizes: null,
    shownSmoothness: null,
    shownField: null,
    hasIsosurface: false,
    tints: new Map(),
    isReplaying: false,
    isOtherModel: false,
    isMeshOfOthers: false,
    colors: viewerColors.dark,
    origin: [0, 0, 0],
    viewport,
    ...change,
  };
}

/** Shows states in a layer, one after the other. */
export function show(layer: Layer, ...states: readonly SceneState[]): void {
  states.forEach((state, i) => layer.update(new SceneChanges(state, states[i - 1] ?? null)));
}

/** Shows a state in a layer that already shows another one. */
export function change(layer: Layer, before: SceneState, state: SceneState): void {
  layer.update(new SceneChanges(state, before));
}

/**
 * Returns a camera at (0, -10, 0) that looks along +y, with z up and x to the right. At y = 0, 100 pixels are 10
 * units.
 */
export function frontCamera(): PerspectiveCamera {
  const camera = new PerspectiveCamera(2 * Math.atan(0.5) * (180 / Math.PI), 2, 0.1, 100);
  camera.up.set(0, 0, 1);
  camera.position.set(0, -10, 0);
  camera.lookAt(new Vector3());
  camera.updateMatrixWorld();
  camera.updateProjectionMatrix();
  return camera;
}

/** Returns samples of straight lines, and of patches made of triangles. */
export function preview(
  lines: readonly (readonly number[])[],
  patches: readonly (readonly number[])[] = [],
): ProjectPreview {
  const linePoints = Float64Array.from(lines.flat());
  const patchPoints = Float64Array.from(patches.flat());
  const offsets = (lists: readonly (readonly number[])[], size: number): Uint32Array => {
    let end = 0;
    return Uint32Array.from([0, ...lists.map((list) => (end += list.length / size))]);
  };
  return {
    linePoints,
    lineOffsets: offsets(lines, 3),
    patchPoints,
    patchTriangles: Uint32Array.from({ length: patchPoints.length / 3 }, (_, node) => node),
    patchOffsets: offsets(patches, 9),
  } as unknown as ProjectPreview;
}

/** Replaces the worker that builds trees; never answers. */
export const noTree = (): Promise<never> => new Promise<never>(() => undefined);
