/** Measures of a mesh, independent of the package. */
import type { Mesh } from "./mesh-files.js";

/** Returns the number of tetrahedra at each face, by its nodes in order. */
function tetrahedraAtFaces(tetrahedra: Mesh["tetrahedra"]): Map<string, number> {
  const faces = new Map<string, number>();
  for (const nodes of tetrahedra) {
    for (const left of nodes) {
      const key = nodes
        .filter((node) => node !== left)
        .toSorted((p, q) => p - q)
        .join();
      faces.set(key, (faces.get(key) ?? 0) + 1);
    }
  }
  return faces;
}

/** Returns the number of faces of one tetrahedron only. */
export function boundaryTriangles({ tetrahedra }: Mesh): number {
  return [...tetrahedraAtFaces(tetrahedra).values()].filter((count) => count === 1).length;
}

/** Returns the volume of a mesh, and how many elements, faces and edges of its boundary are invalid. */
export function measured({ points, tetrahedra }: Mesh) {
  const at = (node: number): number[] => [...points.subarray(3 * node, 3 * node + 3)];
  const sixfold = tetrahedra.map((nodes) => {
    const [a = [], b = [], c = [], d = []] = nodes.map(at);
    const [u, v, w] = [b, c, d].map((p) => p.map((x, k) => x - (a[k] ?? 0)));
    const [[ux = 0, uy = 0, uz = 0] = [], [vx = 0, vy = 0, vz = 0] = [], [wx = 0, wy = 0, wz = 0] = []] = [
      u,
      v,
      w,
    ];
    return ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx);
  });
  const faces = tetrahedraAtFaces(tetrahedra);
  const edges = new Map<string, number>();
  for (const [key, count] of faces) {
    if (count > 1) continue;
    const corners = key.split(",");
    for (const left of corners) {
      const edge = corners.filter((corner) => corner !== left).join();
      edges.set(edge, (edges.get(edge) ?? 0) + 1);
    }
  }
  return {
    volume: sixfold.reduce((sum, six) => sum + six / 6, 0),
    inverted: sixfold.filter((six) => six <= 0).length,
    crowdedFaces: [...faces.values()].filter((count) => count > 2).length,
    openEdges: [...edges.values()].filter((count) => count % 2 === 1).length,
  };
}
