// @vitest-environment happy-dom
import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { Bounds } from "../../../web/viewer/bounds";
import { ViewCamera } from "../../../web/viewer/camera";
import { closeUpBox } from "../../../web/viewer/close-up";

const low = new Vector3(-1, -1, -1);
const high = new Vector3(1, 2, 1);

function fittedView(width: number, height: number): ViewCamera {
  const element = document.createElement("div");
  document.body.append(element);
  const view = new ViewCamera(element, false);
  view.setModelRadius(2);
  view.resize(width, height, 0);
  view.fit(low, high, false);
  return view;
}

/** The largest distance of a corner of the box from the middle of the view, as a share of its half width or height. */
function reach(view: ViewCamera): number {
  view.update(1);
  view.camera.updateMatrixWorld();
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) =>
    new Vector3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z).project(view.camera),
  );
  return Math.max(...corners.flatMap(({ x, y }) => [Math.abs(x), Math.abs(y)]));
}

describe("a view whose size changes", () => {
  it("fits the model again, also after a rotation", () => {
    const view = fittedView(390, 640);
    const before = reach(view);
    view.resize(390, 160, 0);
    expect(reach(view)).toBeLessThan(1);
    view.resize(390, 640, 0);
    expect(reach(view)).toBeCloseTo(before, 6);
    view.rotate(25, 10, false);
    view.resize(390, 160, 0);
    view.resize(390, 640, 0);
    expect(reach(view)).toBeGreaterThan(0.85);
    expect(reach(view)).toBeLessThan(1);
  });

  it("keeps a camera that the user has zoomed or moved", () => {
    const zoomed = fittedView(390, 160);
    zoomed.zoom(1.5, false);
    const moved = fittedView(390, 160);
    moved.pan(0.2, 0, false);
    for (const view of [zoomed, moved]) {
      const { pose } = view;
      view.resize(390, 640, 0);
      expect(view.pose).toEqual(pose);
    }
  });
});

describe("the view of a small part", () => {
  const model = new Bounds().add(0, 0, 0).add(4, 3, 0);
  const sizes = (target: Bounds) => {
    const [from, to] = closeUpBox(target, model.radius, [0, 0, 0]);
    return to.sub(from).toArray();
  };

  it("contains a tenth of the model's diagonal on each side", () => {
    const point = new Bounds().add(1, 1, 0);
    expect(sizes(point)).toEqual([1, 1, 1].map((size) => expect.closeTo(size, 12) as number));
    expect(closeUpBox(point, model.radius, [1, 1, 0])[0].toArray()).toEqual([-0.5, -0.5, -0.5]);
  });

  it("has smaller surroundings around a larger part, and none around the model", () => {
    const half = new Bounds().add(0, 0, 0).add(2, 1.5, 0);
    expect(sizes(half)).toEqual([2.5, 2, 0.5].map((size) => expect.closeTo(size, 12) as number));
    expect(sizes(model)).toEqual([4, 3, 0]);
  });

  it("shows a small element in at least a fifth of its sides, however large the model is", () => {
    const element = new Bounds().add(0, 0, 0).add(0.003, 0.004, 0);
    for (const size of sizes(element)) expect(size).toBeLessThanOrEqual(5 * 0.005 + 1e-12);
  });
});
