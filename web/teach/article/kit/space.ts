/**
 * Scenes in space without a graphics card: a camera on a sphere around a target, which turns points into pixels. Lines keep
 * their widths, and the drawing prints. Enough for a handful of triangles.
 */
import type { Position } from "../../../document/position";
import { addScaled, dot, subtract } from "../../../document/vectors";
import { clamp } from "./motion";
import type { Pixel, Stage } from "./stage";

export interface CameraOptions {
  readonly target: Position;
  readonly distance: number;
  /** Angles in radians. */
  readonly yaw: number;
  readonly pitch: number;
  /** Range of the pitch that a reader can reach; from a little above the ground on, if it is not given. */
  readonly pitches?: readonly [number, number];
}

/** Width / height below which the camera goes back, so that the scene fits the width. */
const narrow = 1.25;
/** Half the opening angle of the camera, as a tangent. */
const opening = Math.tan(((30 / 2) * Math.PI) / 180);

type Axes = readonly [Position, Position, Position];

export class Camera {
  target: Position;
  distance: number;
  yaw: number;
  pitch: number;
  readonly #pitches: readonly [number, number];
  /** The axes, and the angles that they belong to. */
  #known: { readonly yaw: number; readonly pitch: number; readonly axes: Axes } | null = null;

  constructor(
    readonly stage: Stage,
    options: CameraOptions,
  ) {
    this.target = options.target;
    this.distance = options.distance;
    this.yaw = options.yaw;
    this.pitch = options.pitch;
    this.#pitches = options.pitches ?? [0.08, 1.4];
    this.#turnByPointer();
    this.#turnByKeys();
  }

  /** The axes of the view: to the right, up, and towards the eye. */
  get axes(): Axes {
    const { yaw, pitch } = this;
    if (this.#known?.yaw === yaw && this.#known.pitch === pitch) return this.#known.axes;
    const [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
    const axes: Axes = [
      [cy, sy, 0],
      [-sp * sy, sp * cy, cp],
      [cp * sy, -cp * cy, sp],
    ];
    this.#known = { yaw, pitch, axes };
    return axes;
  }

  get #reach(): number {
    return this.distance * Math.max(1, narrow / (this.stage.width / this.stage.height));
  }

  get eye(): Position {
    const towards = this.axes[2];
    return this.target.map((x, i) => x + (towards[i] ?? 0) * this.#reach) as unknown as Position;
  }

  /** Returns the distance of a point from the eye, along the view. */
  depth(point: Position): number {
    return this.#reach - dot(subtract(point, this.target), this.axes[2]);
  }

  pixel(point: Position): Pixel {
    const { width, height } = this.stage;
    const [right, up] = this.axes;
    const from = subtract(point, this.target);
    const scale = height / 2 / opening / Math.max(0.05, this.depth(point));
    return [width / 2 + dot(from, right) * scale, height / 2 - dot(from, up) * scale];
  }

  /** Returns the ray through a pixel: from the eye, in a direction of any length. */
  ray([x, y]: Pixel): { readonly from: Position; readonly direction: Position } {
    const { width, height } = this.stage;
    const [right, up, towards] = this.axes;
    const [u, v] = [(x - width / 2) * ((2 * opening) / height), (height / 2 - y) * ((2 * opening) / height)];
    const direction = [0, 1, 2].map((i) => (right[i] ?? 0) * u + (up[i] ?? 0) * v - (towards[i] ?? 0));
    return { from: this.eye, direction: direction as unknown as Position };
  }

  /** Returns where the ray through a pixel meets a plane; null if they are parallel or it is behind the eye. */
  onPlane(pixel: Pixel, through: Position, normal: Position): Position | null {
    const { from, direction } = this.ray(pixel);
    const along = dot(direction, normal);
    if (Math.abs(along) < 1e-9) return null;
    const t = dot(subtract(through, from), normal) / along;
    return t > 0 ? addScaled(from, direction, t) : null;
  }

  #turnByPointer(): void {
    const { element } = this.stage;
    element.classList.add("turns");
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.target instanceof HTMLButtonElement) return;
      const [x, y, yaw, pitch] = [event.clientX, event.clientY, this.yaw, this.pitch];
      element.setPointerCapture(event.pointerId);
      const turn = (moved: PointerEvent): void => {
        this.yaw = yaw - (moved.clientX - x) * 0.008;
        this.pitch = clamp(pitch + (moved.clientY - y) * 0.006, ...this.#pitches);
        this.stage.requestDraw();
      };
      element.addEventListener("pointermove", turn);
      for (const type of ["pointerup", "pointercancel"])
        element.addEventListener(type, () => element.removeEventListener("pointermove", turn), {
          once: true,
        });
    });
  }

  #turnByKeys(): void {
    const { element } = this.stage;
    element.tabIndex = 0;
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", "View: arrow keys turn it");
    element.addEventListener("keydown", (event) => {
      const turn = { ArrowLeft: [0.12, 0], ArrowRight: [-0.12, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[
        event.key
      ];
      if (!turn || event.target !== element) return;
      event.preventDefault();
      this.yaw += turn[0] ?? 0;
      this.pitch = clamp(this.pitch + (turn[1] ?? 0), ...this.#pitches);
      this.stage.requestDraw();
    });
  }
}
