import { Raycaster, Vector2, type PerspectiveCamera } from "three";
import type { Position } from "../document/position";
import type { Ray } from "../document/work-plane";
import { addOrigin } from "./layers/layer";
import type { Viewport } from "./scene-state";
import { screenProjection, type ScreenPoint } from "./screen";

/** The view as seen from one position of the pointer, in model coordinates. */
export interface PointerView {
  readonly pointer: ScreenPoint;
  /** From the eye through the pointer. */
  readonly ray: Ray;
  /** Returns where a position appears, also beside the view; null if it lies behind the eye or too far away. */
  readonly toScreen: (position: Position) => ScreenPoint | null;
}

export function pointerView(
  camera: PerspectiveCamera,
  viewport: Viewport,
  origin: Position,
  pointer: ScreenPoint,
): PointerView {
  const raycaster = new Raycaster();
  const { width, height } = viewport;
  raycaster.setFromCamera(new Vector2((2 * pointer.x) / width - 1, 1 - (2 * pointer.y) / height), camera);
  const { origin: eye, direction } = raycaster.ray;
  return {
    pointer,
    ray: {
      origin: addOrigin([eye.x, eye.y, eye.z], origin),
      direction: [direction.x, direction.y, direction.z],
    },
    toScreen: screenProjection(camera, viewport, origin),
  };
}
