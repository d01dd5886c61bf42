import { PerspectiveCamera, Vector3 } from "three";
import { expect, it } from "vitest";
import { fitDistance } from "../../../web/viewer/camera";

const fieldOfView = 32;

/**
 * Returns the largest distance of a box's corners from the centre of the view, as a fraction of its half width or
 * half height.
 */
function reach(low: Vector3, high: Vector3, azimuth: number, polar: number, aspect: number): number {
  const centre = new Vector3().addVectors(low, high).multiplyScalar(0.5);
  const camera = new PerspectiveCamera(fieldOfView, aspect, 0.01, 1e6);
  const distance = fitDistance(low, high, azimuth, polar, aspect);
  camera.up.set(0, 0, 1);
  const toEye = [Math.sin(polar) * Math.sin(azimuth), -Math.sin(polar) * Math.cos(azimuth), Math.cos(polar)];
  camera.position.fromArray(toEye).multiplyScalar(distance).add(centre);
  camera.lookAt(centre);
  camera.updateMatrixWorld();
  camera.updateProjectionMatrix();
  const reaches = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
    const corner = new Vector3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    const { x, y } = corner.project(camera);
    return Math.max(Math.abs(x), Math.abs(y));
  });
  return Math.max(...reaches);
}

it("the fit distance fits boxes of any shape from any direction into views of any shape", () => {
  for (const [x, y, z] of [
    [1, 1, 1],
    [10, 1, 0.1],
    [0, 0, 5],
  ] as const) {
    // prettier-ignore
    const low = new Vector3(3, -4, 5);
    const high = new Vector3(3 + x, -4 + y, 5 + z);
    for (const azimuth of [0, 0.7, 2.5, -1.5]) {
      for (const polar of [0.3, 1.1, Math.PI / 2, 2.8]) {
        for (const aspect of [0.5, 1.6]) {
          const share = reach(low, high, azimuth, polar, aspect);
          expect(share).toBeLessThan(1);
          // The margin is 6 % of the model's size, which is slightly less of the view's.
          expect(share).toBeGreaterThan(0.85);
        }
      }
    }
  }
});

it("the fit distance is proportional to the size of the box and independent of its position", () => {
  const at = (offset: number, size: number): number =>
    fitDistance(new Vector3(offset, 0, 0), new Vector3(offset + size, size, size), 0.6, 1.1, 1.5);
  expect(at(100, 2)).toBeCloseTo(at(0, 2));
  expect(at(0, 20)).toBeCloseTo(10 * at(0, 2));
});
