import { describe, expect, it } from "vitest";
import type { Position } from "../../../web/document/position";
import type { Cut } from "../../../web/document/selection";
import { cutToElement } from "../../../web/viewer/cut-to-element";
import { gridMesh } from "./grid-mesh";

const mesh = gridMesh(4);
const count = mesh.tetrahedra.length / 4;
const axisIndex = { x: 0, y: 1, z: 2 } as const;

const eyes: readonly Position[] = [
  [1, -1, 1.2],
  [-3, 1, 1],
  [0, 0, -1],
  [0.1, 5, 0.1],
  [0, -2, 0],
];

const cornersAlong = (element: number, axis: Cut["axis"]): number[] =>
  [...mesh.tetrahedra.subarray(4 * element, 4 * element + 4)].map(
    (node) => mesh.points[3 * node + axisIndex[axis]] ?? 0,
  );

const meanOf = (values: readonly number[]): number => values.reduce((a, b) => a + b, 0) / values.length;

describe("the cut to an element", () => {
  it.each(eyes)("leaves nothing in front of it for an eye at %s, %s, %s", (...eye) => {
    for (let element = 0; element < count; element += 7) {
      const { enabled, axis, flipped, position } = cutToElement(mesh, element, eye);
      expect(enabled).toBe(true);
      // The cut opens towards the viewer.
      expect(Math.sign(eye[axisIndex[axis]])).toBe(flipped ? -1 : 1);
      const all = Array.from({ length: count }, (_, t) => cornersAlong(t, axis));
      const [low, high] = [Math.min(...all.flat()), Math.max(...all.flat())];
      const limit = low + position * (high - low);
      const kept = all.filter((corners) => (flipped ? meanOf(corners) >= limit : meanOf(corners) <= limit));
      expect(kept.length).toBeLessThan(count);
      const own = meanOf(all[element] ?? []);
      const tolerance = 1e-9 * (high - low);
      for (const corners of kept) {
        const beyond = flipped ? own - meanOf(corners) : meanOf(corners) - own;
        expect(beyond).toBeLessThanOrEqual(tolerance);
      }
    }
  });

  it("keeps a part of the mesh for every element but those at the far side", () => {
    const [axis, eye]: [Cut["axis"], Position] = ["z", [0, 0, 1]];
    const heights = Array.from({ length: count }, (_, t) => cornersAlong(t, axis));
    const middle = heights.findIndex((corners) => Math.min(...corners) >= 1 && Math.max(...corners) <= 3);
    const { position } = cutToElement(mesh, middle, eye);
    expect(position).toBeGreaterThan(0.1);
    expect(position).toBeLessThan(0.9);
  });
});
