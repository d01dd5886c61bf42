/** Recognizes surfaces without topology in formats whose triangles refer to nodes. */
import { type Steps, stepwise } from "../base/steps.js";

/**
 * Returns whether no two polygons of a surface share a node, as if each were read by itself. The triangles of a polygon
 * follow each other. O(n), and O(1) for most surfaces that share nodes.
 */
export function* isSoup(triangles: Uint32Array, nodes: number): Steps<boolean> {
  const count = triangles.length / 3;
  // A polygon of n corners has n - 2 triangles.
  if (count < 2 || count >= nodes) return false;
  const polygonOf = new Uint32Array(nodes);
  let [polygon, corners, size, isApart] = [0, 0, 0, true];
  yield* stepwise(count, (t) => {
    const known = [0, 1, 2].map((corner) => polygonOf[triangles[3 * t + corner] ?? 0] ?? 0);
    if (known.every((one) => one === 0)) {
      isApart &&= size === corners - 2 || polygon === 0;
      [polygon, corners, size] = [polygon + 1, 0, 0];
    }
    isApart &&= known.every((one) => one === 0 || one === polygon);
    size++;
    for (let corner = 3 * t; corner < 3 * t + 3; corner++) {
      const node = triangles[corner] ?? 0;
      if (polygonOf[node] === 0) corners++;
      polygonOf[node] = polygon;
    }
  });
  return isApart && polygon > 1 && size === corners - 2;
}
