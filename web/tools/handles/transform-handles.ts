import { Group, Object3D, Raycaster, Vector2, type PerspectiveCamera } from "three";
import { TransformControls, type TransformControlsGizmo } from "three/addons/controls/TransformControls.js";
import type { Position } from "../../document/position";
import type { HandleMode } from "../../document/tools";
import { rotationAbout, scalingAbout, translation, type Affine } from "../../document/transforms/affine";
import { roundTo } from "../../document/work-plane";

/** Steps of a drag; 0 for none. */
export interface HandleSteps {
  /** Coordinates of the middle, in model units. */
  readonly length: number;
  /** Degrees. */
  readonly angle: number;
  readonly factor: number;
}

/** What a drag does: an offset, an angle in degrees, or factors. */
export interface HandleMotion {
  readonly map: Affine;
  readonly numbers: readonly number[];
}

/** A position of the pointer from -1 to 1, right and up, as three expects it. */
export interface NormalizedPointer {
  readonly x: number;
  readonly y: number;
}

/** Smallest factor of a scale: a drag through the middle neither flattens nor mirrors. */
const minFactor = 0.05;
/** Rounding errors of the handles: what is smaller counts as no change. */
const precision = 1e-9;

/** Handles of the modes that move and scale, as three names them. */
const handleNames = ["X", "Y", "Z", "XY", "YZ", "XZ", "XYZ"] as const;

const axisIndices: Readonly<Record<string, 0 | 1 | 2>> = { X: 0, Y: 1, Z: 2 };

/**
 * Arrows, rings or boxes at a middle, by which a selection is moved, rotated or scaled. They know nothing of the selection:
 * each drag gives a map of space. Without an element, three's controls have no listeners of their own.
 */
export class TransformHandles {
  readonly root = new Group();
  readonly #target = new Object3D();
  readonly #controls: TransformControls;
  readonly #gizmo: TransformControlsGizmo | undefined;
  readonly #raycaster = new Raycaster();
  /** In model coordinates, when the drag began. */
  #middle: Position = [0, 0, 0];
  #origin: Position = [0, 0, 0];

  constructor(camera: PerspectiveCamera) {
    this.#controls = new TransformControls(camera);
    this.#controls.setSpace("world");
    const helper = this.#controls.getHelper();
    this.#gizmo = helper.children.find((child): child is TransformControlsGizmo => "gizmo" in child);
    this.root.add(this.#target, helper);
    this.#controls.attach(this.#target);
  }

  get isDragging(): boolean {
    return this.#controls.dragging;
  }

  /** The axis of the handle under the pointer; null if it has more than one, or none. */
  get axis(): 0 | 1 | 2 | null {
    return axisIndices[this.#controls.axis ?? ""] ?? null;
  }

  setMode(mode: HandleMode): void {
    this.#controls.setMode(mode);
  }

  /** Places the handles, unless they are dragged. */
  place(middle: Position, origin: Position): void {
    if (this.isDragging) return;
    this.#middle = middle;
    this.#origin = origin;
    this.#target.position.set(middle[0] - origin[0], middle[1] - origin[1], middle[2] - origin[2]);
    this.#target.quaternion.identity();
    this.#target.scale.set(1, 1, 1);
    this.root.updateMatrixWorld(true);
  }

  /** Highlights the handle under the pointer. Returns whether there is one. */
  hover(pointer: NormalizedPointer): boolean {
    this.#controls.pointerHover(asEvent(pointer));
    // Three lets the arrows be taken far beside them, also on the squares of two axes.
    if (this.#controls.mode !== "rotate") this.#controls.axis = this.#drawnAt(pointer) ?? this.#controls.axis;
    // The middle of the arrows belongs to what is selected there: it is dragged in the work plane, with snapping.
    if (this.#controls.mode === "translate" && this.#controls.axis === "XYZ") this.#controls.axis = null;
    return this.#controls.axis !== null;
  }

  press(pointer: NormalizedPointer): void {
    this.#controls.pointerDown(asEvent(pointer));
  }

  /** Returns the map from the beginning of the drag to the pointer, with its numbers. */
  drag(pointer: NormalizedPointer, steps: HandleSteps): HandleMotion {
    this.#controls.pointerMove(asEvent(pointer, -1));
    const { mode } = this.#controls;
    if (mode === "rotate") return this.#rotation(steps.angle);
    return mode === "scale" ? this.#scaling(steps.factor) : this.#translation(steps.length);
  }

  release(pointer: NormalizedPointer): void {
    this.#controls.pointerUp(asEvent(pointer));
  }

  dispose(): void {
    this.#controls.detach();
    this.#controls.getHelper().dispose();
  }

  /** Returns the name of the handle that is drawn under the pointer; null for none. */
  #drawnAt({ x, y }: NormalizedPointer): TransformControls["axis"] {
    const { camera, mode, dragging } = this.#controls;
    if (!this.#gizmo || dragging) return null;
    this.#raycaster.setFromCamera(new Vector2(x, y), camera);
    const hits = this.#raycaster.intersectObject(this.#gizmo.gizmo[mode]);
    const name = hits.find(({ object }) => object.visible)?.object.name;
    return handleNames.find((handle) => handle === name) ?? null;
  }

  #translation(step: number): HandleMotion {
    const { x, y, z } = this.#target.position;
    const at = [x, y, z].map((local, k) => local + (this.#origin[k] ?? 0));
    const offset = at.map((to, k) => {
      const from = this.#middle[k] ?? 0;
      if (Math.abs(to - from) <= precision * Math.max(1, Math.abs(from))) return 0;
      return (step > 0 ? roundTo(to, step) : to) - from;
    });
    return { map: translation(offset as [number, number, number]), numbers: offset };
  }

  #rotation(step: number): HandleMotion {
    const { x, y, z, w } = this.#target.quaternion;
    const length = Math.hypot(x, y, z);
    if (length <= precision) return { map: translation([0, 0, 0]), numbers: [0] };
    const degrees = (2 * Math.atan2(length, w) * 180) / Math.PI;
    const angle = step > 0 ? roundTo(degrees, step) : degrees;
    const axis = [x, y, z].map((part) => roundTo(part / length, precision)) as [number, number, number];
    return { map: rotationAbout(this.#middle, axis, angle), numbers: [angle] };
  }

  #scaling(step: number): HandleMotion {
    const { x, y, z } = this.#target.scale;
    const factors = [x, y, z].map((factor) => {
      const positive = Math.max(minFactor, factor);
      if (Math.abs(positive - 1) <= precision) return 1;
      return step > 0 ? Math.max(minFactor, roundTo(positive, step)) : positive;
    });
    return { map: scalingAbout(this.#middle, factors as [number, number, number]), numbers: factors };
  }
}

/** The methods of the handles take a position of the pointer, whatever their declared type. */
function asEvent({ x, y }: NormalizedPointer, button = 0): PointerEvent {
  return { x, y, button } as unknown as PointerEvent;
}
