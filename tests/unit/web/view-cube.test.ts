// @vitest-environment happy-dom
import { Matrix4, Vector3 } from "three";
import { expect, it } from "vitest";
import { ViewCamera } from "../../../web/viewer/camera";
import { cubePieces, cubeTransform } from "../../../web/viewer/view-cube";

/** Returns a camera near the unit cube. */
function cameraOf(): ViewCamera {
  const camera = new ViewCamera(document.createElement("div"), false);
  camera.setModelRadius(1);
  camera.resize(400, 400, 0);
  camera.fit(new Vector3(-1, -1, -1), new Vector3(1, 1, 1), false);
  return camera;
}

const matrixOf = (transform: string): Matrix4 =>
  new Matrix4().fromArray(
    transform
      .replace(/^matrix3d\(|\).*$/g, "")
      .split(",")
      .map(Number),
  );

/** Returns a piece as the camera sees it, in the axes of CSS. */
function seen(camera: ViewCamera, transform: string): Matrix4 {
  camera.update(1);
  return matrixOf(cubeTransform(camera.camera.quaternion)).multiply(matrixOf(transform));
}

it.each(cubePieces.filter(({ face }) => face))(
  "the label at the $face is upright in that view",
  ({ face, transform }) => {
    const camera = cameraOf();
    if (face) camera.look(face, false);
    const { elements } = seen(camera, transform);
    for (const [k, entry] of [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0].entries())
      expect(elements[k]).toBeCloseTo(entry, 3);
  },
);

it("each of the 26 pieces faces the viewer who looks from its direction", () => {
  expect(cubePieces).toHaveLength(26);
  const camera = cameraOf();
  for (const { direction, transform } of cubePieces) {
    camera.lookFrom(direction, false);
    const piece = seen(camera, transform);
    const [middle, outward] = [new Vector3().setFromMatrixPosition(piece), new Vector3()];
    outward.setFromMatrixColumn(piece, 2);
    expect(outward.z).toBeCloseTo(1, 3);
    expect(middle.normalize().z).toBeCloseTo(1, 3);
  }
});

it("a view is reached the shorter way round", () => {
  const camera = cameraOf();
  camera.look("front", false);
  camera.rotate(540, 0, false);
  camera.look("left", false);
  camera.update(1);
  expect(camera.controls.azimuthAngle).toBeCloseTo((630 * Math.PI) / 180, 6);
});
