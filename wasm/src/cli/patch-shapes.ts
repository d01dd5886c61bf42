/** Areas and normals of the patches of a mesh, by which a user recognizes them. */
import type { Mesh } from "../mesh/mesh.js";

interface PatchShape {
  /** Sum of the areas of its triangles. */
  readonly area: number;
  /** The unit normal, to the side from which the triangles are counter-clockwise; null if the patch is not flat. */
  readonly normal: readonly number[] | null;
}

/** A patch is flat if its area vectors add up to a vector of the length of its area. Largest relative difference. */
const FLAT = 1e-6;

/** Returns the shape of each patch of the mesh, in their order. */
export function patchShapes({
  patches,
  trianglePatch,
  triangles,
  points,
}: Pick<Mesh, "patches" | "trianglePatch" | "triangles" | "points">): PatchShape[] {
  const sums = patches.map(() => ({ area: 0, vector: [0, 0, 0] }));
  trianglePatch.forEach((patch, triangle) => {
    const sum = sums[patch];
    if (sum === undefined) return;
    const vector = areaVector(points, triangles.subarray(3 * triangle, 3 * triangle + 3));
    sum.area += Math.hypot(...vector);
    sum.vector = sum.vector.map((value, axis) => value + (vector[axis] ?? 0));
  });
  return sums.map(({ area, vector }) => {
    const length = Math.hypot(...vector);
    const isFlat = area > 0 && length >= (1 - FLAT) * area;
    return { area, normal: isFlat ? vector.map((value) => value / length) : null };
  });
}

/** Half the cross product of two edges: its length is the area of the triangle. */
function areaVector(points: Float64Array, [a = 0, b = 0, c = 0]: Uint32Array): readonly number[] {
  const edge = (to: number) =>
    [0, 1, 2].map((axis) => (points[3 * to + axis] ?? 0) - (points[3 * a + axis] ?? 0));
  const [[ux = 0, uy = 0, uz = 0], [vx = 0, vy = 0, vz = 0]] = [edge(b), edge(c)];
  return [(uy * vz - uz * vy) / 2, (uz * vx - ux * vz) / 2, (ux * vy - uy * vx) / 2];
}
