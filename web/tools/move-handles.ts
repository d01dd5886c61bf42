import { Group, Object3D, type PerspectiveCamera } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { placed, type Quaternion } from "../document/placement";
import type { Position } from "../document/position";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges } from "../viewer/scene-state";

/** How the handles have moved the body since the drag began. */
export interface HandleMotion {
  readonly translation: Position;
  readonly rotation: Quaternion;
}

/** A position of the pointer from -1 to 1, right and up, as three expects it. */
interface NormalizedPointer {
  readonly x: number;
  readonly y: number;
}

/** Handles at the middle of a body: arrows that move it, or rings that rotate it. A tool drives them. */
export class MoveHandles implements Layer {
  readonly root = new Group();
  readonly #target = new Object3D();
  readonly #controls: TransformControls;
  readonly #body: number;
  #start: Position = [0, 0, 0];

  constructor(camera: PerspectiveCamera, body: number, onMotion: (motion: HandleMotion) => void) {
    this.#body = body;
    // Without an element, the handles have no listeners of their own.
    this.#controls = new TransformControls(camera);
    this.#controls.setSpace("world");
    this.root.add(this.#target, this.#controls.getHelper());
    this.#controls.attach(this.#target);
    this.#controls.addEventListener("objectChange", () => {
      const { position, quaternion } = this.#target;
      const [x, y, z] = this.#start;
      onMotion({
        translation: [position.x - x, position.y - y, position.z - z],
        rotation: [quaternion.x, quaternion.y, quaternion.z, quaternion.w],
      });
    });
  }

  setMode(mode: "translate" | "rotate"): void {
    this.#controls.setMode(mode);
  }

  update({ state }: SceneChanges): void {
    const body = state.bodies.find(({ id }) => id === this.#body);
    this.root.visible = body?.given != null;
    if (this.#controls.dragging || !body?.given) return;
    const centre = placed(body.given.drawn.centre, body.placement);
    this.#target.position.set(
      centre[0] - state.origin[0],
      centre[1] - state.origin[1],
      centre[2] - state.origin[2],
    );
    this.#target.quaternion.identity();
    this.root.updateMatrixWorld(true);
  }

  /** Highlights the handle under the pointer. Returns whether there is one. */
  hover(pointer: NormalizedPointer): boolean {
    if (!this.root.visible) return false;
    this.#controls.pointerHover(asEvent(pointer));
    return this.#controls.axis !== null;
  }

  /** Begins to drag the handle under the pointer. */
  press(pointer: NormalizedPointer): void {
    const { x, y, z } = this.#target.position;
    this.#start = [x, y, z];
    this.#controls.pointerDown(asEvent(pointer));
  }

  drag(pointer: NormalizedPointer): void {
    this.#controls.pointerMove(asEvent(pointer, -1));
  }

  release(pointer: NormalizedPointer): void {
    this.#controls.pointerUp(asEvent(pointer));
  }

  dispose(): void {
    this.#controls.detach();
    this.#controls.getHelper().dispose();
  }
}

/** The methods of the handles take a position of the pointer, whatever their declared type. */
function asEvent({ x, y }: NormalizedPointer, button = 0): PointerEvent {
  return { x, y, button } as unknown as PointerEvent;
}
