/** Volumes from files, to be background grids: tetrahedra, and whatever numbers their nodes carry. */
import { ReadFailure } from "../read-result.js";
import type { FileMesh, NodeData } from "./file-mesh.js";

/** Every node belongs to a tetrahedron. */
export interface VolumeFile {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Four node positions per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** By name, as in the file. */
  readonly nodeData: ReadonlyMap<string, NodeData>;
}

/**
 * The tetrahedra of a file with the nodes they use, in the order of the file. Throws a ReadFailure
 * where a corner is no node, or there is no tetrahedron.
 */
export function volumeFile(
  points: Float64Array,
  corners: ArrayLike<number>,
  nodeData: ReadonlyMap<string, NodeData>,
  remedy: string,
): VolumeFile {
  const count = points.length / 3;
  if (corners.length === 0) {
    throw new ReadFailure({ code: "no-tetrahedra", message: "the file holds no tetrahedron", remedy });
  }
  const isUsed = new Uint8Array(count);
  for (let i = 0; i < corners.length; i++) {
    const node = corners[i] ?? NaN;
    if (!(Number.isInteger(node) && node >= 0 && node < count)) {
      const message = `tetrahedron ${Math.floor(i / 4)} (counted from 0) has a corner that is no node`;
      throw new ReadFailure({ message, remedy });
    }
    isUsed[node] = 1;
  }
  const kept: number[] = [];
  isUsed.forEach((used, node) => {
    if (used === 1) kept.push(node);
  });
  const numbers = new Uint32Array(count);
  kept.forEach((node, number) => (numbers[node] = number));
  return {
    points: pick(points, 3, kept),
    tetrahedra: Uint32Array.from(corners, (node) => numbers[node] ?? 0),
    nodeData: new Map(
      [...nodeData].map(([name, { components, values }]) => [
        name,
        { components, values: pick(values, components, kept) },
      ]),
    ),
  };
}

function pick(values: Float64Array, stride: number, kept: readonly number[]): Float64Array {
  const picked = new Float64Array(stride * kept.length);
  kept.forEach((node, i) => picked.set(values.subarray(stride * node, stride * (node + 1)), stride * i));
  return picked;
}

/** The tetrahedra of a file with the nodes they use. Throws a ReadFailure where there are none. */
export function volumeOf({ points, tetrahedra, nodeData }: FileMesh): VolumeFile {
  return volumeFile(points, tetrahedra, nodeData, "Give a file with linear tetrahedra.");
}
