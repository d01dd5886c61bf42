/** Extracts the triangles of a mesh with the points they use, for formats that hold surfaces only. */
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";

/** Returns the mesh without tetrahedra and unused nodes; the order of nodes is kept. */
export function* boundaryOf(mesh: Mesh): Steps<Mesh> {
  const { points, triangles } = mesh;
  const numbers = new Uint32Array(points.length / 3);
  let total = 0;
  yield* stepwise(triangles.length, (i) => {
    const node = triangles[i] ?? 0;
    total += 1 - (numbers[node] ?? 0);
    numbers[node] = 1;
  });
  if (total === numbers.length) return { ...mesh, ...noVolume() };
  let count = 0;
  const kept = new Float64Array(3 * total);
  yield* stepwise(numbers.length, (node) => {
    if (numbers[node] === 0) return;
    for (let axis = 0; axis < 3; axis++) kept[3 * count + axis] = points[3 * node + axis] ?? 0;
    numbers[node] = count++;
  });
  const renumbered = new Uint32Array(triangles.length);
  yield* stepwise(triangles.length, (i) => (renumbered[i] = numbers[triangles[i] ?? 0] ?? 0));
  return {
    ...mesh,
    points: kept,
    triangles: renumbered,
    ...noVolume(),
  };
}

/** Returns the parts of a mesh without tetrahedra. They are its own: arrays that are transferred are lost. */
export const noVolume = () =>
  ({
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
    regions: [],
    nodeData: new Map(),
    elementData: undefined,
  }) satisfies Partial<Mesh>;

/** Returns a colour per patch: its own, or one of a cyclic list of distinguishable colours (Okabe and Ito). */
export function colorsOf({ patches }: Mesh): (readonly [number, number, number])[] {
  return patches.map(({ color }, p) => color ?? DISTINCT[p % DISTINCT.length] ?? [0.5, 0.5, 0.5]);
}

const DISTINCT = [
  [0, 0.447, 0.698],
  [0.902, 0.624, 0],
  [0, 0.62, 0.451],
  [0.8, 0.475, 0.655],
  [0.337, 0.706, 0.914],
  [0.835, 0.369, 0],
  [0.941, 0.894, 0.259],
] as const;
