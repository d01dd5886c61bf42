import type { Mesh, MeshResult } from "tetrafront";
import type { Project, ProjectPreview } from "tetrafront/project";
import type { ViewState } from "../document/selection";
import type { Defects } from "../document/validate";
import type { ViewerColors } from "./colors";
import type { Position } from "../document/position";
import type { ShownField } from "../session/solutions";
import type { ShownSizes } from "../session/size-feed";
import type { ShownSmoothness } from "../session/smoothness-feed";
import type { ShownBody } from "./shown-bodies";

/** Lines and patches of a project, sampled by the engine. */
export interface SampledProject {
  readonly samples: ProjectPreview;
  /** The project that was sampled; its lists and the samples have the same order. */
  readonly project: Project;
}

export interface Viewport {
  /** CSS pixels. */
  readonly width: number;
  readonly height: number;
  /** Device pixels per CSS pixel. */
  readonly pixelRatio: number;
  /** The frames of a motion follow each other slowly: they are drawn with less detail. */
  readonly isHurried: boolean;
}

/** What the viewer shows. Immutable: parts that are equal by identity have not changed. */
export interface ShownState extends ViewState {
  readonly project: Project;
  readonly preview: SampledProject | null;
  readonly bodies: readonly ShownBody[];
  readonly mesh: MeshResult | null;
  /** The mesh belongs to an earlier state of the project. */
  readonly isMeshStale: boolean;
  /** The mesh is out of date because the project has other bodies: they are drawn instead. */
  readonly isMeshOfOthers: boolean;
  /** Faces of the front of the current run, x y z of three corners each; null if it has not advanced, and without a run. */
  readonly front: Float64Array | null;
  /** The mesh that the current run is optimizing, which is shown instead of `mesh`. */
  readonly unoptimized: Pick<MeshResult, "mesh"> | null;
  /** The boundary that the last run checked; `triangles` and `defects` refer to it. */
  readonly checkedSurface: Mesh | null;
  readonly defects: Defects;
  /** Colours of the groups, by the keys of their members. */
  readonly tints: ReadonlyMap<string, readonly [number, number, number]>;
  /** Target sizes that are shown instead of the surfaces; null for none. */
  readonly shownSizes: ShownSizes | null;
  /** Stripes or curvatures that are shown on the patches, instead of the mesh; null for none. */
  readonly shownSmoothness: ShownSmoothness | null;
  /** Values of the mesh that are shown as its colours; null for none. */
  readonly shownField: ShownField | null;
  /** An isosurface of these values is shown. */
  readonly hasIsosurface: boolean;
  /** A recorded front is shown instead of the surfaces of the model and its mesh. */
  readonly isReplaying: boolean;
}

/** All that the layers draw from. */
export interface SceneState extends ShownState {
  readonly colors: ViewerColors;
  /** Local coordinates are relative to this position, because single precision suffices near zero only. */
  readonly origin: Position;
  readonly viewport: Viewport;
  /** A recorded front of another model is shown, instead of anything of this one. */
  readonly isOtherModel: boolean;
}

/** Returns whether the mesh is drawn, and not only known. */
export const drawsMesh = ({ layers, unoptimized, isMeshOfOthers }: SceneState): boolean =>
  layers.mesh && (unoptimized !== null || !isMeshOfOthers);

/** Returns whether shapes of the shown field are drawn: its mesh is drawn, and neither a front nor anything else instead. */
export function drawsFieldShapes(state: SceneState): boolean {
  const { shownField, mesh, front, unoptimized, shownSizes, shownSmoothness } = state;
  const isOfMesh = shownField !== null && shownField.tetrahedra === mesh?.mesh.tetrahedra;
  const isReplaced = front !== null || unoptimized !== null || state.isMeshOfOthers || state.isReplaying;
  return isOfMesh && !isReplaced && shownSizes === null && shownSmoothness === null;
}

/** Returns whether an isosurface is drawn, which the surfaces of the mesh and of bodies would hide. */
export const drawsIsosurface = (state: SceneState): boolean => state.hasIsosurface && drawsFieldShapes(state);

/** Returns whether faces of tetrahedra or of the front are drawn. A closed front has none. */
export function showsFaces(state: SceneState): boolean {
  const { layers, front, unoptimized, mesh } = state;
  if (front) return layers.mesh && front.length > 0;
  return drawsMesh(state) && ((unoptimized ?? mesh)?.mesh.tetrahedra ?? []).length > 0;
}

/** A new state of the scene, and the state before it. */
export class SceneChanges {
  readonly state: SceneState;
  readonly #before: SceneState | null;

  /** `before` is null for the first state: everything has changed. */
  constructor(state: SceneState, before: SceneState | null) {
    this.state = state;
    this.#before = before;
  }

  /** Returns whether any of these parts has changed. */
  has(...parts: readonly (keyof SceneState)[]): boolean {
    const before = this.#before;
    return before === null || parts.some((part) => before[part] !== this.state[part]);
  }
}
