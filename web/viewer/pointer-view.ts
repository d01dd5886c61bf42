import { Raycaster, Vector2, type PerspectiveCamera } from "three";
import type { Position } from "../document/position";
import type { Ray } from "../document/work-plane";
import { addOrigin } from "./layers/layer";
import type { Viewport } from "./scene-state";
import { Screen, type ProjectedPoint, type ScreenPoint } from "./screen";

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
  const screen = new Screen(camera, viewport, pointer);
  const point: ProjectedPoint = { x: 0, y: 0, depth: 0 };
  return {
    pointer,
    ray: {
      origin: addOrigin([eye.x, eye.y, eye.z], origin),
      direction: [direction.x, direction.y, direction.z],
    },
    toScreen: ([x, y, z]) =>
      screen.project(x - origin[0], y - origin[1], z - origin[2], point) ? { x: point.x, y: point.y } : null,
  };
}
