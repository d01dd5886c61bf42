import type { Mesh } from "tetrafront";
import type { Elements } from "../document/mesh-quality";
import type { SceneState } from "./scene-state";
import { bodyCorners } from "./shown-bodies";
import { faceNodes } from "./queries/topology";

function cornersOf(points: Float64Array, nodes: readonly number[]): number[] {
  return nodes.flatMap((node) => [0, 1, 2].map((axis) => points[3 * node + axis] ?? 0));
}

/** Returns the corners of an element's four faces, x y z each. */
export function elementCorners({ points, tetrahedra }: Elements, element: number): number[] {
  return cornersOf(
    points,
    faceNodes.map((node) => tetrahedra[4 * element + node] ?? 0),
  );
}

/** Returns the corners of some triangles, x y z each. Leaves out indices that are out of range. */
export function triangleCorners(
  { points, triangles }: Pick<Mesh, "points" | "triangles">,
  indices: readonly number[],
): number[] {
  const present = indices.filter((triangle) => 3 * triangle + 2 < triangles.length);
  return cornersOf(
    points,
    present.flatMap((triangle) => [...triangles.subarray(3 * triangle, 3 * triangle + 3)]),
  );
}

/** Returns the corners of the selected element or triangles. */
export function selectedCorners({
  element,
  triangles,
  markedBody,
  mesh,
  checkedSurface,
  bodies,
}: SceneState): number[] {
  if (element !== null) return mesh ? elementCorners(mesh.mesh, element) : [];
  if (markedBody !== null) {
    const body = bodies.find(({ id }) => id === markedBody);
    return body ? bodyCorners(body, triangles) : [];
  }
  return checkedSurface ? triangleCorners(checkedSurface, triangles) : [];
}

/** Returns the corners of the triangles that errors name. */
export function defectiveCorners({ checkedSurface, defects, bodies }: SceneState): number[] {
  const ofBodies = bodies.flatMap((body) => bodyCorners(body, defects.bodies.get(body.id) ?? []));
  return [...(checkedSurface ? triangleCorners(checkedSurface, defects.triangles) : []), ...ofBodies];
}
