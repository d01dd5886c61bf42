import type CameraControls from "camera-controls";
import { Vector3, type Object3D, type PerspectiveCamera, type WebGLRenderer } from "three";
import { ViewportGizmo, type GizmoOptions } from "three-viewport-gizmo";
import type { ViewerColors } from "./colors";
import { prepareShaders } from "./shaders";

/** Where the library draws the cube from. */
const eye = new Vector3(0, 0, 7);

/** The clickable cube in the corner of the view. */
export class ViewCube {
  readonly #gizmo: ViewportGizmo;
  readonly #fixed: GizmoOptions;
  readonly #listening = new AbortController();

  constructor(
    camera: PerspectiveCamera,
    renderer: WebGLRenderer,
    controls: CameraControls,
    colors: ViewerColors,
    options: { readonly container: HTMLElement; readonly animated: boolean; readonly onChange: () => void },
  ) {
    this.#fixed = { container: options.container, animated: options.animated };
    this.#gizmo = new ViewportGizmo(camera, renderer, { ...styleOf(colors), ...this.#fixed });
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
      if (isOver || wasOver) options.onChange();
      wasOver = isOver;
    };
    options.container.addEventListener("pointermove", light, { signal: this.#listening.signal });
  }

  /** Compiles the shaders of the cube. */
  async prepare(renderer: WebGLRenderer, camera: PerspectiveCamera): Promise<void> {
    await prepareShaders(renderer, this.#gizmo, camera);
  }

  get animating(): boolean {
    return this.#gizmo.animating;
  }

  setColors(colors: ViewerColors): void {
    this.#clear();
    this.#gizmo.set({ ...styleOf(colors), ...this.#fixed });
  }

  resize(): void {
    this.#gizmo.update(false);
  }

  render(): void {
    for (const piece of this.#gizmo.children) piece.visible = this.#isFront(piece);
    this.#gizmo.render();
  }

  dispose(): void {
    this.#listening.abort();
    this.#clear();
  }

  /** The library removes every other piece only. */
  #clear(): void {
    do this.#gizmo.dispose();
    while (this.#gizmo.children.length > 0);
  }

  /** Whether the outer side of a piece can be seen. Pieces are flat; each draw call takes time, even if it draws nothing. */
  #isFront({ position }: Object3D): boolean {
    const place = position.clone().applyQuaternion(this.#gizmo.quaternion);
    return place.dot(eye.clone().sub(place)) > 0;
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
    size: 92,
    placement: "top-right",
    offset: { top: 10, right: 10 },
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
