import type CameraControls from "camera-controls";
import type { Quaternion } from "three";
import { PerspectiveCamera, type Object3D, type WebGLRenderer } from "three";
import { ViewportGizmo, type GizmoOptions } from "three-viewport-gizmo";
import type { ViewerColors } from "./colors";
import { cubePlace } from "./cube-place";
import { KeptPicture } from "./kept-picture";
import { prepareShaders } from "./shaders";

/** Sine of the angle to the z axis below which the view is from above or below: less than a pixel of the cube. */
const alongZ = 1e-3;

/** From where the library draws the cube, which has no name for this camera. */
const cubeCamera = new PerspectiveCamera(26, 1, 5, 10);
cubeCamera.position.set(0, 0, 7);

/** What the picture shows, apart from colours and highlight. */
interface Pictured {
  readonly direction: Quaternion;
  readonly pixelRatio: number;
}

/**
 * The clickable cube in the corner of the view. It consists of many pieces, and each of them is a draw call, so its picture
 * is kept as long as nothing on it changes.
 */
export class ViewCube {
  readonly #renderer: WebGLRenderer;
  readonly #gizmo: ViewportGizmo;
  readonly #fixed: GizmoOptions;
  readonly #requestFrame: () => void;
  readonly #listening = new AbortController();
  readonly #picture: KeptPicture;
  /** What the picture shows; null if it is to be drawn again. */
  #pictured: Pictured | null = null;
  /** The library has a new camera, which is ready for hit tests only when it has drawn with it. */
  #isNew = true;

  constructor(
    camera: PerspectiveCamera,
    renderer: WebGLRenderer,
    controls: CameraControls,
    colors: ViewerColors,
    options: { readonly container: HTMLElement; readonly animated: boolean; readonly onChange: () => void },
  ) {
    this.#renderer = renderer;
    this.#requestFrame = options.onChange;
    this.#fixed = { container: options.container, animated: options.animated };
    this.#picture = new KeptPicture(renderer, cubePlace);
    this.#gizmo = new ViewportGizmo(camera, renderer, { ...styleOf(colors), ...this.#fixed });
    setUpright(this.#gizmo.children);
    this.#gizmo.addEventListener("start", () => {
      controls.enabled = false;
      options.onChange();
    });
    this.#gizmo.addEventListener("change", () => {
      const { x, y, z } = camera.position;
      void controls.setPosition(x, y, z, false);
      options.onChange();
    });
    this.#gizmo.addEventListener("end", () => {
      controls.enabled = true;
      // From above or below, no direction is the library's: the views of the keys have x to the right.
      if (Math.sin(controls.polarAngle) < alongZ) void controls.rotateTo(0, controls.polarAngle, false);
      // A piece that the pointer has left is not highlighted any more.
      this.#pictured = null;
      options.onChange();
    });
    controls.addEventListener("update", () => {
      controls.getTarget(this.#gizmo.target);
      this.#gizmo.update(false);
    });
    let wasOver = false;
    const light = ({ target }: PointerEvent): void => {
      // A pointer that has left the canvas may be over the cube, which is then highlighted.
      const isOver = !(target instanceof HTMLCanvasElement);
      if (isOver || wasOver) {
        this.#pictured = null;
        options.onChange();
      }
      wasOver = isOver;
    };
    const { signal } = this.#listening;
    for (const type of ["pointermove", "pointerdown", "pointerout"] as const)
      options.container.addEventListener(type, light, { signal });
    renderer.domElement.addEventListener("webglcontextrestored", () => (this.#pictured = null), { signal });
  }

  /** Compiles the shaders of the cube. */
  async prepare(renderer: WebGLRenderer, camera: PerspectiveCamera): Promise<void> {
    await prepareShaders(renderer, this.#gizmo, camera);
    await this.#picture.prepare();
  }

  get animating(): boolean {
    return this.#gizmo.animating;
  }

  setColors(colors: ViewerColors): void {
    this.#clear();
    this.#gizmo.set({ ...styleOf(colors), ...this.#fixed });
    setUpright(this.#gizmo.children);
    this.#pictured = null;
    this.#isNew = true;
  }

  resize(): void {
    this.#gizmo.update(false);
  }

  render(): void {
    // The library turns the camera of the view when it draws.
    if (this.#gizmo.animating || this.#isNew) {
      // The kept picture differs by roundings: the view must end with it, however few frames are drawn.
      if (this.#isNew) this.#requestFrame();
      this.#pictured = null;
      this.#isNew = false;
      this.#showFront();
      this.#gizmo.render();
      return;
    }
    const scene = this.#gizmo.parent;
    if (!scene) return;
    const pixelRatio = this.#renderer.getPixelRatio();
    const direction = this.#gizmo.quaternion;
    const before = this.#pictured;
    if (before?.pixelRatio !== pixelRatio || !before.direction.equals(direction)) {
      this.#showFront();
      this.#picture.draw(scene, cubeCamera);
      this.#pictured = { pixelRatio, direction: direction.clone() };
    }
    this.#picture.show();
  }

  dispose(): void {
    this.#listening.abort();
    this.#clear();
    this.#picture.dispose();
  }

  #showFront(): void {
    for (const piece of this.#gizmo.children) piece.visible = this.#isFront(piece);
  }

  /** The library removes every other piece only. */
  #clear(): void {
    do this.#gizmo.dispose();
    while (this.#gizmo.children.length > 0);
  }

  /** Whether the outer side of a piece can be seen. Pieces are flat; each draw call takes time, even if it draws nothing. */
  #isFront({ position }: Object3D): boolean {
    const place = position.clone().applyQuaternion(this.#gizmo.quaternion);
    return place.dot(cubeCamera.position.clone().sub(place)) > 0;
  }
}

/** Rotates the labels of the faces at the top and at the bottom, which the library turns by a right angle with z up. */
export function setUpright(pieces: readonly Object3D[]): void {
  for (const piece of pieces) {
    const { x, y, z } = piece.position;
    if (x === 0 && y === 0 && z !== 0) piece.rotateZ((-Math.sign(z) * Math.PI) / 2);
  }
}

function styleOf(colors: ViewerColors): GizmoOptions {
  const face = (label: string) => ({
    label,
    color: colors.cubeFace,
    labelColor: colors.cubeText,
    hover: { color: colors.cubeHover, labelColor: "#ffffff" },
  });
  const trim = { color: colors.cubeTrim, opacity: 1, hover: { color: colors.cubeHover, opacity: 1 } };
  return {
    type: "cube",
    size: cubePlace.size,
    placement: "top-right",
    offset: { top: cubePlace.offset, right: cubePlace.offset },
    resolution: 128,
    font: { family: "Inter Variable, sans-serif", weight: 600 },
    background: { enabled: false },
    corners: trim,
    edges: trim,
    right: face("Right"),
    left: face("Left"),
    top: face("Top"),
    bottom: face("Bottom"),
    // With z up, the library's names of these two are swapped.
    front: face("Back"),
    back: face("Front"),
  };
}
