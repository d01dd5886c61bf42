/** Values of the tetrahedra for files that list triangles too: a triangle has the value of the tetrahedron behind it. */
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh, NodeData } from "../mesh/mesh.js";
import { NONE, tetFaces } from "./tet-faces.js";

/** Returns the values of the tetrahedra, then of the triangles; NaN for a triangle without a tetrahedron. O(n). */
export function* cellDataOf(mesh: Mesh): Steps<ReadonlyMap<string, NodeData>> {
  const { elementData = new Map<string, NodeData>(), tetrahedra, triangles } = mesh;
  if (elementData.size === 0) return elementData;
  const { faceOfTriangle } = yield* tetFaces(mesh);
  const [tets, faces] = [tetrahedra.length / 4, triangles.length / 3];
  const data = new Map<string, NodeData>();
  for (const [name, { components, values }] of elementData) {
    const all = new Float64Array(components * (tets + faces)).fill(NaN);
    all.set(values);
    yield* stepwise(faces, (triangle) => {
      const face = faceOfTriangle[triangle] ?? NONE;
      if (face === NONE) return;
      const first = components * (face >>> 2);
      all.set(values.subarray(first, first + components), components * (tets + triangle));
    });
    data.set(name, { components, values: all });
  }
  return data;
}

/**
 * Returns the cells in the order of files that list the triangles of each patch, then the tetrahedra of each region. Tetrahedra are
 * numbered from 0, triangles after them.
 */
export function* cellsByGroup({
  trianglePatch,
  patches,
  tetrahedronRegion,
  regions,
}: Mesh): Steps<Uint32Array> {
  const tets = tetrahedronRegion.length;
  const order = new Uint32Array(tets + trianglePatch.length);
  let begin = 0;
  for (const [owners, count, first] of [
    [trianglePatch, patches.length, tets],
    [tetrahedronRegion, regions.length, 0],
  ] as const) {
    const next = new Uint32Array(count + 1);
    yield* stepwise(owners.length, (e) => {
      const after = (owners[e] ?? 0) + 1;
      next[after] = (next[after] ?? 0) + 1;
    });
    next.forEach((size, g) => (next[g] = size + (g === 0 ? begin : (next[g - 1] ?? 0))));
    yield* stepwise(owners.length, (e) => {
      const owner = owners[e] ?? 0;
      const at = next[owner] ?? 0;
      order[at] = first + e;
      next[owner] = at + 1;
    });
    begin += owners.length;
  }
  return order;
}
