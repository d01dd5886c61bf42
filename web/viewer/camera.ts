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

// Must be set before any camera or control exists: z is up throughout.
Object3D.DEFAULT_UP.set(0, 0, 1);
CameraControls.install({
  THREE: { Box3, Matrix4, Quaternion, Raycaster, Sphere, Spherical, Vector2, Vector3, Vector4 },
});

export type StandardView = "isometric" | "front" | "back" | "right" | "left" | "top" | "bottom";

/** Where the camera stands, as azimuth and polar angle in degrees. Front looks along +y. */
const standardAngles: { readonly [V in StandardView]: readonly [number, number] } = {
  isometric: [38, 64],
  front: [0, 90],
  back: [180, 90],
  right: [90, 90],
  left: [-90, 90],
  top: [0, 0],
  bottom: [0, 180],
};

const degrees = Math.PI / 180;
const fieldOfView = 32;
/** Room around a fitted model, as a factor on its width and height. */
const fitMargin = 1.06;

/** Orbit, pan, zoom and fit around the model. The angles are those of a z-up world. */
export class ViewCamera {
  readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.01, 1000);
  readonly controls: CameraControls;
  #radius = 1;

  constructor(element: HTMLElement, smooth: boolean) {
    this.controls = new CameraControls(this.camera, element);
    const { ACTION } = CameraControls;
    this.controls.mouseButtons.left = ACTION.ROTATE;
    this.controls.mouseButtons.right = ACTION.ROTATE;
    this.controls.mouseButtons.middle = ACTION.TRUCK;
    this.controls.mouseButtons.wheel = ACTION.DOLLY;
    this.controls.touches.one = ACTION.TOUCH_ROTATE;
    this.controls.touches.two = ACTION.TOUCH_DOLLY_TRUCK;
    this.controls.touches.three = ACTION.TOUCH_TRUCK;
    this.controls.dollyToCursor = true;
    this.controls.smoothTime = smooth ? 0.16 : 0;
    this.controls.draggingSmoothTime = smooth ? 0.05 : 0;
    this.#rotateTo("isometric", false);
  }

  /** Sizes that follow from the model: how near and far one may go. */
  setModelRadius(radius: number): void {
    this.#radius = radius;
    this.controls.minDistance = radius * 0.02;
    this.controls.maxDistance = radius * 40;
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
  }

  /** Moves so that a box, given by two corners, fills the view; the direction stays. */
  fit(low: Vector3, high: Vector3, animate: boolean): void {
    const centre = new Vector3().addVectors(low, high).multiplyScalar(0.5);
    // Where a turn under way will end, not where it now is.
    const { theta: azimuthAngle, phi: polarAngle } = this.controls.getSpherical(new Spherical(), true);
    const toEye = new Vector3(
      Math.sin(polarAngle) * Math.sin(azimuthAngle),
      -Math.sin(polarAngle) * Math.cos(azimuthAngle),
      Math.cos(polarAngle),
    );
    const right = new Vector3(Math.cos(azimuthAngle), Math.sin(azimuthAngle), 0);
    const up = new Vector3().crossVectors(toEye, right);
    const upward = Math.tan((fieldOfView / 2) * degrees);
    const sideward = upward * this.camera.aspect;
    let distance = 0;
    const corner = new Vector3();
    for (let i = 0; i < 8; ++i) {
      corner.set(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z).sub(centre);
      const needed = Math.max(Math.abs(corner.dot(right)) / sideward, Math.abs(corner.dot(up)) / upward);
      distance = Math.max(distance, needed * fitMargin + corner.dot(toEye));
    }
    void this.controls.moveTo(centre.x, centre.y, centre.z, animate);
    void this.controls.setFocalOffset(0, 0, 0, animate);
    void this.controls.dollyTo(Math.max(distance, this.#radius * 0.02), animate);
  }

  look(view: StandardView, animate: boolean): void {
    this.#rotateTo(view, animate);
  }

  /** Turns by angles in degrees; for the keyboard. */
  turn(azimuth: number, polar: number, animate: boolean): void {
    void this.controls.rotate(azimuth * degrees, polar * degrees, animate);
  }

  /** Shifts the view by fractions of the distance to the target. */
  shift(right: number, down: number, animate: boolean): void {
    const { distance } = this.controls;
    void this.controls.truck(right * distance, down * distance, animate);
  }

  zoom(factor: number, animate: boolean): void {
    void this.controls.dollyTo(this.controls.distance / factor, animate);
  }

  /** Advances running motions. True while the picture changes. */
  update(seconds: number): boolean {
    const moved = this.controls.update(seconds);
    const distance = this.controls.distance;
    this.camera.near = Math.max(distance - 12 * this.#radius, distance * 0.004);
    this.camera.far = distance + 12 * this.#radius;
    this.camera.updateProjectionMatrix();
    return moved;
  }

  dispose(): void {
    this.controls.dispose();
  }

  #rotateTo(view: StandardView, animate: boolean): void {
    const [azimuth, polar] = standardAngles[view];
    void this.controls.rotateTo(azimuth * degrees, polar * degrees, animate);
  }
}
