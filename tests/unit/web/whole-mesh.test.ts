/** The elements of a front as one mesh, whole and cut open. */
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { wholeMesh, type WholeMesh } from "../../../web/teach/player/whole-mesh";
import { galleryProject, recordFront } from "../../support/recorded-models";

const closed = { cutAt: null, isApart: false };
const opened = { cutAt: 0.5, isApart: false };

let trace: Trace;
beforeAll(async () => {
  trace = await recordFront(galleryProject("unit-cube"));
});

/** Volume by the divergence theorem. */
function volumeOf({ positions }: WholeMesh): number {
  let volume = 0;
  for (let at = 0; at < positions.length; at += 9) {
    const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = positions.subarray(
      at,
      at + 9,
    );
    volume += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
  }
  return volume;
}

it("is bounded by the boundary of the model once the front is closed", () => {
  const whole = wholeMesh(trace, trace.stepCount, closed, [0, 0, 0]);
  expect(whole.positions.length).toBe(9 * (trace.steps.frontSizes[0] ?? 0));
  expect(volumeOf(whole)).toBeCloseTo(1, 6);
  // The same relative to another origin.
  expect(volumeOf(wholeMesh(trace, trace.stepCount, closed, [3, 4, 5]))).toBeCloseTo(1, 5);
});

it("is the volume behind the front while it advances", () => {
  const half = Math.round(trace.stepCount / 2);
  const volume = volumeOf(wholeMesh(trace, half, closed, [0, 0, 0]));
  expect(volume).toBeGreaterThan(0.2);
  expect(volume).toBeLessThan(0.9);
  expect(wholeMesh(trace, 0, closed, [0, 0, 0]).positions).toHaveLength(0);
});

it("is about half the model if it is cut open, with whole elements at the cut", () => {
  const cut = wholeMesh(trace, trace.stepCount, opened, [0, 0, 0]);
  expect(volumeOf(cut)).toBeCloseTo(0.5, 1);
  expect(cut.values.every((element) => element < trace.elements.nodes.length / 4)).toBe(true);
});

it("has all faces of elements that are pulled apart, each with the centroid of its own element", () => {
  const apart = wholeMesh(trace, trace.stepCount, { cutAt: null, isApart: true }, [0, 0, 0]);
  const count = trace.elementsAt(trace.stepCount).length;
  expect(apart.positions).toHaveLength(36 * count);
  expect(volumeOf(apart)).toBeCloseTo(1, 5);
  for (let element = 0; element < count; element += 50)
    for (let axis = 0; axis < 3; axis++) {
      // Each corner of an element is one of three of its faces.
      const along = Array.from(
        { length: 12 },
        (_, corner) => apart.positions[36 * element + 3 * corner + axis] ?? 0,
      );
      const mean = along.reduce((sum, x) => sum + x, 0) / 12;
      for (let corner = 0; corner < 12; corner++)
        expect(apart.centroids[36 * element + 3 * corner + axis]).toBeCloseTo(mean, 5);
    }
});

it("grows with the share that is left behind the plane", () => {
  const volumes = [0.2, 0.5, 0.8, 1].map((cutAt) =>
    volumeOf(wholeMesh(trace, trace.stepCount, { cutAt, isApart: false }, [0, 0, 0])),
  );
  expect(volumes).toEqual(volumes.toSorted((a, b) => a - b));
  expect(volumes.at(-1)).toBeCloseTo(1, 6);
});
