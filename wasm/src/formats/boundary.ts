/** The triangles of a mesh with only the points they use, for formats that hold surfaces. */
import type { FileMesh } from "./file-mesh.js";

/** The same mesh without tetrahedra; nodes keep their order. */
export function boundaryOf(mesh: FileMesh): FileMesh {
  const { points, triangles } = mesh;
  const numbers = new Uint32Array(points.length / 3);
  for (const node of triangles) numbers[node] = 1;
  const total = numbers.reduce((sum, used) => sum + used, 0);
  if (total === numbers.length) return { ...mesh, ...NO_VOLUME };
  let count = 0;
  const kept = new Float64Array(3 * total);
  numbers.forEach((used, node) => {
    if (used === 0) return;
    kept.set(points.subarray(3 * node, 3 * node + 3), 3 * count);
    numbers[node] = count++;
  });
  return {
    ...mesh,
    points: kept,
    triangles: triangles.map((node) => numbers[node] ?? 0),
    ...NO_VOLUME,
  };
}

const NO_VOLUME = {
  tetrahedra: new Uint32Array(),
  tetrahedronRegion: new Uint32Array(),
  regions: [],
  nodeData: new Map(),
} satisfies Partial<FileMesh>;

/** A colour per patch: its own, or one of a row that eyes tell apart (Okabe and Ito), again and again. */
export function colorsOf({ patches }: FileMesh): (readonly [number, number, number])[] {
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
