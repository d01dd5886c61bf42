// @vitest-environment happy-dom
import { Object3D, Vector3 } from "three";
import { expect, it } from "vitest";
import { ViewCamera, type StandardView } from "../../../web/viewer/camera";
import { setUpright } from "../../../web/viewer/view-cube";

/** Faces of the cube as its library places them, with the direction in which their labels are read. */
const faces: Readonly<Record<string, readonly [number, number, number]>> = {
  top: [0, 0, 1],
  bottom: [0, 0, -1],
  front: [0, -1, 0],
  right: [1, 0, 0],
  back: [0, 1, 0],
  left: [-1, 0, 0],
};

it.each(Object.entries(faces))("the label at the %s is upright in that view", (view, position) => {
  const face = new Object3D();
  face.up.set(0, 0, 1);
  face.position.set(...position);
  face.lookAt(face.position.clone().multiplyScalar(2));
  setUpright([face]);
  const element = document.createElement("div");
  const camera = new ViewCamera(element, false);
  camera.setModelRadius(1);
  camera.resize(400, 400, 0);
  camera.fit(new Vector3(-1, -1, -1), new Vector3(1, 1, 1), false);
  camera.look(view as StandardView, false);
  camera.update(1);
  camera.camera.updateMatrixWorld();
  face.updateMatrixWorld();
  const axisOf = (object: Object3D, column: number): Vector3 =>
    new Vector3().setFromMatrixColumn(object.matrixWorld, column);
  for (const column of [0, 1])
    expect(axisOf(face, column).dot(axisOf(camera.camera, column))).toBeCloseTo(1, 3);
});
