import { BufferAttribute, BufferGeometry, LineSegments, Matrix4, Vector3, type Camera } from "three";
import { roundTo, type WorkPlane } from "../../document/work-plane";
import { createGroundMaterial } from "../materials/ground-material";
import { setColor, setNumber } from "../materials/uniforms";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** Half the number of lines in each direction. */
const lines = 40;

/** The grid of the work plane around the middle of the view. Its step follows the zoom. */
export class PlaneGridLayer implements Layer {
  readonly #material = createGroundMaterial();
  readonly root = new LineSegments(unitGrid(), this.#material);
  readonly #stepNow: () => number;
  #plane: WorkPlane | null = null;
  #origin = new Vector3();

  /** @param stepNow returns the step of the grid at the present zoom. */
  constructor(stepNow: () => number) {
    this.#stepNow = stepNow;
    this.root.frustumCulled = false;
    this.root.renderOrder = -1;
    this.root.matrixAutoUpdate = false;
    this.root.matrixWorldAutoUpdate = false;
    setNumber(this.#material, "reach", lines);
    this.root.onBeforeRender = (_renderer, _scene, camera) => this.#place(camera);
  }

  update(changes: SceneChanges): void {
    const { colors, workPlane, origin } = changes.state;
    if (changes.has("colors")) setColor(this.#material, "color", colors.ground);
    this.#plane = workPlane;
    this.#origin.set(...origin);
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }

  #place(camera: Camera): void {
    if (!this.#plane) return;
    const { origin, x, y, z } = this.#plane.frame;
    const step = this.#stepNow();
    const [u, v, normal] = [new Vector3(...x), new Vector3(...y), new Vector3(...z)];
    const zero = new Vector3(...origin).sub(this.#origin);
    const middle = middleOfView(camera, zero, normal).sub(zero);
    const [right, up] = [roundTo(middle.dot(u), step), roundTo(middle.dot(v), step)];
    const corner = zero.addScaledVector(u, right).addScaledVector(v, up);
    this.root.matrixWorld
      .makeBasis(u, v, normal)
      .multiply(new Matrix4().makeScale(step, step, step))
      .setPosition(corner);
  }
}

/** Returns where the middle of the view meets a plane; if it does so far away or never, the position below the eye. */
function middleOfView(camera: Camera, on: Vector3, normal: Vector3): Vector3 {
  const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const direction = new Vector3(0, 0, -1).transformDirection(camera.matrixWorld);
  const height = on.clone().sub(eye).dot(normal);
  const slope = direction.dot(normal);
  const distance = height / slope;
  const isNear = distance > 0 && Math.abs(slope) > 0.1;
  return isNear ? eye.addScaledVector(direction, distance) : eye.addScaledVector(normal, height);
}

/** A grid with step 1, in pieces, because the fading is interpolated between the ends of a piece. */
function unitGrid(): BufferGeometry {
  const ends: number[] = [];
  for (let i = -lines; i <= lines; ++i) {
    for (let j = -lines; j < lines; j += 4) {
      ends.push(i, j, 0, i, j + 4, 0, j, i, 0, j + 4, i, 0);
    }
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
}
