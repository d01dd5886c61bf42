import type { SurfaceMesh, VolumeMesh } from "tetrafront";
import { faceNodes } from "./topology";

function placesOf(points: Float64Array, nodes: readonly number[]): number[] {
  return nodes.flatMap((node) => [0, 1, 2].map((axis) => points[3 * node + axis] ?? 0));
}

/** The corners of an element's four faces, x y z each. */
export function elementCorners({ points, tetrahedra }: VolumeMesh, element: number): number[] {
  return placesOf(
    points,
    faceNodes.map((node) => tetrahedra[4 * element + node] ?? 0),
  );
}

/** The corners of some triangles, x y z each; those that are not there are left out. */
export function triangleCorners({ points, triangles }: SurfaceMesh, wanted: readonly number[]): number[] {
  const present = wanted.filter((triangle) => 3 * triangle + 2 < triangles.length);
  return placesOf(
    points,
    present.flatMap((triangle) => [...triangles.subarray(3 * triangle, 3 * triangle + 3)]),
  );
}
