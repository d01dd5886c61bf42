import { Matrix4, Vector3, type PerspectiveCamera } from "three";
import type { Entity } from "../document/entities";
import type { Position } from "../document/position";
import type { Viewport } from "./scene-state";

export interface ScreenPoint {
  /** CSS pixels from the left and from the top of the view. */
  x: number;
  y: number;
}

/** A point of the screen, and its distance from the eye. */
export interface ProjectedPoint extends ScreenPoint {
  depth: number;
}

/** The screen as a hit test sees it: projects local positions, and knows how deep the pointer reaches. */
export class Screen {
  readonly pointer: Readonly<ScreenPoint>;
  /** Positions farther from the eye are covered by a surface. */
  readonly maxDepth: number;
  /** Entities that the pointer passes through. */
  readonly isSkipped: (entity: Entity) => boolean;
  readonly #viewport: Viewport;
  readonly #matrix = new Matrix4();
  readonly #eye = new Vector3();

  constructor(
    camera: PerspectiveCamera,
    viewport: Viewport,
    pointer: ScreenPoint,
    maxDepth = Infinity,
    isSkipped: (entity: Entity) => boolean = () => false,
  ) {
    this.pointer = pointer;
    this.isSkipped = isSkipped;
    this.maxDepth = maxDepth;
    this.#viewport = viewport;
    this.#matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.#eye.setFromMatrixPosition(camera.matrixWorld);
  }

  /** Writes where a local position appears to `point`. Returns false if it lies behind the eye or too far away. */
  project(x: number, y: number, z: number, point: ProjectedPoint): boolean {
    const e = this.#matrix.elements;
    const w = e[3] * x + e[7] * y + e[11] * z + e[15];
    const clipZ = e[2] * x + e[6] * y + e[10] * z + e[14];
    if (clipZ < -w || clipZ > w) return false;
    const { width, height } = this.#viewport;
    point.x = ((e[0] * x + e[4] * y + e[8] * z + e[12]) / w + 1) * 0.5 * width;
    point.y = (1 - (e[1] * x + e[5] * y + e[9] * z + e[13]) / w) * 0.5 * height;
    point.depth = Math.hypot(x - this.#eye.x, y - this.#eye.y, z - this.#eye.z);
    return true;
  }
}

/**
 * Returns a function that finds where a position of the model appears, also beside the view; it gives null behind the eye and
 * too far away. Local coordinates are relative to `origin`.
 */
export function screenProjection(
  camera: PerspectiveCamera,
  viewport: Viewport,
  [x0, y0, z0]: Position,
): (position: Position) => ScreenPoint | null {
  const point: ProjectedPoint = { x: 0, y: 0, depth: 0 };
  const screen = new Screen(camera, viewport, point);
  return ([x, y, z]) => (screen.project(x - x0, y - y0, z - z0, point) ? { x: point.x, y: point.y } : null);
}
