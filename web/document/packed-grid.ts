import type { Project, ProjectBackgroundNode } from "tetrafront";

type Nodes = Project["background"]["nodes"];
type Tetrahedra = Project["background"]["tetrahedra"];

/** A background grid as flat arrays, which a browser stores a hundred times as fast as its text. */
export interface PackedGrid {
  /** Per node: id, x y z, size, stretching, direction x y z; not a number where there is none. */
  readonly nodes: Float64Array;
  /** Four node ids per tetrahedron. */
  readonly tetrahedra: Float64Array;
}

/** Numbers per node. */
const stride = 9;

export function packNodes(nodes: Nodes): Float64Array {
  const packed = new Float64Array(stride * nodes.length).fill(NaN);
  nodes.forEach(({ id, at, size, stretching, direction }, i) => {
    const first = stride * i;
    packed[first] = id;
    packed.set(at, first + 1);
    packed[first + 4] = size;
    if (stretching !== undefined) packed[first + 5] = stretching;
    if (direction !== undefined) packed.set(direction, first + 6);
  });
  return packed;
}

export function packTetrahedra(tetrahedra: Tetrahedra): Float64Array {
  const packed = new Float64Array(4 * tetrahedra.length);
  let out = 0;
  for (const corners of tetrahedra) for (const id of corners) packed[out++] = id;
  return packed;
}

export function unpackNodes(packed: Float64Array): Nodes {
  return Array.from({ length: packed.length / stride }, (_, i): ProjectBackgroundNode => {
    const [id = 0, x = 0, y = 0, z = 0, size = 0, stretching = NaN, u = NaN, v = NaN, w = NaN] =
      packed.subarray(stride * i, stride * (i + 1));
    return {
      id,
      at: [x, y, z],
      size,
      ...(Number.isNaN(stretching) ? {} : { stretching }),
      ...(Number.isNaN(u) ? {} : { direction: [u, v, w] as const }),
    };
  });
}

export function unpackTetrahedra(packed: Float64Array): Tetrahedra {
  return Array.from({ length: packed.length / 4 }, (_, t) => {
    const [a = 0, b = 0, c = 0, d = 0] = packed.subarray(4 * t, 4 * t + 4);
    return [a, b, c, d] as const;
  });
}
