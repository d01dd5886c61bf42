/** The elements of a front as one mesh, whole and cut open. */
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import { wholeMesh, type WholeMesh } from "../../../web/teach/player/whole-mesh";
import { galleryProject, recordFront } from "../../support/recorded-models";

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
  const whole = wholeMesh(trace, trace.stepCount, false, [0, 0, 0]);
  expect(whole.positions.length).toBe(9 * (trace.steps.frontSizes[0] ?? 0));
  expect(volumeOf(whole)).toBeCloseTo(1, 6);
  // The same relative to another origin.
  expect(volumeOf(wholeMesh(trace, trace.stepCount, false, [3, 4, 5]))).toBeCloseTo(1, 5);
});

it("is the volume behind the front while it advances", () => {
  const half = Math.round(trace.stepCount / 2);
  const volume = volumeOf(wholeMesh(trace, half, false, [0, 0, 0]));
  expect(volume).toBeGreaterThan(0.2);
  expect(volume).toBeLessThan(0.9);
  expect(wholeMesh(trace, 0, false, [0, 0, 0]).positions).toHaveLength(0);
});

it("is about half the model if it is cut open, with whole elements at the cut", () => {
  const cut = wholeMesh(trace, trace.stepCount, true, [0, 0, 0]);
  expect(volumeOf(cut)).toBeCloseTo(0.5, 1);
  expect(cut.values.every((element) => element < trace.elements.nodes.length / 4)).toBe(true);
});
