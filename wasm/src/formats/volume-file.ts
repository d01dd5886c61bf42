/** Volumes from files, for use as background grids: tetrahedra and the values at their nodes. */
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh, NodeData } from "../mesh/mesh.js";
import { ReadFailure } from "./read-result.js";

/**
 * Returns the tetrahedra of a file with the nodes they use, in file order. Throws a ReadFailure if there are none
 * or if a corner is not a node. O(n).
 */
export function* volumeOf({ points, tetrahedra, nodeData, ...rest }: Mesh): Steps<Mesh> {
  const remedy = "Use a file with linear tetrahedra.";
  if (tetrahedra.length === 0) {
    throw new ReadFailure({ code: "no-tetrahedra", message: "the file contains no tetrahedra", remedy });
  }
  const numbers = new Uint32Array(points.length / 3).fill(UNUSED);
  yield* stepwise(tetrahedra.length, (i) => {
    const node = tetrahedra[i] ?? 0;
    if (node >= numbers.length) {
      const message = `tetrahedron ${Math.floor(i / 4)} (counted from 0) refers to a node that does not exist`;
      throw new ReadFailure({ message, remedy });
    }
    numbers[node] = 0;
  });
  let count = 0;
  yield* stepwise(numbers.length, (node) => {
    if (numbers[node] !== UNUSED) numbers[node] = count++;
  });
  const renumbered = new Uint32Array(tetrahedra.length);
  yield* stepwise(renumbered.length, (i) => (renumbered[i] = numbers[tetrahedra[i] ?? 0] ?? 0));
  const kept = new Map<string, NodeData>();
  for (const [name, { components, values }] of nodeData) {
    kept.set(name, { components, values: yield* rowsKept(values, components, numbers, count) });
  }
  return {
    ...rest,
    points: yield* rowsKept(points, 3, numbers, count),
    tetrahedra: renumbered,
    nodeData: kept,
    triangles: new Uint32Array(),
    trianglePatch: new Uint32Array(),
    patches: [],
  };
}

/** Marks a node without an index. */
const UNUSED = 0xffffffff;

/** Returns the rows of the nodes that have an index, in order; `count` is their number. */
function* rowsKept(
  values: Float64Array,
  stride: number,
  numbers: Uint32Array,
  count: number,
): Steps<Float64Array> {
  const kept = new Float64Array(stride * count);
  let end = 0;
  yield* stepwise(numbers.length, (node) => {
    if (numbers[node] === UNUSED) return;
    for (let i = 0; i < stride; i++) kept[end++] = values[stride * node + i] ?? NaN;
  });
  return kept;
}
