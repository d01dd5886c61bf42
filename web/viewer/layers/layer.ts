import type { Object3D } from "three";
import type { ViewerColors } from "../colors";

/** A place in model coordinates. */
export type Position = readonly [number, number, number];

/** What every layer of the scene offers the viewer. Layers own their GPU resources. */
export interface SceneLayer {
  /** Added to the scene once, by the viewer. */
  readonly root: Object3D;
  setColors(colors: ViewerColors): void;
  dispose(): void;
}
