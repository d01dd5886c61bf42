import {
  BufferGeometry,
  Float32BufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Vector3,
  type Camera,
  type PerspectiveCamera,
} from "three";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** Length of an axis in CSS pixels. */
const pixels = 46;

/** Red, green and blue of each axis: readable on both themes. */
const colors = [
  [0.88, 0.3, 0.4],
  [0.3, 0.66, 0.36],
  [0.3, 0.54, 0.9],
];

/** The axes of coordinates at the origin, of a fixed length on the screen, in front of everything. */
export class AxesLayer implements Layer {
  readonly root: LineSegments;
  readonly #material = new LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true });
  readonly #origin = new Vector3();
  #height = 1;

  constructor() {
    const ends = [0, 1, 2].flatMap((axis) => [0, 0, 0, ...[0, 1, 2].map((k) => (k === axis ? 1 : 0))]);
    const geometry = new BufferGeometry()
      .setAttribute("position", new Float32BufferAttribute(ends, 3))
      .setAttribute(
        "color",
        new Float32BufferAttribute(
          colors.flatMap((color) => [...color, ...color]),
          3,
        ),
      );
    this.root = new LineSegments(geometry, this.#material);
    this.root.frustumCulled = false;
    this.root.renderOrder = 2;
    this.root.matrixAutoUpdate = false;
    this.root.matrixWorldAutoUpdate = false;
    this.root.onBeforeRender = (_renderer, _scene, camera) => this.#place(camera);
  }

  update({ state }: SceneChanges): void {
    const [x, y, z] = state.origin;
    this.#origin.set(-x, -y, -z);
    this.#height = state.viewport.height;
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }

  #place(camera: Camera): void {
    const { fov, zoom, view } = camera as PerspectiveCamera;
    // Of the whole picture, if a part of it is drawn.
    const height = this.#height * (view?.enabled ? view.fullHeight / view.height : 1) * zoom;
    const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
    const direction = new Vector3(0, 0, -1).transformDirection(camera.matrixWorld);
    const depth = Math.max(1e-30, this.#origin.clone().sub(eye).dot(direction));
    const length = (pixels * 2 * depth * Math.tan((fov * Math.PI) / 360)) / height;
    this.root.matrixWorld.makeScale(length, length, length).setPosition(this.#origin);
  }
}
