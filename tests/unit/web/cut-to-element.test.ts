import { describe, expect, it } from "vitest";
import type { Position } from "../../../web/document/position";
import type { Cut } from "../../../web/document/selection";
import { cutToElement } from "../../../web/viewer/cut-to-element";
import { between, cross, dot, mean, subtract } from "../../../web/document/vectors";
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

/** Returns whether a ray from a position hits a tetrahedron: clips it by the planes of the faces (Cyrus and Beck, 1978). */
function isHit(corners: readonly Position[], from: Position, direction: Position): boolean {
  let [first, last] = [0, Infinity];
  for (let face = 0; face < 4; face++) {
    const [a, b, c] = corners.filter((_, i) => i !== face) as [Position, Position, Position];
    const inner = corners[face] ?? a;
    const normal = cross(subtract(b, a), subtract(c, a));
    const inwards = dot(normal, subtract(inner, a)) < 0 ? -1 : 1;
    const height = inwards * dot(normal, subtract(from, a));
    const slope = inwards * dot(normal, direction);
    if (slope === 0) {
      if (height < 0) return false;
    } else if (slope > 0) first = Math.max(first, -height / slope);
    else last = Math.min(last, -height / slope);
  }
  return last - first > 1e-9;
}

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

  it.each(eyes)("leaves no element in its sight for an eye at %s, %s, %s", (...eye) => {
    const corners = (t: number): Position[] =>
      [...mesh.tetrahedra.subarray(4 * t, 4 * t + 4)].map((node) => {
        const [x = 0, y = 0, z = 0] = mesh.points.subarray(3 * node, 3 * node + 3);
        return [x, y, z];
      });
    for (let element = 0; element < count; element += 5) {
      const { axis, flipped, position } = cutToElement(mesh, element, eye);
      // An element at the far side is shown among those beside it.
      if ((flipped ? 1 - position : position) < 0.15) continue;
      const limit = 4 * position;
      const kept = Array.from({ length: count }, (_, t) => t).filter((t) => {
        const at = meanOf(cornersAlong(t, axis));
        return t !== element && (flipped ? at >= limit : at <= limit);
      });
      const own = corners(element);
      const centre = mean(own);
      for (const corner of own) {
        const from = between(corner, centre, 0.01);
        for (const t of kept) expect(isHit(corners(t), from, eye)).toBe(false);
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
