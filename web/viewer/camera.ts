import CameraControls from "camera-controls";
import {
  Box3,
  Matrix4,
  Object3D,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Sphere,
  Spherical,
  Vector2,
  Vector3,
  Vector4,
} from "three";
import type { Position } from "../document/position";

// Must be set before any camera or control exists: z is up throughout.
Object3D.DEFAULT_UP.set(0, 0, 1);
CameraControls.install({
  THREE: { Box3, Matrix4, Quaternion, Raycaster, Sphere, Spherical, Vector2, Vector3, Vector4 },
});

export type StandardView = "isometric" | "front" | "back" | "right" | "left" | "top" | "bottom";

/** Position of the camera: azimuth and polar angle in degrees. The front view looks along +y. */
const standardAngles: { readonly [V in StandardView]: readonly [number, number] } = {
  isometric: [38, 64],
  front: [0, 90],
  back: [180, 90],
  right: [90, 90],
  left: [-90, 90],
  top: [0, 0],
  bottom: [0, 180],
};

/** Where the camera is, and the position it looks at. */
export interface CameraPose {
  readonly eye: Position;
  readonly target: Position;
}

/** Permitted distance from the target, in radii of the model. */
const minDistance = 0.02;
const maxDistance = 40;

/** The same, in distances up to which the scene is drawn. */
const farthest = 3;
/** Smallest distance from the origin up to which the scene is drawn, in radii of the model: the ground takes nine. */
const minReach = 12;

const degrees = Math.PI / 180;
const fieldOfView = 32;
/** Factor on the width and height of a fitted model, which leaves a margin around it. */
const fitMargin = 1.06;

/**
 * Returns the distance from the centre of a box at which it just fills the view.
 * @param azimuth, polar direction of the camera, in radians.
 * @param aspect width / height of the view, or of the part of it that is free.
 */
export function fitDistance(
  low: Vector3,
  high: Vector3,
  azimuth: number,
  polar: number,
  aspect: number,
): number {
  const centre = new Vector3().addVectors(low, high).multiplyScalar(0.5);
  const toEye = new Vector3(
    Math.sin(polar) * Math.sin(azimuth),
    -Math.sin(polar) * Math.cos(azimuth),
    Math.cos(polar),
  );
  const right = new Vector3(Math.cos(azimuth), Math.sin(azimuth), 0);
  const up = new Vector3().crossVectors(toEye, right);
  const upward = Math.tan((fieldOfView / 2) * degrees);
  const sideward = upward * aspect;
  let distance = 0;
  const corner = new Vector3();
  for (let i = 0; i < 8; ++i) {
    corner.set(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z).sub(centre);
    const needed = Math.max(Math.abs(corner.dot(right)) / sideward, Math.abs(corner.dot(up)) / upward);
    distance = Math.max(distance, needed * fitMargin + corner.dot(toEye));
  }
  return distance;
}

/** A box that was fitted into the view, and where the camera has moved for it. */
interface Fit {
  readonly low: Vector3;
  readonly high: Vector3;
  readonly target: Vector3;
  readonly distance: number;
}

/** Relative difference of positions up to which the camera is where it was. */
const poseTolerance = 1e-6;

/** The camera and its orbit, pan, zoom and fit. z is up. */
export class ViewCamera {
  readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.01, 1000);
  readonly controls: CameraControls;
  /** Does a drag with the left button orbit? */
  leftOrbits = false;
  readonly #element: HTMLElement;
  #radius = 1;
  /** Distance from the origin up to which the scene is drawn. */
  #reach = minReach;
  /** Scratch. */
  readonly #direction = new Vector3();
  /** Share of the width that is not covered. */
  #freeShare = 1;
  /** The box that was fitted last; null before any. */
  #fitted: Fit | null = null;

  constructor(element: HTMLElement, smooth: boolean) {
    this.controls = new CameraControls(this.camera, element);
    const { ACTION } = CameraControls;
    element.addEventListener("pointerdown", this.#chooseActions, { capture: true });
    this.#element = element;
    this.controls.mouseButtons.middle = ACTION.TRUCK;
    this.controls.mouseButtons.wheel = ACTION.DOLLY;
    this.controls.touches.one = ACTION.TOUCH_ROTATE;
    this.controls.touches.two = ACTION.TOUCH_DOLLY_TRUCK;
    this.controls.touches.three = ACTION.TOUCH_TRUCK;
    this.controls.dollyToCursor = true;
    this.controls.smoothTime = smooth ? 0.16 : 0;
    this.controls.draggingSmoothTime = smooth ? 0.05 : 0;
    this.look("isometric", false);
  }

  /** Sets how near and how far the camera may go, and the distance from the origin up to which the scene is drawn. */
  setModelRadius(radius: number, reach = 0): void {
    this.#radius = radius;
    this.#reach = Math.max(minReach * radius, reach);
    this.controls.minDistance = radius * minDistance;
    this.controls.maxDistance = Math.max(radius * maxDistance, farthest * this.#reach);
  }

  /** Height of the part of the model that fills the view at the distance of the target. */
  get heightAtTarget(): number {
    return 2 * this.controls.distance * Math.tan((fieldOfView / 2) * degrees);
  }

  /**
   * Sets the size of the view in CSS pixels, and how much of its width is covered at the left: the target appears in the
   * middle of the rest. What was fitted last is fitted again, unless the camera was moved or zoomed since. Returns whether
   * it was fitted again.
   */
  resize(width: number, height: number, coveredLeft: number): boolean {
    const fitted = this.#isAtFit() ? this.#fitted : null;
    this.camera.aspect = width / Math.max(1, height);
    const covered = Math.min(0.5, coveredLeft / Math.max(1, width));
    this.#freeShare = 1 - covered;
    // Width of what the camera sees, at a distance of 1.
    const seen = 2 * Math.tan((fieldOfView / 2) * degrees) * this.camera.aspect;
    this.camera.filmOffset = covered === 0 ? 0 : (-covered / 2) * seen * this.camera.getFilmWidth();
    this.camera.updateProjectionMatrix();
    if (fitted) this.fit(fitted.low, fitted.high, false);
    return fitted !== null;
  }

  /** Moves so that a box, given by two corners, fills the view. The direction stays. */
  fit(low: Vector3, high: Vector3, animate: boolean): void {
    const centre = new Vector3().addVectors(low, high).multiplyScalar(0.5);
    // The direction in which a running rotation will end.
    const { theta, phi } = this.controls.getSpherical(new Spherical(), true);
    const distance = fitDistance(low, high, theta, phi, this.camera.aspect * this.#freeShare);
    void this.controls.moveTo(centre.x, centre.y, centre.z, animate);
    void this.controls.setFocalOffset(0, 0, 0, animate);
    void this.controls.dollyTo(Math.max(distance, this.#radius * minDistance), animate);
    this.#fitted = { low: low.clone(), high: high.clone(), ...this.#aim };
  }

  look(view: StandardView, animate: boolean): void {
    const [azimuth, polar] = standardAngles[view];
    this.#rotateTo(azimuth * degrees, polar * degrees, animate);
  }

  /** Looks from a direction, which may have any length. From above and below, x is to the right. */
  lookFrom([x, y, z]: Position, animate: boolean): void {
    const across = Math.hypot(x, y);
    this.#rotateTo(across === 0 ? 0 : Math.atan2(x, -y), Math.atan2(across, z), animate);
  }

  /** The pose at which a running motion will end, in the coordinates of the scene. */
  get pose(): CameraPose {
    const eye = this.controls.getPosition(new Vector3(), true);
    const target = this.controls.getTarget(new Vector3(), true);
    return { eye: eye.toArray(), target: target.toArray() };
  }

  /** Moves at once. */
  setPose({ eye, target }: CameraPose): void {
    void this.controls.setFocalOffset(0, 0, 0, false);
    void this.controls.setLookAt(...eye, ...target, false);
  }

  /** Moves with the scene, whose coordinates all change by an offset. A running motion of the target ends. */
  shift(offset: readonly [number, number, number]): void {
    const by = new Vector3(...offset);
    const { x, y, z } = this.controls.getTarget(new Vector3(), true).add(by);
    void this.controls.moveTo(x, y, z, false);
    if (!this.#fitted) return;
    for (const position of [this.#fitted.low, this.#fitted.high, this.#fitted.target]) position.add(by);
  }

  /** Rotates by angles in degrees. */
  rotate(azimuth: number, polar: number, animate: boolean): void {
    void this.controls.rotate(azimuth * degrees, polar * degrees, animate);
  }

  /** Moves sideways, by fractions of the distance to the target. */
  pan(right: number, down: number, animate: boolean): void {
    const { distance } = this.controls;
    void this.controls.truck(right * distance, down * distance, animate);
  }

  zoom(factor: number, animate: boolean): void {
    void this.controls.dollyTo(this.controls.distance / factor, animate);
  }

  /**
   * Frames a picture of another shape: it shows all that the view shows, with the target in the middle. Returns a function
   * that restores the view.
   */
  frame(aspect: number): () => void {
    const { aspect: before, filmOffset } = this.camera;
    this.camera.aspect = aspect;
    this.camera.filmOffset = 0;
    this.camera.zoom = Math.min(1, aspect / before);
    return () => {
      Object.assign(this.camera, { aspect: before, filmOffset, zoom: 1 });
      this.camera.clearViewOffset();
    };
  }

  /** Advances running motions. Returns whether the picture changes. */
  update(seconds: number): boolean {
    const moved = this.controls.update(seconds);
    const distance = this.controls.distance;
    // The origin is near the model, the target anywhere.
    const { position } = this.camera;
    const depthOfOrigin = -position.dot(this.camera.getWorldDirection(this.#direction));
    this.camera.near = Math.max(Math.min(distance, depthOfOrigin) - this.#reach, distance * 0.004);
    this.camera.far = Math.max(distance, position.length()) + this.#reach;
    this.camera.updateProjectionMatrix();
    return moved;
  }

  dispose(): void {
    this.#element.removeEventListener("pointerdown", this.#chooseActions, { capture: true });
    this.controls.dispose();
  }

  /** The right button orbits. With Shift, left and right button pan; Ctrl with the right button, too. */
  readonly #chooseActions = ({ shiftKey, ctrlKey, metaKey }: PointerEvent): void => {
    const { ROTATE, TRUCK, NONE } = CameraControls.ACTION;
    this.controls.mouseButtons.left = shiftKey ? TRUCK : this.leftOrbits ? ROTATE : NONE;
    this.controls.mouseButtons.right = shiftKey || ctrlKey || metaKey ? TRUCK : ROTATE;
  };

  /** The position that the camera looks at, and its distance to it, at the end of a running motion. */
  get #aim(): Pick<Fit, "target" | "distance"> {
    return {
      target: this.controls
        .getTarget(new Vector3(), true)
        .add(this.controls.getFocalOffset(new Vector3(), true)),
      distance: this.controls.getSpherical(new Spherical(), true).radius,
    };
  }

  /** Returns whether the camera has at most been rotated since the last fit. */
  #isAtFit(): boolean {
    if (!this.#fitted) return false;
    const { target, distance } = this.#aim;
    const tolerance = poseTolerance * this.#fitted.distance;
    return (
      target.distanceTo(this.#fitted.target) <= tolerance &&
      Math.abs(distance - this.#fitted.distance) <= tolerance
    );
  }

  /** Rotates the shorter way round, by angles in radians. */
  #rotateTo(azimuth: number, polar: number, animate: boolean): void {
    const turns = Math.round((this.controls.azimuthAngle - azimuth) / (2 * Math.PI));
    void this.controls.rotateTo(azimuth + turns * 2 * Math.PI, polar, animate);
  }
}
