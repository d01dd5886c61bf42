import { BufferAttribute, Group, MeshBasicMaterial, type BufferGeometry, type Mesh } from "three";
import { expect, it } from "vitest";
import type { DrawnSurface } from "../../../web/document/drawn-surface";
import { BodyPieces } from "../../../web/viewer/layers/body-pieces";

const triangles = 250_000;
const surface: DrawnSurface = {
  centre: [0, 0, 0],
  low: [-1, -1, -1],
  high: [1, 1, 1],
  corners: new Float32Array(9 * triangles).map((_, i) => i),
  order: new Uint32Array(triangles),
  patchOffsets: Uint32Array.of(0, triangles),
  values: null,
};

it("a large surface is drawn in pieces, one more with each frame, with the states of its vertices", () => {
  const root = new Group();
  const pieces = new BodyPieces(root);
  const material = new MeshBasicMaterial();
  pieces.setTriangles(surface, [material, material, material]);
  const states = new BufferAttribute(new Uint8Array(3 * triangles).fill(1), 1);
  pieces.show(states, [true, false, false]);
  const all = root.children as Mesh<BufferGeometry>[];
  const visible = (): number => all.filter((mesh) => mesh.visible).length;
  const solid = all.filter((_, k) => k % 3 === 0);
  expect(solid).toHaveLength(3);
  expect(visible()).toBe(1);
  const drawn = [visible()];
  while (pieces.drawMore()) drawn.push(visible());
  expect(drawn).toEqual([1, 2, 3]);
  // Together, the pieces are the surface; none is measured by the renderer.
  const parts = solid.map(({ geometry }) => geometry.getAttribute("position").array);
  expect(parts.reduce((sum, { length }) => sum + length, 0)).toBe(9 * triangles);
  expect(parts.map(([first]) => first)).toEqual(parts.map((_, p) => 9 * Math.floor((p * triangles) / 3)));
  for (const { geometry } of solid) expect(geometry.boundingSphere?.radius).toBeCloseTo(Math.sqrt(3));

  const codes = (): unknown[] => solid.map(({ geometry }) => geometry.getAttribute("state").array.at(-1));
  const versions = (): number[] =>
    solid.map(({ geometry }) => (geometry.getAttribute("state") as BufferAttribute).version);
  expect(codes()).toEqual([1, 1, 1]);
  const before = versions();
  states.array.fill(2);
  states.addUpdateRange(0, 3 * triangles);
  states.needsUpdate = true;
  pieces.show(states, [true, true, false]);
  expect(codes()).toEqual([2, 2, 2]);
  expect(versions()).toEqual(before.map((version) => version + 1));

  // Only changed vertices are copied to the GPU.
  const ranges = () =>
    solid.map(({ geometry }) => (geometry.getAttribute("state") as BufferAttribute).updateRanges);
  for (const { geometry } of solid) (geometry.getAttribute("state") as BufferAttribute).clearUpdateRanges();
  const second = 3 * Math.floor(triangles / 3);
  states.array.fill(3, second - 6, second + 9);
  states.addUpdateRange(second - 6, 15);
  states.needsUpdate = true;
  pieces.show(states, [true, true, false]);
  expect(ranges()).toEqual([[{ start: second - 6, count: 6 }], [{ start: 0, count: 9 }], []]);
  expect(versions()).toEqual(before.map((version, p) => version + (p < 2 ? 2 : 1)));
  expect(visible()).toBe(6);
  pieces.dispose();
  expect(root.children).toHaveLength(0);
});
